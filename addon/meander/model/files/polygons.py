# SPDX-License-Identifier: GPL-3.0-or-later
"""Meshes of polygons as files have them, and as the library wants them; numpy only, no bpy."""

from __future__ import annotations

from dataclasses import dataclass, field
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from ... import core


@dataclass
class MeshOfFile:
    """The mesh of a file, and what there is to say of the file.

    vertices   (n, 3) float64
    faces      (m, 3) uint32: triangles
    remarks    a sentence each, of what was left out or passed over
    polygons   (m,) the face of the file, from 0, that each triangle is a part of; None: itself
    lines      (p,) of each face of the file, its line, from 1; None: it has no lines
    first      how the file counts its first face and vertex, 0 or 1
    path       of the file
    joined     whether the file gives places at every face, so that its vertices have no numbers
    """

    vertices: NDArray[np.float64]
    faces: NDArray[np.uint32]
    remarks: list[str] = field(default_factory=list)
    polygons: NDArray[np.integer] | None = None
    lines: NDArray[np.uint32] | None = None
    first: int = 1
    joined: bool = False
    path: Path | None = None


def triangles_of(
    vertices: NDArray[np.float64], corners: NDArray[np.uint32], ends: NDArray[np.integer]
) -> tuple[NDArray[np.uint32], NDArray[np.integer] | None]:
    """Polygons of three or more corners as triangles, and the polygon of each; None: its own.

    corners  of one polygon after another
    ends     where the corners of each polygon end
    """
    if len(corners) == 3 * len(ends):  # none has fewer
        return corners.reshape(-1, 3), None
    return core.triangulated(vertices, corners, ends)


def left_out(count: int) -> list[str]:
    """What is said of faces that are none."""
    if not count:
        return []
    faces = "1 face" if count == 1 else f"{count:,} faces"
    return [f"left out {faces} of fewer than three corners"]
