# SPDX-License-Identifier: GPL-3.0-or-later
"""Fills long and narrow surfaces, and says how much of each stays empty.

    python3 tests/sweep/long_surfaces.py [--only strip] [--lengths 10,100] [--widths 0.8,4]

A line for every shape, length and width in spacings, with few faces and with many, from nothing and
from a stroke at one end. Times are of a processor; `times` is over that of a square of as many
faces and the same area from nothing.
"""

from __future__ import annotations

import argparse
import sys
import time
from collections.abc import Callable
from dataclasses import dataclass
from functools import cache
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

ROOT = Path(__file__).resolve().parents[2]
sys.path += [str(ROOT / "tests" / "core"), str(ROOT / "addon")]

from geometry import Mesh  # noqa: E402
from meander import core  # noqa: E402

Points = NDArray[np.float64]


def band(left: Points, right: Points, closed: bool = False) -> Mesh:
    """The quads between two rows of points (n, 3), each as two faces."""
    n = len(left)
    a = np.arange(n if closed else n - 1)
    b = (a + 1) % n
    faces = np.vstack([np.stack([a, b, b + n], 1), np.stack([a, b + n, a + n], 1)])
    return Mesh(np.vstack([left, right]), faces.astype(np.uint32))


def grid(rows: NDArray[np.float64], closed: bool) -> Mesh:
    """The surface over rows of points (m, n, 3); `closed`: each row is."""
    m, n = rows.shape[:2]
    i, j = np.meshgrid(np.arange(m - 1), np.arange(n if closed else n - 1), indexing="ij")
    a, b = i * n + j, i * n + (j + 1) % n
    quads = np.stack([a, b, b + n, a + n], -1).reshape(-1, 4)
    faces = np.vstack([quads[:, [0, 1, 2]], quads[:, [0, 2, 3]]])
    return Mesh(rows.reshape(-1, 3), faces.astype(np.uint32))


def along(length: float, pieces: int) -> Points:
    points = np.zeros((pieces + 1, 3))
    points[:, 0] = np.linspace(0, length, pieces + 1)
    return points


def strip(length: float, width: float, pieces: int) -> Mesh:
    middle = along(length, pieces)
    return band(middle - [0, width / 2, 0], middle + [0, width / 2, 0])


def needle(length: float, width: float, pieces: int) -> Mesh:
    """A flat one: at the far end it has no width."""
    middle = along(length, pieces)
    half = width / 2 * (1 - np.linspace(0, 1, pieces + 1) * (1 - 1e-3))
    side = np.stack([0 * half, half, 0 * half], 1)
    return band(middle - side, middle + side)


def tube(length: float, width: float, pieces: int, sides: int) -> Mesh:
    """`width` is across."""
    angles = 2 * np.pi * np.arange(sides) / sides
    rows = along(length, pieces)[:, None, :] + np.zeros((1, sides, 1))
    rows[:, :, 1] = width / 2 * np.cos(angles)
    rows[:, :, 2] = width / 2 * np.sin(angles)
    return grid(rows, closed=True)


def pipe(length: float, width: float, pieces: int) -> Mesh:
    return tube(length, width, pieces, 8)


def square_pipe(length: float, width: float, pieces: int) -> Mesh:
    return tube(length, width, pieces, 4)


def spiral(length: float, width: float, pieces: int) -> Mesh:
    """A ribbon that winds round itself, flat, with room between its turns."""
    pitch = 2 * width
    turns = np.sqrt(length / (np.pi * pitch) + 1) - 1
    t = np.linspace(0, 1, max(pieces, int(12 * turns) + 2))
    radius = pitch * (1 + turns * t)
    out = np.stack([np.cos(2 * np.pi * turns * t), np.sin(2 * np.pi * turns * t), 0 * t], 1)
    return band((radius + width / 2)[:, None] * out, (radius - width / 2)[:, None] * out)


def ring(length: float, width: float, pieces: int) -> Mesh:
    """`length` is that of its middle line."""
    angles = np.linspace(0, 2 * np.pi, max(pieces, 12), endpoint=False)
    out = np.stack([np.cos(angles), np.sin(angles), 0 * angles], 1)
    radius = length / (2 * np.pi)
    return band((radius + width / 2) * out, (radius - width / 2) * out, closed=True)


