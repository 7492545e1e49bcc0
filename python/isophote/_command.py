"""The command ``isophote``."""

from __future__ import annotations

import sys

from . import _isophote


def main() -> int:
    """Runs the command; returns its exit code."""
    return _isophote.command(["isophote", *sys.argv[1:]])
