# SPDX-License-Identifier: GPL-3.0-or-later
"""``python -m meander.jobs JOB.toml ...``: farm.py for the Python package."""

import sys

from .command import main

if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
