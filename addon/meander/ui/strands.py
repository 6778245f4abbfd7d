# SPDX-License-Identifier: GPL-3.0-or-later
"""The sub-panel "Seed and Strands": seed, stroke, guides, parts they leave out; its settings."""

import bpy

from ..run import seeds
from ..scene.curve_reader import has_strands
from ..scene.linked_settings import owner_of, settings_of
from .declared import switch
from .drawing import MEANDER_OT_draw_seed
from .registered import registration
from .seeds import (
    MEANDER_OT_preview_seed,
    MEANDER_OT_seed_from_boundary,
    MEANDER_OT_seed_from_edges,
    MEANDER_OT_stroke_from_vertices,
)
from .sidebar import GUIDANCE, GUIDANCE_ORDER, SubPanel, columns
from .unanimated import BoolProperty, PointerProperty


def _is_another(settings: bpy.types.PropertyGroup, object: bpy.types.Object) -> bool:
    return object != owner_of(settings)


def _is_another_curve(settings: bpy.types.PropertyGroup, object: bpy.types.Object) -> bool:
    return has_strands(object) and object != owner_of(settings)


class StrandSettings:
    """The part of MeanderSettings that says what else there is beside the seed."""

    stroke_from: PointerProperty(
        type=bpy.types.Object,
        name="From",
        description=(
            "Without a seed: begin one open strand at the origin of this object, on or close to "
            "the surface. Its ends stay there, so that one stroke fills the surface"
        ),
        poll=_is_another,
    )
    stroke_to: PointerProperty(
        type=bpy.types.Object,
        name="To",
        description="End that strand at the origin of this object",
        poll=_is_another,
    )
    guides: PointerProperty(
        type=bpy.types.Object,
        name="Guides",
        description=(
            "Curve, text, Grease Pencil or mesh without faces that stays as drawn, moved to the "
            "surface, while the others keep the spacing from it. Its strands may cross and touch "
            "each other"
        ),
        poll=_is_another_curve,
    )
    guide_collection: PointerProperty(
        type=bpy.types.Collection,
        name="Collection",
        description=(
            "All curves, texts, Grease Pencil and meshes without faces in this collection are "
            "guides as well"
        ),
    )
    keep_guides: BoolProperty(
        name="Keep Guides",
        description="Write the guides into the result, as splines of their own",
        default=True,
    )


class MEANDER_PT_strands(SubPanel, bpy.types.Panel):
    bl_idname = "MEANDER_PT_strands"
    bl_label = "Seed and Strands"
    bl_parent_id = GUIDANCE
    bl_order = GUIDANCE_ORDER["strands"]

    def draw(self, context: bpy.types.Context) -> None:
        layout = self.layout
        columns(layout)
        active = context.active_object
        settings: bpy.types.PropertyGroup = settings_of(active)
        layout.prop(settings, "seed")
        layout.operator(
            MEANDER_OT_preview_seed.bl_idname,
            icon="HIDE_OFF",
            depress=seeds.is_shown(active),
        )
        if active.type == "MESH":
            _draw_makers(layout.column(align=True), active)
        stroke = layout.column(align=True)
        stroke.active = settings.seed is None
        stroke.prop(settings, "stroke_from", text="From")
        stroke.prop(settings, "stroke_to", text="To")
        switch(layout, settings, "fixed_ends")
        switch(layout, settings, "seed_every_part")
        switch(layout, settings, "bridge_parts")
        guides = layout.column(align=True)
        guides.prop(settings, "guides")
        guides.prop(settings, "guide_collection")
        row = layout.row()
        row.active = bool(settings.guides or settings.guide_collection)
        switch(row, settings, "keep_guides")


def _draw_makers(column: bpy.types.UILayout, surface: bpy.types.Object) -> None:
    """The buttons that make a seed of this mesh."""
    column.operator(MEANDER_OT_draw_seed.bl_idname, icon="GREASEPENCIL")
    if surface.mode == "EDIT":
        edges = MEANDER_OT_seed_from_edges.bl_idname
        column.operator(edges, icon="EDGESEL")
        column.operator(edges, text="Guides from Edges", icon="EDGESEL").guides = True
        column.operator(MEANDER_OT_stroke_from_vertices.bl_idname, icon="VERTEXSEL")
    column.operator(MEANDER_OT_seed_from_boundary.bl_idname, icon="MESH_CIRCLE")


register, unregister = registration(MEANDER_PT_strands)
