# SPDX-License-Identifier: GPL-3.0-or-later
"""Strands laid flat by a UV map: each triangle carries its pieces into the plane; no bpy.

Where the map is cut along a seam the strand is cut as well, exactly on the edge. What lies on both
sides of a seam becomes several open strands.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from ..geometry.flat_crossings import crossings, segments_of
from .drawing import ring
from .toolpath import Mesh, Strand, strand_of

# The triangle nearest to each point and the weights of its corners.
Nearest = Callable[[NDArray[np.float64]], tuple[NDArray[np.int64], NDArray[np.float64]]]

# A piece lies in a triangle if its ends are no farther outside than this share of its height:
# results are kept in single precision.
_ON = 1e-4
# Two places of the map are one if they are no farther apart than this share of a triangle's side.
_SAME = 1e-3
# Room between islands that are laid side by side, as a share of the drawing's width.
_MARGIN = 0.05
# Pieces that pass over several triangles are halved so often at most.
_MOST_HALVINGS = 12


def unrolled(
    strands: Sequence[Strand], mesh: Mesh, uv: NDArray[np.float64], nearest: Nearest | None = None
) -> list[Strand]:
    """The strands in the plane z = 0, in their order, enlarged so that areas are the surface's.

    Where islands of the map lie on top of each other, so that what is on them would cross, they are
    laid side by side.

    strands   with faces, whose pieces may pass over several triangles where `nearest` is given
    uv        (faces, 3, 2), the map at the corners of the mesh's triangles
    nearest   finds points on the mesh; None: every piece lies in one triangle
    """
    scale = _scale(mesh, uv)
    island = _islands(mesh, uv)
    flat: list[tuple[Strand, int]] = []
    lines = [
        (ring(strand), np.append(strand.faces, strand.faces[:1]) if strand.closed else strand.faces)
        for strand in strands
    ]
    if nearest is not None:
        lines = _divided(lines, mesh, nearest)
    for strand, (points, faces) in zip(strands, lines, strict=True):
        begin, end, small, held = _in_the_map(points, faces, mesh, uv)
        runs = _runs(begin, end, small, island[held])
        for run, closed, of in _joined(runs, strand.closed):
            made = _strand(run * scale, closed)
            if made is not None:
                flat.append((made, of))
    return _apart(flat)


def _islands(mesh: Mesh, uv: NDArray[np.float64]) -> NDArray[np.int64]:
    """The island of the map that each triangle is a part of, named by its first triangle: triangles
    that have an edge in common in the map too, and are not folded onto each other there."""
    count = len(mesh.faces)
    faces = mesh.faces.astype(np.int64)
    ends = np.stack([faces, np.roll(faces, -1, axis=1)], axis=2).reshape(-1, 2)
    places = np.stack([uv, np.roll(uv, -1, axis=1)], axis=2).reshape(-1, 2, 2)
    turned = ends[:, 0] > ends[:, 1]
    ends[turned], places[turned] = ends[turned, ::-1], places[turned, ::-1]
    order = np.lexsort((ends[:, 1], ends[:, 0]))
    one, other = order[:-1], order[1:]
    u, v = uv[:, 1] - uv[:, 0], uv[:, 2] - uv[:, 0]
    side = np.sign(u[:, 0] * v[:, 1] - u[:, 1] * v[:, 0])
    small = _SAME * np.linalg.norm(uv - np.roll(uv, 1, axis=1), axis=2).max(axis=1)
    near = np.linalg.norm(places[one] - places[other], axis=2).max(axis=1) <= small[one // 3]
    joined = (ends[one] == ends[other]).all(axis=1) & near & (side[one // 3] == side[other // 3])
    a, b = one[joined] // 3, other[joined] // 3
    label = np.arange(count)
    while True:
        least = np.minimum(label[a], label[b])
        new = label.copy()
        np.minimum.at(new, label[a], least)
        np.minimum.at(new, label[b], least)
        new = new[new]
        if np.array_equal(new, label):
            return label
        label = new


def _apart(flat: list[tuple[Strand, int]]) -> list[Strand]:
    """Strands on islands, those islands moved to the side whose strands would cross others'."""
    strands = [strand for strand, _island in flat]
    if len({island for _strand, island in flat}) < 2:
        return strands
    islands = np.array([island for _strand, island in flat])
    begin, end, owner = segments_of(
        [strand.points for strand in strands], [strand.closed for strand in strands]
    )
    first, second, _places = crossings(begin, end)
    a, b = islands[owner[first]], islands[owner[second]]
    conflicts: dict[int, set[int]] = {}
    for one, other in np.unique(np.column_stack([a, b])[a != b], axis=0).tolist():
        conflicts.setdefault(one, set()).add(other)
        conflicts.setdefault(other, set()).add(one)
    if not conflicts:
        return strands
    sheet: dict[int, int] = {}
    for island in sorted(set(islands.tolist())):  # on the first sheet where nothing is in the way
        taken = {sheet[other] for other in conflicts.get(island, ()) if other in sheet}
        sheet[island] = next(n for n in range(len(taken) + 1) if n not in taken)
    low = np.min([strand.points.min(axis=0) for strand in strands], axis=0)
    high = np.max([strand.points.max(axis=0) for strand in strands], axis=0)
    step = np.array([(1.0 + _MARGIN) * (high - low)[0], 0.0, 0.0])
    return [
        replace(strand, points=strand.points + sheet[island] * step)
        for strand, island in flat
    ]


