# SPDX-License-Identifier: GPL-3.0-or-later
"""Meshes and curves in Wavefront OBJ files: numpy only, no bpy.

Coordinates are doubles and are taken as they are: no axis conversion, no scale. Blender's own
importer would round them to single precision and turn the axes.

What is wrong with a *file* (unreadable, malformed, no faces) is a `FileError` here; what is wrong
with a *mesh* (an index out of range, a vertex twice in a face, NaN) is left to the library, which
names the element.
"""

from __future__ import annotations

from pathlib import Path
from typing import NoReturn

import numpy as np
from numpy.typing import NDArray

from ..core import Polylines, Seed
from .whole_files import FileError, read_bytes, whole_file

# Face indices travel as uint32; what is larger cannot even be handed on to be refused.
_LARGEST_INDEX = 0xFFFFFFFF


def _read_lines(path: Path) -> list[bytes]:
    data = read_bytes(path).removeprefix(b"\xef\xbb\xbf")
    if b"\\" in data:  # a backslash at the end of a line continues it
        data = data.replace(b"\\\r\n", b" ").replace(b"\\\n", b" ")
    return data.splitlines()


def _malformed(path: Path, number: int, line: bytes, wanted: str) -> NoReturn:
    """Refuses line `number` (from 1), quoting its beginning."""
    text = line.strip().decode("utf-8", "replace")
    quoted = text if len(text) <= 40 else text[:37] + "..."
    raise FileError(f"{path}, line {number}: {quoted!r} is not {wanted}; correct the file")


def _point(path: Path, number: int, line: bytes) -> tuple[float, float, float]:
    # A v line may go on with a weight or a colour, which do not matter here.
    try:
        _, x, y, z = line.split(None, 4)[:4]
        return float(x), float(y), float(z)
    except ValueError:
        _malformed(path, number, line, "a vertex with three coordinates")


def _index(token: bytes, point_count: int) -> int:
    """The zero-based index of an OBJ reference such as 7, 7/1/3 or -1.

    `point_count` points stand before the line, which is where negative references count from.
    Raises ValueError for 0 and for what is no number. An index past the end is allowed here.
    """
    value = int(token.partition(b"/")[0])
    index = value - 1 if value > 0 else point_count + value
    if value == 0 or not 0 <= index < _LARGEST_INDEX:
        raise ValueError
    return index


def read_obj_mesh(path: str | Path) -> tuple[NDArray[np.float64], NDArray[np.uint32]]:
    """Reads the `v` and `f` lines of an OBJ file; all other lines are ignored.

    Returns vertices (n, 3) and triangles (m, 3), zero-based; polygons are fanned from their first
    corner. Indices past the last vertex and coordinates that are not finite are passed on, since
    the library names them.

    Raises FileError: the file cannot be read, a line is malformed, there are no faces.
    """
    path = Path(path)
    points: list[tuple[float, float, float]] = []
    triangles: list[tuple[int, int, int]] = []
    for number, line in enumerate(_read_lines(path), start=1):
        tokens = line.split(None, 1)
        if not tokens:
            continue
        if tokens[0] == b"v":
            points.append(_point(path, number, line))
        elif tokens[0] == b"f":
            try:
                corners = [_index(token, len(points)) for token in line.split()[1:]]
                first, second, third = corners[:3]
            except ValueError:
                _malformed(path, number, line, "a face of three or more vertices, counted from 1")
            triangles.append((first, second, third))
            for at in range(3, len(corners)):
                triangles.append((first, corners[at - 1], corners[at]))
    if not triangles:
        raise FileError(f"{path} has no faces; give a triangle mesh with v and f lines")
    vertices = np.array(points, dtype=np.float64).reshape(-1, 3)
    return vertices, np.array(triangles, dtype=np.uint32)


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
    coordinates = np.array(points, dtype=np.float64).reshape(-1, 3)
    for at, strand in enumerate(strands):
        # Exporters without cyclic lines repeat the first point under a new index.
        ends_meet = np.array_equal(coordinates[strand[0]], coordinates[strand[-1]])
        if not closed[at] and len(strand) > 3 and ends_meet:
            strand.pop()
            closed[at] = True
    offsets = np.cumsum([0] + [len(strand) for strand in strands]).astype(np.uint32)
    order = [vertex for strand in strands for vertex in strand]
    return Seed(coordinates[order], offsets, np.array(closed, dtype=np.uint8))


def _read_edges(
    path: Path,
) -> tuple[list[tuple[float, float, float]], dict[tuple[int, int], None], dict[int, list[int]]]:
    """The points, the edges in the order of the file, and the neighbours of every vertex."""
    points: list[tuple[float, float, float]] = []
    edges: dict[tuple[int, int], None] = {}  # in the order of the file
    neighbours: dict[int, list[int]] = {}
    last_reference = (-1, 0)  # greatest index and the line that has it
    for number, line in enumerate(_read_lines(path), start=1):
        tokens = line.split(None, 1)
        if not tokens:
            continue
        if tokens[0] == b"v":
            points.append(_point(path, number, line))
        elif tokens[0] == b"l":
            try:
                chain = [_index(token, len(points)) for token in line.split()[1:]]
            except ValueError:
                chain = []
            if len(chain) < 2:
                _malformed(path, number, line, "a line of two or more vertices, counted from 1")
            last_reference = max(last_reference, (max(chain), number))
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
    if last_reference[0] >= len(points):
        raise FileError(
            f"{path}, line {last_reference[1]}: there is no vertex {last_reference[0] + 1}, the "
            f"file has {len(points)}; correct the file"
        )
    return points, edges, neighbours


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


def write_obj_curve(path: str | Path, polylines: Polylines) -> None:
    """Writes a curve as `v` lines and one `l` line per strand, atomically.

    A closed strand ends with its first index again. 17 significant digits, so that reading gives
    the same doubles.

    Raises FileError when the file cannot be written; it is then as it was.
    """
    positions = np.ascontiguousarray(polylines.positions, dtype=np.float64).reshape(-1, 3)
    text = ["# Meander: v and l lines; a closed strand ends with its first index again\n"]
    text.append(("v %.17g %.17g %.17g\n" * len(positions)) % tuple(positions.ravel().tolist()))
    offsets = np.asarray(polylines.offsets).tolist()
    for start, stop, closed in zip(offsets[:-1], offsets[1:], polylines.closed, strict=True):
        indices = list(range(start + 1, stop + 1))
        if closed:
            indices.append(start + 1)
        text.append("l " + " ".join(map(str, indices)) + "\n")
    with whole_file(Path(path)) as temporary:
        temporary.write_text("".join(text), encoding="ascii", newline="\n")
