# SPDX-License-Identifier: GPL-3.0-or-later
"""What a run is made of, in plain Python and numpy: no bpy, no ctypes."""
