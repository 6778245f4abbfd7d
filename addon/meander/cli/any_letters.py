# SPDX-License-Identifier: GPL-3.0-or-later
"""Output that no letter stops: consoles and pipes of some systems know few of them; no bpy."""

from __future__ import annotations

import sys


def print_any_letters() -> None:
    """Has letters that the output does not know printed as numbers, instead of an exception.

    Names of files and objects hold any letters, on Linux also bytes that are none.
    """
    for stream in (sys.stdout, sys.stderr):
        if hasattr(stream, "reconfigure"):  # not what hosts put in their place
            stream.reconfigure(errors="backslashreplace")
