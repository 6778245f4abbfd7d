# SPDX-License-Identifier: GPL-3.0-or-later
"""The live look for a result that has none: from an earlier version, or bare."""

from __future__ import annotations

import bpy

from ..model.profile import radius_factors
from . import points
from .errors import DataError
from .look import Look, add_modifier, modifier_of
from .points import polylines_of
from .profile import set_tilt_and_radius
from .transforms import mean_scale, world_matrix


def add_look(result: bpy.types.Object, depsgraph: bpy.types.Depsgraph) -> None:
    """Gives a result the modifier, as thick as its bevel was, which goes.

    The points get what the modifier wants to know: tilt, by which X of the profile is the surface
    normal, and, where the run has left it, the room beside them as their radius.

    Raises DataError, with nothing changed, for what is more than polylines on a surface.
    """
    curve, settings = result.data, result.meander
    if modifier_of(result) is not None:
        return
    if curve.shape_keys is not None or any(spline.type != "POLY" for spline in curve.splines):
        raise DataError(
            f"'{result.name}' has shape keys or splines that are no polylines; fill the surface "
            "again to have a curve with a live look"
        )
    polylines, _index, _weights = polylines_of(result, depsgraph)
    if len(polylines.closed) != len(curve.splines):
        raise DataError(f"'{result.name}' has splines of a single point; delete them first")
    matrix = world_matrix(result)
    spacing = settings.spacing / mean_scale(matrix)
    if not spacing > 0.0:
        raise DataError(f"'{result.name}' has no spacing; set the one that it was made with")
    share = curve.bevel_depth / spacing if curve.bevel_depth > 0.0 else settings.bevel_share
    varies = settings.density_source not in ("NONE", "GROUP") or bool(settings.density_group)
    add_modifier(result, Look(share, follows=settings.radius_follows and varies), spacing)
    curve.bevel_depth = 0.0
    curve.twist_mode = "Z_UP"
    radii = points.medial_radii_of(result, len(polylines.positions), matrix)
    factors = None if radii is None else radius_factors(radii, settings.spacing / 2.0)
    set_tilt_and_radius(curve, polylines, matrix, factors)
