# SPDX-License-Identifier: GPL-3.0-or-later
"""Meander: grow a curve on a mesh until it fills the surface at an even spacing.

core        the native library, numpy in and numpy out        (no bpy)
stepper     one run of the flow, watched or in one go         (no bpy)
toolpath    the curve for machines: resampled, as CSV or JSON  (no bpy)
pace        how often a growing curve is shown             (no bpy)
thinning    the curve without points that nearly coincide  (no bpy)
blender_data    meshes, curves and weights in, curves out
density     from values on a surface to the density        (no bpy)
blender_ramp        a ramp that is shaped by hand
blender_density     what the density is chosen from: weights, attributes, colours, images
blender_alignment   which directions strands follow
terms       weights, powers and lengths of the flow        (no bpy)
blender_terms       the same as settings
strands     seeds, strokes and guides put together            (no bpy)
strand_data     the same as Blender has them; their materials
preparation, blender_preparation     mending meshes, and the part of one that is filled
profile     tilt and radius of a result's points
motion      curves on surfaces that move: followed, and baked
properties  the settings on an object
session     one run as Blender sees it: start, show, keep, restore
pace, growing_curve     how often the curve is shown meanwhile, and how it is drawn
point_attributes    what is known of every point, as attributes of a mesh or of hair curves
export_toolpath     the points of a result as a file, and as such objects
operators, sidebar, panels, ..._panel   buttons

Nothing here imports bpy before register(), so that `meander.core` can be used without Blender.
"""

import importlib
import sys

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

# In the order in which they depend on each other.
_SUBMODULES = (
    "core",
    "stepper",
    "toolpath",
    "thinning",
    "pace",
    "blender_data",
    "density",
    "blender_ramp",
    "blender_density",
    "blender_alignment",
    "terms",
    "blender_terms",
    "strands",
    "strand_data",
    "preparation",
    "blender_preparation",
    "profile",
    "point_attributes",
    "motion_settings",
    "properties",
    "session",
    "motion",
    "operators",
    "sidebar",
    "panels",
    "term_panels",
    "motion_panel",
    "export_toolpath",
    "preparation_panels",
    "strand_panel",
)
_WITH_CLASSES = (
    "properties",
    "session",
    "operators",
    "panels",
    "term_panels",
    "motion_panel",
    "export_toolpath",
    "preparation_panels",
    "strand_panel",
)

# When a new version is installed over this one, Blender reloads this file only: without this the
# old submodules would stay until restart. On the first import there is nothing to reload.
for _name in _SUBMODULES:
    _module = sys.modules.get(f"{__package__}.{_name}")
    if _module is not None:
        importlib.reload(_module)


def _modules() -> list:
    return [importlib.import_module(f".{name}", __package__) for name in _WITH_CLASSES]


def register() -> None:
    """Adds the settings, operators, panels and menu entries to Blender."""
    for module in _modules():
        module.register()


def unregister() -> None:
    """Takes everything out again; a run that is still going is cancelled first."""
    for module in reversed(_modules()):
        module.unregister()
