"""How the site is built: `make docs`."""

import os
import re
import sys
from pathlib import Path

DOCS = Path(__file__).resolve().parent
ROOT = DOCS.parent
# For autodoc, and for the kernels of notebooks.
sys.path.insert(0, str(ROOT / "python"))
os.environ["PYTHONPATH"] = os.pathsep.join(filter(None, [str(ROOT / "python"), os.environ.get("PYTHONPATH")]))
os.environ["MPLBACKEND"] = "module://matplotlib_inline.backend_inline"

import isophote  # noqa: E402

project = "Isophote"
author = "the Isophote authors"
version = release = isophote.__version__
language = "en"
extensions = ["myst_nb", "sphinx.ext.autodoc", "sphinx_copybutton"]
exclude_patterns = ["requirements.txt"]
# Blocks without a language are commands and formulas.
highlight_language = "text"
nitpicky = True
# Types of other packages, which are linked nowhere: the site is built without the network.
nitpick_ignore_regex = [("py:.*", r"(numpy|np|matplotlib|xarray|distributed|collections|os|typing)\..*")]

# Links to headings work as they do where the pages are read without a site.
myst_heading_anchors = 3
myst_links_external_new_tab = False

nb_execution_mode = "force"
nb_execution_raise_on_error = True
nb_execution_timeout = 120

autodoc_member_order = "bysource"
autodoc_typehints = "description"
autodoc_class_signature = "mixed"

copybutton_prompt_text = r">>> |\.\.\. "
copybutton_prompt_is_regexp = True

html_theme = "furo"
html_title = f"Isophote {release}"
html_show_copyright = False
html_show_sourcelink = False


def setup(app):
    """Pages of the repository that are none of the site become files to download, as links to other files do."""
    link = re.compile(r"\]\(((?:\.\./)+[^)#\s]+\.md)\)")

    def outside(match, page):
        target = (page.parent / match[1]).resolve()
        return match[0] if target.is_relative_to(DOCS) else f"](path:{match[1]})"

    def read(app, name, source):
        page = Path(app.env.doc2path(name))
        source[0] = link.sub(lambda match: outside(match, page), source[0])

    app.connect("source-read", read)
