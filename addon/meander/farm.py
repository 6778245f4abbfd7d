# SPDX-License-Identifier: GPL-3.0-or-later
"""Fills many surfaces: runs the items of a job file, alone or beside others that do the same.

    python3 <this file> JOB.toml [--jobs N] [--shard I/N] ...
    blender --background --python-exit-code 1 --python <this file> -- JOB.toml ...

The Python, or Blender's own, is 3.11 or later and has numpy. See docs/farm.md, and --help.

Exit codes: 0 all items are done; 1 some have failed, each named with a sentence; 2 the job cannot
be run, with one sentence; 130 interrupted: run again, it goes on.
"""

from __future__ import annotations

import importlib.util
import runpy
import sys
from pathlib import Path

if __name__ == "__main__":
    if importlib.util.find_spec("numpy") is None:
        print(
            "meander: this Python has no numpy, which Meander's options need; install it, or run "
            "this in Blender",
            file=sys.stderr,
        )
        sys.exit(2)
    # The way from a script to its package is the same as batch.py's.
    batch = runpy.run_path(str(Path(__file__).with_name("batch.py")), run_name="batch")
    __package__ = batch["__package__"]

    from .headless.command import arguments_of_process
    from .jobs.command import main

    sys.exit(main(arguments_of_process()))
