# SPDX-License-Identifier: GPL-3.0-or-later
"""The spacing at which a curve has a length that is asked for: of cables, of heaters; no bpy."""

from __future__ import annotations

import argparse
import math
from collections.abc import Callable

import numpy as np

from ..model.problem import open_flow
from . import limits
from .flags import flow_options
from .place import Place
from .reading import read_input
from .values import BadInput, positive
from .watching import interruptible, run

# A length as near as this is what was asked for; curves of few turns cannot always be nearer.
CLOSE = 0.005
_NEAR = 0.05
_MOST_TRIALS = 6


def add_options(parser: argparse.ArgumentParser) -> None:
    parser.add_argument(
        "--target-length",
        type=positive,
        metavar="L",
        help="find the spacing at which the curve is that long, in scene units, by some runs; in "
        "place of --spacing",
    )


def problem_of(arguments: argparse.Namespace) -> str | None:
    """What is wrong with the options, as a sentence, or None."""
    if arguments.spacing is None and arguments.target_length is None:
        return "the following arguments are required: --spacing; see --help"
    if arguments.spacing is not None and arguments.target_length is not None:
        return "--spacing and --target-length are both given; choose one"
    return None


def find_spacing(arguments: argparse.Namespace, place: Place) -> float:
    """The spacing of the trial whose length was nearest. Raises BadInput where none came near."""
    wanted = arguments.target_length
    arguments.spacing = 1.0  # only to read the surface
    given = read_input(arguments, flow_options(arguments), place)
    spacing = _area(given.problem.vertices, given.problem.faces) / wanted

    def length_at(spacing: float) -> float:
        length = _length_at(spacing, arguments, place)
        place.say(f"meander: at a spacing of {spacing:.6g} the curve is {length:.6g} long")
        return length

    found, length = nearest(length_at, spacing, wanted)
    if abs(length / wanted - 1.0) > _NEAR:
        raise BadInput(
            f"no spacing gives a length of {wanted:g}: the nearest one found is {length:.4g}, at a "
            f"spacing of {found:.4g}; choose another length, or that spacing"
        )
    return found


def nearest(
    length_at: Callable[[float], float], spacing: float, wanted: float
) -> tuple[float, float]:
    """The spacing and length of the nearest trial: a secant of the logarithms, which are nearly on
    a line."""
    trials: list[tuple[float, float]] = []
    while len(trials) < _MOST_TRIALS:
        length = length_at(spacing)
        trials.append((spacing, length))
        if not length > 0.0 or abs(length / wanted - 1.0) <= CLOSE:
            break
        slope = -1.0
        if len(trials) > 1:
            (s, a), (t, b) = trials[-2:]
            if a > 0.0 and a != b and s != t:
                slope = (math.log(b) - math.log(a)) / (math.log(t) - math.log(s))
        slope = min(max(slope, -2.0), -0.5)  # what topology makes of two near trials is no slope
        spacing *= math.exp((math.log(wanted) - math.log(length)) / slope)
    return min(trials, key=lambda trial: abs(math.log(max(trial[1], 1e-300) / wanted)))


def _length_at(spacing: float, arguments: argparse.Namespace, place: Place) -> float:
    arguments.spacing = spacing
    given = read_input(arguments, flow_options(arguments), place)
    opened = interruptible(
        lambda context: open_flow(
            given.problem, context, lambda cost: limits.refuse_large(cost, arguments)
        )
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
