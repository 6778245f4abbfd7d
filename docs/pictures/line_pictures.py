# SPDX-License-Identifier: GPL-3.0-or-later
"""Makes the pictures of docs/make/picture.md, by the Python package: line_pictures.py PHOTOS FOLDER

PHOTOS is the folder `data` of scikit-image, whose photographs are free: astronaut (NASA, public
domain), camera and coffee (CC0), chelsea (CC0). Needs Pillow. Runs where `meander` is the package.
"""

from __future__ import annotations

import sys
from pathlib import Path
from typing import Any

import meander
import numpy as np
from PIL import Image

SIZE = 1000
# File: photograph, the part of it (left, top, right, bottom), and what is wished.
PICTURES: dict[str, tuple[str, tuple[int, ...], dict[str, Any]]] = {
    "picture_portrait": ("astronaut.png", (95, 0, 385, 290), {"pen": 0.6}),
    "picture_engraving": (
        "astronaut.png",
        (95, 0, 385, 290),
        {"pen": 0.6, "style": "engraving"},
    ),
    "picture_scribble": ("camera.png", (90, 20, 430, 360), {"pen": 0.8, "style": "scribble"}),
    "picture_inks": (
        "coffee.png",
        (40, 0, 520, 400),
        {"pen": 0.6, "inks": ("cyan", "magenta", "yellow", "black")},
    ),
}


def main() -> None:
    photos, folder = Path(sys.argv[1]), Path(sys.argv[2])
    for name, (photo, part, wishes) in PICTURES.items():
        with Image.open(photos / photo) as opened:
            pixels = np.asarray(opened.crop(part))
        drawing = meander.draw_picture(pixels, width=200.0, threads=2, **wishes)
        page = drawing.preview(SIZE)
        page = page.quantize(64) if len(drawing.inks) > 1 else page.convert("L").quantize(16)
        page.save(folder / f"{name}.png", optimize=True)
        for ink, figures in zip(drawing.inks, drawing.figures, strict=True):
            print(name, ink, f"{figures['length'] / 1000:.1f} m", figures["tone"], flush=True)


if __name__ == "__main__":
    main()
