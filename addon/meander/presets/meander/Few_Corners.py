# SPDX-License-Identifier: GPL-3.0-or-later
import bpy

settings = bpy.context.active_object.meander

settings.preset = "FINEST"
settings.start = "GROW"
settings.medial_axis = "PRESET"
settings.use_weights = False
settings.length_weight = 0.0
settings.bending_weight = 1.0
settings.length_power = 2.0
settings.medial_power = 2.0
settings.segment_share = 0.0
settings.reach = 0.0
settings.start_spacing_factor = 4.0
settings.alignment_source = "NONE"
settings.alignment_axis = "AUTO"
settings.alignment_space = "WORLD"
settings.alignment_curvature = "MIN"
settings.alignment_weight = 1.0
settings.align_across = False
settings.alignment_smoothing = 2.0
settings.border_distance = 0.5
settings.use_outline = False
