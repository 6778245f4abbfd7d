# SPDX-License-Identifier: GPL-3.0-or-later
"""OpenEXR files of one part with 32-bit floats, compressed line by line; numpy and zlib only.

After the file layout that the OpenEXR project publishes (openexr.com, "OpenEXR File Layout").
"""

from __future__ import annotations

import struct
import zlib

import numpy as np
from numpy.typing import NDArray

_FLOAT, _ZIP, _LINES = 2, 3, 16  # lines that are compressed together
_MAGIC = struct.pack("<II", 20000630, 2)


def exr(image: NDArray[np.float32]) -> bytes:
    """A file of an image, (rows, columns) or with red, green and blue (rows, columns, 3); the first
    row is at the top."""
    height, width = image.shape[:2]
    names = "Y" if image.ndim == 2 else "BGR"  # as the alphabet has them
    planes = image.reshape(height, width, -1)[:, :, ::-1].transpose(0, 2, 1)
    lines = np.ascontiguousarray(planes, dtype="<f4").reshape(height, -1)
    blocks = [
        struct.pack("<ii", first, len(packed)) + packed
        for first in range(0, height, _LINES)
        for packed in [_packed(lines[first : first + _LINES].tobytes())]
    ]
    head = _MAGIC + _header(width, height, names)
    begin = len(head) + 8 * len(blocks)
    ends = begin + np.cumsum([0] + [len(block) for block in blocks[:-1]])
    return head + ends.astype("<u8").tobytes() + b"".join(blocks)


def _header(width: int, height: int, names: str) -> bytes:
    channels = b"".join(
        name.encode() + b"\0" + struct.pack("<iB3xii", _FLOAT, 0, 1, 1) for name in names
    )
    window = struct.pack("<iiii", 0, 0, width - 1, height - 1)
    attributes = (
        ("channels", "chlist", channels + b"\0"),
        ("compression", "compression", bytes([_ZIP])),
        ("dataWindow", "box2i", window),
        ("displayWindow", "box2i", window),
        ("lineOrder", "lineOrder", b"\0"),  # from the top
        ("pixelAspectRatio", "float", struct.pack("<f", 1.0)),
        ("screenWindowCenter", "v2f", struct.pack("<ff", 0.0, 0.0)),
        ("screenWindowWidth", "float", struct.pack("<f", 1.0)),
    )
    return b"".join(
        f"{name}\0{kind}\0".encode() + struct.pack("<i", len(value)) + value
        for name, kind, value in attributes
    ) + b"\0"


def _packed(raw: bytes) -> bytes:
    """Bytes of alike weight side by side, as differences, compressed; as they are where that is no
    shorter, which readers tell by their number."""
    values = np.frombuffer(raw, dtype=np.uint8)
    sorted_ = np.concatenate([values[0::2], values[1::2]])
    steps = sorted_.copy()
    steps[1:] = sorted_[1:] - sorted_[:-1] + np.uint8(128)
    packed = zlib.compress(steps.tobytes(), 6)
    return packed if len(packed) < len(raw) else raw
