# SPDX-License-Identifier: GPL-3.0-or-later
"""Files of images of a map: their names, and PNG."""

from __future__ import annotations

import os
import re
from collections.abc import Callable, Generator, Sequence
from pathlib import Path
from typing import TypeVar

from .. import core
from .maps import KINDS, MOST_TILES, Mapped, NoPlace, Style, Tile

_Result = TypeVar("_Result")

# From this share of pixels in two places on it is worth a word.
_OVERLAPPING = 0.005
# The share of the work at a tile that is done when all values are known, and files are left.
_VALUES = 0.8


def images(
    mapped: Mapped,
    path: Path,
    kinds: Sequence[str],
    style: Style,
    context: core.Context | None = None,
    progress: Callable[[float], None] = lambda share: None,
) -> tuple[dict[Path, bytes], float]:
    """Files beside the path NAME.png or NAME.exr: NAME_KIND.png, with UDIM numbers where there are
    several tiles; and the largest overlap of a tile.

    context    where it is cancelled, a core.MeanderError of the status CANCELLED is raised soon
    progress   called with the share that is done, rising, for every few million pixels

    Raises NoPlace.
    """
    return finished(drawn(mapped, path, kinds, style, context), progress)


def finished(
    work: Generator[float, None, _Result], progress: Callable[[float], None] = lambda share: None
) -> _Result:
    """Does the rest of what is done piece by piece, and returns what comes of it.

    progress   called with the share that is done
    """
    while True:
        try:
            progress(next(work))
        except StopIteration as end:
            return end.value


def drawn(
    mapped: Mapped,
    path: Path,
    kinds: Sequence[str],
    style: Style,
    context: core.Context | None = None,
) -> Generator[float, None, tuple[dict[Path, bytes], float]]:
    """The same piece by piece: gives the share that is done, and returns the files."""
    tiles = mapped.tiles()
    problem = problem_of_tiles(tiles)
    if problem is not None:
        raise NoPlace(problem)
    files, overlap = {}, 0.0
    for done, number in enumerate(tiles):
        tile = Tile(mapped, number, style, context, kinds)
        overlap = max(overlap, tile.overlap)
        for share in tile.draw():
            yield (done + _VALUES * share) / len(tiles)
        for place, kind in enumerate(kinds, 1):
            name = file_of(path, kind, number, len(tiles) > 1)
            files[name] = tile.file(kind, path.suffix.lower())
            yield (done + _VALUES + (1.0 - _VALUES) * place / len(kinds)) / len(tiles)
    return files, overlap


def overlap_warning(overlap: float) -> str | None:
    """What somebody should know of a map that lies on itself, as a sentence, or None."""
    if overlap < _OVERLAPPING:
        return None
    return (
        f"The UV map lies on itself: {100.0 * overlap:.0f} % of its pixels belong to two places "
        "of the surface, and show one of them; unwrap the mesh without overlaps"
    )


def file_of(path: Path, kind: str, tile: tuple[int, int], many: bool) -> Path:
    """Where one image goes."""
    number = f".{1001 + tile[0] + 10 * tile[1]}" if many else ""
    return path.with_name(f"{path.stem}_{kind}{number}{path.suffix}")


def is_of(path: Path, other: Path) -> bool:
    """Whether writing the images of `path` could write `other`."""
    stem = other.stem
    if path.suffix.lower() == other.suffix.lower() and re.search(r"\.\d{4}$", stem):
        stem = stem[: stem.rindex(".")]
    of_kind = any(stem == f"{path.stem}_{kind}" for kind in KINDS)
    if not of_kind or path.suffix.lower() != other.suffix.lower():
        return False
    return os.path.realpath(path.parent) == os.path.realpath(other.parent)


def problem_of_tiles(tiles: Sequence[tuple[int, int]]) -> str | None:
    """What is wrong with the squares that a UV map lies in, as the end of a sentence, or None."""
    if not tiles:
        return "has no area; unwrap the mesh again"
    if any(not 0 <= column < 10 or row < 0 for column, row in tiles):
        return "leaves the squares that UDIM counts, 0 to 10 across and up from 0; move it there"
    if len(tiles) > MOST_TILES:
        return f"lies in {len(tiles)} squares, and {MOST_TILES} is the most; pack its islands"
    return None
