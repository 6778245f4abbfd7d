# SPDX-License-Identifier: GPL-3.0-or-later
"""How the batch command reads values of its options; one sentence for those it cannot use."""

from __future__ import annotations

import argparse
import math
import re
from collections.abc import Callable
from pathlib import Path
from typing import Any, NoReturn

from ..model.camera import PAPERS
from ..model.preparation import Share


class BadInput(Exception):
    """What the caller gave cannot be used; ``str(error)`` is one sentence for people."""


# What begins with a dash and is meant as a number. argparse knows -1 and -.5 but takes -1e-7 for an
# option that there is not.
_NEGATIVE = re.compile(r"-(\.?\d|(inf|infinity|nan)$)", re.IGNORECASE)

# The sides of a sheet of paper.
_SIDES = re.compile(r"(\d+(?:\.\d+)?)x(\d+(?:\.\d+)?)")


class Parser(argparse.ArgumentParser):
    """A parser that raises BadInput instead of leaving the program."""

    def __init__(self, **how: Any) -> None:
        super().__init__(**how)
        self._negative_number_matcher = _NEGATIVE

    def error(self, message: str) -> NoReturn:
        # argparse would print the usage as well, and several lines are not one sentence.
        raise BadInput(f"{message}; see --help")


def file_name(text: str) -> Path:
    """The path of a file."""
    if not text.strip():
        raise argparse.ArgumentTypeError("it is empty; give the name of a file")
    # Without its end, which pathlib forgets, it would be the name of a file.
    if text.endswith("/") and not Path(text).is_dir():
        raise argparse.ArgumentTypeError(f"{text!r} names a folder; give the name of a file")
    return Path(text)


def number(text: str) -> float:
    """A finite number."""
    try:
        value = float(text)
    except ValueError:
        value = math.nan
    if not math.isfinite(value):
        raise argparse.ArgumentTypeError(f"{text!r} is not a finite number")
    return value


def reader(
    kind: type,
    least: float | None = None,
    greatest: float | None = None,
    above: float | None = None,
) -> Callable[[str], float]:
    """What reads a number of a kind, int or float, that lies within limits."""

    def read(text: str) -> float:
        value = number(text) if kind is float else _whole(text)
        if least is not None and greatest is not None and not least <= value <= greatest:
            raise argparse.ArgumentTypeError(
                f"{text!r} is out of range; choose from {least:.12g} to {greatest:.12g}"
            )
        if least is not None and value < least:
            raise argparse.ArgumentTypeError(f"{text!r} is less than {least:g}")
        if above is not None and value <= above:
            raise argparse.ArgumentTypeError(f"{text!r} is not greater than {above:g}")
        if greatest is not None and value > greatest:
            raise argparse.ArgumentTypeError(f"{text!r} is greater than {greatest:.12g}")
        return value

    return read


def paper(text: str) -> tuple[float, float]:
    """Width and height of a sheet of paper in millimetres, by its name or its sides."""
    named, sides = PAPERS.get(text.lower()), _SIDES.fullmatch(text.lower())
    if named is not None:
        return named
    if sides is None or not all(1.0 <= float(side) <= 1e5 for side in sides.groups()):
        raise argparse.ArgumentTypeError(
            f"{text!r} is no paper; choose from {', '.join(PAPERS)}, or give its sides in "
            "millimetres, such as 200x300"
        )
    return float(sides[1]), float(sides[2])


def share_or(read: Callable[[str], float]) -> Callable[[str], float]:
    """What reads per cent as a Share, and everything else as `read` does."""
    return lambda text: Share(read(text[:-1]) / 100.0) if text.endswith("%") else read(text)


def one_of_several(choices: tuple[str, ...]) -> Callable[[str], tuple[str, ...]]:
    """What reads words of a choice, with commas between them, into their order in the choice."""

    def read(text: str) -> tuple[str, ...]:
        words = [word.strip() for word in text.split(",")]
        for word in words:
            if word not in choices:
                raise argparse.ArgumentTypeError(
                    f"{word!r} is none of {', '.join(choices)}; name some of them"
                )
        return tuple(choice for choice in choices if choice in words)

    return read


def synonym_reader(synonyms: tuple[tuple[str, str], ...]) -> Callable[[str], str]:
    """What reads a word and puts the choice that it stands for in its place."""
    meaning = dict(synonyms)
    return lambda text: meaning.get(text, text)


def _whole(text: str) -> int:
    try:
        return int(text)
    except ValueError:
        raise argparse.ArgumentTypeError(f"{text!r} is not a whole number") from None


positive = reader(float, above=0.0)
index = reader(int, least=0, greatest=2**31 - 1)
