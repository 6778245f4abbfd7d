# SPDX-License-Identifier: GPL-3.0-or-later
"""Seeds made of what a mesh has, and what a run would start from, shown on it."""

from __future__ import annotations

import functools
from collections.abc import Callable

import bmesh
import bpy
import numpy as np
from bpy.props import BoolProperty

from ..run import seeds
from ..run.lasting import why_busy
from ..scene.errors import DataError
from ..scene.fillable import why_not
from ..scene.linked_settings import settings_to_change
from ..scene.seeds import new_seed, strands_of_boundary, strands_of_edges
from ..scene.settings import surface_of
from .reasons import Reasoned, Reasons
from .refusing import refusing
from .registered import registration


class _OfMesh(Reasoned):
    """An operator that makes a seed of the active mesh."""

    bl_options = {"REGISTER", "UNDO"}
    modes: tuple[str, ...] = ("EDIT", "OBJECT")
    ask = ""  # what is to be chosen

    @classmethod
    def reasons(cls, context: bpy.types.Context) -> Reasons:
        active = context.active_object
        yield why_busy()
        if active is None or active.type != "MESH" or active.mode not in cls.modes:
            yield cls.ask


def _leave_edit_mode(context: bpy.types.Context) -> None:
    """Undo in Edit Mode knows nothing of new objects, so what makes one ends in Object Mode."""
    if context.mode != "OBJECT":
        bpy.ops.object.mode_set(mode="OBJECT")


def _made(
    operator: bpy.types.Operator,
    context: bpy.types.Context,
    find: Callable[[bpy.types.Object, bpy.types.Depsgraph], list[tuple[np.ndarray, bool]]],
    guides: bool = False,
) -> set[str]:
    """Makes a curve of the strands that are found, and the seed, or the guides, of it."""
    surface, mode = context.active_object, context.active_object.mode
    _leave_edit_mode(context)
    try:
        strands = find(surface, context.evaluated_depsgraph_get())
    except DataError:
        bpy.ops.object.mode_set(mode=mode)
        raise
    seed = new_seed(surface, f"{surface.name} {'Guides' if guides else 'Seed'}", strands)
    if guides:
        settings_to_change(surface).guides = seed
    else:
        settings_to_change(surface).seed = seed
    count = "one strand" if len(strands) == 1 else f"{len(strands)} strands"
    is_what = "guides" if guides else "the seed"
    operator.report({"INFO"}, f"{seed.name}, {count}, is {is_what} of {surface.name}")
    return {"FINISHED"}


class MEANDER_OT_seed_from_edges(_OfMesh, bpy.types.Operator):
    """Make a curve of the selected edges, and the seed of this mesh of it"""

    bl_idname = "meander.seed_from_edges"
    bl_label = "Seed from Edges"
    bl_description = (
        "Make a curve that follows the selected edges, and the seed of it: each chain of edges "
        "becomes an open strand, each loop a closed one"
    )
    # In Object Mode it works on the selection that Edit Mode has left, for scripts and the redo
    # panel.
    ask = "Select edges of a mesh in Edit Mode"

    guides: BoolProperty(
        name="As Guides",
        description="Make them guides, which stay as they are and may branch, instead of the seed",
        default=False,
        options={"SKIP_SAVE"},
    )

    @refusing
    def execute(self, context: bpy.types.Context) -> set[str]:
        found = functools.partial(strands_of_edges, branches=self.guides)
        return _made(self, context, found, self.guides)


class MEANDER_OT_seed_from_boundary(_OfMesh, bpy.types.Operator):
    """Make a curve of the boundary, and the seed of this mesh of it"""

    bl_idname = "meander.seed_from_boundary"
    bl_label = "Seed from Boundary"
    bl_description = (
        "Make a curve of closed strands along the boundaries of the mesh, and the seed of it. In "
        "Edit Mode with boundary edges selected, of their loops only"
    )
    ask = "Choose a mesh in Object Mode or Edit Mode"

    @refusing
    def execute(self, context: bpy.types.Context) -> set[str]:
        in_edit_mode = context.active_object.mode == "EDIT"
        return _made(self, context, functools.partial(strands_of_boundary, selected=in_edit_mode))


class MEANDER_OT_stroke_from_vertices(_OfMesh, bpy.types.Operator):
    """Make a two-point curve of the two selected vertices, and the seed of this mesh of it"""

    bl_idname = "meander.stroke_from_vertices"
    bl_label = "Stroke from Vertices"
    bl_description = (
        "Make a curve of two points at the two selected vertices, and the seed of it: one stroke "
        "from one to the other then fills the surface, with its ends where they are"
    )
    modes = ("EDIT",)
    ask = "Select two vertices of a mesh in Edit Mode"

    @refusing
    def execute(self, context: bpy.types.Context) -> set[str]:
        mesh_object = context.active_object
        mesh = bmesh.from_edit_mesh(mesh_object.data)
        # As they were selected, where Blender knows. By number: in Debian 13's Blender 4.3, on
        # Python 3.13, the history cannot be iterated.
        history = mesh.select_history
        chosen = [history[index] for index in range(len(history))]
        picked = [item for item in chosen if isinstance(item, bmesh.types.BMVert)]
        others = [vertex for vertex in mesh.verts if vertex.select and vertex not in picked]
        ends = [vertex.co[:] for vertex in picked + others]
        if len(ends) != 2:
            raise DataError(f"{len(ends)} vertices are selected; select two, the ends")
        _leave_edit_mode(context)
        stroke = new_seed(mesh_object, f"{mesh_object.name} Stroke", [(np.array(ends), False)])
        settings = settings_to_change(mesh_object)
        settings.seed, settings.fixed_ends = stroke, True
        self.report({"INFO"}, f"{stroke.name} is the seed of {mesh_object.name}")
        return {"FINISHED"}


class MEANDER_OT_preview_seed(Reasoned, bpy.types.Operator):
    """Show on the surface what a run would start from, or show it no longer"""

    bl_idname = "meander.preview_seed"
    bl_label = "Preview Seed"
    bl_description = (
        "Show what a run would start from, laid on the surface: strands in orange, guides in blue, "
        "the loops of a mesh without a seed. Again: show it no longer"
    )

    @classmethod
    def reasons(cls, context: bpy.types.Context) -> Reasons:
        yield why_busy()
        if surface_of(context.active_object) is None:
            yield why_not(context.active_object)

    @refusing
    def execute(self, context: bpy.types.Context) -> set[str]:
        active = context.active_object
        if seeds.is_shown(active):
            seeds.hide()
            return {"FINISHED"}
        found = seeds.show(active, context)
        if found.warning:
            self.report({"WARNING"}, found.warning)
        counts = "one strand" if found.strands == 1 else f"{found.strands} strands"
        if found.guides:
            counts += " and one guide" if found.guides == 1 else f" and {found.guides} guides"
        self.report({"INFO"}, "; ".join(filter(None, (f"Starts from {counts}", found.remark))))
        return {"FINISHED"}


register, unregister = registration(
    MEANDER_OT_preview_seed,
    MEANDER_OT_seed_from_edges,
    MEANDER_OT_seed_from_boundary,
    MEANDER_OT_stroke_from_vertices,
)
