#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""A picture in one line as TSP art, to compare with: tsp_art.py PICTURE OUT.obj --pen W

PICTURE is square, and OUT has its line in a square of side 1; the pen is in the same unit. The
points are a weighted Voronoi stippling (Secord 2002) whose density goes with the square of the
darkness, as the length of a tour on an area goes with the root of the number of points there. The
tour begins along a Hilbert curve and is improved by 2-opt and Or-opt among near neighbours until
nothing is left to improve (Kaplan and Bosch 2005 join stipples so). The number of points is chosen
so that the tour is as long as the picture's darkness asks for: the mean darkness over the pen, the
length of a drawing with the right tone. Prints JSON. Needs numpy, scipy and Pillow.
"""

from __future__ import annotations

import argparse
import json

import numpy as np
from PIL import Image
from scipy.spatial import cKDTree

RASTER = 1000
NEAR = 8


def darkness_of(path: str, least: float, most: float) -> np.ndarray:
    image = Image.open(path).convert("L").resize((RASTER, RASTER), Image.Resampling.LANCZOS)
    return np.clip(1.0 - np.asarray(image) / 255.0, least, most)


def stippled(weights: np.ndarray, count: int, rounds: int, random) -> np.ndarray:
    """Points (count, 2) in the unit square, y upwards, by Lloyd's relaxation on a raster."""
    row, column = np.divmod(np.arange(RASTER * RASTER), RASTER)
    cells = np.column_stack([column, row])
    places = (cells + 0.5) / RASTER
    places[:, 1] = 1.0 - places[:, 1]
    mass = weights.ravel()
    chosen = random.choice(len(mass), count, replace=False, p=mass / mass.sum())
    points = places[chosen] + (random.random((count, 2)) - 0.5) / RASTER
    for _ in range(rounds):
        owner = cKDTree(points).query(places)[1]
        total = np.bincount(owner, mass, count)
        for axis in (0, 1):
            moved = np.bincount(owner, mass * places[:, axis], count)
            middle = moved / np.maximum(total, 1e-300)
            points[:, axis] = np.where(total > 0, middle, points[:, axis])
    return points


def hilbert(points: np.ndarray, bits: int = 12) -> np.ndarray:
    x, y = (points.T * ((1 << bits) - 1)).astype(np.int64)
    key = np.zeros(len(points), dtype=np.int64)
    side = 1 << (bits - 1)
    while side:
        right, up = (x & side) > 0, (y & side) > 0
        key += side * side * ((3 * right) ^ up)
        flip = ~up & right
        x, y = np.where(flip, side - 1 - x, x), np.where(flip, side - 1 - y, y)
        x, y = np.where(~up, y, x), np.where(~up, x, y)
        side >>= 1
    return np.argsort(key, kind="stable")


def improved(points: np.ndarray, tour: np.ndarray) -> np.ndarray:
    """2-opt with neighbour lists; a tour is closed."""
    count = len(points)
    near = cKDTree(points).query(points, NEAR + 1)[1][:, 1:].tolist()
    place = np.empty(count, dtype=np.int64)
    place[tour] = np.arange(count)
    xy = points.tolist()

    def apart(a: int, b: int) -> float:
        return ((xy[a][0] - xy[b][0]) ** 2 + (xy[a][1] - xy[b][1]) ** 2) ** 0.5

    def turn(i: int, j: int) -> None:
        """Turns tour[i..j] round, or the rest where that is shorter."""
        inner = (j - i) % count + 1
        if 2 * inner > count:
            i, j, inner = (j + 1) % count, (i - 1) % count, count - inner
        where = (i + np.arange(inner)) % count
        tour[where] = tour[where[::-1]]
        place[tour[where]] = where

    waiting = list(range(count))
    queued = [True] * count
    while waiting:
        a = waiting.pop()
        queued[a] = False
        for forward in (1, -1):
            i = int(place[a])
            b = int(tour[(i + forward) % count])
            length = apart(a, b)
            for c in near[a]:
                gain = length - apart(a, c)
                if gain <= 1e-12:
                    break
                j = int(place[c])
                d = int(tour[(j + forward) % count])
                if apart(c, d) + gain - apart(b, d) <= 1e-12:
                    continue
                if forward == 1:
                    turn((i + 1) % count, j)
                else:
                    turn(i, (j - 1) % count)
                for city in (a, b, c, d):
                    if not queued[city]:
                        queued[city] = True
                        waiting.append(city)
                break
            else:
                continue
            break
    return tour


def length_of(points: np.ndarray) -> float:
    return float(np.linalg.norm(np.roll(points, -1, axis=0) - points, axis=1).sum())


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("picture")
    parser.add_argument("output")
    parser.add_argument("--pen", type=float, required=True)
    parser.add_argument("--least", type=float, default=0.06)
    parser.add_argument("--most", type=float, default=0.9)
    parser.add_argument("--rounds", type=int, default=12)
    arguments = parser.parse_args()
    dark = darkness_of(arguments.picture, arguments.least, arguments.most)
    wanted = dark.mean() / arguments.pen
    random = np.random.default_rng(0)
    # Tours by 2-opt are about .75 times the root of area times points.
    count = int((wanted / 0.75) ** 2 / (dark.mean() ** 2 / (dark**2).mean()))
    for _ in range(2):
        points = stippled(dark**2, count, arguments.rounds, random)
        points = points[improved(points, hilbert(points))]
        length = length_of(points)
        if abs(length / wanted - 1.0) < 0.01:
            break
        count = int(count * (wanted / length) ** 2)
    lines = [f"v {x:.9g} {y:.9g} 0" for x, y in points]
    lines.append("l " + " ".join(str(k + 1) for k in [*range(len(points)), 0]))
    with open(arguments.output, "w", encoding="utf-8") as file:
        file.write("\n".join(lines) + "\n")
    print(json.dumps({"points": len(points), "length": length, "wanted": wanted}))


if __name__ == "__main__":
    main()
