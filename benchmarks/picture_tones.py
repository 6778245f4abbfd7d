#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""How well pictures in one line have the tone, and TSP art of the same length beside them.

    picture_tones.py PHOTOS FOLDER [--only NAME,NAME] [--threads N]

PHOTOS is the folder `data` of scikit-image, whose photographs are free. FOLDER gets the pictures as
squares and the lines as .obj files in a square of side 1. Each line is drawn on a raster, where ink
over ink is ink once, and compared with the picture, both blurred by two mean spacings, away from
5 % of the sides. Prints a JSON object a picture. Runs where `meander` is the package; needs Pillow
and scipy.
"""

from __future__ import annotations

import argparse
import json
import subprocess
import sys
from pathlib import Path
from typing import Any

import line_art
import meander
import numpy as np
from PIL import Image, ImageDraw
from scipy.ndimage import gaussian_filter

SIZE, FINER = 1600, 4
PEN = 1.0 / 250.0
LEAST, MOST = 0.06, 0.9
PHOTOS = ("astronaut", "camera", "chelsea", "coffee", "coins")
RIM = slice(SIZE // 20, SIZE - SIZE // 20)


def ball() -> Image.Image:
    """A shaded ball on a ramp."""
    place = (np.arange(SIZE) + 0.5) / SIZE
    x, y = np.meshgrid(place, place[::-1])
    u, v = (x - 0.5) / 0.32, (y - 0.5) / 0.32
    inside = u * u + v * v
    shade = np.clip(-0.5 * u + 0.4 * v + 0.77 * np.sqrt(np.clip(1 - inside, 0, 1)), 0, 1)
    dark = np.where(inside < 1, 0.95 - 0.85 * shade, 0.15 + 0.45 * x)
    return Image.fromarray(np.round(255.0 * (1.0 - dark)).astype(np.uint8))


def square(name: str, photos: Path) -> Image.Image:
    """A picture as a square of SIZE pixels."""
    if name == "ball":
        return ball()
    if name == "line art":
        return line_art.page()
    with Image.open(photos / f"{name}.png") as opened:
        picture = opened.convert("L")
    side = min(picture.size)
    left, top = ((length - side) // 2 for length in picture.size)
    part = picture.crop((left, top, left + side, top + side))
    return part.resize((SIZE, SIZE), Image.Resampling.LANCZOS)


def ink_of(lines: list[np.ndarray]) -> np.ndarray:
    """The share of ink of each pixel; places of lines are from 0 to 1, from the lower left."""
    side = SIZE * FINER
    sheet = Image.new("1", (side, side), 0)
    draw = ImageDraw.Draw(sheet)
    for points in lines:
        places = np.column_stack([points[:, 0], 1.0 - points[:, 1]]) * side
        draw.line(places.ravel().tolist(), fill=1, width=round(PEN * side), joint="curve")
    return np.asarray(sheet).reshape(SIZE, FINER, SIZE, FINER).mean(axis=(1, 3))


def judged(lines: list[np.ndarray], dark: np.ndarray) -> dict[str, float]:
    """The mean difference and the bias, and the length in sides of the picture."""
    blur = 2.0 * PEN / float(dark.mean()) * SIZE
    off = (gaussian_filter(ink_of(lines), blur) - gaussian_filter(dark, blur))[RIM, RIM]
    length = sum(float(np.linalg.norm(np.diff(line, axis=0), axis=1).sum()) for line in lines)
    return {"error": float(np.abs(off).mean()), "bias": float(off.mean()), "length": length}


def write_obj(path: Path, lines: list[np.ndarray]) -> None:
    with path.open("w", encoding="utf-8") as file:
        count = 0
        for points in lines:
            file.writelines(f"v {x:.9g} {y:.9g} 0\n" for x, y in points)
            numbers = range(count + 1, count + len(points) + 1)
            file.write("l " + " ".join(map(str, numbers)) + "\n")
            count += len(points)


def read_obj(path: Path) -> list[np.ndarray]:
    words = [line.split() for line in path.read_text(encoding="utf-8").splitlines()]
    points = np.array([[float(x) for x in line[1:3]] for line in words if line[0] == "v"])
    return [points[[int(k) - 1 for k in line[1:]]] for line in words if line[0] == "l"]


def row(name: str, photos: Path, folder: Path, threads: int) -> dict[str, Any]:
    picture = square(name, photos)
    file = folder / f"{name.replace(' ', '_')}.png"
    picture.save(file)
    dark = np.clip(1.0 - np.asarray(picture) / 255.0, LEAST, MOST)
    found: dict[str, Any] = {"picture": name}
    for style in ("portrait", "scribble"):
        drawing = meander.draw_picture(
            np.asarray(picture), 1.0, PEN, style=style, tone="value", threads=threads
        )
        lines = drawing.lines()
        write_obj(file.with_name(f"{file.stem}_{style}.obj"), lines)
        found[style] = judged(lines, dark) | {
            key: drawing.figures[0][key] for key in ("crossings", "iterations", "stop_reason")
        }
    tour = file.with_name(f"{file.stem}_tsp.obj")
    art = Path(__file__).with_name("tsp_art.py")
    if not tour.exists():  # it takes longer than all the rest
        command = [sys.executable, str(art), str(file), str(tour), "--pen", str(PEN)]
        subprocess.run(command, check=True, stdout=subprocess.DEVNULL)
    found["tsp"] = judged(read_obj(tour), dark)
    return found


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("photos", type=Path)
    parser.add_argument("folder", type=Path)
    parser.add_argument("--only")
    parser.add_argument("--threads", type=int, default=1)
    given = parser.parse_args()
    given.folder.mkdir(parents=True, exist_ok=True)
    names = given.only.split(",") if given.only else ("ball", *PHOTOS, "line art")
    for name in names:
        print(json.dumps(row(name, given.photos, given.folder, given.threads)), flush=True)


if __name__ == "__main__":
    main()
