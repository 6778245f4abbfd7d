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
# Thread breaks where the needle comes down again and again in one place.
LEAST_STITCH = 0.3
# How long the stitches are that hold the ends of a thread, in millimetres, where there is room.
_TIE = 0.7
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


def stitched(
    drawing: Drawing, stitch_length: float, tolerance: float, least: float = LEAST_STITCH
) -> Drawing:
    """The thread that follows a flat drawing: straight stitches between its points, which lie on
    the grid of a machine.

    stitch_length   in millimetres: stitches are equally long along each strand, at most that
    tolerance       in millimetres: where a stitch would be farther from the strand it is halved,
                    and again; 0: a tenth of the spacing, if it is known
    least           in millimetres, at most half of the length: no stitch is shorter, whatever the
                    tolerance

    A strand that is shorter than a stitch is left out. Raises FileError where nothing is left.
    """
    unit = drawing.millimetres
    step, longest = 1.0 / (_TENTHS * unit), stitch_length / unit
    least = min(least / unit, longest / 2.0)
    allowed = tolerance / unit or TOLERANCE_OF_SPACING * drawing.spacing
    strands = []
    for strand in drawing.strands:
        # Both ends of a stitch may move by half a diagonal of the grid.
        even = resampled_by_step(strand, longest - step * np.sqrt(2.0))
        arcs = np.append(even.arc_lengths, strand.length) if strand.closed else even.arc_lengths
        if allowed > 0.0:
            # The grid alone takes a point half a diagonal away.
            arcs = _halved(strand, arcs, max(allowed, step * np.sqrt(0.5)), least, step)
        places = _apart(_places(strand, arcs, step), least, longest, step)
        if len(places) < 2:
            continue
        places = places[:-1] if strand.closed else places
        normals = np.tile([0.0, 0.0, 1.0], (len(places), 1))
        strands.append(replace(strand_of(places, normals, strand.closed), part=strand.part))
    if not strands:
        raise FileError(
            f"All strands are shorter than a stitch of {least * unit:g} mm; choose a larger size"
        )
    return replace(drawing, strands=strands)


def _places(strand: Strand, arcs: np.ndarray, step: float) -> np.ndarray:
    """The points of a grid that are nearest to those of a strand at arc lengths."""
    knots = np.append(strand.arc_lengths, strand.length) if strand.closed else strand.arc_lengths
    points = ring(strand)
    places = np.column_stack([np.interp(arcs, knots, points[:, axis]) for axis in range(3)])
    return np.round(places / step) * step


def _apart(places: np.ndarray, least: float, longest: float, step: float) -> np.ndarray:
    """A way through some of the places, from the first to the last, of stitches that are neither
    too short nor too long; a single place where first and last are all of it, and too near."""

    def length(one: np.ndarray, other: np.ndarray) -> float:
        return float(np.linalg.norm(other - one)) * (1.0 + 1e-9)

    def step_to(place: np.ndarray) -> None:
        if length(kept[-1], place) > longest * (1.0 + 2e-9):  # others before it are left out
            kept.append(np.round((kept[-1] + place) / 2.0 / step) * step)
        kept.append(place)

    last, kept = places[-1], [places[0]]
    for place in places[1:]:
        if length(kept[-1], place) >= least:
            step_to(place)
    if (kept[-1] != last).any():  # the end stays where it is
        while len(kept) > 1 and length(kept[-1], last) < least:
            kept.pop()
        if length(kept[-1], last) >= least:
            step_to(last)
    return np.array(kept)


def _halved(
    strand: Strand, arcs: np.ndarray, allowed: float, least: float, step: float
) -> np.ndarray:
    """Arc lengths with others between where the chord from one to the next is too far from the
    strand, and the halves are not shorter than `least`."""
    knots, points = strand.arc_lengths, strand.points
    for _ in range(_MOST_HALVINGS):
        places = _places(strand, arcs, step)
        piece = np.clip(np.searchsorted(arcs, knots, side="right") - 1, 0, len(arcs) - 2)
        low, along = places[piece], places[piece + 1] - places[piece]
        square = np.maximum((along * along).sum(axis=1), np.finfo(float).tiny)
        share = np.clip(((points - low) * along).sum(axis=1) / square, 0.0, 1.0)
        far = np.linalg.norm(points - low - share[:, None] * along, axis=1) > allowed
        cut = np.unique(piece[far])
        cut = cut[arcs[cut + 1] - arcs[cut] >= 2.0 * least]
        if not len(cut):
            break
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
    middle = np.round((low + high) / 2.0 * drawing.millimetres * _TENTHS)
    pattern = pyembroidery.EmbPattern()
    pattern.add_thread({"hex": "#000000", "name": "Black"})
    pattern.metadata("name", _plain(title))
    for number, strand in enumerate(drawing.strands):
        if strand.part and number:
            pattern.add_command(pyembroidery.STOP)
        # The y axis of the package points down.
        places = np.round(ring(strand) * drawing.millimetres * _TENTHS) - middle
        _add(pattern, places[:, :2] * [1.0, -1.0], pyembroidery)
    pattern.end()
    stream = io.BytesIO()
    settings = {"tie_on": False, "tie_off": False}  # those would be shorter than any stitch
    write = {".dst": pyembroidery.write_dst, ".pes": pyembroidery.write_pes}[suffix]
    write(pattern, stream, settings)
    return stream.getvalue()


def _add(pattern: Any, places: np.ndarray, pyembroidery: Any) -> None:
    """One strand. The needle comes without thread to a place on the first stitch, since a stitch in
    the place of a jump would have no length, and goes over both ends three times to hold them."""
    steps = np.linalg.norm(np.diff(places, axis=0), axis=1)
    reach = max(_TIE * _TENTHS, float(steps.min()) + 1.0)
    begin, end = _tie(places[0], places[1], reach), _tie(places[-1], places[-2], reach)
    pattern.add_stitch_absolute(pyembroidery.JUMP, *begin.tolist())
    for place in (places[0], begin, *places, end, places[-1]):
        pattern.add_stitch_absolute(pyembroidery.STITCH, *place.tolist())
    pattern.add_command(pyembroidery.TRIM)


def _tie(here: np.ndarray, there: np.ndarray, reach: float) -> np.ndarray:
    """Where a stitch that holds an end goes: so far along a stitch, or all of it."""
    share = reach / float(np.linalg.norm(there - here))
    return there if share > 0.5 else np.round(here + share * (there - here))


def _plain(text: str) -> str:
    """A name as the head of a file may have it."""
    letters = "".join(letter if letter.isascii() and letter.isalnum() else "_" for letter in text)
    return letters[:16] or "Meander"


def is_wanted(path: Path) -> bool:
    """Whether a file is one of these formats."""
    return path.suffix.lower() in SUFFIXES
