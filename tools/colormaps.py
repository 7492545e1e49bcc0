#!/usr/bin/env python3
"""Write crates/isophote-export/src/colormap_tables.rs.

Run from the repository root with matplotlib and cmcrameri installed:

    pip install matplotlib==3.11.2 cmcrameri==1.10
    python tools/colormaps.py

Sources and licences of the tables:

viridis, inferno  S. van der Walt and N. Smith, https://bids.github.io/colormap, CC0
cividis           J. Nuñez, C. Anderton and R. Renslow 2018, doi:10.1371/journal.pone.0199239, CC0
turbo             A. Mikhailov, Google LLC 2019, https://gist.github.com/mikhailov-work/ee72ba4191942acecc03fe6da94fc73f,
                  Apache-2.0
batlow            F. Crameri, Scientific colour maps, doi:10.5281/zenodo.1243862, MIT
"""

from pathlib import Path

import cmcrameri
import matplotlib
import numpy

TABLE_FILE = Path("crates/isophote-export/src/colormap_tables.rs")
COLORS_A_LINE = 10

TABLES = {
    "viridis": (matplotlib.colormaps["viridis"], "S. van der Walt and N. Smith, CC0"),
    "cividis": (matplotlib.colormaps["cividis"], "J. Nuñez, C. Anderton and R. Renslow 2018, CC0"),
    "inferno": (matplotlib.colormaps["inferno"], "S. van der Walt and N. Smith, CC0"),
    "turbo": (matplotlib.colormaps["turbo"], "A. Mikhailov, Google LLC 2019, Apache-2.0"),
    "batlow": (cmcrameri.cm.batlow, "F. Crameri, Scientific colour maps, doi:10.5281/zenodo.1243862, MIT"),
}


def main() -> None:
    tables = "".join(rust_table(name, *entry) for name, entry in TABLES.items())
    TABLE_FILE.write_text(
        "//! Colour tables as 0xRRGGBB (sRGB), written by `tools/colormaps.py`: do not edit.\n"
        '#![expect(clippy::unreadable_literal, reason = "colours are read as RRGGBB")]\n' + tables,
        encoding="utf-8",
    )


def rust_table(name: str, colormap: matplotlib.colors.ListedColormap, source: str) -> str:
    """One table as a Rust constant; each component is rounded to the nearest of 256 steps."""
    colors = numpy.rint(numpy.array(colormap.colors) * 255).astype(int)
    assert colors.shape == (256, 3), (name, colors.shape)
    words = [f"0x{red:02x}{green:02x}{blue:02x}," for red, green, blue in colors]
    lines = [" ".join(words[start : start + COLORS_A_LINE]) for start in range(0, 256, COLORS_A_LINE)]
    rows = "".join(f"    {line}\n" for line in lines)
    return f"\n/// {source}.\n#[rustfmt::skip]\npub(super) const {name.upper()}: [u32; 256] = [\n{rows}];\n"


if __name__ == "__main__":
    main()
