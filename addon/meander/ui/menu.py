# SPDX-License-Identifier: GPL-3.0-or-later
"""The menu "Meander" in the menus Object, Mesh and Weights of the 3D viewport.

It has every operator, so that all of them are found by Menu Search (F3) and reached by keys.
"""

from __future__ import annotations

import bpy

from .fill import draw_fill_buttons
from .registered import registration

# Operators in groups. They have the labels of the buttons, so each label says enough by itself.
_ENTRIES: tuple[tuple[str, ...], ...] = (
    (
        "stop",
        "show_variations",
        "choose_settings",
        "propose_spacing",
        "show_as_rendered",
        "render_as_shown",
        "show_gaps",
        "select_curve",
        "use_as_surface",
        "make_again",
        "select_problem",
    ),
    (
        "draw_seed",
        "end_seed",
        "seed_from_edges",
        "seed_from_boundary",
        "stroke_from_vertices",
        "preview_seed",
    ),
    (
        "two_tone",
        "relief",
        "ribbon",
        "maze",
        "make_material",
        "cut_along_curve",
        "add_look",
    ),
    (
        "bake_motion",
        "bake_growth",
        "animate_growth",
        "clear_bake",
    ),
    (
        "make_light",
        "points_to_mesh",
        "points_to_curves",
        "export_toolpath",
        "maps",
        "picture",
        "draw_camera",
    ),
    ("open_help",),
)


class MEANDER_MT_object(bpy.types.Menu):
    bl_idname = "MEANDER_MT_object"
    bl_label = "Meander"

    def draw(self, context: bpy.types.Context) -> None:
        layout = self.layout
        layout.operator_context = "INVOKE_DEFAULT"
        draw_fill_buttons(layout, context, in_menu=True)
        for group in _ENTRIES:
            layout.separator()
            for name in group:
                layout.operator(f"meander.{name}")


def _in_menu(self: bpy.types.Menu, _context: bpy.types.Context) -> None:
    self.layout.separator()
    self.layout.menu(MEANDER_MT_object.bl_idname, text="Meander", icon="MOD_CURVE")


_MENUS = ("VIEW3D_MT_object", "VIEW3D_MT_edit_mesh", "VIEW3D_MT_paint_weight")


register, unregister = registration(MEANDER_MT_object, menus=dict.fromkeys(_MENUS, _in_menu))
