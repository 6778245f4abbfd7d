# SPDX-License-Identifier: GPL-3.0-or-later
"""How a command ends: what it prints, whatever its letters are, and its exit code; no bpy."""

from __future__ import annotations

import contextlib
import os
import sys
import traceback
from collections.abc import Callable
from typing import Any

from .. import core
from ..model.files.whole import FileError
from .values import BadInput


class GapsLeft(Exception):
    """A run that was to fail where it leaves a surface unfilled has done so; one sentence."""


def exit_code_of(work: Callable[[], None], *refusals: type[Exception]) -> int:
    """Does the work of a command and returns its exit code.

    refusals   what the work raises for bad input besides what every command does

    0 done; 3 done, and all files written, but the surface is not filled and --fail-on-gaps asks
    for that; 2 bad input, with one sentence on stderr and every output file as it was; 1 a defect,
    with a traceback; 130 interrupted from the keyboard, with every output file as it was.
    """
    print_any_letters()
    try:
        work()
    except (BadInput, core.MeanderError, FileError, *refusals) as problem:
        if getattr(problem, "status", None) == core.Status.INTERNAL:
            traceback.print_exc()
            return 1
        line = f"meander: {' '.join(str(problem).split())}"
        while_heard(print, line, file=sys.stderr, flush=True)
        return 2
    except GapsLeft as gaps:
        while_heard(print, f"meander: {gaps}", file=sys.stderr, flush=True)
        return 3
    except KeyboardInterrupt:
        while_heard(print, "meander: interrupted", file=sys.stderr, flush=True)
        return 130
    except Exception:
        traceback.print_exc()
        return 1
    return 0


def while_heard(say: Callable[..., None], *line: Any, **how: Any) -> None:
    """Prints a line, unless nobody reads it any more, as behind `| head -1` or on a full disk: that
    is no reason to end, and nothing is printed from there on."""
    try:
        say(*line, **how)
    except OSError:
        forget_unheard()


def sent(write: Callable[[], None], way: str) -> None:
    """Writes to the standard output what was asked for, as far as somebody reads it.

    way   what to do where it cannot be written

    Raises BadInput where it cannot.
    """
    if sys.stdout is None:
        raise BadInput(f"there is no standard output; {way}")
    try:
        write()
        sys.stdout.flush()
    except BrokenPipeError:  # whoever reads it has enough
        forget_unheard()
    except OSError as problem:
        forget_unheard()
        raise BadInput(
            f"the standard output cannot be written ({problem.strerror}); {way}"
        ) from problem


def forget_unheard() -> None:
    """Sends the standard streams that take nothing any more to nowhere: what is left in a buffer
    would fail once more when the process ends."""
    nowhere = os.open(os.devnull, os.O_WRONLY)
    for stream in (sys.stdout, sys.stderr):
        with contextlib.suppress(OSError, ValueError, AttributeError):
            try:
                stream.flush()
            except OSError:
                os.dup2(nowhere, stream.fileno())
    os.close(nowhere)


def print_any_letters() -> None:
    """Has letters that the output does not know printed as numbers, instead of an exception.

    Names of files and objects hold any letters, on Linux also bytes that are none. Without a stderr
    nothing is said: print() would take None for the standard output, where a file may go.
    """
    if sys.stderr is None:
        sys.stderr = open(os.devnull, "w", encoding="utf-8")  # noqa: SIM115  (until the end)
    for stream in (sys.stdout, sys.stderr):
        if hasattr(stream, "reconfigure"):  # not what hosts put in their place
            stream.reconfigure(errors="backslashreplace")
