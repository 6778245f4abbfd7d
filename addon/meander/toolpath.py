# SPDX-License-Identifier: GPL-3.0-or-later
"""Curves as paths for tools: points in order with normals, resampled, as CSV or JSON. No bpy.

Strands are never joined: a machine that goes from one to the next lifts its tool. Resampled points
lie on the pieces of the polyline, and so on the surface, since every piece lies in one face.
"""

from __future__ import annotations

import json
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from .core import Polylines
from .mesh_files import FileError, atomic_output

SUFFIXES = (".csv", ".json")

# So many points at most come of resampling; more is a slip of the unit.
_MOST_POINTS = 50_000_000


@dataclass(frozen=True)
class Strand:
    """One strand: its points in order.

    closed       the last point goes on to the first, which is not repeated
    length       of the polyline that the points were taken from, back to the first point if closed
    points       (n, 3) float64
    normals      (n, 3) float64, unit, of the surface
    tangents     (n, 3) float64, unit, along the strand
    arc_lengths  (n,) float64, way from the first point along the polyline
    """

    closed: bool
    length: float
    points: NDArray[np.float64]
    normals: NDArray[np.float64]
    tangents: NDArray[np.float64]
    arc_lengths: NDArray[np.float64]


def strands_of(polylines: Polylines) -> list[Strand]:
    """Every point of every strand."""
    strands = []
    offsets = np.asarray(polylines.offsets, dtype=np.int64)
    for begin, end, closed in zip(offsets[:-1], offsets[1:], polylines.closed, strict=True):
        points = np.asarray(polylines.positions[begin:end], dtype=np.float64)
        normals = np.asarray(polylines.normals[begin:end], dtype=np.float64)
        way = _way(points, bool(closed))
        strands.append(
            Strand(
                bool(closed),
                float(way[-1]),
                points,
                normals,
                _tangents(points, bool(closed)),
                way[: len(points)],
            )
        )
    return strands


def resampled_by_step(strand: Strand, step: float) -> Strand:
    """Points at equal ways along the strand, at most `step` apart, its ends among them.

    At least 3 points of a closed strand and 2 of an open one. Raises FileError for a step so small
    that the points could not be counted.
    """
    if not strand.length > 0.0:
        return strand
    ratio = strand.length / step
    if ratio > _MOST_POINTS:
        raise FileError(
            f"A step of {step:g} would give more than {_MOST_POINTS:,} points; choose a longer one"
        )
    pieces = max(int(np.ceil(ratio * (1.0 - 1e-12))), 3 if strand.closed else 1)
    ways = np.linspace(0.0, strand.length, pieces + 1)
    if strand.closed:
        ways = ways[:-1]
    knots = strand.arc_lengths
    points, normals = strand.points, strand.normals
    if strand.closed:
        knots = np.append(knots, strand.length)
        points, normals = np.vstack([points, points[:1]]), np.vstack([normals, normals[:1]])
    piece = np.clip(np.searchsorted(knots, ways, side="right") - 1, 0, len(knots) - 2)
    length = knots[piece + 1] - knots[piece]
    share = np.divide(ways - knots[piece], length, out=np.zeros_like(ways), where=length > 0.0)
    share = np.clip(share, 0.0, 1.0)[:, None]
    blended = (1.0 - share) * normals[piece] + share * normals[piece + 1]
    taken = (1.0 - share) * points[piece] + share * points[piece + 1]
    return Strand(
        strand.closed,
        strand.length,
        taken,
        _unit(blended, normals[piece]),
        _tangents(taken, strand.closed),
        ways,
    )


def resampled_by_tolerance(strand: Strand, tolerance: float) -> Strand:
    """As few of the strand's own points as keep it within `tolerance` of the straight pieces
    between them (Ramer 1972; Douglas and Peucker 1973). At least 3 of a closed strand.
    """
    points = strand.points
    count = len(points)
    if count < 3:
        return strand
    keep = np.zeros(count + 1, dtype=bool)
    if strand.closed:
        # Three to begin with: the first, the farthest from it, and the farthest from both.
        ring = np.vstack([points, points[:1]])
        far = int(np.argmax(((points - points[0]) ** 2).sum(axis=1)))
        third = int(np.argmax(_distances(points, points[0], points[far])))
        first = sorted({0, far, third, count})
    else:
        ring = points
        first = [0, count - 1]
    keep[first] = True
    spans = list(zip(first[:-1], first[1:]))
    while spans:
        begin, end = spans.pop()
        if end - begin < 2:
            continue
        distances = _distances(ring[begin + 1 : end], ring[begin], ring[end])
        worst = int(np.argmax(distances))
        if distances[worst] <= tolerance:
            continue
        middle = begin + 1 + worst
        keep[middle] = True
        spans += [(begin, middle), (middle, end)]
    kept = np.flatnonzero(keep[:count])
    return Strand(
        strand.closed,
        strand.length,
        points[kept],
        strand.normals[kept],
        _tangents(points[kept], strand.closed),
        strand.arc_lengths[kept],
    )


