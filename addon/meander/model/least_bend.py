# SPDX-License-Identifier: GPL-3.0-or-later
"""How sharply a curve bends, and a radius that no turn of it is to fall short of; no bpy.

Turns get wider with the stiffness, but not by a rule: the sharpest of hundreds is what counts, and
where the surface itself bends, or the spacing is too small, no stiffness helps. So the curve that
has grown gets stiffer in steps, until the radius holds, and is measured after each.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import replace
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from .. import core
from ..core import Polylines

# Bends are measured over an arc of half a radius: what is shorter is smoothed by any thread.
_ARC = 0.5
# Places that are looked at for each such arc, of which the sharpest is missed by up to 5 % of the
# radius; and how many times as many around those that are about as sharp as it.
_PER_ARC = 4
_CLOSER = 8
_ABOUT = 1.25
# Arcs at a time.
_BLOCK = 1 << 15


class Bend(NamedTuple):
    """The sharpest bend of a curve.

    radius   of the circle through three points of it, in its units; infinite where it is straight
    place    (3,), the point in the middle
    strand   the strand that has it
    """

    radius: float
    place: NDArray[np.float64]
    strand: int


def sharpest_bend(polylines: Polylines, radius: float) -> Bend | None:
    """The least radius of bending in space, over arcs of half of `radius`, which is half the
    spacing; None for a curve that has no such arc.
    """
    best: Bend | None = None
    offsets = np.asarray(polylines.offsets, dtype=np.int64).tolist()
    for number, (begin, end, closed) in enumerate(
        zip(offsets[:-1], offsets[1:], polylines.closed, strict=True)
    ):
        strand = _Strand(polylines.positions[begin:end], bool(closed), _ARC * radius / 2.0)
        if not strand.has_arc:
            continue
        places = strand.places(_PER_ARC)
        radii = np.concatenate([strand.radii(some) for some in _blocks(places)])
        # Only where it bends about as sharply as anywhere is it worth a closer look.
        sharp = np.flatnonzero(radii <= _ABOUT * radii.min())
        if len(sharp) > _BLOCK:
            sharp = sharp[np.argsort(radii[sharp], kind="stable")[:_BLOCK]]
        closer = strand.around(places[np.sort(sharp)])
        radii = np.concatenate([strand.radii(some) for some in _blocks(closer)])
        least = int(np.argmin(radii))
        if best is None or radii[least] < best.radius:
            best = Bend(float(radii[least]), strand.at(closer[least : least + 1])[0], number)
    return best


def _blocks(places: np.ndarray) -> Iterator[np.ndarray]:
    """All at once would take half a kilobyte each."""
    return (places[begin : begin + _BLOCK] for begin in range(0, len(places), _BLOCK))


class _Strand:
    """A strand, and places on it by the length of the line up to there."""

    def __init__(self, points: np.ndarray, closed: bool, half: float) -> None:
        """half   of the arcs over which bends are measured"""
        points = np.asarray(points, dtype=np.float64)
        if closed:
            points = np.vstack([points, points[:1]])
        steps = np.linalg.norm(np.diff(points, axis=0), axis=1)
        self._lengths = np.concatenate([[0.0], np.cumsum(steps)])
        self._axes = np.ascontiguousarray(points.T)
        self._closed, self._half = closed, half

    @property
    def has_arc(self) -> bool:
        return bool(self._lengths[-1] > 2.0 * self._half)

    def places(self, per_arc: int) -> np.ndarray:
        """The middles of arcs, evenly, about so many for the length of each."""
        length, half = float(self._lengths[-1]), self._half
        count = int(np.ceil(per_arc * length / (2.0 * half)))
        if self._closed:
            return np.linspace(0.0, length, count, endpoint=False)
        return np.linspace(half, length - half, count)

    def around(self, places: np.ndarray) -> np.ndarray:
        """The same places and those around them, up to the next that places() gives."""
        step = 2.0 * self._half / (_PER_ARC * _CLOSER)
        around = (places[:, None] + step * np.arange(1 - _CLOSER, _CLOSER)).ravel()
        if self._closed:
            return around
        return np.clip(around, self._half, float(self._lengths[-1]) - self._half)

    def at(self, places: np.ndarray) -> np.ndarray:
        """(n, 3)"""
        length = float(self._lengths[-1])
        places = places % length if self._closed else np.clip(places, 0.0, length)
        return np.column_stack([np.interp(places, self._lengths, axis) for axis in self._axes])

    def radii(self, middles: np.ndarray) -> np.ndarray:
        """Of the bends over the arcs around places."""
        half = self._half
        return _radii(self.at(middles - half), self.at(middles), self.at(middles + half))


def _radii(a: np.ndarray, b: np.ndarray, c: np.ndarray) -> np.ndarray:
    """Of the circles through three points each."""
    u, v = b - a, c - a
    area = np.linalg.norm(np.cross(u, v), axis=1)
    sides = np.prod([np.linalg.norm(side, axis=1) for side in (u, v, c - b)], axis=0)
    # Three points of which two are one: the curve turns back on itself.
    flat = area <= 1e-12 * np.maximum(sides, np.finfo(float).tiny) ** (2.0 / 3.0)
    back = (u * (c - b)).sum(axis=1) < 0.0
    radii = np.divide(sides, 2.0 * area, out=np.full(len(a), np.inf), where=~flat)
    return np.where(flat & back, 0.0, radii)


# Up to where a curve still turns at the spacing; beyond twice as much the library warns.
STIFFNESSES = (1.0, 1.5, 2.0, 3.0, 4.0, 6.0, 8.0)

# Strands rest farther apart by this power of their stiffness, which the library makes up for
# (docs/decisions.md, "The spacing that is asked for").
LOOSER_WHERE_STIFF = 1.0 / 9.0


class Stiffening:
    """What has been found for a radius that is asked for, in the units of the mesh; 0: for none.

    held   whether the curve keeps the radius, once it has been measured
    best   the bend that came nearest, and the stiffness of its curve; None: nothing was too sharp
    """

    def __init__(self, least: float) -> None:
        self.least = least
        self.held = True
        self.best: tuple[Bend, float] | None = None

    def following(self, bend: Bend | None, options: core.FlowOptions) -> core.FlowOptions | None:
        """The options with which a curve is to go on; None: it holds, or nothing helps.

        bend      its sharpest one, of sharpest_bend()
        options   with which it grew
        """
        self.held = bend is None or bend.radius >= self.least
        if self.held:
            return None
        if self.best is None or bend.radius > self.best[0].radius:
            self.best = bend, options.bending_weight
        return _stiffer(options)

    def refusal(self, length_text: Callable[[float], str]) -> str:
        """Of a radius that is not held, a sentence.

        length_text   writes a length
        """
        bend, stiffness = self.best
        place = ", ".join(f"{value:.4g}" for value in bend.place)
        return (
            f"no stiffness holds a bend radius of {length_text(self.least)}: the curve comes "
            f"nearest with {length_text(bend.radius)}, at a stiffness of {stiffness:g}, and bends "
            f"most sharply at ({place}); choose a larger spacing, a smaller radius, or a surface "
            "that is smoother there"
        )


def _stiffer(options: core.FlowOptions) -> core.FlowOptions | None:
    """The same options with the next stiffness; None: this is the last."""
    now = options.bending_weight
    following = [stiffness for stiffness in STIFFNESSES if stiffness > now]
    if not following:
        return None
    # The polish follows in proportion, as the weight of the table does.
    ratio = following[0] / now if now > 0.0 else 1.0
    # At its spacing a curve turns hardly any wider however stiff it is: here stiffness may widen
    # it.
    rest = options.tunings["polish_rest"] * ratio**-LOOSER_WHERE_STIFF
    return replace(
        options,
        bending_weight=following[0],
        polish_bending_weight=options.polish_bending_weight * ratio,
        tunings={**options.tunings, "polish_rest": rest},
    )
