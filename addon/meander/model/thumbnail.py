# SPDX-License-Identifier: GPL-3.0-or-later
"""Small pictures of curves on their surface, drawn by numpy alone; no bpy."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from .. import core

# How much larger it is drawn before it is averaged.
_FINER = 2
_MARGIN = 0.04
# A point of the line is seen if it is no deeper than this behind the surface, in pixels.
_BEHIND = 3.0
_LINE = np.array([0.96, 0.60, 0.22])
# Of the surface: where it is seen from the side, and from the front.
_DARK, _BRIGHT = 0.10, 0.34
# Rows of places in a triangle, at most.
_MOST_ROWS = 1024


class Thumbnails:
    """Pictures of many curves on one surface, all seen alike."""

    def __init__(
        self,
        vertices: NDArray[np.float64],
        faces: NDArray[np.integer],
        turn: NDArray[np.float64],
        size: int,
    ) -> None:
        """vertices (n, 3), faces (m, 3)

        turn   (3, 3): its rows are to the right, up, and towards the viewer
        size   of the pictures, which are square, in pixels
        """
        self._size, self._wide = size, _FINER * size
        self._turn = np.asarray(turn, dtype=np.float64)
        turned = vertices[np.unique(faces)] @ self._turn.T
        low, high = turned.min(axis=0), turned.max(axis=0)
        extent = max(float((high - low)[:2].max()), 1e-300)
        self._scale = (1.0 - 2.0 * _MARGIN) * self._wide / extent
        self._middle = (low + high) / 2.0
        self._depth = np.full(self._wide**2, -np.inf)
        self._shade = np.zeros(self._wide**2)
        self._draw_surface(self._seen(vertices), faces)

    def of(self, curve: core.Polylines) -> NDArray[np.float32]:
        """Red, green, blue and alpha of every pixel, (size, size, 4), the lowest row first."""
        color = np.repeat(self._shade[:, None], 3, axis=1)
        color[self._pixels_of(curve)] = _LINE
        drawn = np.isfinite(self._depth).astype(np.float64)
        cells = (self._size, _FINER, self._size, _FINER)
        alpha = drawn.reshape(cells).mean(axis=(1, 3))
        color = (color * drawn[:, None]).reshape(*cells, 3).mean(axis=(1, 3))
        color /= np.maximum(alpha, 1e-9)[:, :, None]
        return np.dstack([color, alpha]).astype(np.float32)

    def _seen(self, points: NDArray[np.floating]) -> NDArray[np.float64]:
        """In pixels to the right, up, and towards the viewer."""
        seen = (np.asarray(points, dtype=np.float64) @ self._turn.T - self._middle) * self._scale
        seen[:, :2] += self._wide / 2.0
        return seen

    def _index(self, places: NDArray[np.float64]) -> NDArray[np.int64]:
        cells = np.clip(places[:, :2].astype(np.int64), 0, self._wide - 1)
        return cells[:, 1] * self._wide + cells[:, 0]

    def _draw_surface(self, seen: NDArray[np.float64], faces: NDArray[np.integer]) -> None:
        """Fills the pixels with what is nearest of places in all triangles, a pixel apart."""
        corners = seen[faces]
        sides = corners - np.roll(corners, 1, axis=1)
        rows = np.ceil(1.5 * np.linalg.norm(sides[:, :, :2], axis=2).max(axis=1))
        rows = np.clip(rows, 1, _MOST_ROWS)
        rows = (2 ** np.ceil(np.log2(rows))).astype(np.int64)  # few kinds of triangles
        normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
        lengths = np.maximum(np.linalg.norm(normals, axis=1), 1e-300)
        facing = np.abs(normals[:, 2]) / lengths
        shades = _DARK + (_BRIGHT - _DARK) * facing
        for count in np.unique(rows):
            i, j = np.nonzero(np.tri(count, dtype=bool)[::-1])
            weights = np.column_stack([i, j, count - 1 - i - j]) + 1.0 / 3.0
            some = np.flatnonzero(rows == count)
            for part in np.array_split(some, len(some) * len(weights) // 2_000_000 + 1):
                places = np.einsum("pw,fwk->fpk", weights / count, corners[part]).reshape(-1, 3)
                self._put(places, np.repeat(shades[part], len(weights)))

    def _put(self, places: NDArray[np.float64], shades: NDArray[np.float64]) -> None:
        order = np.argsort(places[:, 2], kind="stable")
        index, depth, shades = self._index(places[order]), places[order, 2], shades[order]
        nearer = depth > self._depth[index]
        # Of several for one pixel the last one stays, which is the nearest.
        self._depth[index[nearer]] = depth[nearer]
        self._shade[index[nearer]] = shades[nearer]

    def _pixels_of(self, curve: core.Polylines) -> NDArray[np.int64]:
        seen = self._seen(curve.positions)
        ends = np.arange(1, len(seen) + 1)
        lasts = np.asarray(curve.offsets[1:], dtype=np.int64) - 1
        ends[lasts] = np.where(curve.closed, curve.offsets[:-1], lasts)
        steps = seen[ends] - seen
        counts = np.maximum(np.ceil(np.linalg.norm(steps[:, :2], axis=1)), 1).astype(np.int64)
        which = np.repeat(np.arange(len(seen)), counts)
        nth = np.arange(len(which)) - np.repeat(np.cumsum(counts) - counts, counts)
        places = seen[which] + steps[which] * (nth / counts[which])[:, None]
        places = places[places[:, 2] >= self._depth[self._index(places)] - _BEHIND]
        found = [self._index(places + [x, y, 0.0]) for x in (-0.5, 0.5) for y in (-0.5, 0.5)]
        pixels = np.unique(np.concatenate(found))
        return pixels[np.isfinite(self._depth[pixels])]
