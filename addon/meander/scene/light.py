# SPDX-License-Identifier: GPL-3.0-or-later
"""A result that is there already, with fewer points."""

from __future__ import annotations

from typing import Any

import bpy
import numpy as np

from .. import core
from ..model.geometry.simplification import Light, light_points
from ..model.toolpaths import bridges
from . import points as point_attributes
from .columns import column
from .errors import DataError
from .transforms import to_world, world_matrix

# What a point of a spline has: the attribute and its width.
_OF_POINTS = (("co", 4), ("radius", 1), ("tilt", 1), ("weight_softbody", 1))
_OF_SPLINES = ("use_cyclic_u", "material_index", "use_smooth")


def make_light(result: bpy.types.Object, light: Light) -> tuple[int, int]:
    """Takes points out of the splines of a result; what the others have stays with them.

    Returns how many points there were and how many there are. Raises DataError, with nothing
    changed, for a curve that is more than points in order.
    """
    curve = result.data
    if curve.shape_keys is not None:
        raise DataError(f"'{result.name}' has shape keys, which need all of its points")
    if any(spline.type != "POLY" for spline in curve.splines):
        raise DataError(
            f"'{result.name}' has splines that are no polylines; convert them to Poly first"
        )
    if not curve.splines:
        return 0, 0
    points = [_values_of(spline) for spline in curve.splines]
    kinds = [{name: getattr(spline, name) for name in _OF_SPLINES} for spline in curve.splines]
    matrix = world_matrix(result)
    kept = light_points(_polylines(points, kinds, matrix), light, least_spacing(result))
    offsets = np.cumsum([0] + [len(values["co"]) for values in points])
    before = int(offsets[-1])
    if len(kept) == before:
        return before, before
    radii = point_attributes.medial_radii_of(result, before, matrix)
    curve.splines.clear()
    for values, kind, begin, end in zip(points, kinds, offsets[:-1], offsets[1:]):
        _add_spline(curve, values, kind, kept[(kept >= begin) & (kept < end)] - begin)
    if radii is not None:
        point_attributes.store_medial_radii(result, radii[kept], matrix)
    figures = result.meander.figures
    if figures.bridges:
        figures.bridges = bridges.thinned(figures.bridges, offsets[:-1], kept)
    curve.update_tag()
    return before, len(kept)


def least_spacing(result: bpy.types.Object) -> float:
    """The least spacing of a result in world units, which a run has left with it.

    Raises DataError where there is none to be had.
    """
    settings = result.meander
    spacing = settings.figures.least_spacing or settings.spacing
    if not spacing > 0.0:
        raise DataError(f"'{result.name}' has no spacing; set the one that it was made with")
    return spacing


def _values_of(spline: bpy.types.Spline) -> dict[str, np.ndarray]:
    return {name: column(spline.points, name, width) for name, width in _OF_POINTS}


def _polylines(
    points: list[dict[str, np.ndarray]], kinds: list[dict[str, Any]], matrix: np.ndarray
) -> core.Polylines:
    """The splines in world units; their normals are of no interest."""
    positions = to_world(np.vstack([values["co"][:, :3] for values in points]), matrix)
    return core.Polylines(
        positions,
        np.zeros_like(positions),
        np.cumsum([0] + [len(values["co"]) for values in points]).astype(np.uint32),
        np.array([kind["use_cyclic_u"] for kind in kinds], dtype=np.uint8),
    )


def _add_spline(
    curve: bpy.types.Curve,
    values: dict[str, np.ndarray],
    kind: dict[str, Any],
    kept: np.ndarray,
) -> None:
    spline = curve.splines.new("POLY")
    spline.points.add(len(kept) - 1)
    for name, _width in _OF_POINTS:
        spline.points.foreach_set(name, np.ascontiguousarray(values[name][kept]).ravel())
    for name, value in kind.items():
        setattr(spline, name, value)
