# SPDX-License-Identifier: GPL-3.0-or-later
"""Symmetry in the batch command; no bpy."""

from __future__ import annotations

import argparse
from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any

from .. import core
from ..model.copies import AllCopies
from ..model.geometry.reflection import mirror_of
from ..model.opening import Opened
from ..model.problem import Problem
from ..model.whole import whole_of

OFF = "none"


def problem_of(arguments: argparse.Namespace) -> str | None:
    """What does not go together with the option, as a sentence, or None."""
    if arguments.mirror == OFF:
        if arguments.hide_seam:
            return "--hide-seam is about the plane of symmetry; add --mirror, or leave it out"
        return None
    told = {
        "outline": "would run along the plane of symmetry too",
        "least_bend_radius": "does not hold where the curve crosses the plane of symmetry",
        "smallest_part": "does not fit parts that symmetry halves",
    }
    for name, why in told.items():
        if getattr(arguments, name):
            option = f"--{name.replace('_', '-')}"
            return f"{option} {why}; leave out {option} or --mirror"
    return None


def reflect(problem: Problem, arguments: argparse.Namespace, matrix: Any = None) -> None:
    """Gives a problem the mirror that is asked for.

    matrix   (4, 4), of the object; None: its space is that of the vertices
    """
    if arguments.mirror != OFF:
        problem.mirror = mirror_of(arguments.mirror, matrix, arguments.hide_seam)


@contextmanager
def whole(
    opened: Opened, options: core.FlowOptions
) -> Iterator[tuple[core.Flow | AllCopies, dict[str, Any] | None, dict[str, Any] | None]]:
    """The flow of the whole curve of a run that has ended, its figures, None: as the flow tells
    them, and the report's "mirror".

    options   those of the run at its end
    """
    if opened.part is None:
        yield opened.flow, None, None
        return
    found = whole_of(opened.part, opened.flow, options)
    with found.flow as flow:
        yield flow, found.figures, found.mirror()
