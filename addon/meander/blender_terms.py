# SPDX-License-Identifier: GPL-3.0-or-later
"""The settings of weights, powers and lengths on an object."""

import bpy
from bpy.props import BoolProperty, FloatProperty

from . import core
from .terms import Terms


class TermSettings:
    """The part of MeanderSettings that says how the curve behaves."""

    use_weights: BoolProperty(
        name="Custom Weights",
        description="Use the weights and powers below instead of the preset's",
        default=False,
        options=set(),
    )
    length_weight: FloatProperty(
        name="Length",
        description=(
            "Weight of the curve's length: more keeps strands taut and farther apart, "
            "with more corners"
        ),
        default=0.0,
        min=0.0,
        max=1e6,
        soft_max=2.0,
        precision=2,
        step=10,
        options=set(),
    )
    bending_weight: FloatProperty(
        name="Bending",
        description=(
            "Weight of bending: more makes turns rounder and fewer, less lets the curve wind. "
            "The final polish follows in proportion"
        ),
        default=1.0,
        min=0.0,
        max=1e6,
        soft_max=5.0,
        precision=2,
        step=10,
        options=set(),
    )
    length_power: FloatProperty(
        name="Length Power",
        description=(
            "Power p of the length term; 2 is plain, larger values make segments more alike"
        ),
        default=2.0,
        min=1.5,
        max=8.0,
        precision=1,
        step=50,
        options=set(),
    )
    medial_power: FloatProperty(
        name="Spacing Power",
        description=(
            "Power q of the spacing term; 2 is plain, larger values weigh the worst gaps more"
        ),
        default=2.0,
        min=2.0,
        max=8.0,
        precision=1,
        step=50,
        options=set(),
    )
    segment_share: FloatProperty(
        name="Segment Length",
        description=(
            "Shortest segment in halves of the spacing. Longer is faster and coarser; 0 leaves it "
            "to the preset, which takes 0.2"
        ),
        default=0.0,
        min=0.0,
        max=1.0,
        soft_max=0.5,
        precision=2,
        step=5,
        options=set(),
    )
    reach: FloatProperty(
        name="Reach",
        description=(
            "How far strands look for others, in halves of the spacing. Less follows the seed's "
            "shape longer, below 2 parts may stay empty; 0 leaves it to the preset"
        ),
        default=0.0,
        min=0.0,
        max=1e6,
        soft_max=10.0,
        precision=1,
        step=50,
        options=set(),
    )
    start_spacing_factor: FloatProperty(
        name="Start Spacing",
        description=(
            "Fill at this many times the spacing first and shrink to it: fewer corners for more "
            "iterations. 1 is off"
        ),
        default=1.0,
        min=1.0,
        max=16.0,
        soft_max=8.0,
        precision=1,
        step=50,
        options=set(),
    )


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
