# SPDX-License-Identifier: GPL-3.0-or-later
"""Weights, powers and lengths of the flow, as the settings of an object say."""

from __future__ import annotations

import bpy

from .. import core
from ..model.terms import Terms


def _given(value: float) -> float:
    """What the user has typed, and not the float32 that Blender keeps of it."""
    return float(f"{value:.6g}")


def terms_of(settings: bpy.types.PropertyGroup) -> Terms:
    """What the settings of an object say."""
    own = settings.use_weights
    return Terms(
        length=_given(settings.length_weight) if own else None,
        bending=_given(settings.bending_weight) if own else None,
        length_power=_given(settings.length_power) if own else None,
        medial_power=_given(settings.medial_power) if own else None,
        segment_share=_share(settings.segment_share, 0.01),
        reach=_share(settings.reach, 1.5),
        start_spacing_factor=_given(settings.start_spacing_factor),
    )


def _share(value: float, least: float) -> float:
    """0, or at least what the library takes: the way up from 0 leads through what is too small."""
    return max(_given(value), least) if value > 0.0 else 0.0


def store_terms(terms: Terms, settings: bpy.types.PropertyGroup) -> None:
    """Writes terms into the settings of an object; terms_of() then gives them back."""
    own = (terms.length, terms.bending, terms.length_power, terms.medial_power)
    settings.use_weights = any(value is not None for value in own)
    names = ("length_weight", "bending_weight", "length_power", "medial_power")
    for name, value in zip(names, own):
        if value is not None:
            setattr(settings, name, value)
    settings.segment_share = terms.segment_share
    settings.reach = terms.reach
    if terms.start_spacing_factor is not None:
        settings.start_spacing_factor = terms.start_spacing_factor


def warnings_of(settings: bpy.types.PropertyGroup) -> list[str]:
    """What is allowed but seldom meant, one sentence each."""
    try:
        options = core.default_options(settings.preset.lower())
        options.radius = 1.0
        terms_of(settings).apply(options)
        return core.option_warnings(options)
    except core.MeanderError:  # no library: the button says so
        return []
