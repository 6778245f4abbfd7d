# SPDX-License-Identifier: GPL-3.0-or-later
"""Options that have the names that they have, and no others: what is misspelt would do nothing."""

from __future__ import annotations

import difflib
import functools
from collections.abc import Iterable
from dataclasses import fields
from typing import Any, TypeVar

import numpy as np

from .errors import MeanderError

_Class = TypeVar("_Class", bound=type)

_MOST_LETTERS = 60


def unknown_name(what: str, name: str, known: Iterable[str]) -> str:
    """The sentence about a name that is none, with the nearest one, or else with all."""
    names = list(known)
    near = difflib.get_close_matches(name.lower(), names, n=1)
    way = f"did you mean {near[0]}?" if near else f"choose from {', '.join(names)}"
    return f"there is no {what} called {name}; {way}"


def only_its_names(kind: _Class) -> _Class:
    """A dataclass that refuses any other attribute, when it is made and later, with a MeanderError
    that names the nearest one."""
    made = kind.__init__

    def check(options: Any, name: str) -> None:
        names = [field.name for field in fields(options)]
        if name not in names:
            raise MeanderError(unknown_name(f"option of {type(options).__name__}", name, names))

    @functools.wraps(made)
    def __init__(self: Any, *values: Any, **named: Any) -> None:
        for name in named:
            check(self, name)
        made(self, *values, **named)

    def __setattr__(self: Any, name: str, value: Any) -> None:
        check(self, name)
        object.__setattr__(self, name, value)

    kind.__init__ = __init__
    kind.__setattr__ = __setattr__
    return kind


def refuse_other(
    what: str, value: Any, kind: type, way: str = "make one, and set its attributes"
) -> None:
    """Raises MeanderError for what is none of a class, as a dict of options is.

    way   what to do
    """
    if not isinstance(value, kind):
        raise MeanderError(
            f"{what} must be a {kind.__name__}, not a {type(value).__name__}; {way}"
        )


def number_of(what: str, value: Any) -> float:
    """A number as the library takes it. Raises MeanderError for what is none."""
    try:
        return float(value)
    except (TypeError, ValueError, OverflowError):
        raise MeanderError(f"the {what} must be a number, not {_shown(value)}") from None


def whole_of(what: str, value: Any) -> int:
    """A whole number of 32 bits: ctypes would turn -1 into 4294967295 without a word."""
    try:
        number = int(value)
        if number == value and 0 <= number <= 0xFFFFFFFF:
            return number
    except (TypeError, ValueError, OverflowError):
        pass
    raise MeanderError(f"the {what} must be a whole number, 0 or more, not {_shown(value)}")


def switch_of(what: str, value: Any) -> bool:
    """What is on or off: a word such as "no" would be on."""
    if isinstance(value, bool | int | np.bool_) and value in (False, True):
        return bool(value)
    raise MeanderError(f"the {what} must be True or False, not {_shown(value)}")


def _shown(value: Any) -> str:
    """A value within a sentence, which an array of many lines would be too long for."""
    text = " ".join(repr(value).split())
    return text if len(text) <= _MOST_LETTERS else f"a {type(value).__name__}"
