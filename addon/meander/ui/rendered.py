# SPDX-License-Identifier: GPL-3.0-or-later
"""What the panel says of a surface that renders otherwise than the view shows, and two remedies."""

from __future__ import annotations

import bpy

from ..run.lasting import why_busy
from ..scene import rendered
from ..scene.fillable import why_not
from ..scene.linked_settings import is_from_file
from ..scene.rendered import Rendering, make_same, rendering_of
from ..scene.settings import surface_of
from .reasons import Reasoned, Reasons
from .registered import registration
from .sidebar import notice

_SAME = "It renders as the view shows it"


def sentence_of(rendering: Rendering) -> str:
    """How a surface renders, and what it means for the line where that is not seen."""
    how = {
        rendered.SUBDIVISIONS: f"with {'more' if rendering.cost > 1.0 else 'fewer'} subdivisions",
        rendered.MODIFIERS: "with other modifiers",
        rendered.RESOLUTION: "at another resolution",
    }[rendering.kind]
    if not rendering.is_set:
        how = "otherwise"
    what = f"This mesh renders {how} than the view shows"
    return what if rendering.may_be_filled else f"{what}: too many to fill, so it hides the line"


def draw_rendering(layout: bpy.types.UILayout, context: bpy.types.Context) -> None:
    """Says so, with a button for either remedy; nothing where both are the same."""
    surface = surface_of(context.active_object)
    rendering = None if surface is None else rendering_of(surface, context.scene)
    if rendering is None:
        return
    notice(layout, sentence_of(rendering), "RESTRICT_RENDER_OFF")
    if rendering.is_set:
        column = layout.column(align=True)
        column.operator(MEANDER_OT_show_as_rendered.bl_idname, icon="RESTRICT_VIEW_OFF")
        column.operator(MEANDER_OT_render_as_shown.bl_idname, icon="RESTRICT_RENDER_OFF")


class _MakesSame(Reasoned):
    """Makes render and view the same, the line of one surface with them."""

    bl_options = {"REGISTER", "UNDO"}
    as_rendered: bool

    @classmethod
    def reasons(cls, context: bpy.types.Context) -> Reasons:
        surface = surface_of(context.active_object)
        yield why_busy()
        if surface is None:
            yield why_not(context.active_object)
        if is_from_file(surface) or surface.data is not None and is_from_file(surface.data):
            yield "The surface is linked from another file"
        rendering = rendering_of(surface, context.scene)
        if rendering is None:
            yield _SAME
        elif not rendering.is_set:
            yield "Nodes or other objects do that"

    def execute(self, context: bpy.types.Context) -> set[str]:
        make_same(surface_of(context.active_object), context.scene, self.as_rendered)
        return {"FINISHED"}


class MEANDER_OT_show_as_rendered(_MakesSame, bpy.types.Operator):
    """Have the view show the surface with the subdivisions and modifiers of the render"""

    bl_idname = "meander.show_as_rendered"
    bl_label = "Show as Rendered"
    as_rendered = True


class MEANDER_OT_render_as_shown(_MakesSame, bpy.types.Operator):
    """Render the surface with the subdivisions and modifiers that the view shows"""

    bl_idname = "meander.render_as_shown"
    bl_label = "Render as Shown"
    as_rendered = False


register, unregister = registration(MEANDER_OT_show_as_rendered, MEANDER_OT_render_as_shown)
