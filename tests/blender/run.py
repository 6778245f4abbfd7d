# SPDX-License-Identifier: GPL-3.0-or-later
"""Runs the tests of this folder inside Blender, or under the bpy module.

    blender -b --factory-startup --python-exit-code 1 --python tests/blender/run.py -- [pytest ...]
    python tests/blender/run.py [pytest ...]
"""

import os
import sys
from pathlib import Path

HERE = Path(__file__).resolve().parent


def main() -> int:
    import pytest

    if "--" in sys.argv:
        arguments = sys.argv[sys.argv.index("--") + 1 :]
    else:
        # Without "--", Blender's own arguments are in argv; under bpy only ours are.
        arguments = sys.argv[1:] if Path(sys.argv[0]).name == Path(__file__).name else []
    if not any(Path(argument.split("::")[0]).exists() for argument in arguments):
        arguments = [*arguments, str(HERE)]
    return int(pytest.main(["-q", "-p", "no:cacheprovider", "--rootdir", str(HERE), *arguments]))


if __name__ == "__main__":
    import bpy

    status = main()
    if not bpy.app.binary_path:
        # As a module, bpy 4.2 frees the classes of panels after Python's interpreter has ended,
        # and crashes or not as memory falls: its exit code would say nothing about the tests.
        sys.stdout.flush()
        sys.stderr.flush()
        os._exit(status)
    sys.exit(status)
