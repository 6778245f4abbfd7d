# SPDX-License-Identifier: GPL-3.0-or-later
"""Distances along a surface by brute force; plain numpy, and nothing of the library.

Points lie on every edge, the points of a face see each other in a straight line, and whatever is
farther is reached from face to face. So paths bend at points of edges only, and are longer than the
shortest ones by a small part of the distance between those.
"""

from __future__ import annotations

from functools import cache

import geometry
import numpy as np
from numpy.typing import NDArray


def _points_of_faces(mesh: geometry.Mesh, gap: float) -> tuple[NDArray, list[NDArray]]:
    """Points on the edges, at most `gap` apart, vertices first; and which of them each face has."""
    sides = np.sort(mesh.faces[:, [[0, 1], [1, 2], [2, 0]]].reshape(-1, 2).astype(int), axis=1)
    edges, edge_of_side = np.unique(sides, axis=0, return_inverse=True)
    edge_of_side = edge_of_side.reshape(-1, 3)
    points, inside, count = [mesh.vertices], [], len(mesh.vertices)
    for a, b in edges:
        start, end = mesh.vertices[a], mesh.vertices[b]
        pieces = max(1, int(np.ceil(np.linalg.norm(end - start) / gap)))
        shares = np.arange(1, pieces)[:, None] / pieces
        points.append(start + shares * (end - start))
        inside.append(np.arange(count, count + pieces - 1))
        count += pieces - 1
    of_faces = [
        np.concatenate([face.astype(int), *(inside[edge] for edge in of_face)])
        for face, of_face in zip(mesh.faces, edge_of_side)
    ]
    return np.concatenate(points), of_faces


def _apart(a: NDArray, b: NDArray) -> NDArray:
    return np.sqrt(sum((a[:, k, None] - b[:, k]) ** 2 for k in range(3)))


def distances_along(
    mesh: geometry.Mesh,
    sources: tuple[NDArray, NDArray],
    places: tuple[NDArray, NDArray],
    gap: float,
) -> NDArray[np.float64]:
    """The distance along the surface from each place to the nearest source; infinite where a
    place's component has none.

    sources, places   points (n, 3), and the face that each lies in (n,)
    gap               between points on the edges
    """
    points, of_faces = _points_of_faces(mesh, gap)
    faces_of: list[list[int]] = [[] for _ in points]
    for face, members in enumerate(of_faces):
        for point in members:
            faces_of[point].append(face)
    distance = np.full(len(points), np.inf)
    sources_in = _by_face(sources[1])
    for face, chosen in sources_in.items():
        members = of_faces[face]
        near = _apart(points[members], sources[0][chosen]).min(axis=1)
        distance[members] = np.minimum(distance[members], near)
    within = cache(lambda face: _apart(points[of_faces[face]], points[of_faces[face]]))
    reached = np.nonzero(np.isfinite(distance))[0].tolist()
    while reached:
        changed = {face for point in reached for face in faces_of[point]}
        reached = []
        for face in changed:
            members = of_faces[face]
            through = (within(face) + distance[members]).min(axis=1)
            better = through < distance[members]
            distance[members[better]] = through[better]
            reached += members[better].tolist()
    found = np.full(len(places[0]), np.inf)
    for face, chosen in _by_face(places[1]).items():
        members = of_faces[face]
        found[chosen] = (_apart(places[0][chosen], points[members]) + distance[members]).min(axis=1)
        if face in sources_in:
            straight = _apart(places[0][chosen], sources[0][sources_in[face]]).min(axis=1)
            found[chosen] = np.minimum(found[chosen], straight)
    return found


def _by_face(faces: NDArray) -> dict[int, NDArray]:
    """Which points lie in each face that has any."""
    order = np.argsort(faces, kind="stable")
    present, first = np.unique(faces[order], return_index=True)
    return dict(zip(present.tolist(), np.split(order, first[1:])))
