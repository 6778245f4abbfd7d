# SPDX-License-Identifier: GPL-3.0-or-later
"""The options of the flow as the settings of an object say."""

from __future__ import annotations

import bpy

from .. import core
from ..model.options.option import apply, chosen
from ..model.options.table import OF_THE_FLOW, in_panel
from ..model.picture.line import as_drawn
from .picture import SPACING
from .preferences import preferred

# The switch of the settings that say how strands are shaped.
_SHAPE = "use_weights"


def options_of(settings: bpy.types.PropertyGroup, spacing: float) -> core.FlowOptions:
    """The options of a flow: those of the preset with what the preferences and then the settings
    say in their place.

    spacing   in world units

    Raises core.MeanderError where there is no library.
    """
    options = core.default_options(settings.preset.lower())
    options.radius = spacing / 2.0
    values = chosen(OF_THE_FLOW, settings)
    for option in in_panel("Preferences"):
        values[option.setting] = values[option.setting] or preferred(option.setting) or None
    apply(OF_THE_FLOW, values, options)
    if (settings.density_source, settings.density_attribute) == ("ATTRIBUTE", SPACING):
        as_drawn(options)
    return options


def keep_shape(options: core.FlowOptions, settings: bpy.types.PropertyGroup) -> None:
    """Writes the shape of the strands of a flow into settings, which then no preset decides."""
    for option in OF_THE_FLOW:
        if option.switch == _SHAPE:
            setattr(settings, option.setting, getattr(options, option.field))
    setattr(settings, _SHAPE, True)


def warnings_of(settings: bpy.types.PropertyGroup) -> list[str]:
    """What is allowed but rarely intended, one sentence each; lengths are in spacings."""
    try:
        return core.option_warnings(options_of(settings, 1.0))
    except core.MeanderError:  # no library: the button says so
        return []
