# SPDX-License-Identifier: GPL-3.0-or-later
"""Options of a page that a drawing lies on; pictures and drawings of a view have them in common."""

from __future__ import annotations

from dataclasses import replace

from .export import ROWS as _EXPORT
from .option import Flag, Option

MARGIN = Option(
    "margin",
    "Margin",
    "White on all sides of the page, in millimetres",
    "Page",
    least=0.0,
    flag=Flag("--margin", "", "page", "MM", least=0.0),
)


def margin(default: float, group: str) -> Option:
    """The row of a command that leaves so many millimetres by default."""
    return _with_default(
        MARGIN, default, group, f"of white on all sides, in millimetres; default: {default:g}"
    )


def line_width(default: float, group: str) -> Option:
    """The row of a command whose pen is so wide by default, in millimetres."""
    row = next(row for row in _EXPORT if row.setting == "line_width")
    return _with_default(row, default, group, f"of the pen, in millimetres; default: {default:g}")


def _with_default(row: Option, default: float, group: str, text: str) -> Option:
    flag = replace(row.flag, help=text, group=group, metavar="MM", default=default)
    return replace(row, default=default, flag=flag)
