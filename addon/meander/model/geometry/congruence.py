# SPDX-License-Identifier: GPL-3.0-or-later
"""Which of several meshes are the same, turned and moved; numpy only, no bpy.

Vertices correspond by their numbers. The turn that brings one set of points nearest to another:
Kabsch 1976, A solution for the best rotation to relate two sets of vectors.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

# So many kinds of one mesh are looked for; what is left then is taken as of kinds of its own.
_MOST_KINDS = 64


class Congruent(NamedTuple):
    """Meshes and those that stand for them.

    sources   (n,) int64, which one stands for each: the first of its kind
    turns     (n, 3, 3) float64, the rotation that brings that onto it
    """

    sources: NDArray[np.int64]
    turns: NDArray[np.float64]

    @property
    def is_fewer(self) -> bool:
        """Whether one stands for several."""
        return bool((self.sources != np.arange(len(self.sources))).any())

    @classmethod
    def of_all(cls, count: int) -> Congruent:
        """Each stands for itself."""
        return cls(np.arange(count), np.tile(np.eye(3), (count, 1, 1)))


def congruent(
    points: NDArray[np.float64],
    begins: NDArray[np.int64],
    faces: NDArray[np.int64],
    spans: NDArray[np.int64],
    share: float,
    most: float,
) -> Congruent:
    """Which meshes are alike.

    points   of all, each around its own middle; those of mesh k begin at begins[k]
    faces    of all, by numbers in `points`; those of mesh k are spans[k] .. spans[k + 1]
    share    of its size by which a vertex may be off, and `most`, however large it is
    """
    count = len(begins)
    ends = np.append(begins[1:], len(points))
    kinds: dict[tuple[int, bytes], list[int]] = {}
    for k in range(count):
        own = faces[spans[k] : spans[k + 1]] - begins[k]
        kinds.setdefault((int(ends[k] - begins[k]), own.tobytes()), []).append(k)
    found = Congruent.of_all(count)
    for (size, _faces), members in kinds.items():
        if len(members) > 1:
            left = np.array(members)
            own = points[begins[left][:, None] + np.arange(size)]
            _compare(own, left, found, share, most)
    return found


def _compare(
    own: NDArray[np.float64],
    members: NDArray[np.int64],
    found: Congruent,
    share: float,
    most: float,
) -> None:
    """Notes which of these meshes, (m, v, 3), with the same faces, are alike."""
    sizes = np.sqrt((own * own).sum(axis=2).mean(axis=1))
    left = np.arange(len(members))
    for _kind in range(_MOST_KINDS):
        if len(left) < 2:
            return
        first, near = left[0], left
        allowed = min(share * sizes[first], most)
        near = near[np.abs(sizes[near] - sizes[first]) <= allowed]
        turns = _turns(own[first], own[near])
        off = np.linalg.norm(own[near] - own[first] @ turns.transpose(0, 2, 1), axis=2)
        alike = off.max(axis=1) <= allowed
        alike[near == first] = True
        found.sources[members[near[alike]]] = members[first]
        found.turns[members[near[alike]]] = turns[alike]
        found.turns[members[first]] = np.eye(3)
        left = np.setdiff1d(left, near[alike])


def _turns(
    points: NDArray[np.float64], others: NDArray[np.float64]
) -> NDArray[np.float64]:
    """The rotations (m, 3, 3) that bring points (v, 3) nearest to others (m, v, 3)."""
    left, _sizes, right = np.linalg.svd(np.einsum("vi,mvj->mij", points, others))
    signs = np.sign(np.linalg.det(left) * np.linalg.det(right))
    right[:, 2] *= np.where(signs < 0.0, -1.0, 1.0)[:, None]
    return (left @ right).transpose(0, 2, 1)
