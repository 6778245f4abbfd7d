# SPDX-License-Identifier: GPL-3.0-or-later
"""The strands of a run as Blender has them: seed, stroke and guides in, materials out."""

from __future__ import annotations

from dataclasses import dataclass

import bpy
import numpy as np

from .. import core
from ..model import strands
from ..model.toolpaths import bridges
from .curve_reader import ends_of, has_strands, point_numbers, strand_term, strands_of_curve
from .errors import DataError
from .fillable import is_result
from .linked_settings import settings_of
from .points import farthest
from .transforms import world_matrix

# Points of a part that tell whether it lies on its surface.
_CHECKED = 500


@dataclass(frozen=True)
class SplineMaterials:
    """The materials that the splines of a result take over from those that they grew from."""

    slots: tuple[tuple[str, str | None] | None, ...] = ()  # materials by name and library
    indices: tuple[int, ...] = ()  # per strand


# ------------------------------------------------------------------------------------------------
# Strands in


def parts_of(
    active: bpy.types.Object, depsgraph: bpy.types.Depsgraph, restart: bool
) -> tuple[list[strands.Part], SplineMaterials]:
    """The strands that a run on a surface or a result starts from, guides among them.

    A result goes on from its own splines, unless it is to `restart`. Those of them that are guides
    are read again from the drawn ones, where the settings still name these.

    Raises DataError with one sentence for what cannot be used.
    """
    settings: bpy.types.PropertyGroup = settings_of(active)
    fixed_ends = settings.fixed_ends or _has_stroke(settings)
    guides, guide_objects = _drawn_guides(settings, depsgraph)
    if not is_result(active) or restart:
        if settings.seed is not None:
            seed = strands_of_curve(settings.seed, depsgraph, settings.fixed_ends)
            parts = [part_of(settings.seed, seed)]
            return parts + guides, _materials_of([settings.seed, *guide_objects], parts + guides)
        parts = _stroke(settings) + guides
        return parts, _materials_of([None] * (len(parts) - len(guides)) + guide_objects, parts)
    own = strands_of_curve(active, depsgraph, fixed_ends)
    figures = active.meander.figures
    count, begin = len(own.closed), figures.first_guide
    indices = tuple(_material_indices(active, count))
    known = count == figures.strands
    if figures.bridges:
        own, indices, line, more = _without_bridges(active, own, indices, fixed_ends)
        count += more
        begin += more if begin > line else 0
    end = begin + figures.guides
    if not figures.guides:
        parts = [strands.Part(active.name, own, drawn=False)] + guides
        return parts, SplineMaterials((), indices)
    if not known:
        raise DataError(
            f"'{active.name}' has other splines than its run has left, so that its guides cannot "
            "be told from them; use Fill Again"
        )
    pieces = [(0, begin, False), (begin, end, True), (end, count, False)]
    parts = []
    for first, last, is_guide in pieces:
        if is_guide and guides:
            parts += guides
        elif last > first:
            piece = strands.span(own, first, last)
            parts.append(strands.Part(active.name, piece, is_guide, first, drawn=False))
    if guides:
        drawn = sum(len(part.seed.closed) for part in guides)
        indices = (*indices[:begin], *([0] * drawn), *indices[end:])
    return parts, SplineMaterials((), indices)


def _without_bridges(
    result: bpy.types.Object, own: core.Seed, indices: tuple[int, ...], fixed_ends: bool
) -> tuple[core.Seed, tuple[int, ...], int, int]:
    """A result's strands as they were before they were joined to one line, their materials, which
    spline the line was, and how many strands more they are than splines.

    Raises DataError where the result has other points by now.
    """
    found = bridges.parted(own, result.meander.figures.bridges)
    if found is None:
        raise DataError(
            f"'{result.name}' has other points than its run has left, so that its bridges cannot "
            "be taken out; use Fill Again"
        )
    seed, line, count = found
    if fixed_ends:
        seed.fixed = ends_of(seed.offsets, seed.closed)
    indices = (*indices[:line], *([indices[line]] * count), *indices[line + 1 :])
    return seed, indices, line, count - 1


def part_of(curve_object: bpy.types.Object, seed: core.Seed, guide: bool = False) -> strands.Part:
    numbers, term = point_numbers(curve_object, seed), strand_term(curve_object)
    return strands.Part(curve_object.name, seed, guide, numbers=numbers, term=term)


