# SPDX-License-Identifier: GPL-3.0-or-later
"""How a command ends: what it prints, whatever its letters are, and its exit code; no bpy."""

from __future__ import annotations

import sys
import traceback
from collections.abc import Callable

from .. import core
from ..model.files.whole import FileError
from .values import BadInput


def exit_code_of(work: Callable[[], None], *refusals: type[Exception]) -> int:
    """Does the work of a command and returns its exit code.

    refusals   what the work raises for bad input besides what every command does

    0 done; 2 bad input, with one sentence on stderr and every output file as it was; 1 a defect,
    with a traceback; 130 interrupted from the keyboard, with every output file as it was.
    """
    print_any_letters()
    try:
        work()
    except (BadInput, core.MeanderError, FileError, *refusals) as problem:
        if getattr(problem, "status", None) == core.Status.INTERNAL:
            traceback.print_exc()
            return 1
        print(f"meander: {' '.join(str(problem).split())}", file=sys.stderr, flush=True)
        return 2
    except KeyboardInterrupt:
        print("meander: interrupted", file=sys.stderr, flush=True)
        return 130
    except Exception:
        traceback.print_exc()
        return 1
    return 0


def print_any_letters() -> None:
    """Has letters that the output does not know printed as numbers, instead of an exception.

    Names of files and objects hold any letters, on Linux also bytes that are none.
    """
    for stream in (sys.stdout, sys.stderr):
        if hasattr(stream, "reconfigure"):  # not what hosts put in their place
            stream.reconfigure(errors="backslashreplace")
