"""``python -m isophote`` runs the command ``isophote``."""

from __future__ import annotations

import sys

from ._command import main

if __name__ == "__main__":
    sys.exit(main())
