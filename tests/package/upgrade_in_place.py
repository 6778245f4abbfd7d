# SPDX-License-Identifier: GPL-3.0-or-later
"""Blender script of test_installed.py: installs a zip over another one in the same session.

    blender --background --python upgrade_in_place.py -- OLD.zip NEW.zip FOUND.json

Writes which modules are those of the old zip; all of the new one have NEW_VERSION.
"""

import json
import os
import sys
from pathlib import Path

import bpy

# Where bpy is a module of Python, importing it is what puts Blender's own modules on the path.
import addon_utils  # isort: skip

EXTENSION = bpy.app.version >= (4, 2, 0)
NAME = "bl_ext.user_default.meander" if EXTENSION else "meander"


def install(path: str) -> None:
    if EXTENSION:
        bpy.ops.extensions.package_install_files(
            filepath=path, repo="user_default", enable_on_install=True
        )
    else:
        bpy.ops.preferences.addon_install(filepath=path, overwrite=True)
        bpy.ops.preferences.addon_enable(module=NAME)
    _enabled_at_start, loaded = addon_utils.check(NAME)
    if not loaded:
        raise SystemExit(f"{path} could not be enabled")


def fill() -> str:
    bpy.ops.mesh.primitive_cube_add()
    bpy.context.active_object.meander.spacing = 0.5
    bpy.ops.meander.run()
    return bpy.context.active_object.name


old_zip, new_zip, found = sys.argv[sys.argv.index("--") + 1 :]
install(old_zip)
fill()
install(new_zip)
result = fill()
modules = {name: item for name, item in sys.modules.items() if name.startswith(f"{NAME}.")}
Path(found).write_text(
    json.dumps(
        {
            "result": result,
            "modules": sorted(modules),
            "old": sorted(name for name in modules if not hasattr(modules[name], "NEW_VERSION")),
        }
    )
)
if not bpy.app.binary_path:
    os._exit(0)  # bpy 4.2 crashes in its clean-up at exit once classes have been registered
