# SPDX-License-Identifier: GPL-3.0-or-later
"""Strands as glTF 2.0 in one binary file (.glb): lines, or a tube with UVs; no bpy.

Coordinates are in metres, and turned so that y points up, as the format has it.
"""

from __future__ import annotations

import json
import struct
from typing import Any

import numpy as np
from numpy.typing import NDArray

from .drawing import Drawing, far_away
from .tube import tube_of

# Of the specification: types of components, targets of buffer views, modes of primitives.
_FLOAT, _UINT = 5126, 5125
_VERTICES, _INDICES = 34962, 34963
_LINES = 1
_JSON, _BIN = 0x4E4F534A, 0x004E4942
# x, z and -y of what has its z axis up.
_UP = np.array([[1.0, 0.0, 0.0], [0.0, 0.0, 1.0], [0.0, -1.0, 0.0]])


class _Buffer:
    """The file's numbers, and what describes them."""

    def __init__(self) -> None:
        self.parts: list[bytes] = []
        self.views: list[dict[str, Any]] = []
        self.accessors: list[dict[str, Any]] = []
        self.size = 0

    def add(self, values: NDArray, indices: bool = False, limits: bool = False) -> int:
        """Adds an array (n,) or (n, 2 or 3) and returns the number of its accessor."""
        data = np.ascontiguousarray(values, dtype="<u4" if indices else "<f4")
        content = data.tobytes()
        self.views.append(
            {
                "buffer": 0,
                "byteOffset": self.size,
                "byteLength": len(content),
                "target": _INDICES if indices else _VERTICES,
            }
        )
        accessor: dict[str, Any] = {
            "bufferView": len(self.views) - 1,
            "componentType": _UINT if indices else _FLOAT,
            "count": len(data),
            "type": "SCALAR" if data.ndim == 1 else f"VEC{data.shape[1]}",
        }
        if limits:
            accessor |= {
                "min": data.min(axis=0).astype(float).tolist(),
                "max": data.max(axis=0).astype(float).tolist(),
            }
        self.accessors.append(accessor)
        self.parts.append(content)
        self.size += len(content)
        return len(self.accessors) - 1


def glb_bytes(drawing: Drawing, width: float, title: str, version: str) -> bytes:
    """The content of a file.

    drawing   in metres
    width     the diameter of the tube, in metres; 0: lines

    Of lines, every strand is a primitive, with normals, and arc lengths as _ARC_LENGTH. A tube is
    one primitive: U is the length along the strand, in spacings, and V goes once around it.
    """
    origin, buffer = far_away(drawing.strands), _Buffer()
    primitives = _tubes(buffer, drawing, width, origin) if width > 0.0 else _lines(
        buffer, drawing, origin
    )
    node: dict[str, Any] = {"name": title, "mesh": 0}
    if origin.any():
        node["translation"] = (_UP @ origin).tolist()
    record = {
        "asset": {"version": "2.0", "generator": f"Meander {version}"},
        "scene": 0,
        "scenes": [{"nodes": [0]}],
        "nodes": [node],
        "meshes": [{"name": title, "primitives": primitives}],
        "materials": [
            {"name": "Meander", "pbrMetallicRoughness": {"metallicFactor": 0.0}}
        ],
        "accessors": buffer.accessors,
        "bufferViews": buffer.views,
        "buffers": [{"byteLength": buffer.size}],
    }
    text = json.dumps(record, separators=(",", ":"), allow_nan=False).encode("ascii")
    return _packed((_JSON, text, b" "), (_BIN, b"".join(buffer.parts), b"\0"))


def _packed(*chunks: tuple[int, bytes, bytes]) -> bytes:
    """Chunks, each filled up to whole words, behind the header."""
    parts = []
    for kind, content, filler in chunks:
        filled = content + filler * (-len(content) % 4)
        parts.append(struct.pack("<II", len(filled), kind) + filled)
    body = b"".join(parts)
    return struct.pack("<4sII", b"glTF", 2, 12 + len(body)) + body


def _lines(buffer: _Buffer, drawing: Drawing, origin: NDArray[np.float64]) -> list[dict[str, Any]]:
    """Pairs of points, which every reader knows, and not strips or loops."""
    primitives = []
    for strand in drawing.strands:
        here = np.arange(len(strand.points))
        pairs = np.column_stack([here, np.roll(here, -1)])[: None if strand.closed else -1]
        attributes = {
            "POSITION": buffer.add((strand.points - origin) @ _UP.T, limits=True),
            "NORMAL": buffer.add(strand.normals @ _UP.T),
            "_ARC_LENGTH": buffer.add(strand.arc_lengths),
        }
        indices = buffer.add(pairs.ravel(), indices=True)
        primitives.append(
            {"mode": _LINES, "material": 0, "attributes": attributes, "indices": indices}
        )
    return primitives


def _tubes(
    buffer: _Buffer, drawing: Drawing, width: float, origin: NDArray[np.float64]
) -> list[dict[str, Any]]:
    tube = tube_of(drawing.strands, width / 2.0)
    along = drawing.spacing or width
    return [
        {
            "material": 0,
            "attributes": {
                "POSITION": buffer.add((tube.points - origin) @ _UP.T, limits=True),
                "NORMAL": buffer.add(tube.normals @ _UP.T),
                "TEXCOORD_0": buffer.add(tube.along_and_around / [along, 1.0]),
            },
            "indices": buffer.add(tube.triangles.ravel(), indices=True),
        }
    ]
