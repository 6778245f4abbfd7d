# SPDX-License-Identifier: GPL-3.0-or-later
"""The panels of what the curve follows and how it behaves: density, direction, weights."""

from __future__ import annotations

import bpy

from ..scene import density
from ..scene.density import active_group, choice_of
from ..scene.flow_options import warnings_of
from ..scene.linked_settings import owner_of, settings_of
from ..scene.settings import surface_of
from .declared import row, rows
from .settings import MeanderSettings
from .sidebar import (
    ADVANCED,
    ADVANCED_ORDER,
    GUIDANCE,
    GUIDANCE_ORDER,
    SubPanel,
    columns,
    notice,
)


class MEANDER_PT_density(SubPanel, bpy.types.Panel):
    bl_idname = "MEANDER_PT_density"
    bl_label = "Density"
    bl_parent_id = GUIDANCE
    bl_order = GUIDANCE_ORDER["density"]
    bl_options = {"DEFAULT_CLOSED"}

    def draw(self, context: bpy.types.Context) -> None:
        layout = self.layout
        columns(layout, live=True)
        active = context.active_object
        settings: MeanderSettings = settings_of(active)
        layout.prop(settings, "density_source")
        source = settings.density_source
        if source == "NONE":
            return
        surface = surface_of(active)
        if source == "GROUP":
            layout.prop_search(settings, "density_group", surface, "vertex_groups", text="Group")
            if not settings.density_group:
                self._draw_taken(layout, surface, active_group(settings, surface))
        elif source == "ATTRIBUTE":
            layout.prop(settings, "density_attribute", icon="SPREADSHEET")
        elif source == "COLOR":
            layout.prop(settings, "density_color", text="Color", icon="GROUP_VCOL")
        elif source == "IMAGE":
            layout.template_ID(settings, "density_image", open="image.open", text="Image")
            if surface.type == "MESH":
                layout.prop_search(settings, "density_uv_map", surface.data, "uv_layers")
        else:
            layout.prop(settings, "density_curvature")
            row(layout, settings, "density_smoothing")
        self._draw_ramp(layout.column(), settings)

    def _draw_taken(
        self, layout: bpy.types.UILayout, surface: bpy.types.Object, group: str
    ) -> None:
        """Which group a run takes where none is named: paint is never left out in silence."""
        if len(surface.vertex_groups):
            notice(layout, f"Active: {group}" if group else "None: even spacing")
        else:
            notice(layout, "No vertex groups")

    def _draw_ramp(self, layout: bpy.types.UILayout, settings: MeanderSettings) -> None:
        taken = active_group(settings, surface_of(owner_of(settings)))
        layout.active = choice_of(settings).varies or bool(taken)
        column = layout.column(align=True)
        unit = column.split(factor=0.4)
        unit.label(text="")  # the fields' own labels are below
        unit.label(text="Of the spacing")
        column.prop(settings, "factor_0", text="At Low")
        column.prop(settings, "factor_1", text="At High")
        layout.prop(settings, "density_interpolation", text="Ramp")
        if settings.density_interpolation == "FREE":
            node = density.node_of(settings.density_ramp)
            if node is not None:
                layout.template_curve_mapping(node, "mapping")
        layout.column(heading="Range").prop(settings, "use_density_range", text="Custom")
        column = layout.column(align=True)
        column.active = settings.use_density_range
        column.prop(settings, "density_low", text="From")
        column.prop(settings, "density_high", text="To")


class MEANDER_PT_alignment(SubPanel, bpy.types.Panel):
    bl_idname = "MEANDER_PT_alignment"
    bl_label = "Direction"
    bl_parent_id = GUIDANCE
    bl_order = GUIDANCE_ORDER["direction"]
    bl_options = {"DEFAULT_CLOSED"}

    def draw(self, context: bpy.types.Context) -> None:
        layout = self.layout
        columns(layout)
        active = context.active_object
        settings: MeanderSettings = settings_of(active)
        layout.prop(settings, "alignment_source")
        source = settings.alignment_source
        if source == "NONE":
            return
        if source == "AXIS":
            layout.prop(settings, "alignment_axis")
            layout.row().prop(settings, "alignment_space", expand=True)
        elif source == "CURVATURE":
            layout.row().prop(settings, "alignment_curvature", expand=True)
            row(layout, settings, "alignment_smoothing")
        elif source == "STROKES":
            layout.prop(settings, "alignment_strokes", icon="CURVE_DATA")
        elif source == "UV":
            layout.row().prop(settings, "alignment_uv", expand=True)
            surface = surface_of(active)
            if surface.type == "MESH":
                layout.prop_search(settings, "alignment_uv_map", surface.data, "uv_layers")
        elif source == "ATTRIBUTE":
            layout.prop(settings, "alignment_attribute", icon="SPREADSHEET")
        self._draw_angle(layout, settings, surface_of(active))
        row(layout, settings, "alignment_weight")
        row(layout, settings, "align_across")


    def _draw_angle(
        self, layout: bpy.types.UILayout, settings: MeanderSettings, surface: bpy.types.Object
    ) -> None:
        layout.prop(settings, "alignment_angle")
        source = settings.alignment_angle
        if source == "GROUP":
            layout.prop_search(
                settings, "alignment_angle_group", surface, "vertex_groups", text="Group"
            )
        elif source == "ATTRIBUTE":
            layout.prop(settings, "alignment_angle_attribute", icon="SPREADSHEET")
        elif source == "COLOR":
            layout.prop(settings, "alignment_angle_color", text="Color", icon="GROUP_VCOL")
        elif source == "IMAGE":
            layout.template_ID(settings, "alignment_angle_image", open="image.open", text="Image")
            if surface.type == "MESH":
                layout.prop_search(
                    settings, "alignment_angle_uv_map", surface.data, "uv_layers"
                )


class MEANDER_PT_weights(SubPanel, bpy.types.Panel):
    bl_idname = "MEANDER_PT_weights"
    bl_label = "Strand Shape"
    bl_parent_id = ADVANCED
    bl_order = ADVANCED_ORDER["weights"]
    bl_options = {"DEFAULT_CLOSED"}

    def draw(self, context: bpy.types.Context) -> None:
        layout = self.layout
        columns(layout, live=True)
        settings: MeanderSettings = settings_of(context.active_object)
        rows(layout, settings, "Strand Shape", heading="Shape")
        for warning in warnings_of(settings):
            notice(layout, warning, "ERROR")


_CLASSES = (MEANDER_PT_density, MEANDER_PT_alignment, MEANDER_PT_weights)


def register() -> None:
    for cls in _CLASSES:
        bpy.utils.register_class(cls)


def unregister() -> None:
    for cls in reversed(_CLASSES):
        bpy.utils.unregister_class(cls)
