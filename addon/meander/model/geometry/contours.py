# SPDX-License-Identifier: GPL-3.0-or-later
"""The lines that a draughtsman draws of a surface: where it turns out of sight, its creases and its
edges; no bpy.

On what is shaded smooth a surface turns out of sight where its normal is at right angles to the
view, which is a line across faces (Hertzmann and Zorin 2000); else where one face is seen and the
next is not.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from .chains import chains_of
from .clipped_mesh import Triangles

# Faces that meet at more than 40 degrees have a crease between them.
_CREASE = np.cos(np.radians(40.0))
# Lines are lifted off the surface, or its own faces would hide them: in mean lengths of edges.
_LIFT = 0.05

Points = NDArray[np.float64]


def contours(mesh: Triangles, towards: Points) -> list[tuple[Points, Points, bool]]:
    """Points, normals and whether it is closed, of each line.

    towards   unit directions (n, 3) from the vertices of the mesh to the eye
    """
    edges, owners = mesh.edges()
    corners = mesh.vertices[mesh.faces]
    across = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    across /= np.maximum(np.linalg.norm(across, axis=1), 1e-300)[:, None]
    front = np.einsum("ij,ij->i", across, towards[mesh.faces[:, 0]]) > 0.0
    smooth = np.zeros(len(mesh.vertices), dtype=bool)
    normals = _mean_normals(mesh, across)
    if mesh.normals is not None:
        length = np.linalg.norm(mesh.normals, axis=1)
        smooth = length > 1e-9
        normals = np.where(
            smooth[:, None], mesh.normals / np.where(smooth, length, 1.0)[:, None], normals
        )
    facing = np.einsum("ij,ij->i", normals, towards)
    lift = _LIFT * float(np.linalg.norm(corners[:, 1] - corners[:, 0], axis=1).mean())
    outward = np.where(facing < 0.0, -1.0, 1.0)[:, None] * normals
    places = mesh.vertices + lift * outward
    smooth_faces = smooth[mesh.faces].all(axis=1)
    drawn = edges[_drawn(len(edges), owners, across, front, smooth_faces)]
    found = [
        (places[chain.vertices], outward[chain.vertices], chain.closed)
        for chain in chains_of(drawn.tolist())
    ]
    # Across faces, from edge to edge where the sign changes.
    one, other = facing[edges].T
    changes = (one >= 0.0) != (other >= 0.0)
    on_face = changes[owners] & smooth_faces[:, None]
    crossed = np.flatnonzero(on_face.sum(axis=1) == 2)
    pieces = owners[crossed][on_face[crossed]].reshape(-1, 2)
    with np.errstate(divide="ignore", invalid="ignore"):
        share = np.where(changes, one / (one - other), 0.0)[:, None]
    middles = (1.0 - share) * mesh.vertices[edges[:, 0]] + share * mesh.vertices[edges[:, 1]]
    out = (1.0 - share) * normals[edges[:, 0]] + share * normals[edges[:, 1]]
    for chain in chains_of(pieces.tolist()):
        line = middles[chain.vertices] + lift * out[chain.vertices]
        found.append((line, out[chain.vertices], chain.closed))
    return found


def _mean_normals(mesh: Triangles, across: Points) -> Points:
    found = np.zeros_like(mesh.vertices)
    for corner in range(3):
        np.add.at(found, mesh.faces[:, corner], across)
    return found / np.maximum(np.linalg.norm(found, axis=1), 1e-300)[:, None]


def _drawn(
    count: int,
    owners: NDArray[np.int64],
    across: Points,
    front: NDArray[np.bool_],
    smooth: NDArray[np.bool_],
) -> NDArray[np.bool_]:
    """Which edges are drawn: those of one face or of many, creases, and those behind which a
    surface turns out of sight that is not smooth."""
    uses = np.bincount(owners.ravel(), minlength=count)
    order = np.argsort(owners.ravel(), kind="stable")
    faces = order // 3
    first = np.concatenate([[0], np.cumsum(uses)[:-1]])
    one = faces[first]
    two = faces[np.minimum(first + 1, len(faces) - 1)]
    paired = uses == 2
    crease = np.einsum("ij,ij->i", across[one], across[two]) < _CREASE
    turns = (front[one] != front[two]) & ~(smooth[one] & smooth[two])
    seen = front[one] | front[two]
    return ~paired | (seen & crease) | turns
