# SPDX-License-Identifier: GPL-3.0-or-later
"""Make Material: the line as the images of a material of its surface."""

from __future__ import annotations

import math

import bpy
from bpy.props import BoolProperty, EnumProperty, IntProperty

from ..model import image_files, maps
from ..run.images import make_material
from ..scene.errors import DataError
from ..scene.image_material import map_name
from .on_result import OnOwnResult, result_of
from .refusing import refusing, sentence_of
from .registered import registration


class MEANDER_OT_make_material(OnOwnResult, bpy.types.Operator):
    """Show the curve by a material of its surface, made of images, which are packed into the file:
    for scenes with many copies, and without a curve. Unwraps a mesh that has no UV map"""

    bl_idname = "meander.make_material"
    bl_label = "Make Material"
    bl_options = {"REGISTER", "UNDO"}

    kind: EnumProperty(
        name="Material",
        description="What the line becomes",
        items=(
            ("INLAY", "Inlay", "Brass in dark wood, which bulges between the turns"),
            ("GLAZE", "Glaze", "The colors of the look along the line, on round ridges"),
            ("ENGRAVING", "Engraving", "A dark groove in steel"),
        ),
    )
    size: IntProperty(
        name="Size",
        description="Of a side of the images, in pixels",
        default=2048,
        min=maps.SIZES[0],
        max=maps.SIZES[1],
        subtype="PIXEL",
    )
    follows: BoolProperty(
        name="Follow Curve",
        description="Make the images again whenever the curve is another",
        default=True,
    )
    hide: BoolProperty(name="Hide Curve", description="Hide the curve itself", default=True)

    @refusing
    def execute(self, context: bpy.types.Context) -> set[str]:
        result = result_of(context)
        surface = result.meander.surface
        unwrapped = not map_name(surface)
        if unwrapped:
            _unwrap(surface, context)
        manager = context.window_manager
        manager.progress_begin(0.0, 1.0)  # the mouse pointer shows it
        try:
            material, overlap = make_material(
                result, context, self.kind, self.size, self.follows, manager.progress_update
            )
        finally:
            manager.progress_end()
        if self.hide:
            result.hide_render = True
            if context.view_layer.objects.get(result.name) == result:
                result.hide_set(True)
        if context.view_layer.objects.get(surface.name) == surface:
            context.view_layer.objects.active = surface
        warning = image_files.overlap_warning(overlap)
        if warning:
            self.report({"WARNING"}, sentence_of(warning))
        how = ", unwrapped for it" if unwrapped else ""
        self.report(
            {"INFO"}, f"{material.name} on {surface.name}{how}: seen in renders and their previews"
        )
        return {"FINISHED"}


def _unwrap(surface: bpy.types.Object, context: bpy.types.Context) -> None:
    """Lays a mesh flat without overlaps; what is active and selected stays so."""
    layer = context.view_layer
    if surface.data.library is not None or layer.objects.get(surface.name) != surface:
        raise DataError(f"'{surface.name}' has no UV map; unwrap it first")
    active, selected = layer.objects.active, list(context.selected_objects)
    hidden = surface.hide_get()
    surface.hide_set(False)
    for other in selected:
        other.select_set(False)
    surface.select_set(True)
    layer.objects.active = surface
    try:
        bpy.ops.object.mode_set(mode="EDIT")
        bpy.ops.mesh.reveal(select=False)
        bpy.ops.mesh.select_all(action="SELECT")
        bpy.ops.uv.smart_project(angle_limit=math.radians(66.0), island_margin=0.01)
        bpy.ops.object.mode_set(mode="OBJECT")
    except RuntimeError as problem:
        raise DataError(f"'{surface.name}' has no UV map; unwrap it first") from problem
    finally:
        surface.hide_set(hidden)
        surface.select_set(False)
        for other in selected:
            other.select_set(True)
        layer.objects.active = active


register, unregister = registration(MEANDER_OT_make_material)
