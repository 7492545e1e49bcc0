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
nitpick_ignore_regex = [
    ("py:.*", r"(numpy|np|matplotlib|xarray|distributed|collections|os|typing)\..*"),
    ("py:.*", r"pandas\..*"),
]

# Links to headings work as they do where the pages are read without a site.
myst_heading_anchors = 3
myst_links_external_new_tab = False

nb_execution_mode = "force"
nb_execution_raise_on_error = True
nb_execution_timeout = 120
nb_execution_in_temp = True
nb_merge_streams = True

autodoc_member_order = "bysource"
autodoc_typehints = "signature"
# Named at the top of the reference, which is where they are explained.
# fmt: off
TYPES = (
    "Vector", "Pair", "Size", "Amount", "Matrix", "Vectors", "Triples", "ArrayLike", "Channels", "Progress", "SceneOrPath",
    "AnyLight", "AnyShape", "ConventionName", "Quantities", "Precision", "Elsewhere", "Side", "SurfaceProjection", "Colormap",
    "Handedness",
)
# fmt: on
PLAIN = {"Number": "float", "Whole": "int", "Word": "str", "Flag": "bool", "MaterialName": "str", "File": "str"}
nitpick_ignore_regex.append(("py:.*", rf"(isophote\._types\.)?({'|'.join(TYPES)})"))
autodoc_type_aliases = {name: name for name in (*TYPES, *PLAIN)}
maximum_signature_line_length = 90
python_use_unqualified_type_names = True
# Nobody makes these but the package.
RESULTS = ("Map", "SurfaceMap", "GridMap", "Values", "Probes", "Section", "MapFile")

copybutton_prompt_text = r">>> |\.\.\. "
copybutton_prompt_is_regexp = True

html_theme = "furo"
html_title = f"Isophote {release}"
html_show_copyright = False
html_show_sourcelink = False
html_copy_source = False


def signature(app, what, name, obj, options, signature, returned):
    """Types as users know them, in place of those that tell the package how to convert what they write."""
    if what == "class" and name.removeprefix("isophote.") in RESULTS:
        return "", None
    if signature is not None:
        signature = re.sub(r"TypeAliasForwardRef\('(\w+)'\)", r"\1", signature)
        signature = re.sub(r"~?[\w.]*Annotated\[(.+?), <function .+? at 0x[0-9a-f]+>\]", r"\1", signature)
        signature = re.sub(rf"\b({'|'.join(PLAIN)})\b", lambda match: PLAIN[match[0]], signature)
        signature = signature.replace("<factory>", "{}")
    if returned is not None:
        returned = re.sub(r"~numpy\.ndarray\[.+?, ~numpy\.dtype\[(.+?)\]\]", r"~numpy.typing.NDArray[\1]", returned)
        if returned.endswith("PartType"):
            returned = name.split(".")[-2]
    return signature, returned


def docstring(app, what, name, obj, options, lines):
    """What is said of parameters, which is a line each, becomes a list."""
    listed, within = [], False
    for line in lines:
        if re.match(r"``\w+``(, ``\w+``)*:", line):
            listed.extend([f"- {line}"] if within else ["", f"- {line}"])
            within = True
        else:
            within = within and bool(line.strip())
            listed.append(f"  {line}" if within else line)
    lines[:] = listed


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
    app.connect("autodoc-process-signature", signature)
    app.connect("autodoc-process-docstring", docstring)
