# SPDX-License-Identifier: GPL-3.0-or-later
"""The command of the Python package, as `meander` and as `python -m meander`: a mesh file in, a
filling curve and a report out. Its options and exit codes are those of the add-on's batch command;
all that it says goes to stderr.
"""

from __future__ import annotations

import sys

from .cli import command
from .cli.place import Place


def main() -> int:
    """Runs the command with the arguments of this process, and returns its exit code."""
    place = Place("meander", lambda line: print(line, file=sys.stderr, flush=True))
    return command.main(sys.argv[1:], place)


if __name__ == "__main__":
    sys.exit(main())