def _scale(mesh: Mesh, uv: NDArray[np.float64]) -> float:
    """The root of the surface's area over the map's."""
    a, b, c = (mesh.vertices[mesh.faces[:, corner]] for corner in range(3))
    area = np.linalg.norm(np.cross(b - a, c - a), axis=1).sum()
    u, v = uv[:, 1] - uv[:, 0], uv[:, 2] - uv[:, 0]
    flat = np.abs(u[:, 0] * v[:, 1] - u[:, 1] * v[:, 0]).sum()
    return float(np.sqrt(area / flat)) if flat > 0.0 else 0.0


def _divided(
    lines: list[tuple[np.ndarray, np.ndarray]], mesh: Mesh, nearest: Nearest
) -> list[tuple[np.ndarray, np.ndarray]]:
    """Lines, each its points and their faces, with points on the surface between those of pieces
    that pass over more than two triangles. All at once: `nearest` costs as much for one point."""
    if not lines:
        return lines
    points = np.vstack([of_line for of_line, _faces in lines])
    faces = np.concatenate([of_line for _points, of_line in lines])
    owner = np.repeat(np.arange(len(lines)), [len(of_line) for _points, of_line in lines])
    for _ in range(_MOST_HALVINGS):
        here, there = faces[:-1], faces[1:]
        good = (here == there) | _holds(points[1:], here, mesh) | _holds(points[:-1], there, mesh)
        shared, _first, _second = _shared_edges(here, there, mesh)
        long = np.flatnonzero(~(good | shared) & (owner[:-1] == owner[1:]))
        if not len(long):
            break
        index, weights = nearest((points[long] + points[long + 1]) / 2.0)
        places = np.einsum("nk,nkj->nj", weights, mesh.vertices[mesh.faces[index]])
        points = np.insert(points, long + 1, places, axis=0)
        faces = np.insert(faces, long + 1, index)
        owner = np.insert(owner, long + 1, owner[long])
    ends = np.searchsorted(owner, np.arange(1, len(lines)))
    return list(zip(np.split(points, ends), np.split(faces, ends)))


def _in_the_map(
    points: np.ndarray, faces: np.ndarray, mesh: Mesh, uv: np.ndarray
) -> tuple[np.ndarray, np.ndarray, np.ndarray, np.ndarray]:
    """Every piece as one or two in the map: their begins and ends, (n, 2), a length that is
    nothing there, and the triangles that carry them."""
    here, there = faces[:-1], faces[1:]
    begin, end = points[:-1], points[1:]
    in_here = (here == there) | _holds(end, here, mesh)
    in_there = ~in_here & _holds(begin, there, mesh)
    shared, first, second = _shared_edges(here, there, mesh)
    across = ~in_here & ~in_there & shared
    middle = (begin + end) / 2.0
    middle[across] = _nearest_on(
        begin[across], end[across], mesh.vertices[first[across]], mesh.vertices[second[across]]
    )
    # In two parts, the second of which is nothing where one triangle holds the whole.
    face_1, face_2 = np.where(in_there, there, here), np.where(in_here, here, there)
    parts = np.stack([_carried(begin, face_1, mesh, uv), _carried(middle, face_1, mesh, uv)], 1)
    more = np.stack([_carried(middle, face_2, mesh, uv), _carried(end, face_2, mesh, uv)], 1)
    both = np.stack([parts, more], axis=1).reshape(-1, 2, 2)
    sides = np.linalg.norm(uv - np.roll(uv, 1, axis=1), axis=2).max(axis=1)
    small = _SAME * np.column_stack([sides[face_1], sides[face_2]]).reshape(-1)
    return both[:, 0], both[:, 1], small, np.column_stack([face_1, face_2]).reshape(-1)


def _runs(
    begin: np.ndarray, end: np.ndarray, small: np.ndarray, island: np.ndarray
) -> list[tuple[np.ndarray, int]]:
    """Polylines of pieces that continue one another on one island, and the islands."""
    apart = np.linalg.norm(begin[1:] - end[:-1], axis=1) > np.maximum(small[1:], small[:-1])
    apart |= island[1:] != island[:-1]
    cuts = [0, *(np.flatnonzero(apart) + 1).tolist(), len(begin)]
    return [
        (np.vstack([begin[a:b], end[b - 1 : b]]), int(island[a]))
        for a, b in zip(cuts[:-1], cuts[1:])
    ]


