# SPDX-License-Identifier: GPL-3.0-or-later
"""Meander: grow a curve on a mesh until it fills the surface at an even spacing.

binding     all of ctypes: the native library, its structs, the objects made of them
core        the door to it: numpy in, numpy out
model       what a run is made of, in plain Python and numpy
scene       reads Blender data into arrays, and writes arrays back
run         a run from its plan to its result; curves on surfaces that move
ui          settings, operators, panels
cli         the batch command, from options to files
headless    what the command needs of Blender; batch.py and Blender start it here
jobs        many runs of the command, from a job file; farm.py starts it

Each uses only what stands above it. Nothing in binding, core, model, cli and jobs imports bpy, or
uses a room that does: these five are also the Python package (python/meander). Nothing here imports
bpy before register(), so that `meander.core` can be used without Blender.
"""

import sys
from types import ModuleType

# Read by Blender up to 4.1; from 4.2 on blender_manifest.toml says the same.
bl_info = {
    "name": "Meander",
    "author": "The Meander Authors",
    "version": (0, 1, 0),
    "blender": (3, 4, 0),
    "location": "View3D > Sidebar > Meander",
    "description": "Fill a surface with an evenly spaced curve",
    "category": "Add Curve",
}


def _forget_submodules() -> None:
    """Lets every submodule be imported again, from the files that are there now.

    When a new version is installed over this one, Blender reloads this file only. All others would
    stay as they were until restart, and fit neither each other nor the new library.
    """
    prefix = f"{__package__}."
    for name in [name for name in sys.modules if name.startswith(prefix)]:
        del sys.modules[name]
    # `from . import name` asks the package first.
    for name in [name for name, value in globals().items() if isinstance(value, ModuleType)]:
        if getattr(globals()[name], "__name__", "").startswith(prefix):
            del globals()[name]


_forget_submodules()  # on the first import there are none


def register() -> None:
    """Adds the settings, operators, panels and menu entries to Blender."""
    from .headless import command
    from .ui import registration

    registration.register()
    command.register()


def unregister() -> None:
    """Takes everything out again; a run that is still going is cancelled first."""
    from .headless import command
    from .ui import registration

    command.unregister()
    registration.unregister()
