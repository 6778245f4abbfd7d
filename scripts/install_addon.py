# SPDX-License-Identifier: GPL-3.0-or-later
"""Blender script: installs the add-on's zip into the current profile, enables it, and saves that.

    blender --background --python-exit-code 1 --python scripts/install_addon.py -- ZIP
    python scripts/install_addon.py -- ZIP                     (where bpy is a module of Python)

As an extension from Blender 4.2 on, as an add-on before. The last line printed is the folder into
which the add-on was installed. For a throw-away profile, set Blender's own variables:
BLENDER_USER_CONFIG and BLENDER_USER_SCRIPTS up to 4.1, BLENDER_USER_RESOURCES after.
"""

import sys
from pathlib import Path

import bpy

# Where bpy is a module of Python, importing it is what puts Blender's own modules on the path.
import addon_utils  # isort: skip

NAME = "meander"


def install(path: str) -> str:
    """Installs and enables the zip; the name of the module that it became."""
    if bpy.app.version >= (4, 2, 0):
        bpy.ops.extensions.package_install_files(
            filepath=path, repo="user_default", enable_on_install=True
        )
        return f"bl_ext.user_default.{NAME}"
    bpy.ops.preferences.addon_install(filepath=path, overwrite=True)
    bpy.ops.preferences.addon_enable(module=NAME)
    return NAME


def main(path: str) -> None:
    module = install(path)
    # When an add-on fails to load, Blender prints a traceback and continues: so check.
    _enabled_at_start, loaded = addon_utils.check(module)
    if not loaded:
        raise SystemExit(f"{module} was installed from {path} but could not be enabled")
    bpy.ops.wm.save_userpref()
    print(Path(sys.modules[module].__file__).parent)


if __name__ == "__main__":
    main(str(Path(sys.argv[sys.argv.index("--") + 1]).resolve()))