def _joined(
    runs: list[tuple[np.ndarray, int]], closed: bool
) -> list[tuple[np.ndarray, bool, int]]:
    """The runs of a closed strand begin in the middle of one: its halves are put together."""
    whole = [(run, False, island) for run, island in runs]
    if not closed:
        return whole
    (first, island), (last, other) = runs[0], runs[-1]
    gap = np.linalg.norm(first[0] - last[-1])
    size = float(np.ptp(np.vstack([run for run, _island in runs]), axis=0).max())
    if island != other or gap > _SAME * max(size, 1e-300):
        return whole
    if len(runs) == 1:
        return [(first[:-1], True, island)]
    return [(np.vstack([last[:-1], first]), False, island), *whole[1:-1]]


def _strand(points: np.ndarray, closed: bool) -> Strand | None:
    """A flat strand without points on top of one another; None: there is nothing of it."""
    ends = np.roll(points, -1, axis=0) if closed else points[1:]
    steps = np.linalg.norm(ends - points[: len(ends)], axis=1)
    size = float(np.ptp(points, axis=0).max())
    keep = np.append(True, (steps[:-1] if closed else steps) > 1e-9 * size)
    if keep.sum() < (3 if closed else 2) or size == 0.0:
        return None
    if not closed:
        keep[-1] = True
    flat = np.column_stack([points[keep], np.zeros(int(keep.sum()))])
    return strand_of(flat, np.tile([0.0, 0.0, 1.0], (len(flat), 1)), closed)


def _weights(points: np.ndarray, faces: np.ndarray, mesh: Mesh) -> np.ndarray:
    """Of the corners of triangles, at the places in their planes nearest to points."""
    a, b, c = (mesh.vertices[mesh.faces[faces, corner]] for corner in range(3))
    u, v, w = b - a, c - a, points - a
    normal = np.cross(u, v)
    square = np.maximum(np.einsum("nk,nk->n", normal, normal), np.finfo(float).tiny)
    second = np.einsum("nk,nk->n", np.cross(w, v), normal) / square
    third = np.einsum("nk,nk->n", np.cross(u, w), normal) / square
    return np.column_stack([1.0 - second - third, second, third])


def _holds(points: np.ndarray, faces: np.ndarray, mesh: Mesh) -> np.ndarray:
    """Whether triangles hold points, but for rounding."""
    weights = _weights(points, faces, mesh)
    corners = mesh.vertices[mesh.faces[faces]]
    off = np.linalg.norm(np.einsum("nk,nkj->nj", weights, corners) - points, axis=1)
    side = np.linalg.norm(corners - np.roll(corners, 1, axis=1), axis=2).min(axis=1)
    return (weights.min(axis=1) >= -_ON) & (off <= _ON * side)


def _shared_edges(here: np.ndarray, there: np.ndarray, mesh: Mesh) -> tuple:
    """Whether two triangles have an edge in common, and its vertices."""
    a, b = mesh.faces[here].astype(np.int64), mesh.faces[there].astype(np.int64)
    common = (a[:, :, None] == b[:, None, :]).any(axis=2)
    shared = common.sum(axis=1) == 2
    lone = np.argmin(common, axis=1)  # the corner of the first that is not in the second
    rows = np.arange(len(a))
    return shared, a[rows, (lone + 1) % 3], a[rows, (lone + 2) % 3]


def _nearest_on(
    begin: np.ndarray, end: np.ndarray, low: np.ndarray, high: np.ndarray
) -> np.ndarray:
    """The places on edges where lines from begin to end pass them most nearly."""
    u, v, w = end - begin, high - low, begin - low
    uu, uv, vv = (np.einsum("nk,nk->n", *pair) for pair in ((u, u), (u, v), (v, v)))
    uw, vw = (np.einsum("nk,nk->n", *pair) for pair in ((u, w), (v, w)))
    determinant = uu * vv - uv * uv
    share = np.divide(
        uu * vw - uv * uw,
        determinant,
        out=np.full_like(uu, 0.5),
        where=determinant > 1e-12 * uu * vv,
    )
    return low + np.clip(share, 0.0, 1.0)[:, None] * v


def _carried(points: np.ndarray, faces: np.ndarray, mesh: Mesh, uv: np.ndarray) -> np.ndarray:
    """Points of triangles in the map."""
    weights = np.clip(_weights(points, faces, mesh), 0.0, 1.0)
    weights /= weights.sum(axis=1, keepdims=True)
    return np.einsum("nk,nkj->nj", weights, uv[faces])
