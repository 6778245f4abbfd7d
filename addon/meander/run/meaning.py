# SPDX-License-Identifier: GPL-3.0-or-later
"""What a run on an object would mean, cheap enough to be asked at every redraw of a panel."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import bpy
import numpy as np

from ..model.options.table import in_panel
from ..scene import density
from ..scene.changes import shape_count
from ..scene.identity import number_of
from ..scene.linked_settings import settings_of
from ..scene.settings import copied, surface_of
from ..scene.transforms import world_matrix

# What does not change which curve grows: its looks, what happens to it later, how fast it is.
_LOOKS = frozenset(
    {
        "use_bevel",
        "bevel_share",
        "round_share",
        "profile",
        "radius_follows",
        "points_as",
        "bridge_parts",
        "motion",
        "motion_steps",
        "motion_subframes",
        "threads",
        "live",
        *(option.setting for option in in_panel("Make")),
    }
)
# Of the world metric of a surface: its matrix is stored in single precision.
_METRIC_TOLERANCE = 1e-5


@dataclass(frozen=True)
class Meaning:
    """The settings of an object and the shapes that they refer to, to be compared with later ones.

    settings   name and value of all that changes which curve grows
    shape      of the surface: a number of its own, and how often it has changed
    metric     (3, 3): how the surface's own space measures lengths of the world, which moving and
               turning it does not change
    """

    settings: tuple[tuple[str, Any], ...]
    shape: tuple[int, int]
    metric: np.ndarray

    def same_as(self, other: Meaning | None, without: str = "") -> bool:
        """Whether both would grow the same curve, one setting left out of account."""
        if other is None or self.shape != other.shape:
            return False
        allowed = _METRIC_TOLERANCE * float(np.trace(self.metric))
        if np.abs(self.metric - other.metric).max() > allowed:
            return False
        return all(
            mine == theirs or mine[0] == without
            for mine, theirs in zip(self.settings, other.settings)
        )


def meaning_of(active: bpy.types.Object | None) -> Meaning | None:
    """What a run on an object would mean now; None for what is no surface and no result."""
    surface = surface_of(active)
    if surface is None:
        return None
    settings = settings_of(active)
    linear = world_matrix(surface)[:3, :3]
    return Meaning(
        tuple((name, _value(settings, name)) for name in copied(settings) if name not in _LOOKS),
        (number_of(surface), shape_count(surface)),
        linear.T @ linear,
    )


def _value(settings: bpy.types.PropertyGroup, name: str) -> Any:
    """A setting as something that can be kept and compared."""
    value = getattr(settings, name)
    if isinstance(value, bpy.types.NodeTree):
        return density.stops_of(value) if settings.density_interpolation == "FREE" else ()
    if isinstance(value, bpy.types.Object):
        return number_of(value), shape_count(value)
    if isinstance(value, bpy.types.Collection):
        return tuple((number_of(thing), shape_count(thing)) for thing in value.all_objects)
    if isinstance(value, bpy.types.ID):
        return number_of(value)
    return value if isinstance(value, (str, int, float, type(None))) else tuple(value)
