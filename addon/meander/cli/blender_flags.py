# SPDX-License-Identifier: GPL-3.0-or-later
"""The flags of the command that mean nothing without Blender; no bpy."""

from __future__ import annotations

import argparse

from .place import Place

_OBJECT, _CURVE = "it names an object of a .blend", "it names a curve object of a .blend"
_DATA = "it names something of a .blend"
# By the name of the parsed argument: why.
_REASONS = {
    "object": _OBJECT,
    "frame": "it is a frame of a .blend",
    "run_scripts": "it is for scripts of a .blend",
    "seed_object": _CURVE,
    "guides_object": _CURVE,
    "direction_object": _CURVE,
    "direction_angle": _DATA,
    "density_group": _DATA,
    "tone_group": _DATA,
    "mask_group": _DATA,
    "mask_material": _DATA,
    "mask_attribute": _DATA,
    "layout_map": _DATA,
    "bake_frames": "they are frames of a .blend",
    "points": "it makes an object of a .blend, and .csv, .json and .npz have the same in columns",
    "visible_only": "it is Blender that finds what is hidden",
}


def epilog() -> str:
    """What --help says of them where there is no Blender."""
    names = ", ".join(_flag(name) for name in _REASONS)
    return f"These options, and .blend files, need Blender: {names}."


def refuse(arguments: argparse.Namespace, place: Place) -> None:
    """Raises BadInput for the first of them that is given where there is no Blender."""
    for name, reason in _REASONS.items():
        if getattr(arguments, name) not in (None, False):
            place.blender(_flag(name), reason)


def _flag(name: str) -> str:
    return f"--{name.replace('_', '-')}"
