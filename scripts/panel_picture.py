# SPDX-License-Identifier: GPL-3.0-or-later
"""Blender script: cuts the states of the panel out of the pictures of a UI test, side by side.

    bash scripts/test.sh
    blender --background --factory-startup --python-exit-code 1 --python scripts/panel_picture.py

Reads build/ui and writes docs/images/panel_states.png.
"""

from __future__ import annotations

from pathlib import Path

import bpy
import numpy as np

ROOT = Path(__file__).resolve().parents[1]
PICTURES = ROOT / "build" / "ui"
OUTPUT = ROOT / "docs" / "images" / "panel_states.png"
# Left, top, width and height, from the upper left of a window of 1280 x 800.
PANEL = (836, 84, 192, 226)
DIALOG = (217, 394, 366, 108)
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


def main() -> None:
    pieces = [pixels_of(name, PANEL) for name in ("5_estimate", "5_continued", "5_resume")]
    pieces.append(pixels_of("5_question", DIALOG))
    height = max(len(piece) for piece in pieces)
    columns = []
    for piece in pieces:
        column = np.empty((height, piece.shape[1] + GAP, 4), dtype=np.float32)
        column[:] = BACKGROUND
        column[: len(piece), : piece.shape[1]] = piece
        columns.append(column)
    whole = np.hstack(columns)[:, :-GAP]
    image = bpy.data.images.new("Panel States", whole.shape[1], whole.shape[0], alpha=True)
    image.pixels.foreach_set(whole[::-1].ravel())
    image.file_format = "PNG"
    image.filepath_raw = str(OUTPUT)
    image.save()
    print(f"{OUTPUT.relative_to(ROOT)}: {OUTPUT.stat().st_size} bytes")


main()
