# SPDX-License-Identifier: GPL-3.0-or-later
"""The batch command by itself: options and files in, files out, no bpy. `headless` has the part
that needs Blender.
"""
