# SPDX-License-Identifier: GPL-3.0-or-later
"""Draws the pictures of docs/terms.md: what every term of the energy does, at two values.

    bash docs/pictures/make.sh terms

Needs numpy and the built library, no Blender. Writes one PNG for each term, and figures to stdout.
"""

from __future__ import annotations

import struct
import sys
import zlib
from pathlib import Path

import numpy as np

REPOSITORY = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(REPOSITORY / "addon"))
from meander import core  # noqa: E402

SPACING = 0.06
TILE, GAP, FINER, LINE = 230, 10, 3, 1.5  # pixels, and samples a pixel in each direction
PAPER, INK = 255, 30


def sheet(cells: int = 20) -> tuple[np.ndarray, np.ndarray]:
    """The unit square."""
    x, y = np.meshgrid(np.linspace(0, 1, cells + 1), np.linspace(0, 1, cells + 1))
    vertices = np.stack([x, y, 0 * x], axis=-1).reshape(-1, 3)
    first = (np.arange(cells)[:, None] * (cells + 1) + np.arange(cells)).reshape(-1)
    far = first + cells + 2
    faces = np.concatenate([[first, first + 1, far], [first, far, far - 1]], axis=1).T
    return vertices, faces.astype(np.uint32)


def grow(preset: str, field: str | None = None, **changes) -> core.Polylines:
    vertices, faces = sheet()
    options = core.default_options(preset)
    options.radius = SPACING / 2
    for name, value in changes.items():
        unit = options.radius if name in ("segment_length", "max_radius") else 1
        setattr(options, name, value * unit)
    flow = core.Flow(core.Surface(vertices, faces), options)
    if field == "x":
        flow.set_directions(np.tile([1.0, 0, 0], (len(vertices), 1)))
    elif field == "rings":
        x, y = vertices[:, 0] - 0.5, vertices[:, 1] - 0.5
        flow.set_directions(np.stack([-y, x, 0 * x], axis=1))
    reason = flow.run()
    figures = flow.statistics()
    print(
        f"{preset} {field or '-'} {changes}: {reason} after {figures['iterations']} iterations, "
        f"spacing {figures['spacing_median'] / SPACING:.2f} in the median, "
        f"{figures['spacing_p05'] / SPACING:.2f} and {figures['spacing_p95'] / SPACING:.2f} at 5 "
        f"and 95 %, {len(flow.gaps())} gaps"
    )
    return flow.polylines()


def tile(curve: core.Polylines) -> np.ndarray:
    """The curve in grey, `TILE` pixels wide."""
    size = TILE * FINER
    picture = np.zeros((size, size), dtype=bool)
    scale = size - 1 - 8 * FINER
    half = LINE * FINER / 2
    reach = np.arange(-int(half) - 1, int(half) + 2)
    disc = [(i, j) for i in reach for j in reach if i * i + j * j <= half * half + 0.5]
    for strand, closed in enumerate(curve.closed):
        points = curve.positions[curve.offsets[strand] : curve.offsets[strand + 1], :2]
        if closed:
            points = np.vstack([points, points[:1]])
        length = np.concatenate([[0], np.cumsum(np.linalg.norm(np.diff(points, axis=0), axis=1))])
        at = np.linspace(0, length[-1], int(2 * scale * length[-1]) + 2)
        x, y = (
            np.rint(np.interp(at, length, points[:, k]) * scale).astype(int) + 4 * FINER
            for k in (0, 1)
        )
        y = size - 1 - y
        for i, j in disc:
            picture[np.clip(y + i, 0, size - 1), np.clip(x + j, 0, size - 1)] = True
    ink = picture.reshape(TILE, FINER, TILE, FINER).mean(axis=(1, 3))
    grey = PAPER + (INK - PAPER) * ink
    return (np.rint(grey / 17) * 17).astype(np.uint8)  # 16 greys compress well


def write_png(path: Path, tiles: list[np.ndarray]) -> None:
    gap = np.full((TILE, GAP), PAPER, dtype=np.uint8)
    row = tiles[0]
    for other in tiles[1:]:
        row = np.hstack([row, gap, other])
    packed = (row // 17).astype(np.uint8)
    if packed.shape[1] % 2:
        packed = np.hstack([packed, np.full((TILE, 1), 15, dtype=np.uint8)])
    lines = packed[:, ::2] << 4 | packed[:, 1::2]
    raw = b"".join(b"\0" + line.tobytes() for line in lines)

    def chunk(kind: bytes, data: bytes) -> bytes:
        checksum = struct.pack(">I", zlib.crc32(kind + data))
        return struct.pack(">I", len(data)) + kind + data + checksum

    header = struct.pack(">IIBBBBB", packed.shape[1], TILE, 4, 0, 0, 0, 0)
    data = chunk(b"IHDR", header) + chunk(b"IDAT", zlib.compress(raw, 9)) + chunk(b"IEND", b"")
    path.write_bytes(b"\x89PNG\r\n\x1a\n" + data)


PICTURES = {
    "alignment": [("even", None, {}), ("even", "x", {"alignment_weight": 2.0}),
                  ("even", "rings", {"alignment_weight": 2.0})],
    "bending": [("paper", None, {"bending_weight": b}) for b in (0.0, 0.1, 0.5)],
    "length": [("paper", None, {"length_weight": t}) for t in (0.3, 1.0, 2.0)],
    "powers": [("paper", None, {"length_power": p, "medial_power": q})
               for p, q in ((2.0, 2.0), (2.0, 4.0), (4.0, 2.0))],
    "max_radius": [("paper", None, {"max_radius": r}) for r in (2.0, 4.0, 10.0)],
    "segment_length": [("paper", None, {"segment_length": h}) for h in (0.2, 0.4, 0.9)],
    "progressive": [("paper", None, {}), ("even", None, {}),
                    ("even", None, {"start_spacing_factor": 4.0})],
}  # fmt: skip


def main(folder: Path) -> None:
    for name, cases in PICTURES.items():
        tiles = [tile(grow(preset, field, **changes)) for preset, field, changes in cases]
        write_png(folder / f"terms_{name}.png", tiles)


if __name__ == "__main__":
    main(Path(sys.argv[1]))
