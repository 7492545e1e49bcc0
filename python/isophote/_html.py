"""HTML for notebooks."""

from __future__ import annotations


def escaped(text: str) -> str:
    """Text escaped for HTML."""
    import html

    return html.escape(text)


def image(png: bytes, description: str) -> str:
    """An image embedded in the page."""
    import base64

    data = base64.b64encode(png).decode("ascii")
    return f'<img src="data:image/png;base64,{data}" alt="{escaped(description)}" style="max-width: 320px">'


def table(rows: list[tuple[str, str]]) -> str:
    """A two-column table of names and values."""
    cells = (f"<tr><th style='text-align:left'>{escaped(a)}</th><td>{escaped(b)}</td></tr>" for a, b in rows)
    return f"<table>{''.join(cells)}</table>"
