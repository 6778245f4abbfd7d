# SPDX-License-Identifier: GPL-3.0-or-later
"""The table of sentences that the product can say, from the code, for the tests that see each come
up: of the batch command and its readers of files, of jobs and of scenes.

In Python a sentence is a literal, or a formatted one, that is raised in one of our errors, or
returned by a function whose name says that it finds what is wrong. Values in it match anything.
"""

from __future__ import annotations

import ast
import re
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path

PACKAGE = Path(__file__).resolve().parents[2] / "addon" / "meander"
NATIVE = PACKAGE.parents[1] / "native" / "src"
ERRORS = {
    "BadInput", "FileError", "MeanderError", "Malformed", "Short", "ArgumentTypeError",
    "JobError", "DataError",
}  # fmt: skip
FINDERS = re.compile(
    r"problem_of|stroke_of|_read_stops|_no_faces|refusal|crossing_warning|_end_problem|verdict"
    r"|missing_program|_too_far"
)
OF_THE_COMMAND = (
    *sorted((PACKAGE / "cli").glob("*.py")),
    *(PACKAGE / "model" / f"{name}.py" for name in (
        "files/meshes", "files/obj", "files/ply", "files/polygons", "files/stl", "files/text",
        "files/vertex_values", "geometry/surface_crossings", "toolpaths/drawing",
        "toolpaths/embroidery", "toolpaths/gcode", "toolpaths/parts", "toolpaths/toolpath",
        "export", "least_bend", "mirror", "mirror_images", "mirror_whole",
    )),
)  # fmt: skip
OF_JOBS = tuple(sorted((PACKAGE / "jobs").glob("*.py")))
OF_SCENES = tuple(
    path for room in ("scene", "run", "headless") for path in sorted((PACKAGE / room).glob("*.py"))
)


@dataclass(frozen=True)
class Sentence:
    """Where it stands, and what it looks like."""

    place: str
    text: str

    @property
    def pattern(self) -> re.Pattern[str]:
        parts = (re.escape(part) for part in self.text.split("\0"))
        return re.compile(".*".join(parts), re.DOTALL)


def _texts(node: ast.expr) -> Iterator[str]:
    """The literal sentences that an expression may be."""
    if isinstance(node, ast.Constant) and isinstance(node.value, str):
        yield node.value
    elif isinstance(node, ast.JoinedStr):
        parts = (
            part.value if isinstance(part, ast.Constant) else "\0" for part in node.values
        )
        yield re.sub("\0+", "\0", "".join(parts))
    elif isinstance(node, ast.IfExp):
        yield from _texts(node.body)
        yield from _texts(node.orelse)
    elif isinstance(node, ast.BinOp) and isinstance(node.op, ast.Add):
        for one in _texts(node.left):
            for other in list(_texts(node.right)) or ["\0"]:
                yield one + other


def _is_sentence(text: str) -> bool:
    return len(text.replace("\0", " ").split()) >= 4


def missing(
    modules: Iterable[Path], said: Iterable[str], elsewhere: Mapping[str, str]
) -> list[str]:
    """The sentences that nothing in `said` is, but for those that a key of `elsewhere` is part of,
    and keys that are part of none."""
    table, lines = sentences(modules), list(said)
    unsaid = [
        f"{sentence.place}: {sentence.text!r}"
        for sentence in table
        if not any(sentence.pattern.search(line) for line in lines)
        and not any(part in sentence.text for part in elsewhere)
    ]
    idle = [part for part in elsewhere if not any(part in sentence.text for sentence in table)]
    return unsaid + idle


def sentences(modules: Iterable[Path]) -> list[Sentence]:
    found = []
    for path in modules:
        tree = ast.parse(path.read_text(encoding="utf-8"))
        for node in ast.walk(tree):
            values: list[ast.expr] = []
            if isinstance(node, ast.Raise) and isinstance(node.exc, ast.Call):
                name = getattr(node.exc.func, "id", getattr(node.exc.func, "attr", ""))
                values = node.exc.args[:1] if name in ERRORS else []
            elif isinstance(node, ast.FunctionDef) and FINDERS.search(node.name):
                values = [
                    inner.value
                    for inner in ast.walk(node)
                    if isinstance(inner, ast.Return) and inner.value is not None
                ]
            for value in values:
                for text in _texts(value):
                    if _is_sentence(text):
                        found.append(Sentence(f"{path.name}:{value.lineno}", text))
    return list(dict.fromkeys(found))


# What raises a sentence in the library, whose literals in one call are its parts.
_RAISES = re.compile(r"\b(?:refuse(?:_empty)?|require|Failure)\s*\(")
_LITERAL = re.compile(r'"((?:[^"\\\n]|\\.)*)"')


def native_sentences() -> list[Sentence]:
    """Those of the library: the literals of every call that refuses or fails, values between."""
    found = []
    for path in sorted([*NATIVE.rglob("*.cpp"), *NATIVE.rglob("*.h")]):
        text = path.read_text(encoding="utf-8")
        for match in _RAISES.finditer(text):
            call = text[match.end() : _end_of_call(text, match.end())]
            place = f"{path.relative_to(NATIVE)}:{text.count(chr(10), 0, match.start()) + 1}"
            for parts in _alternatives(call):
                if _is_sentence("\0".join(parts)):
                    found.append(Sentence(place, "\0".join(parts)))
    return list(dict.fromkeys(found))


def _alternatives(call: str) -> list[list[str]]:
    """The literals of a call, those that ? and : tell apart in lists of their own."""
    groups: list[list[str]] = [[]]
    before = 0
    for literal in _LITERAL.finditer(call):
        if re.search(r"\?|(?<!:):(?!:)", call[before : literal.start()]):
            groups.append([])
        groups[-1].append(literal.group(1))
        before = literal.end()
    return groups


def _end_of_call(text: str, begin: int) -> int:
    """Behind the parenthesis that closes the one before `begin`."""
    depth, at = 1, begin
    while depth and at < len(text):
        quoted = _LITERAL.match(text, at)
        if quoted:
            at = quoted.end()
            continue
        depth += (text[at] == "(") - (text[at] == ")")
        at += 1
    return at