def star(length: float, width: float, pieces: int) -> Mesh:
    """Ten arms of this length around a polygon."""
    arms, per_arm = 10, max(pieces // 10, 1)
    angles = 2 * np.pi * (np.arange(arms) - 0.5) / arms
    corners = width / (2 * np.sin(np.pi / arms)) * np.stack([np.cos(angles), np.sin(angles)], 1)
    vertices = [np.zeros((1, 2)), corners]
    faces = [[0, 1 + k, 1 + (k + 1) % arms] for k in range(arms)]
    count = 1 + arms
    for k in range(arms):
        ends = np.array([1 + k, 1 + (k + 1) % arms])
        angle = 2 * np.pi * k / arms
        step = length / per_arm * np.array([np.cos(angle), np.sin(angle)])
        for j in range(1, per_arm + 1):
            vertices.append(corners[[k, (k + 1) % arms]] + j * step)
            a, b = ends
            c, d = ends = np.array([count, count + 1])
            count += 2
            faces += [[a, c, d], [a, d, b]]
    flat = np.vstack(vertices)
    return Mesh(np.hstack([flat, np.zeros((len(flat), 1))]), np.array(faces, dtype=np.uint32))


SHAPES: dict[str, Callable[[float, float, int], Mesh]] = {
    made.__name__: made for made in (strip, ring, spiral, pipe, square_pipe, star, needle)
}


def square(area: float, pieces: int) -> Mesh:
    """Of as many cells, about."""
    n = max(1, round(pieces**0.5))
    side = area**0.5
    xs = np.linspace(0, side, n + 1)
    rows = np.stack([*np.meshgrid(xs, xs, indexing="ij"), np.zeros((n + 1, n + 1))], -1)
    return grid(rows, closed=False)


def area_of(mesh: Mesh) -> float:
    a, b, c = (mesh.vertices[mesh.faces[:, corner]] for corner in range(3))
    return float(np.linalg.norm(np.cross(b - a, c - a), axis=1).sum() / 2)


def stroke_at_the_end(mesh: Mesh) -> core.Seed:
    """A short one, near to the edge of the mesh that comes first."""
    corners = mesh.vertices[mesh.faces[0]]
    to = corners.mean(0) - corners[0]
    far = np.linalg.norm(to)
    ends = corners[0] + np.outer([0.3 / max(far, 1), min(0.6, 1.8 / far)], to)
    return core.Seed(ends, np.array([0, 2], dtype=np.uint32), np.zeros(1, dtype=np.uint8))


@dataclass
class Filled:
    """What came of a run."""

    empty: float
    narrow: float
    reason: str
    iterations: int
    nodes: int
    strands: int
    crossings: int
    seconds: float

    def __str__(self) -> str:
        return (
            f"empty {self.empty:.4f} narrow {self.narrow:.4f} {self.reason:9} "
            f"{self.iterations:4} iterations {self.nodes:6} nodes {self.strands} strands "
            f"{self.crossings} crossings {self.seconds:6.2f} s"
        )


def fill(mesh: Mesh, seed: core.Seed | None, start: str, limit: int) -> Filled:
    options = core.default_options("even")
    options.radius = 0.5
    options.threads = 1
    if limit:
        options.iteration_limit = limit
    if start == "full":
        options.start = core.Start.FULL
    begin = time.process_time()
    with core.Surface(mesh.vertices, mesh.faces) as surface:
        flow = core.Flow(surface, options, seed)
    with flow:
        reason = flow.run()
        seconds = time.process_time() - begin
        gaps = flow.gaps()
        figures = flow.statistics()
    return Filled(
        gaps.empty_share, gaps.narrow_share, reason, figures["iterations"], figures["nodes"],
        figures["strands"], figures["crossings"], seconds,
    )  # fmt: skip


@cache
def seconds_of_square(area: float, pieces: int) -> float:
    return fill(square(area, pieces), None, "grow", 0).seconds


def numbers(text: str) -> list[float]:
    return [float(part) for part in text.split(",")]


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__.partition("\n\n")[0])
    parser.add_argument("--only", default="", metavar="NAMES", help="of shapes, with commas")
    parser.add_argument("--lengths", type=numbers, default=[10, 50, 200], help="in spacings")
    widths = [0.8, 1.2, 2, 3, 4, 8]
    parser.add_argument("--widths", type=numbers, default=widths, help="in spacings")
    parser.add_argument("--pieces", type=numbers, default=[1, 200], help="along the surface")
    parser.add_argument("--starts", default="nothing,stroke,full")
    parser.add_argument("--limit", type=int, default=0, help="of iterations; 0: as it is")
    parser.add_argument("--times", action="store_true", help="over that of a square, which is run")
    options = parser.parse_args()
    names = [name for name in SHAPES if not options.only or name in options.only.split(",")]
    wrong = 0
    for name in names:
        for length in options.lengths:
            for width in options.widths:
                for pieces in map(int, options.pieces):
                    mesh = SHAPES[name](length, width, pieces)
                    for start in options.starts.split(","):
                        seed = stroke_at_the_end(mesh) if start == "stroke" else None
                        filled = fill(mesh, seed, start, options.limit)
                        times = ""
                        if options.times:
                            square_seconds = seconds_of_square(area_of(mesh), pieces)
                            times = f" times {filled.seconds / square_seconds:.1f}"
                        converged = filled.reason == "converged"
                        bad = filled.empty > 1e-3 or filled.crossings > 0 or not converged
                        wrong += bad
                        what = f"{name:11} {length:5g} x {width:3g} {pieces:3} {start:7}"
                        print(f"{'!' if bad else ' '} {what} {filled}{times}", flush=True)
    print(f"{wrong} not filled")
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
