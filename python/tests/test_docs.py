"""The examples of the documentation do what they say, and both languages have the same ones.

Run as a program, this draws the tutorial's pictures anew.
"""

from __future__ import annotations

import doctest
import importlib
import os
import re
import shutil
import sys
import tempfile
import warnings
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from sybil import Document, Sybil
from sybil.parsers.myst import PythonCodeBlockParser

ROOT = Path(__file__).resolve().parents[2]
DOCS = ROOT / "docs"
PAGES = [
    ROOT / "README.md",
    ROOT / "README.ru.md",
    *(DOCS / name for name in ("tutorial.md", "tutorial.ru.md", "conventions.md", "conventions.ru.md", "validation.md")),
    *sorted((DOCS / "python").glob("*.md")),
]
MODULES = [path for path in sorted((ROOT / "python/isophote").glob("*.py")) if ">>>" in path.read_text(encoding="utf-8")]
NOTEBOOKS = sorted((DOCS / "notebooks").glob("*.ipynb"))
TRANSLATED = [DOCS / "tutorial.md", DOCS / "conventions.md", ROOT / "README.md"]
# Of a picture's brightness: room for another version of matplotlib, none for another curve or map.
PICTURES_DIFFER_BY = 0.02


def _name(path: Path) -> str:
    return path.relative_to(ROOT).as_posix()


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[Path]:
    """Where an example may write files."""
    plt = pytest.importorskip("matplotlib.pyplot")
    plt.switch_backend("agg")
    monkeypatch.chdir(tmp_path)
    yield tmp_path
    plt.close("all")


def _read(page: Path) -> Document:
    parsers = [PythonCodeBlockParser(doctest_optionflags=doctest.ELLIPSIS)]
    return Sybil(parsers=parsers, path=str(page.parent), pattern=page.name).parse(page)


def _run(page: Path) -> None:
    for example in _read(page).examples():
        example.evaluate()


def _pictures(page: Path) -> list[Path]:
    """The pictures that a page shows and its own examples draw."""
    text = page.read_text(encoding="utf-8")
    shown = [page.parent / link for link in re.findall(r"!\[[^\]]*\]\(([^)]+\.png)\)", text)]
    return [picture for picture in shown if f'savefig("{picture.name}")' in text]


@pytest.mark.filterwarnings("error")
@pytest.mark.parametrize("page", PAGES, ids=_name)
def test_every_example_gives_what_the_page_shows(page: Path, folder: Path) -> None:
    """Word for word; and the pictures are those that the examples draw."""
    from matplotlib.image import imread

    if re.search("render_to_zarr|store=", page.read_text(encoding="utf-8")):
        pytest.importorskip("zarr", reason="Python 3.10 has no zarr 3")
    _run(page)
    for picture in _pictures(page):
        there, drawn = imread(picture), imread(folder / picture.name)
        assert there.shape == drawn.shape, f"{picture.name} has another size: run make docs-figures"
        difference = float(np.abs(there - drawn).mean())
        assert difference < PICTURES_DIFFER_BY, f"{picture.name} is out of date by {difference}: run make docs-figures"


@pytest.mark.filterwarnings("error")
@pytest.mark.parametrize("module", MODULES, ids=_name)
def test_every_example_in_a_docstring_gives_what_it_shows(module: Path, folder: Path) -> None:
    """Those that `help` and the reference show."""
    name = ".".join(("isophote", *(() if module.stem == "__init__" else (module.stem,))))
    assert doctest.testmod(importlib.import_module(name)).failed == 0


@pytest.mark.parametrize("notebook", NOTEBOOKS, ids=_name)
def test_every_notebook_runs_from_its_first_cell_to_its_last(notebook: Path, folder: Path) -> None:
    """With warnings as errors. What a cell asserts holds."""
    nbclient = pytest.importorskip("nbclient")
    nbformat = pytest.importorskip("nbformat")
    cells: Any = nbformat.read(notebook, as_version=4)
    strict = nbformat.v4.new_code_cell("import warnings\nwarnings.simplefilter('error')")
    cells.cells.insert(0, strict)
    environment = os.environ | {
        "MPLBACKEND": "agg",
        "PYTHONPATH": os.pathsep.join(filter(None, [str(ROOT / "python"), os.environ.get("PYTHONPATH")])),
    }
    with warnings.catch_warnings():
        # Those of the client's own sockets and files; the kernel is another process.
        warnings.simplefilter("ignore")
        client = nbclient.NotebookClient(
            cells, timeout=120, kernel_name="python3", resources={"metadata": {"path": str(folder)}}
        )
        client.execute(env=environment)


@pytest.mark.parametrize("notebook", NOTEBOOKS, ids=_name)
def test_a_notebook_is_committed_without_outputs(notebook: Path) -> None:
    """They would be of somebody's machine; the site shows those of its own."""
    nbformat = pytest.importorskip("nbformat")
    cells = nbformat.read(notebook, as_version=4)
    nbformat.validate(cells)
    assert all(not cell.outputs and cell.execution_count is None for cell in cells.cells if cell.cell_type == "code")


@pytest.mark.parametrize("page", TRANSLATED, ids=_name)
def test_a_translated_page_has_the_same_examples(page: Path) -> None:
    """Whoever changes one changes the other; only what comments say is translated."""
    english, russian = (
        [re.sub(r"\s+# .*", "", code) for code in re.findall(r"^```python\n(.*?)^```", text, re.M | re.S)]
        for text in (path.read_text(encoding="utf-8") for path in (page, page.with_suffix(".ru.md")))
    )
    assert english == russian


@pytest.mark.parametrize("notebook", [path for path in NOTEBOOKS if path.stem.endswith(".ru")], ids=_name)
def test_a_translated_notebook_has_the_same_cells(notebook: Path) -> None:
    """In the same order, and the same code in them."""
    nbformat = pytest.importorskip("nbformat")
    original = notebook.with_name(notebook.name.replace(".ru.", "."))
    english, russian = (nbformat.read(path, as_version=4).cells for path in (original, notebook))
    assert [cell.cell_type for cell in english] == [cell.cell_type for cell in russian]
    assert [cell.source for cell in english if cell.cell_type == "code"] == [
        cell.source for cell in russian if cell.cell_type == "code"
    ]


def _draw() -> None:
    import matplotlib

    matplotlib.use("agg")
    for page in PAGES:
        pictures = _pictures(page)
        if not pictures:
            continue
        with tempfile.TemporaryDirectory() as folder:
            os.chdir(folder)
            _run(page)
            for picture in pictures:
                picture.parent.mkdir(parents=True, exist_ok=True)
                shutil.copy(picture.name, picture)
                sys.stdout.write(f"wrote {_name(picture)}\n")
            os.chdir(ROOT)


if __name__ == "__main__":
    _draw()
