# SPDX-License-Identifier: GPL-3.0-or-later
"""How the batch command reads values of its options; one sentence for those it cannot use."""

from __future__ import annotations

import argparse
import math
from collections.abc import Callable
from typing import NoReturn


class BadInput(Exception):
    """What the caller gave cannot be used; ``str(error)`` is one sentence for people."""


class Parser(argparse.ArgumentParser):
    """A parser that raises BadInput instead of leaving the program."""

    def error(self, message: str) -> NoReturn:
        # argparse would print the usage as well, and several lines are not one sentence.
        raise BadInput(f"{message}; see --help")


def number(text: str) -> float:
    """A finite number."""
    try:
        value = float(text)
    except ValueError:
        value = math.nan
    if not math.isfinite(value):
        raise argparse.ArgumentTypeError(f"{text!r} is not a finite number")
    return value


def positive(text: str) -> float:
    """A finite number greater than 0."""
    value = number(text)
    if value <= 0:
        raise argparse.ArgumentTypeError(f"{text!r} is not greater than 0")
    return value


def not_negative(text: str) -> float:
    """A finite number, 0 or greater."""
    value = number(text)
    if value < 0:
        raise argparse.ArgumentTypeError(f"{text!r} is less than 0")
    return value


def count(least: int, greatest: int) -> Callable[[str], int]:
    """What reads a whole number from `least` to `greatest`."""

    def parse(text: str) -> int:
        try:
            value = int(text)
        except ValueError:
            value = -1
        if not least <= value <= greatest:
            raise argparse.ArgumentTypeError(
                f"{text!r} is not a whole number from {least} to {greatest}"
            )
        return value

    return parse
