# SPDX-License-Identifier: GPL-3.0-or-later
"""--quality with a preset of the panel, which stands for several flags; no bpy."""

from __future__ import annotations

import argparse

from ..model.options.option import OF_PRESET
from ..model.options.presets import PRESETS
from ..model.options.table import BY_SETTING


def expand(arguments: argparse.Namespace) -> None:
    """Puts what a preset of the panel says in the place of flags that are not given.

    Of a direction that is given, the preset's own is left out, with whether strands run across it.
    """
    arguments.asked_quality = arguments.quality
    preset = dict(PRESETS.get(arguments.quality, {}))
    if not preset:
        return
    arguments.quality = preset.pop("preset")
    source, across = preset.pop("alignment_source", None), preset.pop("align_across", False)
    if source and arguments.direction is None and arguments.direction_object is None:
        arguments.direction = source
        arguments.across = arguments.across or across
    for setting, value in preset.items():
        flag = BY_SETTING[setting].flag
        default = flag.default
        if getattr(arguments, flag.destination) in (None, OF_PRESET, default):
            setattr(arguments, flag.destination, value)


def asked(arguments: argparse.Namespace) -> str:
    """The preset that was asked for."""
    return getattr(arguments, "asked_quality", arguments.quality)
