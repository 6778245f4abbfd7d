# SPDX-License-Identifier: GPL-3.0-or-later
"""A curve as poses of a robot's tool: places and orientations, ways there and back; no bpy.

The frame of the tool at every pose: its z axis points into the surface, against the normal, its x
axis along the curve, at right angles to the normal, and its y axis completes a right-handed frame.
"""

from __future__ import annotations

import json
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from ..files.npz import write_npz
from ..files.rows import rows, write_pieces
from ..files.whole import whole_file
from ..geometry.unit_vectors import unit
from .toolpath import Strand, offsets_of

KINDS = ("approach", "curve", "retreat")
_COLUMNS = "strand,kind,x,y,z,qx,qy,qz,qw,nx,ny,nz,tx,ty,tz,arc_length"
_FRAME = "z into the surface, x along the curve, y completes a right-handed frame"


@dataclass(frozen=True)
class Poses:
    """The poses of one strand, in order.

    kinds         (n,) places in KINDS
    places        (n, 3) of the tool
    quaternions   (n, 4) x, y, z, w, unit, each in the half of the one before it
    normals       (n, 3) unit
    tangents      (n, 3) unit, at right angles to the normals
    arc_lengths   (n,) of the points on the surface
    """

    kinds: NDArray[np.int64]
    places: NDArray[np.float64]
    quaternions: NDArray[np.float64]
    normals: NDArray[np.float64]
    tangents: NDArray[np.float64]
    arc_lengths: NDArray[np.float64]


def poses_of(strand: Strand, standoff: float = 0.0, approach: float = 0.0) -> Poses:
    """The poses along a strand; a closed one ends with its first pose again.

    standoff   how far from the surface the tool is, along the normal
    approach   how much farther it begins and ends; 0: there is no such way
    """
    order = np.arange(len(strand.points))
    arcs = strand.arc_lengths
    if strand.closed:
        order, arcs = np.append(order, 0), np.append(arcs, strand.length)
    normals, along = strand.normals[order], strand.tangents[order]
    tangents = along - (along * normals).sum(axis=1, keepdims=True) * normals
    # Where a curve turns back its tangent may be along the normal, or none.
    other = np.cross(normals, np.eye(3)[np.abs(normals).argmin(axis=1)])
    other /= np.linalg.norm(other, axis=1, keepdims=True)
    tangents = unit(tangents, other, least=1e-9)
    places = strand.points[order] + standoff * normals
    kinds = np.full(len(order), KINDS.index("curve"))
    if approach > 0.0:
        ends = [0, len(order) - 1]
        far = places[ends] + approach * normals[ends]
        places = np.vstack([far[:1], places, far[1:]])
        normals, tangents = (
            np.vstack([values[:1], values, values[-1:]]) for values in (normals, tangents)
        )
        arcs = np.concatenate([arcs[:1], arcs, arcs[-1:]])
        kinds = np.concatenate([[0], kinds, [2]])
    frames = np.stack([tangents, np.cross(-normals, tangents), -normals], axis=2)
    return Poses(kinds, places, _quaternions(frames), normals, tangents, np.asarray(arcs))


def _quaternions(frames: NDArray[np.float64]) -> NDArray[np.float64]:
    """Of rotation matrices (n, 3, 3): the eigenvector of Bar-Itzhack, "New Method for Extracting
    the Quaternion from a Rotation Matrix", J. Guidance 23, 6 (2000)."""
    m = frames
    k = np.zeros((len(m), 4, 4))
    for i in range(3):
        for j in range(3):
            k[:, i, j] = m[:, i, j] + m[:, j, i]
    trace = np.trace(m, axis1=1, axis2=2)
    for i in range(3):
        k[:, i, i] = 2.0 * m[:, i, i] - trace
    for i, (a, b) in enumerate(((2, 1), (0, 2), (1, 0))):
        k[:, i, 3] = k[:, 3, i] = m[:, a, b] - m[:, b, a]
    k[:, 3, 3] = trace
    found = np.linalg.eigh(k)[1][:, :, -1]
    if len(found):
        found[0] *= 1.0 if found[0, 3] >= 0.0 else -1.0
    # The same half as the one before, so that nothing that interpolates goes the long way round.
    turns = np.sign((found[1:] * found[:-1]).sum(axis=1))
    found[1:] *= np.cumprod(np.where(turns < 0.0, -1.0, 1.0))[:, None]
    return found


def write(path: str | Path, poses: Sequence[Poses], version: str) -> None:
    """Writes a .csv file, a row a pose, a .json file, or the arrays of a .npz file, whole or not at
    all. Raises FileError."""
    suffix = Path(path).suffix.lower()
    if suffix == ".npz":
        write_npz(Path(path), _arrays(poses, version))
        return
    if suffix == ".json":
        record = {
            "version": version,
            "frame": _FRAME,
            "strands": [
                {
                    "kinds": [KINDS[kind] for kind in each.kinds],
                    "places": each.places.tolist(),
                    "quaternions": each.quaternions.tolist(),
                    "normals": each.normals.tolist(),
                    "tangents": each.tangents.tolist(),
                    "arc_lengths": each.arc_lengths.tolist(),
                }
                for each in poses
            ],
        }
        pieces = iter([json.dumps(record, allow_nan=False) + "\n"])
    else:
        pieces = _csv_pieces(poses)
    with whole_file(Path(path)) as temporary:
        write_pieces(temporary, pieces)


def _arrays(poses: Sequence[Poses], version: str) -> Iterator[tuple[str, np.ndarray]]:
    """The poses of all strands one after the other; strand k has those from offsets[k] to
    offsets[k + 1]. Kinds are words, as in the other files."""
    yield "version", np.array(version)
    yield "frame", np.array(_FRAME)
    yield "offsets", offsets_of([len(each.places) for each in poses])
    for name in ("kinds", "places", "quaternions", "normals", "tangents", "arc_lengths"):
        values = np.concatenate([getattr(each, name) for each in poses])
        yield name, np.array(KINDS)[values] if name == "kinds" else values


def _csv_pieces(poses: Sequence[Poses]) -> Iterator[str]:
    yield _COLUMNS + "\n"
    for number, each in enumerate(poses):
        columns = [each.places, each.quaternions, each.normals, each.tangents, each.arc_lengths]
        begins = np.flatnonzero(np.diff(each.kinds, prepend=-1, append=-1))
        for begin, end in zip(begins[:-1].tolist(), begins[1:].tolist()):
            pattern = f"{number},{KINDS[each.kinds[begin]]}" + ",%.12g" * 14 + "\n"
            yield from rows(pattern, *(values[begin:end] for values in columns))
