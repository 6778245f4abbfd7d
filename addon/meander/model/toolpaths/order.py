# SPDX-License-Identifier: GPL-3.0-or-later
"""Where a tool begins, from where it goes on, and which way it follows strands; no bpy."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from .parts import between
from .toolpath import Mesh, Strand

NOTHING_LEFT = (
    "The line ends at the place of --go-on-from, and nothing is left of it; choose a place before"
)


@dataclass(frozen=True)
class Order:
    """How strands are followed; places are (2,) of a flat drawing or (3,), in its coordinates.

    begin      the strand that comes nearest to this place is the first, and begins there
    go_on      what comes before this place is left out
    backwards  what is left is followed from its end to its beginning
    """

    begin: tuple[float, ...] | None = None
    go_on: tuple[float, ...] | None = None
    backwards: bool = False


AS_IT_IS = Order()


class Nearest(NamedTuple):
    """The place of strands that is nearest to another: which strand, where along it, how far."""

    strand: int
    arc: float
    distance: float


def nearest(strands: Sequence[Strand], place: ArrayLike, ends: bool = False) -> Nearest:
    """Where strands come nearest to a place; of several such places the first.

    ends   open strands only count with their ends
    """
    wanted = np.asarray(place, dtype=np.float64)
    found = Nearest(0, 0.0, np.inf)
    for number, strand in enumerate(strands):
        points = strand.points[:, : len(wanted)]
        if ends and not strand.closed:
            tips = np.linalg.norm(points[[0, -1]] - wanted, axis=1)
            arc, distance = (0.0, tips[0]) if tips[0] <= tips[1] else (strand.length, tips[1])
        else:
            arc, distance = _along(strand, points, wanted)
        if distance < found.distance:
            found = Nearest(number, float(arc), float(distance))
    return found


def _along(strand: Strand, points: np.ndarray, wanted: np.ndarray) -> tuple[float, float]:
    """Arc length and distance of the nearest place of a strand."""
    arcs = np.append(strand.arc_lengths, strand.length)
    ring = np.vstack([points, points[:1]]) if strand.closed else np.vstack([points, points[-1:]])
    ways = np.diff(ring, axis=0)
    squares = (ways * ways).sum(axis=1)
    shares = ((wanted - ring[:-1]) * ways).sum(axis=1) / np.where(squares > 0.0, squares, 1.0)
    shares = np.clip(shares, 0.0, 1.0)
    distances = np.linalg.norm(ring[:-1] + shares[:, None] * ways - wanted, axis=1)
    at = int(np.argmin(distances))
    return arcs[at] + shares[at] * (arcs[at + 1] - arcs[at]), distances[at]


def begun_at(strands: Sequence[Strand], place: ArrayLike, mesh: Mesh | None = None) -> list[Strand]:
    """The strands with the one first that comes nearest to a place, and begins there; an open one
    begins at one of its ends.

    mesh   for faces and weights of new points, where the strands have such
    """
    at = nearest(strands, place, ends=True)
    first = strands[at.strand]
    if first.closed:
        first = _turned(first, at.arc, mesh)
    elif at.arc > 0.0:
        first = reversed_strand(first)
    return [first, *(each for number, each in enumerate(strands) if number != at.strand)]


def gone_on(strands: Sequence[Strand], place: ArrayLike, mesh: Mesh | None = None) -> list[Strand]:
    """What there is still to follow from the place on that is nearest to another."""
    at = nearest(strands, place)
    strand = strands[at.strand]
    rest = list(strands[at.strand + 1 :])
    if at.arc <= 0.0:
        return [strand, *rest]
    if at.arc >= strand.length:
        return rest
    return [replace(between(strand, at.arc, strand.length, mesh), part=strand.part), *rest]


def backwards(strands: Sequence[Strand]) -> list[Strand]:
    """The same way from its end to its beginning."""
    return [reversed_strand(strand) for strand in reversed(strands)]


def reversed_strand(strand: Strand) -> Strand:
    """A strand the other way round; a closed one begins where it did."""
    order = np.arange(len(strand.points))[::-1]
    arcs = strand.length - strand.arc_lengths
    if strand.closed:
        order = np.roll(order, 1)
        arcs[0] = 0.0
    return replace(
        strand,
        points=strand.points[order],
        normals=strand.normals[order],
        tangents=-strand.tangents[order],
        arc_lengths=arcs[order],
        radii=None if strand.radii is None else strand.radii[order][:, ::-1],
        faces=None if strand.faces is None else strand.faces[order],
        weights=None if strand.weights is None else strand.weights[order],
    )


def _turned(strand: Strand, arc: float, mesh: Mesh | None) -> Strand:
    """A closed strand that begins elsewhere."""
    if not 0.0 < arc < strand.length:
        return strand
    once = between(strand, arc, arc + strand.length, mesh)  # which ends where it begins

    def ring(values: np.ndarray | None) -> np.ndarray | None:
        return None if values is None else values[:-1]

    return replace(
        strand,
        points=once.points[:-1],
        normals=once.normals[:-1],
        tangents=once.tangents[:-1],
        arc_lengths=once.arc_lengths[:-1],
        radii=ring(once.radii),
        faces=ring(once.faces),
        weights=ring(once.weights),
    )
