# SPDX-License-Identifier: GPL-3.0-or-later
"""Images of a curve on a ball by a map of six islands, against 64 places a pixel found by nothing
of the cut but its line: across the seams as within."""

from __future__ import annotations

from typing import NamedTuple

import geometry
import numpy as np
import pytest
from flows import flow_on
from meander import core
from meander.model.maps import Mapped, Style, Tile

SPACING, SIZE, PLACES = 0.35, 260, 64
# Rows of pixels with whole ones, edges along and across, and nothing between two rows of islands.
ROWS = slice(170, 194)


class Images(NamedTuple):
    """What pixels of ROWS are to show, and how many of their places lie on islands."""

    distance: np.ndarray
    height: np.ndarray
    color: np.ndarray
    on: np.ndarray


def ball(cells: int = 10) -> tuple[geometry.Mesh, np.ndarray]:
    """The unit ball, over a cube whose six sides lie apart in the map."""
    square = geometry.rectangle((-1.0, -1.0), (1.0, 1.0), cells, cells)
    flat, count = square.vertices[:, :2], len(square.vertices)
    sides = []
    for axis in range(3):
        for sign in (1.0, -1.0):
            side = np.full((count, 3), sign)
            side[:, (axis + 1) % 3], side[:, (axis + 2) % 3] = flat[:, 0], sign * flat[:, 1]
            sides.append(side)
    every = np.vstack(sides)
    _rounded, first, number = np.unique(
        np.rint(every * cells).astype(int), axis=0, return_index=True, return_inverse=True
    )
    faces = np.vstack([square.faces + k * count for k in range(6)]).astype(int)
    islands = [
        [0.013 + 0.329 * (k % 3), 0.021 + 0.487 * (k // 3)] + 0.15 * (flat + 1.0) for k in range(6)
    ]
    vertices = every[first] / np.linalg.norm(every[first], axis=1, keepdims=True)
    return geometry.mesh(vertices, number.ravel()[faces]), np.vstack(islands)[faces]


@pytest.fixture(scope="module")
def mapped() -> Mapped:
    surface, uv = ball()
    with flow_on(surface, radius=SPACING / 2, iteration_limit=120) as flow:
        flow.run()
        cut = core.cut_surface(flow, SPACING / 8, middle_lines=True)
    return Mapped.of(cut, uv, SPACING)


def places_in_space() -> np.ndarray:
    """Of each pixel of ROWS those of 64 places that lie on an island, on the ball, (rows, size, 64,
    3); the others are no numbers."""
    (vertices, faces), uv = ball()
    fine = 8 * SIZE
    corners = uv * fine - 0.5
    found = np.full((fine, fine, 3), np.nan)
    for face, (a, b, c) in zip(faces, corners, strict=True):
        low, high = np.ceil(np.minimum(a, np.minimum(b, c))), np.maximum(a, np.maximum(b, c))
        at = np.stack(np.meshgrid(*map(np.arange, low.astype(int), high.astype(int) + 1)), axis=2)
        weights = np.linalg.solve(np.stack([b - a, c - a], axis=1), (at - a).reshape(-1, 2).T).T
        weights = np.column_stack([1.0 - weights.sum(axis=1), weights])
        inside = (weights >= -1e-9).all(axis=1)
        column, row = at.reshape(-1, 2)[inside].T
        found[fine - 1 - row, column] = weights[inside] @ vertices[face]
    found = found.reshape(SIZE, 8, SIZE, 8, 3).swapaxes(1, 2).reshape(SIZE, SIZE, PLACES, 3)[ROWS]
    return found / np.linalg.norm(found, axis=3, keepdims=True)


@pytest.fixture(scope="module")
def true(mapped: Mapped) -> Images:
    """Distances are angles on the ball."""
    cut = mapped.cut
    assert cut.closed.all()  # so every point begins an edge
    a, b = np.moveaxis(cut.positions[cut.line_edges()], 1, 0)
    length = np.linalg.norm(b - a, axis=1)
    a, b = (ends / np.linalg.norm(ends, axis=1, keepdims=True) for ends in (a, b))
    strand = np.searchsorted(cut.offsets, np.arange(len(a)), side="right") - 1
    places = places_in_space()
    on = np.isfinite(places[:, :, :, 0])
    means = np.zeros((*on.shape[:2], 5))
    for pixel in map(tuple, np.argwhere(on.any(axis=2))):
        here = places[pixel][on[pixel]]
        far = np.linalg.norm(a - here[0], axis=1)
        wide = np.linalg.norm(here - here[0], axis=1).max()
        near = np.flatnonzero(far < far.min() + 2.0 * (wide + length.max()))
        chords, share = distances_to(here, a[near], b[near])
        best = chords.argmin(axis=1)
        every, piece = np.arange(len(here)), near[best]
        d = np.minimum(2.0 * np.arcsin(0.5 * chords[every, best]) / SPACING, 1.0)
        along = cut.arc_lengths[piece] + share[every, best] * length[piece]
        part = along / cut.lengths[strand[piece]]
        colours = Style().colours(1.0 - np.abs(2.0 * part - 1.0))  # there and back
        height = 1.0 - np.clip(1.0 - 2.0 * d, 0.0, 1.0) ** 2
        means[pixel] = d.mean(), height.mean(), *colours.mean(axis=0)
    return Images(means[:, :, 0], means[:, :, 1], means[:, :, 2:], on.sum(axis=2))


def distances_to(places: np.ndarray, a: np.ndarray, b: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Of each place from each piece, (n, m), and how far along the piece, from 0 to 1."""
    u, way = b - a, places[:, None] - a
    share = np.clip((way * u).sum(axis=2) / (u * u).sum(axis=1), 0.0, 1.0)
    return np.linalg.norm(way - share[:, :, None] * u, axis=2), share


@pytest.fixture(scope="module")
def tile(mapped: Mapped) -> Tile:
    return Tile(mapped, (0, 0), Style(SIZE, 6), kinds=("distance", "height", "color"))


def test_pixels_on_a_ball_are_the_mean_over_their_area(tile: Tile, true: Images) -> None:
    whole, some = true.on == PLACES, true.on > 0
    # Of what an island hardly touches a few places count, and not the same ones.
    edge = some & ~whole & (true.on >= PLACES // 4)
    assert whole.sum() > 2000 and edge.sum() > 200
    for kind, expected in (("distance", true.distance), ("height", true.height)):
        close = np.abs(tile.values(kind)[ROWS] - expected) < 0.01
        assert min(close[whole].mean(), close[edge].mean()) > 0.99, kind


def test_colours_of_turns_on_a_ball_meet_without_spikes(tile: Tile, true: Images) -> None:
    """A spike shows a colour that neither the pixel has nor any of its neighbours."""
    found, some = tile.values("color")[ROWS], true.on > 0
    jump = np.zeros(some.shape)
    for axis in (0, 1):
        steps = np.abs(np.diff(true.color, axis=axis)).max(axis=2)
        both = np.diff(some.astype(int), axis=axis) == 0  # two that show something, or none
        where = (slice(1, None), slice(None)) if axis == 0 else (slice(None), slice(1, None))
        jump[where] = np.maximum(jump[where], np.where(both, steps, 0.0))
    border = some & (jump > 0.05)
    assert border.sum() > 30
    assert np.abs(found - true.color).max(axis=2)[border].mean() < 0.02
    padded = [np.where(some[:, :, None], true.color, none) for none in (np.inf, -np.inf)]
    around = [
        np.lib.stride_tricks.sliding_window_view(image, (3, 3), axis=(0, 1)) for image in padded
    ]
    least, most = around[0].min(axis=(3, 4)), around[1].max(axis=(3, 4))
    middle = found[1:-1, 1:-1]
    beyond = np.maximum(least - middle, middle - most).max(axis=2)
    assert beyond[some[1:-1, 1:-1]].max() < 0.03
