# SPDX-License-Identifier: GPL-3.0-or-later
"""Tilt and radius of the points of a curve."""

from __future__ import annotations

import bpy
import numpy as np

from .. import core
from ..model.profile import tilts
from .columns import column


def set_tilt_and_radius(
    curve: bpy.types.Curve,
    polylines: core.Polylines,
    matrix: np.ndarray,
    factors: np.ndarray | None = None,
) -> None:
    """Gives the points of poly splines their tilt and their radius.

    polylines   what the splines were written from, with `matrix`
    factors     (n,) radius of every point; None: 1

    They are tilted so that X of a profile is the surface normal, where the curve has the twist
    method Z-Up, as new results have; with another one, chosen by hand, there is no tilt.
    """
    flat = curve.twist_mode == "Z_UP"
    offsets = np.asarray(polylines.offsets, dtype=np.int64)
    # The transpose, not the inverse: normals transform as planes do.
    normals = np.asarray(polylines.normals, dtype=np.float64) @ matrix[:3, :3]
    for spline, begin, end in zip(curve.splines, offsets[:-1], offsets[1:]):
        if flat:
            points = column(spline.points, "co", 4)[:, :3]
            tilt = tilts(points, normals[begin:end], spline.use_cyclic_u)
            spline.points.foreach_set("tilt", tilt.astype(np.float32))
        if factors is not None:
            spline.points.foreach_set("radius", factors[begin:end].astype(np.float32))
    curve.update_tag()
