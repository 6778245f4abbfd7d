# SPDX-License-Identifier: GPL-3.0-or-later
"""The least radius of bending that is asked for: of filaments, of tubes; no bpy."""

from __future__ import annotations

import argparse

from .. import core
from ..model import strands
from ..model.least_bend import Bend, Stiffening, sharpest_bend
from ..model.opening import Opened
from .place import Place
from .values import BadInput
from .watching import run


def problem_of(arguments: argparse.Namespace) -> str | None:
    """What does not go together with the option, as a sentence, or None."""
    if arguments.least_bend_radius is None:
        return None
    if arguments.target_length is not None:
        return (
            "--least-bend-radius changes the length that --target-length finds; find the spacing "
            "first, and give that to --spacing"
        )
    if arguments.bridge:
        return "--bridge makes corners, which no --least-bend-radius holds; leave one of them out"
    return None


def run_until_held(
    opened: Opened, options: core.FlowOptions, arguments: argparse.Namespace, place: Place
) -> tuple[str, core.FlowOptions]:
    """Runs the flow to its end, and on with more stiffness while the curve bends too sharply.

    Returns the stop reason and the options of the last of these runs. Raises BadInput, with the
    place, where no stiffness holds.
    """
    stiffening = Stiffening(arguments.least_bend_radius or 0.0)
    while True:
        reason = run(opened.flow, place.say)
        if not stiffening.least:
            return reason, options
        bend = _sharpest(opened.flow, arguments)
        following = stiffening.following(bend, options)
        if stiffening.held:
            return reason, options
        place.say(
            f"meander: at a stiffness of {options.bending_weight:g} the least bend radius is "
            f"{bend.radius:.4g}"
        )
        if following is None:
            raise BadInput(stiffening.refusal(lambda length: f"{length:.4g}"))
        options = following
        opened.flow.set_options(options)


def _sharpest(flow: core.Flow, arguments: argparse.Namespace) -> Bend | None:
    """The sharpest bend of what is written."""
    curve = flow.rounded(arguments.round)[0] if arguments.round else flow.polylines()
    if arguments.leave_out_guides:
        curve = strands.without_guides(curve, flow.guides())
    return sharpest_bend(curve, arguments.spacing / 2)
