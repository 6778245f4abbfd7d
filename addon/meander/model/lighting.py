# SPDX-License-Identifier: GPL-3.0-or-later
"""How bright matt white surfaces are under lamps: the cosine law (Lambert 1760) with shadows; no
bpy.

Powers and distances count as in Blender: a sun of strength pi makes what faces it white, and a
point lamp of P watts gives P / (4 pi^2 d^2) at a distance d.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Points = NDArray[np.float64]

# Tells which points (n, 3) have nothing before them in unit directions (n, 3) for so far, (n,).
Reaches = Callable[[Points, Points, NDArray[np.float64]], NDArray[np.bool_]]

# An area lamp is as many lamps along either side.
_AREA = 4


@dataclass(frozen=True)
class Lamp:
    """A lamp.

    kind        "sun", "point", "spot" or "area"
    power       the brightness of its colour times watts, of a sun times watts a square metre
    place       (3,); a sun has none
    direction   (3,), unit: where it shines to; a point lamp has none
    cosine      of a spot: of half its angle
    blend       of a spot: the share of its cone in which it fades
    sides       of an area: (2, 3), half its sides; None: of no other kind
    casts       whether things throw shadows in its light
    """

    kind: str
    power: float
    place: Points
    direction: Points
    cosine: float = 0.0
    blend: float = 0.0
    sides: Points | None = None
    casts: bool = True


def light_on(
    points: Points, normals: Points, lamps: Sequence[Lamp], ambient: float, reaches: Reaches
) -> NDArray[np.float64]:
    """The light of white surfaces at points (n, 3) with unit normals (n, 3); (n,), 1 is white.

    ambient   what comes from everywhere
    """
    found = np.full(len(points), ambient)
    for lamp in lamps:
        for part in _parts(lamp):
            towards, distance, strength = _arriving(part, points)
            strength = strength * np.einsum("ij,ij->i", towards, normals).clip(min=0.0) / np.pi
            lit = np.flatnonzero(strength > 0.0)
            if lamp.casts and len(lit):
                lit = lit[reaches(points[lit], towards[lit], distance[lit])]
            found[lit] += strength[lit]
    return found


def _parts(lamp: Lamp) -> Iterator[Lamp]:
    """The lamps without a size that it consists of."""
    if lamp.sides is None:
        yield lamp
        return
    steps = (2.0 * np.arange(_AREA) + 1.0) / _AREA - 1.0
    for u in steps:
        for v in steps:
            place = lamp.place + u * lamp.sides[0] + v * lamp.sides[1]
            yield Lamp("area", lamp.power / _AREA**2, place, lamp.direction)


def _arriving(
    lamp: Lamp, points: Points
) -> tuple[Points, NDArray[np.float64], NDArray[np.float64]]:
    """For each point the direction to the lamp, how far it is, and how strongly it shines there on
    what faces it."""
    if lamp.kind == "sun":
        towards = np.broadcast_to(-lamp.direction, points.shape)
        return towards, np.full(len(points), np.inf), np.full(len(points), lamp.power)
    away = lamp.place - points
    distance = np.maximum(np.linalg.norm(away, axis=1), 1e-300)
    towards = away / distance[:, None]
    strength = lamp.power / (4.0 * np.pi * distance**2)
    if lamp.kind == "point":
        return towards, distance, strength
    forward = -(towards @ lamp.direction)
    if lamp.kind == "area":  # a matt sheet, which shines to one side only
        return towards, distance, 4.0 * strength * forward.clip(min=0.0)
    edge = max(1e-4, (1.0 - lamp.cosine) * lamp.blend)
    t = ((forward - lamp.cosine) / edge).clip(0.0, 1.0)
    return towards, distance, strength * t * t * (3.0 - 2.0 * t)


def vertex_normals(vertices: Points, faces: NDArray[np.integer]) -> Points:
    """The mean of the normals of the faces of each vertex, by their areas; (n, 3), unit, and 0
    where there is none."""
    corners = vertices[faces]
    across = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    found = np.zeros_like(vertices)
    for corner in range(3):
        for axis in range(3):
            found[:, axis] += np.bincount(
                faces[:, corner], weights=across[:, axis], minlength=len(vertices)
            )
    length = np.linalg.norm(found, axis=1)
    return found / np.where(length > 0.0, length, 1.0)[:, None]
