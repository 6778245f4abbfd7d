# SPDX-License-Identifier: GPL-3.0-or-later
"""Blender script: cuts the states of the panel out of the pictures of stories, side by side.

    bash docs/pictures/make.sh panel

Reads build/ui, of a window of 1280 x 800 by a scale of 1, and writes panel_states.png and
look_panel.png into docs/images.
"""

from __future__ import annotations

import struct
import zlib
from pathlib import Path

import bpy
import numpy as np

ROOT = Path(__file__).resolve().parents[2]
PICTURES = ROOT / "build" / "ui"
IMAGES = ROOT / "docs" / "images"
# Left, top, width and height, from the upper left of a window of 1280 x 800.
PANEL = (836, 84, 192, 580)
DIALOG = (117, 494, 366, 108)
LOOK = (836, 332, 192, 387)
GAP = 12
# Of what lies between the pieces, transparent.
BACKGROUND = (0.0, 0.0, 0.0, 0.0)


def pixels_of(name: str, box: tuple[int, int, int, int]) -> np.ndarray:
    """A part of a picture, (height, width, 4), its first row at the top."""
    image = bpy.data.images.load(str(PICTURES / f"{name}.png"))
    everything = np.empty(len(image.pixels), dtype=np.float32)
    image.pixels.foreach_get(everything)
    left, top, width, height = box
    rows = everything.reshape(image.size[1], image.size[0], 4)[::-1]
    return rows[top : top + height, left : left + width]


def write_png(path: Path, pixels: np.ndarray) -> None:
    """Writes (height, width, 4) uint8; for flat pictures like these half as large as Blender's.

    Greys lose their two lowest bits, which nobody sees in a panel.
    """
    height, width, _ = pixels.shape
    colors = (pixels & 0xFC) | (pixels >> 6)
    rows = np.zeros((height, 1 + 4 * width), dtype=np.uint8)  # each begins with filter 0
    rows[:, 1:] = colors.reshape(height, -1)

    def chunk(kind: bytes, data: bytes) -> bytes:
        sum_of_it = zlib.crc32(kind + data)
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", sum_of_it)

    head = struct.pack(">IIBBBBB", width, height, 8, 6, 0, 0, 0)
    data = zlib.compress(rows.tobytes(), 9)
    path.write_bytes(
        b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", head) + chunk(b"IDAT", data) + chunk(b"IEND", b"")
    )


def main() -> None:
    names = ("9_mesh", "9_growing", "9_result", "9_gaps", "5_resume")
    pieces = [pixels_of(name, PANEL) for name in names]
    pieces.append(pixels_of("5_question", DIALOG))
    write_beside("panel_states.png", pieces)
    looks = ("7_look_of_a_result", "7_look_of_a_mesh")
    write_beside("look_panel.png", [pixels_of(name, LOOK) for name in looks])


def write_beside(name: str, pieces: list[np.ndarray]) -> None:
    """Writes a picture of pieces side by side."""
    height = max(len(piece) for piece in pieces)
    columns = []
    for piece in pieces:
        column = np.empty((height, piece.shape[1] + GAP, 4), dtype=np.float32)
        column[:] = BACKGROUND
        column[: len(piece), : piece.shape[1]] = piece
        columns.append(column)
    whole = np.hstack(columns)[:, :-GAP]
    output = IMAGES / name
    write_png(output, np.round(255.0 * whole).astype(np.uint8))
    print(f"{output.relative_to(ROOT)}: {output.stat().st_size} bytes")


main()
