# SPDX-License-Identifier: GPL-3.0-or-later
"""Draws what a camera sees on a page: a scene in, an SVG with a layer for each object out.

    blender --background SCENE.blend --python-exit-code 1 --python <this file> -- \\
        --output OUT.svg --spacing 2 --paper a4

It runs from an installed add-on and from a source checkout, inside Blender and under the bpy module
(``python camera.py -- --input SCENE.blend ...``). See docs/make/scene_drawing.md, and --help.

Exit codes: 0 done; 2 bad input, with one sentence on stderr and every output file as it was; 1 a
defect, with a traceback; 130 interrupted from the keyboard, with every output file as it was.
"""

from __future__ import annotations

import runpy
from pathlib import Path

if __name__ == "__main__":
    # The way from a script to its package is the same as batch.py's.
    batch = runpy.run_path(str(Path(__file__).with_name("batch.py")), run_name="batch")
    __package__ = batch["__package__"]

    from .headless.camera import main
    from .headless.command import arguments_of_process, hear_interruptions

    hear_interruptions()
    batch["end"](main(arguments_of_process()))
