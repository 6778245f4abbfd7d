# SPDX-License-Identifier: GPL-3.0-or-later
"""Meshes and curves in Wavefront OBJ files: numpy only, no bpy.

Coordinates are doubles and are taken as they are: no axis conversion, no scale. Blender's own
importer would round them to single precision and turn the axes.

What is wrong with a *file* (unreadable, malformed, no faces, a vertex that is not there) is a
`FileError` here; what is wrong with a *mesh* (a vertex twice in a face, NaN) is left to the
library, which names the element. It reads the text too, in a fifteenth of the time of Python.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from ... import core
from ...core import Polylines, Seed
from .polygons import MeshOfFile, left_out, triangles_of
from .rows import rows, write_pieces
from .text import in_file, read_plain, told_apart
from .whole import FileError, whole_file


def read_obj(path: Path) -> MeshOfFile:
    """Reads the `v` and `f` lines of an OBJ file; all other lines are ignored.

    Polygons become the triangles that Blender makes of them; faces of fewer than three corners are
    left out. Coordinates that are not finite are passed on, since the library names them.

    Raises FileError: the file cannot be read, a line is malformed or names a vertex that is not
    there, there are no faces.
    """
    data = _text_of(path)
    found = _read(path, data, core.Text.OBJ_FACES)
    if not len(found.ends):
        raise FileError(f"{path} {_no_faces(data)}")
    faces, polygons = triangles_of(found.positions, found.corners, found.ends)
    if not len(faces):
        raise FileError(f"{path} has no faces with an area; give a mesh of v and f lines")
    return MeshOfFile(
        found.positions, faces, left_out(found.left_out), polygons, found.lines, first=1
    )


def _text_of(path: Path) -> bytes:
    data = read_plain(path)
    other = told_apart(data, ".obj")
    if other:
        raise FileError(f"{path} is {other}, and no OBJ file; export the mesh as one")
    return data


def _read(path: Path, data: bytes, kind: core.Text) -> core.TextPolygons:
    try:
        return core.read_polygons(data, kind)
    except core.MeanderError as problem:
        if problem.status != core.Status.INVALID_MESH:
            raise
        raise in_file(path, problem) from problem


def _no_faces(data: bytes) -> str:
    """What to say of an OBJ file without a face."""
    if b"\0" in data[:4096]:
        return "is not text, so it is no OBJ file; export the mesh as one"
    if re.search(rb"^\s*(?:curv|surf|cstype)\b", data, re.MULTILINE):
        return "holds curved surfaces, and no faces; export it with faces"
    if re.search(rb"^\s*l\s", data, re.MULTILINE):
        return "has lines, and no faces; give a mesh with v and f lines, or give it to --seed"
    return "has no faces; give a mesh with v and f lines"


def read_obj_curve(path: str | Path) -> Seed:
    """Reads the `v` and `l` lines of an OBJ file as strands.

    Lines that share an end vertex are chained, so that one line of many points and many lines of
    two points mean the same. A strand that returns to its first point, by index or by coordinates,
    is closed. Strands come in the order, and run in the direction, of their first line.

    Returns a Seed in the file's coordinates, without fixed points.

    Raises FileError: the file cannot be read, a line is malformed, there are no lines, a line
    refers to a vertex that does not exist, a strand branches.
    """
    path = Path(path)
    points, edges, neighbours = _read_edges(path)
    for vertex, around in neighbours.items():
        if len(around) > 2:
            raise FileError(
                f"{path}: the curve branches at vertex {vertex + 1}, where {len(around)} pieces "
                "meet; separate the strands"
            )
    strands, closed = _chain(edges, neighbours)
    for at, strand in enumerate(strands):
        # Exporters without cyclic lines repeat the first point under a new index.
        ends_meet = np.array_equal(points[strand[0]], points[strand[-1]])
        if not closed[at] and len(strand) > 3 and ends_meet:
            strand.pop()
            closed[at] = True
    offsets = np.cumsum([0] + [len(strand) for strand in strands]).astype(np.uint32)
    order = [vertex for strand in strands for vertex in strand]
    return Seed(points[order], offsets, np.array(closed, dtype=np.uint8))


def _read_edges(
    path: Path,
) -> tuple[NDArray[np.float64], dict[tuple[int, int], None], dict[int, list[int]]]:
    """The points, the edges in the order of the file, and the neighbours of every vertex."""
    found = _read(path, _text_of(path), core.Text.OBJ_LINES)
    edges: dict[tuple[int, int], None] = {}  # in the order of the file
    neighbours: dict[int, list[int]] = {}
    begin = 0
    for stop, number in zip(found.ends.tolist(), found.lines.tolist(), strict=True):
        chain = found.corners[begin:stop].tolist()
        begin = stop
        for start, end in zip(chain[:-1], chain[1:], strict=True):
            if start == end:
                continue  # a repeated point adds nothing
            if (start, end) in edges or (end, start) in edges:
                raise FileError(
                    f"{path}, line {number}: the piece between the vertices {start + 1} and "
                    f"{end + 1} is there twice; remove one"
                )
            edges[(start, end)] = None
            neighbours.setdefault(start, []).append(end)
            neighbours.setdefault(end, []).append(start)
    if not edges:
        raise FileError(f"{path} has no curve; give v and l lines with at least two points")
    return found.positions, edges, neighbours


def _chain(
    edges: dict[tuple[int, int], None], neighbours: dict[int, list[int]]
) -> tuple[list[list[int]], list[bool]]:
    """Joins edges into strands of vertex indices, and says which of them are closed.

    No vertex has more than two neighbours.
    """
    strands: list[list[int]] = []
    closed: list[bool] = []
    seen: set[int] = set()

    def walk(before: int, vertex: int) -> list[int]:
        """Vertices from `vertex` on, away from `before`, to an end or back to `before`."""
        found = []
        while True:
            found.append(vertex)
            if vertex in seen:
                return found
            seen.add(vertex)
            onward = [other for other in neighbours[vertex] if other != before]
            if not onward:
                return found
            before, vertex = vertex, onward[0]

    for start, end in edges:
        if start in seen:
            continue
        seen.add(start)
        forward = walk(start, end)
        if forward[-1] == start:
            strands.append([start, *forward[:-1]])
            closed.append(True)
            continue
        others = [other for other in neighbours[start] if other != end]
        backward = walk(start, others[0]) if others else []
        strands.append([*reversed(backward), start, *forward])
        closed.append(False)
    return strands, closed


def write_obj_curve(path: str | Path, polylines: Polylines, pairs: bool = False) -> None:
    """Writes a curve as `v` lines and one `l` line per strand, atomically.

    pairs   one `l` line per piece instead: of longer lines the importer of Blender 3.4 reads the
            first piece only

    A closed strand ends with its first index again. 17 significant digits, so that reading gives
    the same doubles.

    Raises FileError when the file cannot be written; it is then as it was.
    """
    with whole_file(Path(path)) as temporary:
        write_pieces(temporary, _curve_pieces(polylines, pairs))


def _curve_pieces(polylines: Polylines, pairs: bool) -> Iterator[str]:
    yield "# Meander: v and l lines; a closed strand ends with its first index again\n"
    positions = np.asarray(polylines.positions, dtype=np.float64).reshape(-1, 3)
    yield from rows("v %.17g %.17g %.17g\n", positions)
    offsets = np.asarray(polylines.offsets).tolist()
    for start, stop, closed in zip(offsets[:-1], offsets[1:], polylines.closed, strict=True):
        indices = np.arange(start + 1, stop + 1)
        if closed:
            indices = np.append(indices, start + 1)
        if pairs:
            yield from rows("l %d %d\n", indices[:-1], indices[1:])
        else:
            yield "l"
            yield from rows(" %d", indices)
            yield "\n"
