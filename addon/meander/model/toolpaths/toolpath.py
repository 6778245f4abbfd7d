# SPDX-License-Identifier: GPL-3.0-or-later
"""Curves as paths for tools: points in order with normals, resampled, as CSV, JSON or NPZ. No bpy.

Strands are never joined: a machine that goes from one to the next lifts its tool. Resampled points
lie on the pieces of the polyline, and so on the surface, since every piece lies in one face.
"""

from __future__ import annotations

import json
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ...core import PointData, Polylines
from ..files.npz import write_npz
from ..files.rows import rows, write_pieces
from ..files.whole import FileError, whole_file
from ..geometry.simplification import kept_within
from ..geometry.unit_vectors import unit

SUFFIXES = (".csv", ".json", ".npz")

# Resampling gives at most this many points; more is a mistake in the unit.
_MOST_POINTS = 50_000_000


@dataclass(frozen=True)
class Strand:
    """One strand: its points in order.

    closed       the last point goes on to the first, which is not repeated
    length       of the polyline that the points were taken from, back to the first point if closed
    points       (n, 3) float64
    normals      (n, 3) float64, unit, of the surface
    tangents     (n, 3) float64, unit, along the strand
    arc_lengths  (n,) float64, from the first point along the polyline
    radii        (n, 2) float64, r+ and r-: the medial radii to the right and to the left, seen
                 from outside; None where it is not known
    faces        (n,) int64, a triangle that holds the point, of the mesh that was filled
    weights      (n, 3) float64, of the triangle's corners
    part         the number of the part that it is, from 1, where the curve was cut; else 0
    """

    closed: bool
    length: float
    points: NDArray[np.float64]
    normals: NDArray[np.float64]
    tangents: NDArray[np.float64]
    arc_lengths: NDArray[np.float64]
    radii: NDArray[np.float64] | None = None
    faces: NDArray[np.int64] | None = None
    weights: NDArray[np.float64] | None = None
    part: int = 0


@dataclass(frozen=True)
class Mesh:
    """The triangles that faces and weights are about, in the units of the curve."""

    vertices: NDArray[np.float64]
    faces: NDArray[np.uint32]


def strand_of(
    points: NDArray[np.float64], normals: NDArray[np.float64], closed: bool, *known: Any
) -> Strand:
    """A strand through points, (n, 3), with unit normals, (n, 3).

    known   radii, faces and weights of the points; those that are left out are not known
    """
    arc_lengths = _arc_lengths(points, closed)
    return Strand(
        closed,
        float(arc_lengths[-1]),
        points,
        normals,
        _tangents(points, closed),
        arc_lengths[: len(points)],
        *known,
    )


def strands_of(polylines: Polylines, data: PointData | None = None) -> list[Strand]:
    """Every point of every strand, with what `data` knows of it."""
    offsets = np.asarray(polylines.offsets, dtype=np.int64)
    return [
        strand_of(
            np.asarray(polylines.positions[begin:end], dtype=np.float64),
            np.asarray(polylines.normals[begin:end], dtype=np.float64),
            bool(closed),
            *_known(data, begin, end),
        )
        for begin, end, closed in zip(offsets[:-1], offsets[1:], polylines.closed, strict=True)
    ]


def _known(data: PointData | None, begin: int, end: int) -> tuple:
    """Radii, faces and weights of the points from `begin` to `end`."""
    if data is None:
        return None, None, None
    span = slice(begin, end)
    radii = None if data.radii is None else np.asarray(data.radii[span], dtype=np.float64)
    return radii, data.faces[span].astype(np.int64), np.asarray(data.barycentrics[span])


