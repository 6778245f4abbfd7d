# SPDX-License-Identifier: GPL-3.0-or-later
"""The options of the flow as the settings of an object say."""

from __future__ import annotations

import bpy

from .. import core
from ..model.option import apply, chosen
from ..model.options import OF_THE_FLOW


def options_of(settings: bpy.types.PropertyGroup, spacing: float) -> core.FlowOptions:
    """The options of a flow: those of the preset with what the settings say in their place.

    spacing   in world units

    Raises core.MeanderError where there is no library.
    """
    options = core.default_options(settings.preset.lower())
    options.radius = spacing / 2.0
    apply(OF_THE_FLOW, chosen(OF_THE_FLOW, settings), options)
    return options


def warnings_of(settings: bpy.types.PropertyGroup) -> list[str]:
    """What is allowed but rarely intended, one sentence each; lengths are in spacings."""
    try:
        return core.option_warnings(options_of(settings, 1.0))
    except core.MeanderError:  # no library: the button says so
        return []