def check_on_surface(
    parts: list[strands.Part], vertices: np.ndarray, faces: np.ndarray, distance: float
) -> None:
    """Raises DataError where what has grown is farther than that from triangles (world units): it
    belongs to another shape of the surface. What is drawn may be."""
    for part in parts:
        if part.drawn:
            continue
        points = part.seed.points[:: max(1, len(part.seed.points) // _CHECKED)]
        if farthest(points, vertices, faces) > distance:
            raise DataError(
                f"'{part.name}' does not lie on its surface as that is now; go to the frame in "
                "which it was made, or use Fill Again"
            )


def _has_stroke(settings: bpy.types.PropertyGroup) -> bool:
    return settings.seed is None and bool(settings.stroke_from or settings.stroke_to)


def _stroke(settings: bpy.types.PropertyGroup) -> list[strands.Part]:
    if not _has_stroke(settings):
        return []
    ends = (settings.stroke_from, settings.stroke_to)
    if None in ends:
        raise DataError("One end of the stroke is missing; choose an object for From and for To")
    places = [world_matrix(end)[:3, 3] for end in ends]
    return [strands.Part(f"{ends[0].name} to {ends[1].name}", strands.stroke(*places))]


def _drawn_guides(
    settings: bpy.types.PropertyGroup, depsgraph: bpy.types.Depsgraph
) -> tuple[list[strands.Part], list[bpy.types.Object]]:
    objects = [] if settings.guides is None else [settings.guides]
    if settings.guide_collection is not None:
        # The name decides, so that the order does not depend on how they were linked.
        curves = (
            other
            for other in settings.guide_collection.all_objects
            if has_strands(other) and other.meander.surface is None and other not in objects
        )
        found = sorted(curves, key=lambda other: other.name_full)
        if not found and not objects:
            raise DataError(
                f"The collection '{settings.guide_collection.name}' has no curves; draw guides "
                "in it, or leave the field empty"
            )
        objects += [other for other in found if other != settings.seed]
    parts = [
        part_of(other, strands_of_curve(other, depsgraph, branches=True), guide=True)
        for other in objects
    ]
    return parts, objects


# ------------------------------------------------------------------------------------------------
# Materials


def _material_indices(curve_object: bpy.types.Object, count: int) -> list[int]:
    """Those of the splines that became strands, which have two points or more."""
    if not isinstance(curve_object.data, bpy.types.Curve):
        return [0] * count
    splines = [
        spline
        for spline in curve_object.data.splines
        if len(spline.points) + len(spline.bezier_points) > 1
    ]
    if len(splines) != count:  # modifiers have made others of them
        return [0] * count
    return [spline.material_index for spline in splines]


def _materials_of(
    objects: list[bpy.types.Object | None], parts: list[strands.Part]
) -> SplineMaterials:
    slots: list[tuple[str, str | None] | None] = []
    indices: list[int] = []
    for curve_object, part in zip(objects, parts, strict=True):
        count = len(part.seed.closed)
        of_splines = curve_object is not None and isinstance(curve_object.data, bpy.types.Curve)
        if not of_splines or not curve_object.material_slots:
            indices += [0] * count
            continue
        first = len(slots)
        for slot in curve_object.material_slots:
            material = slot.material
            library = material.library.filepath if material and material.library else None
            slots.append(None if material is None else (material.name, library))
        most = len(slots) - 1
        own = _material_indices(curve_object, count)
        indices += [min(first + index, most) for index in own]
    return SplineMaterials(tuple(slots), tuple(indices))


def assign_materials(
    curve: bpy.types.Curve, materials: SplineMaterials, sources: np.ndarray | None = None
) -> None:
    """Gives the splines the materials of those that they grew from.

    sources   the strand that each spline came from; None: one each, in their order

    Slots that a result has already stay: they are the user's.
    """
    if not len(curve.materials):
        for slot in materials.slots:
            curve.materials.append(None if slot is None else bpy.data.materials.get(slot))
    most = max(0, len(curve.materials) - 1)
    indices = materials.indices
    if sources is not None:
        # Loops that had no seed have none.
        indices = [indices[k] if k < len(indices) else 0 for k in sources.tolist()]
    for spline, index in zip(curve.splines, indices):
        spline.material_index = min(index, most)


def note_guides(curve_object: bpy.types.Object, flags: np.ndarray, keep: bool) -> None:
    """Remembers which splines of a new result are guides, or takes them out of it."""
    curve = curve_object.data
    if not keep:
        for spline in [s for s, is_guide in zip(curve.splines, flags, strict=True) if is_guide]:
            curve.splines.remove(spline)
        flags = flags[~flags]
    figures = curve_object.meander.figures
    figures.strands = len(flags)
    figures.guides = int(flags.sum())
    figures.first_guide = int(np.argmax(flags)) if flags.any() else 0
