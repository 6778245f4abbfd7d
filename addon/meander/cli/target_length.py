# SPDX-License-Identifier: GPL-3.0-or-later
"""The spacing at which a curve has a length that is asked for: of cables, of heaters; no bpy."""

from __future__ import annotations

import argparse
import math
from collections.abc import Callable

import numpy as np

from .. import core
from ..model.opening import open_flow
from . import limits
from .place import Place
from .reading import read_input
from .values import BadInput, positive
from .watching import run

# A length as near as this is what was asked for. The turns of a curve lie otherwise at every
# spacing, which makes lengths jump by .4 to .7 per cent (their deviation between near spacings on
# a ball, a sheet, spot and a torus), so that what is nearer is found by chance.
CLOSE = 0.01
_NEAR = 0.05
_MOST_RUNS = 3

# A coarse run takes a third of the time of one of the quality Even, whose curve is 1.00 to 1.04
# times as long, on balls, sheets, spot and a torus alike.
_COARSE = "paper"
_COARSE_CLOSE = 0.02
_COARSE_FAR = 0.25
_MOST_COARSE_RUNS = 3
_TIMES_AS_LONG = 1.03
# Length times spacing over area, where nothing else is known.
_PACKING = 1.0

Trials = list[tuple[float, float]]  # spacings and lengths


def add_options(parser: argparse.ArgumentParser) -> None:
    parser.add_argument(
        "--target-length",
        type=positive,
        metavar="L",
        help="find the spacing at which the curve is that long, in scene units, by coarse runs; in "
        "place of --spacing",
    )


def problem_of(arguments: argparse.Namespace) -> str | None:
    """What is wrong with the options, as a sentence, or None."""
    if arguments.spacing is not None and arguments.target_length is not None:
        return "--spacing and --target-length are both given; choose one"
    return None


class Search:
    """Whole runs at one spacing after the other, until the curve is as long as asked for.

    following   the spacing of the next run, after one; None: the nearest of them stays
    """

    def __init__(self, wanted: float) -> None:
        self.wanted = wanted
        self.trials: Trials = []
        self.following: float | None = None

    def is_nearest(self, spacing: float, length: float) -> bool:
        """Notes what a run has come to, and says whether no earlier one has come nearer.

        Raises BadInput where no run came near.
        """
        self.trials.append((spacing, length))
        found, nearest = _nearest(self.trials, self.wanted)
        away = _distance(nearest, self.wanted)
        self.following = None
        if away > CLOSE and len(self.trials) < _MOST_RUNS:
            self.following = next_spacing(self.trials, self.wanted)
        elif away > _NEAR:
            raise BadInput(_refusal(self.wanted, found, nearest))
        return (found, nearest) == (spacing, length)


def begin(arguments: argparse.Namespace, place: Place) -> Search | None:
    """Finds about the spacing by coarse runs, and puts it into the arguments; None: none is wanted.

    Raises BadInput where these come nowhere near.
    """
    wanted = arguments.target_length
    if wanted is None:
        return None
    arguments.spacing = 1.0  # only to read the surface
    given = read_input(arguments, place)
    spacing = _PACKING * _area(given.problem.vertices, given.problem.faces) / wanted
    if arguments.quality == _COARSE:
        arguments.spacing = spacing
        return Search(wanted)

    def length_at(spacing: float) -> float:
        try:
            length = _TIMES_AS_LONG * _coarse_length(spacing, arguments, place)
        except (BadInput, core.MeanderError) as refusal:
            said = _of_spacing(str(refusal), spacing, wanted, given.problem.vertices)
            raise BadInput(said) from refusal
        place.say(f"meander: at a spacing of {spacing:.6g} the curve is about {length:.6g} long")
        return length

    trials = tried(length_at, spacing, wanted, _COARSE_CLOSE, _MOST_COARSE_RUNS)
    found, length = _nearest(trials, wanted)
    if _distance(length, wanted) > _COARSE_FAR:
        raise BadInput(_refusal(wanted, found, length))
    arguments.spacing = found * length / wanted
    return Search(wanted)


def tried(
    length_at: Callable[[float], float], spacing: float, wanted: float, close: float, most: int
) -> Trials:
    """Spacings and the lengths at them: a secant of the logarithms, which are nearly on a line.

    close   ends the search, as a share of the length
    most    trials
    """
    trials: Trials = []
    while len(trials) < most:
        length = length_at(spacing)
        trials.append((spacing, length))
        if not length > 0.0 or _distance(length, wanted) <= close:
            break
        spacing = next_spacing(trials, wanted)
    return trials


def next_spacing(trials: Trials, wanted: float) -> float:
    """Where the line through the last two trials has the length; through one, or two that are near
    each other, of slope -1."""
    spacing, length = trials[-1]
    if not length > 0.0:
        return spacing / 2.0
    slope = -1.0
    if len(trials) > 1:
        before, longer = trials[-2]
        apart = math.log(spacing) - math.log(before)
        if longer > 0.0 and abs(apart) > 0.05:  # what topology makes of near trials is no slope
            slope = (math.log(length) - math.log(longer)) / apart
    slope = min(max(slope, -2.0), -0.5)
    return spacing * math.exp((math.log(wanted) - math.log(length)) / slope)


def _nearest(trials: Trials, wanted: float) -> tuple[float, float]:
    return min(trials, key=lambda trial: abs(math.log(max(trial[1], 1e-300) / wanted)))


def _distance(length: float, wanted: float) -> float:
    return abs(length / wanted - 1.0)


def _refusal(wanted: float, spacing: float, length: float) -> str:
    return (
        f"no spacing gives a length of {wanted:g}: the nearest one found is {length:.4g}, at a "
        f"spacing of {spacing:.4g}; choose another length, or that spacing"
    )


def _of_spacing(said: str, spacing: float, wanted: float, vertices: np.ndarray) -> str:
    """What is said of a spacing, to whom a length was asked of; of all else what it is."""
    what, _, way = said.partition("; ")
    if "spacing" not in way:
        return said
    wide = spacing > np.linalg.norm(np.ptp(vertices, axis=0)) / 2.0
    return (
        f"a length of {wanted:g} needs a spacing of about {spacing:.4g}: {what[:1].lower()}"
        f"{what[1:]}; choose a {'greater' if wide else 'smaller'} length"
    )


def _coarse_length(spacing: float, arguments: argparse.Namespace, place: Place) -> float:
    """Of a run that takes the surface and its distances as the whole run does, and no polish."""
    arguments.spacing = spacing
    given = read_input(arguments, place)
    whole = given.problem.options
    coarse = core.default_options(_COARSE)
    for name in ("radius", "boundary_distance", "medial_axis", "roughness", "start", "threads"):
        setattr(coarse, name, getattr(whole, name))
    coarse.alignment_weight = whole.alignment_weight
    given.problem.options = coarse
    # Both halves together are as long as the whole, and so are all copies.
    given.problem.mirror = given.problem.copies = None
    opened = open_flow(
        given.problem, accept=lambda cost: limits.refuse_large(cost, arguments)
    )
    with opened.flow as flow:
        run(flow, lambda _line: None)
        return float(flow.statistics()["length"])


def _area(vertices: np.ndarray, faces: np.ndarray) -> float:
    inside = faces.max() < len(vertices) if len(faces) else False
    if not inside:  # for the library to name
        return 1.0
    a, b, c = (vertices[faces[:, corner]] for corner in range(3))
    area = float(np.linalg.norm(np.cross(b - a, c - a), axis=1).sum() / 2.0)
    return area if math.isfinite(area) and area > 0.0 else 1.0
