# SPDX-License-Identifier: GPL-3.0-or-later
"""Prints the names of the mesh objects in a .blend: a script for Blender, for jobs with patterns.

blender --background --python <this file> -- FILE
"""

from __future__ import annotations

import json
import sys

import bpy

if __name__ == "__main__":
    bpy.ops.wm.open_mainfile(filepath=sys.argv[-1], load_ui=False, use_scripts=False)
    names = sorted(thing.name for thing in bpy.context.scene.objects if thing.type == "MESH")
    print(f"meander objects: {json.dumps(names)}", flush=True)
