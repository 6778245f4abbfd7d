# SPDX-License-Identifier: GPL-3.0-or-later
"""Cuts the surface of a result along it, however long ago its run was."""

from __future__ import annotations

from dataclasses import dataclass, replace

import bpy
import numpy as np

from .. import core
from ..model import cut as cuts
from ..model.opening import open_flow
from ..scene.columns import column
from ..scene.cut import Skin, keep_shading, skin_of, write_cut
from ..scene.errors import DataError
from .plan import Plan, plan_of


@dataclass(frozen=True)
class CutResult:
    """A result's surface, cut along the result.

    skin      of the surface
    parted    whether the curve has two sides everywhere, which `cut.sides` are then
    drawn     the strands of the curve with round turns, if they were asked for
    """

    cut: core.CutSurface
    skin: Skin
    plan: Plan
    parted: bool
    drawn: core.Polylines | None = None

    def make(
        self, name: str, cut: core.CutSurface | None = None, keep_normals: bool = True
    ) -> bpy.types.Object:
        """Makes a mesh object of it, or of a part; see write_cut().

        keep_normals   shade it as the surface is shaded; not for what gets another shape
        """
        thing = write_cut(
            name,
            cut or self.cut,
            self.plan.surface.find(),
            self.plan.problem.faces,
            self.skin,
            self.plan.matrix,
            self.plan.spacing,
        )
        if keep_normals:
            keep_shading(thing)
        return thing


def cut_result(
    result: bpy.types.Object,
    scene: bpy.types.Scene,
    depsgraph: bpy.types.Depsgraph,
    detail: float = 0.0,
    middle_lines: bool = False,
    sides: bool = False,
    rounding: float = 0.0,
) -> CutResult:
    """Cuts a result's surface along its splines, as Continue would begin with them.

    detail         length of edges, in half spacings; 0: what the curve calls for
    middle_lines   edges halfway between neighbouring turns too
    sides          those at least where the curve does not part the surface: sides meet there then
    rounding       tolerance of the line with round turns, in spacings; 0: none is drawn

    Raises DataError and core.MeanderError with a sentence for what cannot be done.
    """
    plan = plan_of(result, scene, depsgraph)
    if all(part.guide for part in plan.parts):  # else first loops would grow beside them, and cut
        raise DataError("The result has only guides, and guides do not cut; fill the surface")
    length = detail * plan.spacing / 2.0
    try:
        opened = open_flow(replace(plan.problem, mirror=None, copies=None))
    except core.MeanderError as error:
        if error.status != core.Status.INVALID_SEED:
            raise
        if plan.problem.copies is not None:
            raise DataError(
                "Instances that touch are one mesh for a cut, on which their lines do not lie; "
                "move them apart, or fill what Object > Apply > Make Instances Real makes"
            ) from error
        raise DataError(
            "The curve does not lie on its surface as that is now; fill the surface again"
        ) from error
    with opened.flow as flow:
        cut = core.cut_surface(flow, length, middle_lines)
        parted = cuts.is_parted(cut)
        if sides and not parted and not middle_lines:
            cut = core.cut_surface(flow, length, middle_lines=True)
        drawn = flow.rounded(rounding)[0] if rounding else None
    skin = skin_of(plan.surface.find(), depsgraph)
    return CutResult(cut, skin, plan, parted, drawn)


def paint(thing: bpy.types.Object, material: bpy.types.Material) -> None:
    """Gives a mesh one material, instead of those that it has."""
    _paint(thing.data, [material], np.zeros(len(thing.data.polygons), dtype=np.int32))


def paint_sides(thing: bpy.types.Object, materials: list[bpy.types.Material]) -> None:
    """Gives a cut's two sides two materials."""
    mesh = thing.data
    sides = column(mesh.attributes["side"].data, "value", kind=np.int32)
    _paint(mesh, materials, (sides < 0).astype(np.int32))


def _paint(mesh: bpy.types.Mesh, materials: list[bpy.types.Material], index: np.ndarray) -> None:
    mesh.materials.clear()
    for material in materials:
        mesh.materials.append(material)
    mesh.polygons.foreach_set("material_index", index)
    mesh.update()
