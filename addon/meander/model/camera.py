# SPDX-License-Identifier: GPL-3.0-or-later
"""What a camera sees, on a page of paper: where points come to lie, and how large things are there.

A place on the page is in millimetres from its lower left corner, with y upwards. No bpy.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import ArrayLike, NDArray

# Between neighbouring strands on paper where nobody chose it, in millimetres.
SPACING = 2.0

# Width and height in millimetres, upright.
PAPERS = {
    "a5": (148.0, 210.0),
    "a4": (210.0, 297.0),
    "a3": (297.0, 420.0),
    "a2": (420.0, 594.0),
    "a1": (594.0, 841.0),
    "letter": (215.9, 279.4),
    "tabloid": (279.4, 431.8),
}


@dataclass(frozen=True)
class Page:
    """A page of paper, in millimetres, with a margin on all sides."""

    width: float
    height: float
    margin: float

    def turned_to(self, aspect: float) -> Page:
        """The same page, lying or standing as a frame does that is `aspect` times as wide as
        high."""
        lies = self.width > self.height
        if self.width == self.height or lies == (aspect > 1.0):
            return self
        return Page(self.height, self.width, self.margin)

    @property
    def has_room(self) -> bool:
        """Whether the margins leave any of it."""
        return 2.0 * self.margin < min(self.width, self.height)


@dataclass(frozen=True)
class CameraPage:
    """The frame of a camera on a page, as large as the margins allow and in the middle.

    view         (4, 4) from the world into the space of the camera, which looks along its -z
    projection   (4, 4) from there to clip coordinates, as OpenGL has them
    near, far    what is nearer or farther along the view is not seen
    aspect       width of the frame over its height
    """

    view: NDArray[np.float64]
    projection: NDArray[np.float64]
    near: float
    far: float
    aspect: float
    page: Page

    @property
    def in_perspective(self) -> bool:
        return bool(self.projection[3, 2] != 0.0)

    @cached_property
    def sides(self) -> NDArray[np.float64]:
        """Width and height of the frame on the page."""
        page = self.page
        room = np.array([page.width, page.height]) - 2.0 * page.margin
        width = min(room[0], room[1] * self.aspect)
        return np.array([width, width / self.aspect])

    @cached_property
    def corner(self) -> NDArray[np.float64]:
        """The lower left corner of the frame on the page."""
        return (np.array([self.page.width, self.page.height]) - self.sides) / 2.0

    def on_paper(self, points: ArrayLike) -> NDArray[np.float64]:
        """Where points (n, 3) of the world are drawn, (n, 2). None may lie beside the eye or behind
        it."""
        clip = self._clip(points)
        return self.corner + (clip[:, :2] / clip[:, 3:] + 1.0) / 2.0 * self.sides

    def millimetres(self, points: ArrayLike) -> NDArray[np.float64]:
        """How many millimetres a unit of the world is on paper where points (n, 3) are, across the
        view; (n,)."""
        scale = self.sides[0] / 2.0 * self.projection[0, 0]
        return scale / self._clip(points)[:, 3]

    def depths(self, points: ArrayLike) -> NDArray[np.float64]:
        """How far points (n, 3) are from the eye along the view; (n,)."""
        return -_moved(self.view, points)[:, 2]

    def towards_eye(
        self, points: ArrayLike
    ) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
        """Unit directions (n, 3) in which the eye is, and how far it is up to where things are too
        near to be seen, (n,)."""
        points = np.asarray(points, float)
        before = self.depths(points) - self.near
        back = self.view[2, :3]
        if not self.in_perspective:
            return np.tile(back, (len(points), 1)), before
        away = -self.view[:3, :3].T @ self.view[:3, 3] - points
        length = np.linalg.norm(away, axis=1)
        directions = away / length[:, None]
        return directions, before / (directions @ back)

    def planes(self, beyond: float = 0.0) -> NDArray[np.float64]:
        """The six sides of what the frame holds, (6, 4): plane @ (x, y, z, 1) >= 0 inside.

        beyond   by how many millimetres the frame is larger on all sides
        """
        matrix = self.projection @ self.view
        across = 1.0 + 2.0 * beyond / self.sides
        z = self.view[2]
        return np.array(
            [
                across[0] * matrix[3] + matrix[0],
                across[0] * matrix[3] - matrix[0],
                across[1] * matrix[3] + matrix[1],
                across[1] * matrix[3] - matrix[1],
                -z - [0.0, 0.0, 0.0, self.near],
                z + [0.0, 0.0, 0.0, self.far],
            ]
        )

    def inside(self, points: ArrayLike) -> NDArray[np.bool_]:
        """Which points (n, 3) the frame holds, (n,)."""
        return (_homogeneous(points) @ self.planes().T >= 0.0).all(axis=1)

    def _clip(self, points: ArrayLike) -> NDArray[np.float64]:
        return _moved(self.projection @ self.view, points)


def _homogeneous(points: ArrayLike) -> NDArray[np.float64]:
    points = np.asarray(points, float).reshape(-1, 3)
    return np.column_stack([points, np.ones(len(points))])


def _moved(matrix: NDArray[np.float64], points: ArrayLike) -> NDArray[np.float64]:
    return _homogeneous(points) @ matrix.T
