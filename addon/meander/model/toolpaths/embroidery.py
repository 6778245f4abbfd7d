# SPDX-License-Identifier: GPL-3.0-or-later
"""Flat drawings as embroidery files, by the Python package pyembroidery, where it is installed or
the add-on has its wheel; no bpy."""

from __future__ import annotations

import importlib
import importlib.util
import io
import sys
import zipimport
from dataclasses import replace
from pathlib import Path
from types import ModuleType
from typing import Any

import numpy as np

from ..files.whole import FileError
from .drawing import Drawing, ring
from .toolpath import Strand, resampled_by_step, strand_of

PACKAGE = "pyembroidery"
SUFFIXES = (".dst", ".pes")

# A machine counts in tenths of a millimetre, and its longest stitch is 12.1 mm.
_TENTHS = 10.0
LONGEST_STITCH = 12.1
# How far a stitch may be from the curve unless somebody says so: neighbours are a spacing apart.
TOLERANCE_OF_SPACING = 0.1
_MOST_HALVINGS = 12
# No hoop is wider, in millimetres: a drawing that is has the wrong unit.
_WIDEST = 1000.0


# What the add-on's zip brings. Blender 4.2 and later install it; before, it is read as it is.
_WHEELS = Path(__file__).resolve().parents[2] / "wheels"


def _wheel() -> Path | None:
    return next(iter(sorted(_WHEELS.glob(f"{PACKAGE}-*.whl"))), None)


def is_there() -> bool:
    """Whether the package can be imported."""
    return importlib.util.find_spec(PACKAGE) is not None or _wheel() is not None


def _package() -> ModuleType:
    """The package, once is_there() is true: one that is installed comes first."""
    if importlib.util.find_spec(PACKAGE) is None:
        spec = zipimport.zipimporter(str(_wheel())).find_spec(PACKAGE)
        module = sys.modules[PACKAGE] = importlib.util.module_from_spec(spec)
        try:
            spec.loader.exec_module(module)
        except BaseException:
            del sys.modules[PACKAGE]
            raise
    return importlib.import_module(PACKAGE)


def missing_text(folder: str | None) -> str:
    """What to do about a package that is not there, as a sentence.

    folder   of modules that a Blender finds that is running; None: the command has to run again
    """
    target = f'--target "{folder}" ' if folder else ""
    again = "start Blender again" if folder else "try again"
    return (
        f"Embroidery files need the Python package {PACKAGE}, which is not there; install it with "
        f"python3 -m pip install {target}{PACKAGE}, and {again}"
    )


def stitched(drawing: Drawing, stitch_length: float, tolerance: float) -> Drawing:
    """The thread that follows a flat drawing: straight stitches between its points.

    stitch_length   in millimetres: stitches are equally long along each strand, at most that
    tolerance       in millimetres: where a stitch would be farther from the strand it is halved,
                    and again; 0: a tenth of the spacing, if it is known
    """
    allowed = tolerance / drawing.millimetres or TOLERANCE_OF_SPACING * drawing.spacing
    strands = []
    for strand in drawing.strands:
        even = resampled_by_step(strand, stitch_length / drawing.millimetres)
        arcs = np.append(even.arc_lengths, strand.length) if strand.closed else even.arc_lengths
        if allowed > 0.0:
            arcs = _halved(strand, arcs, allowed)
        places = _places(strand, arcs[:-1] if strand.closed else arcs)
        strands.append(strand_of(places, np.tile([0.0, 0.0, 1.0], (len(places), 1)), strand.closed))
    return replace(drawing, strands=strands)


def _places(strand: Strand, arcs: np.ndarray) -> np.ndarray:
    """The points of a strand at arc lengths."""
    knots = np.append(strand.arc_lengths, strand.length) if strand.closed else strand.arc_lengths
    points = ring(strand)
    return np.column_stack([np.interp(arcs, knots, points[:, axis]) for axis in range(3)])


def _halved(strand: Strand, arcs: np.ndarray, allowed: float) -> np.ndarray:
    """Arc lengths with others between where the chord from one to the next is too far from the
    strand."""
    knots, points = strand.arc_lengths, strand.points
    for _ in range(_MOST_HALVINGS):
        places = _places(strand, arcs)
        piece = np.clip(np.searchsorted(arcs, knots, side="right") - 1, 0, len(arcs) - 2)
        low, along = places[piece], places[piece + 1] - places[piece]
        square = np.maximum((along * along).sum(axis=1), np.finfo(float).tiny)
        share = np.clip(((points - low) * along).sum(axis=1) / square, 0.0, 1.0)
        far = np.linalg.norm(points - low - share[:, None] * along, axis=1) > allowed
        if not far.any():
            break
        cut = np.unique(piece[far])
        arcs = np.insert(arcs, cut + 1, (arcs[cut] + arcs[cut + 1]) / 2.0)
    return arcs


def embroidery_bytes(drawing: Drawing, title: str, suffix: str) -> bytes:
    """The file's content: one thread that follows every strand, trimmed between them.

    drawing   of stitched()
    suffix    one of SUFFIXES

    Raises FileError with one sentence where the package is missing, and for a drawing that is wider
    than any hoop.
    """
    if not is_there():
        raise FileError(missing_text(None))
    pyembroidery = _package()
    low, high = drawing.box()
    width = float((high - low)[:2].max()) * drawing.millimetres
    if width > _WIDEST:
        raise FileError(
            f"The embroidery would be {width:,.0f} mm wide, which no machine can do; choose a size"
        )
    middle = (low + high) / 2.0
    pattern = pyembroidery.EmbPattern()
    pattern.add_thread({"hex": "#000000", "name": "Black"})
    pattern.metadata("name", _plain(title))
    for strand in drawing.strands:
        # The y axis of the package points down.
        places = (ring(strand) - middle)[:, :2] * [1.0, -1.0] * drawing.millimetres * _TENTHS
        _add(pattern, places.round().tolist(), pyembroidery)
    pattern.end()
    stream = io.BytesIO()
    settings = {"tie_on": True, "tie_off": True}
    write = {".dst": pyembroidery.write_dst, ".pes": pyembroidery.write_pes}[suffix]
    write(pattern, stream, settings)
    return stream.getvalue()


def _add(pattern: Any, places: list[list[float]], pyembroidery: Any) -> None:
    """One strand: the needle goes to its beginning without thread."""
    pattern.add_stitch_absolute(pyembroidery.JUMP, *places[0])
    for place in places:
        pattern.add_stitch_absolute(pyembroidery.STITCH, *place)
    pattern.add_command(pyembroidery.TRIM)


def _plain(text: str) -> str:
    """A name as the head of a file may have it."""
    letters = "".join(letter if letter.isascii() and letter.isalnum() else "_" for letter in text)
    return letters[:16] or "Meander"


def is_wanted(path: Path) -> bool:
    """Whether a file is one of these formats."""
    return path.suffix.lower() in SUFFIXES
