# SPDX-License-Identifier: GPL-3.0-or-later
"""The presets of the panel as --quality knows them, besides the library's own; no bpy.

Each is what the file of that name in presets/meander sets, where that is not the default; a test
compares them.
"""

from __future__ import annotations

from typing import Any

PRESETS: dict[str, dict[str, Any]] = {
    "flowing": {"preset": "even", "start": "full"},
    "rows": {
        "preset": "even",
        "start": "full",
        "alignment_source": "axis",
        "alignment_weight": 2.0,
        "align_across": True,
    },
    "few-corners": {"preset": "finest", "start": "grow", "start_spacing_factor": 4.0},
    "organic": {
        "preset": "paper",
        "start": "grow",
        "medial_axis": "geodesic",
        "length_weight": 1.0,
        "bending_weight": 0.05,
        "length_power": 2.0,
        "medial_power": 4.0,
    },
}
