# SPDX-License-Identifier: GPL-3.0-or-later
"""Strands cut into parts of a length: what a pen holds, a skein, a strip of lights; no bpy."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from ..files.whole import FileError
from ..geometry.unit_vectors import unit
from .toolpath import Mesh, Strand, holding

# More parts are a mistake in the unit.
_MOST_PARTS = 100_000


def parted(
    strands: Sequence[Strand], length: float, overlap: float = 0.0, mesh: Mesh | None = None
) -> list[Strand]:
    """Open strands of at most `length`, in order, each numbered as a part, from 1.

    overlap   how much two neighbouring parts have in common, less than the length; negative: the
              gap between them
    mesh      for faces and weights of the ends, where the strands have such

    What is no longer than `length` stays as it is, as a part of its own. Raises FileError for more
    parts than anybody could want.
    """
    found: list[Strand] = []
    for strand in strands:
        if strand.length <= length:
            found.append(replace(strand, part=len(found) + 1))
            continue
        # Each but the ends of an open strand has half of the overlap on both sides.
        count = int(np.ceil((strand.length - max(overlap, 0.0)) / (length - max(overlap, 0.0))))
        if strand.closed:
            count = int(np.ceil(strand.length / (length - max(overlap, 0.0))))
        count = max(count, 2)
        if len(found) + count > _MOST_PARTS:
            raise FileError(
                f"Parts of {length:g} would be more than {_MOST_PARTS:,}; choose a greater length"
            )
        cuts = np.linspace(0.0, strand.length, count + 1)
        for k in range(count):
            begin, end = cuts[k] - overlap / 2.0, cuts[k + 1] + overlap / 2.0
            if not strand.closed:
                begin = begin if k > 0 else 0.0
                end = end if k + 1 < count else strand.length
            if end > begin:
                found.append(replace(between(strand, begin, end, mesh), part=len(found) + 1))
    return found


def between(strand: Strand, begin: float, end: float, mesh: Mesh | None) -> Strand:
    """The part of a strand between arc lengths, which may lie beyond the ends of a closed one."""
    arcs, index = strand.arc_lengths, np.arange(len(strand.points))
    if strand.closed:  # once more before and after
        length = strand.length
        arcs = np.concatenate([arcs - length, arcs, arcs + length, [2.0 * length]])
        index = np.concatenate([index, index, index, index[:1]])
    inner = np.flatnonzero((arcs > begin) & (arcs < end))
    places = np.concatenate([[begin], arcs[inner], [end]])
    before = np.clip(np.searchsorted(arcs, places, side="right") - 1, 0, len(arcs) - 2)
    span = arcs[before + 1] - arcs[before]
    share = np.divide(places - arcs[before], span, out=np.zeros(len(places)), where=span > 0.0)
    share = np.clip(share, 0.0, 1.0)[:, None]
    here, there = index[before], index[before + 1]

    def blended(values: np.ndarray) -> np.ndarray:
        return (1.0 - share) * values[here] + share * values[there]

    points = blended(strand.points)
    faces = weights = None
    if strand.faces is not None and mesh is not None:
        faces, weights = holding(points, strand.faces[here], strand.faces[there], mesh)
    return Strand(
        False,
        end - begin,
        points,
        unit(blended(strand.normals), strand.normals[here]),
        unit(blended(strand.tangents), strand.tangents[here]),
        places - begin,
        None if strand.radii is None else blended(strand.radii),
        faces,
        weights,
    )
