# SPDX-License-Identifier: GPL-3.0-or-later
"""The options that say how dark a line is to look where, of pictures and of surfaces; no bpy."""

from __future__ import annotations

import argparse
from typing import Any

from ..model.options.tone import COMMON
from ..model.picture.strip import read_paper
from ..model.picture.tone import Tone
from .flags import add_flags
from .values import reader

# Their names in the parsed arguments.
COMMON_NAMES = ("tone", "darkest", "lightest", "levels", "paper")


def add_common(group: argparse._ActionsContainer) -> None:
    """The options of tone that pictures and surfaces share."""
    add_flags(group, "tone", COMMON)
    group.add_argument(
        "--levels",
        type=reader(float, 0.0, 100.0),
        nargs=2,
        metavar=("BLACK", "WHITE"),
        help="the lightness, from 0 to 100, that becomes darkest and lightest; default: of eye and "
        "one line, what half a per cent are beyond; else 0 and 100",
    )
    group.add_argument(
        "--paper",
        metavar="STOPS",
        help="how dark shares of ink were measured on paper, such as 0.2:0.27,0.5:0.61,0.8:0.85",
    )


def problem_of(arguments: argparse.Namespace) -> str | None:
    """One sentence about options that do not fit each other; None: they do."""
    tone = tone_of(arguments, with_paper=False)
    if tone.lightest >= tone.darkest:
        return "--lightest is not less than --darkest; choose a smaller one"
    if tone.levels is not None and not tone.levels[0] < tone.levels[1]:
        return "--levels are not in order; give the darker one first"
    return None


def tone_of(
    arguments: argparse.Namespace, saved: Tone | None = None, with_paper: bool = True
) -> Tone:
    """What the options say; what is not given is as saved.

    with_paper   read the measurements as well. Raises FileError for what is none
    """
    saved = Tone() if saved is None else saved
    given: dict[str, Any] = {
        name: value
        for name, option in (("kind", "tone"), ("darkest", "darkest"), ("lightest", "lightest"))
        if (value := getattr(arguments, option)) is not None
    }
    if arguments.levels is not None:
        given["levels"] = tuple(arguments.levels)
    if with_paper and arguments.paper is not None:
        given["paper"] = read_paper(arguments.paper)
    return Tone(**{**vars(saved), **given})
