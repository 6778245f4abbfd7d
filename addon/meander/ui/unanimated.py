# SPDX-License-Identifier: GPL-3.0-or-later
"""The properties of settings: Blender's, but not to be animated, since a run reads them once."""

from __future__ import annotations

from functools import partial

from bpy import props

BoolProperty = partial(props.BoolProperty, options=set())
CollectionProperty = partial(props.CollectionProperty, options=set())
EnumProperty = partial(props.EnumProperty, options=set())
FloatProperty = partial(props.FloatProperty, options=set())
FloatVectorProperty = partial(props.FloatVectorProperty, options=set())
IntProperty = partial(props.IntProperty, options=set())
PointerProperty = partial(props.PointerProperty, options=set())
StringProperty = partial(props.StringProperty, options=set())