def resampled(
    polylines: Polylines, step: float | None = None, tolerance: float | None = None
) -> list[Strand]:
    """The strands of polylines, resampled by a step or by a chord tolerance, or with all points."""
    strands = strands_of(polylines)
    if step is not None:
        return [resampled_by_step(strand, step) for strand in strands]
    if tolerance is not None:
        return [resampled_by_tolerance(strand, tolerance) for strand in strands]
    return strands


def _unit(vectors: np.ndarray, otherwise: np.ndarray) -> np.ndarray:
    lengths = np.linalg.norm(vectors, axis=1, keepdims=True)
    return np.where(lengths > 0.0, vectors / np.where(lengths > 0.0, lengths, 1.0), otherwise)


def _way(points: np.ndarray, closed: bool) -> np.ndarray:
    """Way to every point, and last the whole length, which in an open strand stands twice."""
    following = np.roll(points, -1, axis=0) if closed else np.vstack([points[1:], points[-1:]])
    return np.concatenate([[0.0], np.cumsum(np.linalg.norm(following - points, axis=1))])


def _tangents(points: np.ndarray, closed: bool) -> np.ndarray:
    zero = np.zeros((1, 3))
    pieces = np.diff(points, axis=0, append=points[:1] if closed else points[-1:])
    out = _unit(pieces, np.zeros_like(pieces))
    before = np.roll(out, 1, axis=0)
    if not closed:
        before[:1] = zero
    return _unit(before + out, np.where(np.any(out, axis=1)[:, None], out, before))


def _distances(points: np.ndarray, begin: np.ndarray, end: np.ndarray) -> np.ndarray:
    """Of points from the straight piece between two points."""
    way = end - begin
    square = float(way @ way)
    share = np.clip((points - begin) @ way / square, 0.0, 1.0) if square > 0.0 else 0.0
    return np.linalg.norm(points - begin - np.multiply.outer(share, way), axis=1)


# ------------------------------------------------------------------------------------------------
# Files

_COLUMNS = "strand,closed,point,x,y,z,nx,ny,nz,tx,ty,tz,arc_length"


def write_csv(path: str | Path, strands: list[Strand]) -> None:
    """Writes one row a point, strands numbered from 0, atomically.

    A strand ends where the next number begins; 'closed' is 1 where its last point goes on to its
    first. Raises FileError when the file cannot be written; it is then as it was.
    """
    with atomic_output(Path(path)) as temporary, temporary.open("w", newline="\n") as file:
        file.write(_COLUMNS + "\n")
        for number, strand in enumerate(strands):
            count = len(strand.points)
            rows = np.column_stack(
                [
                    np.full(count, number),
                    np.full(count, int(strand.closed)),
                    np.arange(count),
                    strand.points,
                    strand.normals,
                    strand.tangents,
                    strand.arc_lengths,
                ]
            )
            np.savetxt(file, rows, fmt=["%d"] * 3 + ["%.17g"] * 3 + ["%.9g"] * 6 + ["%.17g"],
                       delimiter=",", newline="\n")  # fmt: skip


def write_json(path: str | Path, strands: list[Strand], version: str) -> None:
    """Writes the strands as one JSON object, atomically. Raises FileError as write_csv does."""
    record = {
        "version": version,
        "strands": [
            {
                "closed": strand.closed,
                "length": strand.length,
                "points": strand.points.tolist(),
                "normals": strand.normals.tolist(),
                "tangents": strand.tangents.tolist(),
                "arc_lengths": strand.arc_lengths.tolist(),
            }
            for strand in strands
        ],
    }
    with atomic_output(Path(path)) as temporary:
        temporary.write_text(json.dumps(record, allow_nan=False) + "\n", encoding="ascii")


def write(path: str | Path, strands: list[Strand], version: str) -> None:
    """Writes a .csv or a .json file."""
    if Path(path).suffix.lower() == ".json":
        write_json(path, strands, version)
    else:
        write_csv(path, strands)