def resampled_by_step(strand: Strand, step: float, mesh: Mesh | None = None) -> Strand:
    """Points at equal arc lengths along the strand, at most `step` apart, its ends among them.

    Normals, r+ and r- are interpolated by arc length. Faces and weights are those of the new
    points, and need the mesh.

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
    targets = np.linspace(0.0, strand.length, pieces + 1)
    if strand.closed:
        targets = targets[:-1]
    knots = strand.arc_lengths
    points, normals = strand.points, strand.normals
    radii, faces = strand.radii, strand.faces
    if strand.closed:
        knots = np.append(knots, strand.length)
        points, normals = np.vstack([points, points[:1]]), np.vstack([normals, normals[:1]])
        radii = None if radii is None else np.vstack([radii, radii[:1]])
        faces = None if faces is None else np.append(faces, faces[0])
    piece = np.clip(np.searchsorted(knots, targets, side="right") - 1, 0, len(knots) - 2)
    length = knots[piece + 1] - knots[piece]
    share = np.divide(
        targets - knots[piece], length, out=np.zeros_like(targets), where=length > 0.0
    )
    share = np.clip(share, 0.0, 1.0)[:, None]
    blended = (1.0 - share) * normals[piece] + share * normals[piece + 1]
    taken = (1.0 - share) * points[piece] + share * points[piece + 1]
    if radii is not None:
        radii = (1.0 - share) * radii[piece] + share * radii[piece + 1]
    held: tuple = (None, None)
    if faces is not None and mesh is not None:
        held = holding(taken, faces[piece], faces[piece + 1], mesh)
    return Strand(
        strand.closed,
        strand.length,
        taken,
        unit(blended, normals[piece]),
        _tangents(taken, strand.closed),
        targets,
        radii,
        *held,
    )


def holding(points: np.ndarray, here: np.ndarray, there: np.ndarray, mesh: Mesh) -> tuple:
    """Which of two triangles holds each point, and the weights of its corners there.

    A piece of the polyline lies in the triangle of one of its ends, if not in those of both.
    """
    first, first_off = _weights(points, here, mesh)
    second, second_off = _weights(points, there, mesh)
    other = second_off < first_off
    weights = np.clip(np.where(other[:, None], second, first), 0.0, 1.0)
    return np.where(other, there, here), weights / weights.sum(axis=1, keepdims=True)


def _weights(
    points: np.ndarray, triangles: np.ndarray, mesh: Mesh
) -> tuple[np.ndarray, np.ndarray]:
    """Weights of the corners at the places in the triangles' planes that are nearest to points, and
    how far off the points are: outside as a share of the triangle, or above it of its size."""
    a, b, c = (mesh.vertices[mesh.faces[triangles, corner]] for corner in range(3))
    u, v, w = b - a, c - a, points - a
    normal = np.cross(u, v)
    square = np.maximum((normal * normal).sum(axis=1), np.finfo(float).tiny)
    second = (np.cross(w, v) * normal).sum(axis=1) / square
    third = (np.cross(u, w) * normal).sum(axis=1) / square
    weights = np.column_stack([1.0 - second - third, second, third])
    height = np.abs((w * normal).sum(axis=1)) / square**0.75
    return weights, np.maximum(-weights.min(axis=1), height)


def resampled_by_tolerance(strand: Strand, tolerance: float) -> Strand:
    """As few of the strand's own points as keep it within `tolerance` of the straight pieces
    between them. At least 3 of a closed strand.
    """
    if len(strand.points) < 3:
        return strand
    points = strand.points
    kept = kept_within(points, strand.closed, tolerance)
    return Strand(
        strand.closed,
        strand.length,
        points[kept],
        strand.normals[kept],
        _tangents(points[kept], strand.closed),
        strand.arc_lengths[kept],
        *(
            None if values is None else values[kept]
            for values in (strand.radii, strand.faces, strand.weights)
        ),
    )


def resampled(
    strands: Sequence[Strand],
    step: float | None = None,
    tolerance: float | None = None,
    mesh: Mesh | None = None,
) -> list[Strand]:
    """Strands resampled by a step or by a chord tolerance, or with all points; see above."""
    if step is not None:
        return [resampled_by_step(strand, step, mesh) for strand in strands]
    if tolerance is not None:
        return [resampled_by_tolerance(strand, tolerance) for strand in strands]
    return list(strands)


def _arc_lengths(points: np.ndarray, closed: bool) -> np.ndarray:
    """Arc length at every point and, last, of the whole strand: twice the same in an open one."""
    following = np.roll(points, -1, axis=0) if closed else np.vstack([points[1:], points[-1:]])
    return np.concatenate([[0.0], np.cumsum(np.linalg.norm(following - points, axis=1))])


def _tangents(points: np.ndarray, closed: bool) -> np.ndarray:
    zero = np.zeros((1, 3))
    pieces = np.diff(points, axis=0, append=points[:1] if closed else points[-1:])
    out = unit(pieces)
    before = np.roll(out, 1, axis=0)
    if not closed:
        before[:1] = zero
    return unit(before + out, np.where(np.any(out, axis=1)[:, None], out, before))


# ------------------------------------------------------------------------------------------------
# Files

_COLUMNS = "strand,closed,point,x,y,z,nx,ny,nz,tx,ty,tz,arc_length,r_plus,r_minus,face,w0,w1,w2"
# Of a point's own number, its place, its directions, and the arc length there.
_ROW = ",".join(["%d", *["%.17g"] * 3, *["%.9g"] * 6, "%.17g"])
# Columns that may be unknown, and are then left empty.
_MORE = (("radii", 2, "%.9g"), ("faces", 1, "%d"), ("weights", 3, "%.17g"))


def write_csv(path: str | Path, strands: list[Strand]) -> None:
    """Writes one row a point, strands numbered from 0, atomically.

    A strand ends where the next number begins; 'closed' is 1 where its last point goes on to its
    first. What is not known of a strand is left empty. Raises FileError when the file cannot be
    written; it is then as it was.
    """
    with whole_file(Path(path)) as temporary:
        write_pieces(temporary, _csv_pieces(strands))


def _csv_pieces(strands: list[Strand]) -> Iterator[str]:
    yield _COLUMNS + "\n"
    for number, strand in enumerate(strands):
        pattern = f"{number},{int(strand.closed)},{_ROW}"
        columns = [np.arange(len(strand.points)), strand.points, strand.normals]
        columns += [strand.tangents, strand.arc_lengths]
        for name, width, form in _MORE:
            known = getattr(strand, name)
            pattern += f",{form}" * width if known is not None else "," * width
            if known is not None:
                columns.append(known)
        yield from rows(pattern + "\n", *columns)


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
                "r_plus": None if strand.radii is None else strand.radii[:, 0].tolist(),
                "r_minus": None if strand.radii is None else strand.radii[:, 1].tolist(),
                "faces": None if strand.faces is None else strand.faces.tolist(),
                "weights": None if strand.weights is None else strand.weights.tolist(),
            }
            for strand in strands
        ],
    }
    with whole_file(Path(path)) as temporary:
        temporary.write_text(json.dumps(record, allow_nan=False) + "\n", encoding="ascii")


def write_arrays(path: str | Path, strands: list[Strand], version: str) -> None:
    """Writes the strands as arrays, which numpy.load reads, atomically. Raises FileError as
    write_csv does.

    version, offsets (m + 1,), closed (m,) and lengths (m,) of m strands; of n points, in the order
    of the strands: points, normals, tangents, arc_lengths, and what is known of all strands of
    radii, faces and weights, with the shapes that a Strand has. Strand k has the points from
    offsets[k] to offsets[k + 1].
    """

    def arrays() -> Iterator[tuple[str, np.ndarray]]:
        yield "version", np.array(version)
        yield "offsets", offsets_of([len(strand.points) for strand in strands])
        yield "closed", np.array([strand.closed for strand in strands], dtype=bool)
        yield "lengths", np.array([strand.length for strand in strands], dtype=np.float64)
        for name in ("points", "normals", "tangents", "arc_lengths", "radii", "faces", "weights"):
            known = [getattr(strand, name) for strand in strands]
            if known and all(values is not None for values in known):
                yield name, np.concatenate(known)

    write_npz(Path(path), arrays())


def offsets_of(counts: Sequence[int]) -> NDArray[np.int64]:
    """Where lists that lie one after the other begin, and the end of the last."""
    return np.cumsum([0, *counts], dtype=np.int64)


_WRITERS: dict[str, Callable[[str | Path, list[Strand], str], None]] = {
    ".csv": lambda path, strands, _version: write_csv(path, strands),
    ".json": write_json,
    ".npz": write_arrays,
}


def write(path: str | Path, strands: list[Strand], version: str) -> None:
    """Writes a file of one of SUFFIXES, by its name; of another name, as a .csv file."""
    _WRITERS.get(Path(path).suffix.lower(), _WRITERS[".csv"])(path, strands, version)
