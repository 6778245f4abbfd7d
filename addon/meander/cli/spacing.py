# SPDX-License-Identifier: GPL-3.0-or-later
"""The spacing of the batch command, which is automatic where none is given; no bpy."""

from __future__ import annotations

import argparse

import numpy as np

from .. import core
from .flags import flow_options


def settled(
    arguments: argparse.Namespace, vertices: np.ndarray, faces: np.ndarray
) -> core.FlowOptions:
    """The options of the flow, once the surface is known: where no spacing was given, the automatic
    one of the panel is put into the arguments, and with a width of the line twice as much."""
    if arguments.spacing is None and arguments.pen is not None:
        arguments.spacing = 2.0 * arguments.pen
    if arguments.spacing is None:
        arguments.spacing = core.automatic_spacing(vertices, faces)
        arguments.spacing_is_automatic = True
    return flow_options(arguments)


def is_automatic(arguments: argparse.Namespace) -> bool:
    """Whether nobody gave the spacing."""
    return getattr(arguments, "spacing_is_automatic", False)


def sentence(spacing: float) -> str:
    """What is said of an automatic one."""
    return (
        f"the spacing is {spacing:g}, which is automatic: a thirtieth of the side of a square of "
        "the surface's area, or as two strands need it in stems; --spacing S sets another"
    )
