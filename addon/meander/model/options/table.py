# SPDX-License-Identifier: GPL-3.0-or-later
"""The table of the options: every row is a setting, a flag, an entry and a line in the documents.

A new option of the flow is a field in the library, a line for editors in binding.flow_options and a
row in flow.py here. docs/options.md is made from the table by scripts/write_option_table.py.
"""

from __future__ import annotations

from .flow import ROWS as FLOW_ROWS
from .input import ROWS as INPUT_ROWS
from .motion import MOTION_ROWS
from .option import Option
from .tone import ROWS as TONE_ROWS

TABLE: tuple[Option, ...] = FLOW_ROWS + INPUT_ROWS + MOTION_ROWS + TONE_ROWS

BY_SETTING: dict[str, Option] = {option.setting: option for option in TABLE}

# What the flow itself is given, in the order in which it is put there.
OF_THE_FLOW: tuple[Option, ...] = tuple(option for option in TABLE if option.field)


def in_panel(panel: str) -> tuple[Option, ...]:
    """The rows of a panel, by its label, from top to bottom."""
    return tuple(option for option in TABLE if option.panel == panel)
