# SPDX-License-Identifier: GPL-3.0-or-later
"""Writes all mutants of a C++ source into it at once: its operators ask mutants.h which one mutant
is alive, and an environment variable says so.

libclang says where expressions begin and end. What it finds in types, constants of the compiler and
macros is left alone; what does not compile afterwards is dropped by mutate.py, and counted.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path

from clang.cindex import Cursor, CursorKind, Index

# The function objects of an operator and of its mutant.
ARITHMETIC = {
    "+": ("std::plus<>", "std::minus<>", "-"),
    "-": ("std::minus<>", "std::plus<>", "+"),
    "*": ("std::multiplies<>", "mutants::NoProduct", "/"),
    "/": ("std::divides<>", "std::multiplies<>", "*"),
    "%": ("std::modulus<>", "mutants::Left", "left"),
}
ORDER = {
    "<": ("std::less<>", "std::less_equal<>", "<=", ">="),
    "<=": ("std::less_equal<>", "std::less<>", "<", ">"),
    ">": ("std::greater<>", "std::greater_equal<>", ">=", "<="),
    ">=": ("std::greater_equal<>", "std::greater<>", ">", "<"),
}
EQUALITY = {"==": "!=", "!=": "=="}
# An operand that a mutant leaves out is true beside && and false beside ||. The other operator is
# no mutant: it differs where just one operand is true, and so dies with one of these.
LOGICAL = {"&&": "({} || mutants::is({}))", "||": "({} && !mutants::is({}))"}
LITERALS = {"0": "1", "1": "0", "2": "1"}
CALLS = {"min": ("least", "max"), "max": ("most", "min"), "abs": ("magnitude", "itself")}

FUNCTIONS = {
    CursorKind.FUNCTION_DECL,
    CursorKind.CXX_METHOD,
    CursorKind.CONSTRUCTOR,
    CursorKind.CONVERSION_FUNCTION,
    CursorKind.FUNCTION_TEMPLATE,
}
TYPES = {CursorKind.CLASS_DECL, CursorKind.STRUCT_DECL, CursorKind.CLASS_TEMPLATE}
BRANCHES = {CursorKind.IF_STMT, CursorKind.WHILE_STMT, CursorKind.CONDITIONAL_OPERATOR}
LOOPS = {CursorKind.FOR_STMT, CursorKind.CXX_FOR_RANGE_STMT, CursorKind.WHILE_STMT}
BLOCKS = {CursorKind.COMPOUND_STMT, CursorKind.CASE_STMT, CursorKind.DEFAULT_STMT}
OPERATORS = {
    CursorKind.BINARY_OPERATOR,
    CursorKind.COMPOUND_ASSIGNMENT_OPERATOR,
    CursorKind.CALL_EXPR,
}
# Statements that can be left out. What jumps is left out by a condition that never holds.
REMOVABLE = {*OPERATORS, CursorKind.UNARY_OPERATOR, CursorKind.UNEXPOSED_EXPR}


@dataclass
class Mutant:
    """One change: `number` chooses it, `line` and `column` are those of the source as it was."""

    number: int
    file: str
    line: int
    column: int
    function: str
    was: str
    becomes: str
    text: str  # the line, for reading

    @property
    def place(self) -> tuple[int, int, str]:
        return self.line, self.column, self.was


def extent(cursor: Cursor) -> tuple[int, int]:
    return cursor.extent.start.offset, cursor.extent.end.offset


def operands_of(cursor: Cursor) -> list[Cursor]:
    """The two of a binary operator, or none."""
    if cursor.kind not in OPERATORS:
        return []
    called = cursor.kind == CursorKind.CALL_EXPR
    found = list(cursor.get_arguments() if called else cursor.get_children())
    if len(found) != 2 or any(operand is None for operand in found):
        return []
    return found if (extent(found[0])[0], extent(found[1])[1]) == extent(cursor) else []


class Schemata:
    """The mutants of one file, `mutants`, and the file with all of them, `mutated`."""

    def __init__(
        self,
        path: Path,
        arguments: Sequence[str],
        functions: Sequence[str] = (),
        first: int = 1,
        dropped: Iterable[tuple[int, int, str]] = (),
    ) -> None:
        """`arguments` are the compiler's, `functions` the functions and classes to look into, or
        none for all, `dropped` the places of mutants to leave out."""
        self.path = path
        self.mutants: list[Mutant] = []
        self._source = path.read_bytes()
        self._lines = self._source.decode().splitlines()
        self._first, self._dropped, self._missing = first, set(dropped), set(functions)
        self._functions = set(functions)
        unit = Index.create().parse(str(path), args=list(arguments))
        errors = [d for d in unit.diagnostics if d.severity >= 3]
        if errors:
            raise ValueError(f"{path} does not parse: {errors[0]}")
        out, at = "", 0
        for body in self._bodies(unit.cursor):
            start, end = extent(body)
            out += self._between(at, start) + self._visit(body)
            at = end
        out += self._between(at, len(self._source))
        if self._missing:
            raise ValueError(f"{path} has no function {', '.join(sorted(self._missing))}")
        # Line for line where it was, also for the compiler.
        self.mutated = '#include "mutants.h"\n#line 1\n' + out

    def _bodies(self, scope: Cursor) -> Iterator[Cursor]:
        """The bodies of functions, and what a constructor initializes its members with."""
        for child in scope.get_children():
            if child.location.file is None or Path(child.location.file.name) != self.path:
                continue
            if child.kind in FUNCTIONS and child.is_definition():
                start, end = extent(child)
                if "constexpr" in self._between(start, end).split("{")[0]:
                    continue
                self._function = child.spelling.split("<")[0]
                parent = child.semantic_parent
                names = {self._function}
                if parent is not None and parent.kind in TYPES:
                    self._function = f"{parent.spelling}::{self._function}"
                    names = {parent.spelling, self._function}
                if self._functions and not names & self._functions:
                    continue
                self._missing -= names
                for part in child.get_children():
                    if part.kind.is_expression() or part.kind == CursorKind.COMPOUND_STMT:
                        yield part
            elif child.kind in {*TYPES, CursorKind.NAMESPACE, CursorKind.UNEXPOSED_DECL}:
                yield from self._bodies(child)

    # Each of these answers with the text of an expression or statement and its mutants.

    def _visit(self, cursor: Cursor) -> str:
        start, end = extent(cursor)
        kind, text, children = cursor.kind, self._between(start, end), list(cursor.get_children())
        constant = kind == CursorKind.DECL_STMT and "constexpr" in text.split("=")[0]
        if constant or kind in {CursorKind.STATIC_ASSERT, CursorKind.TYPE_REF, *TYPES}:
            return text
        if kind in {CursorKind.INTEGER_LITERAL, CursorKind.FLOATING_LITERAL}:
            return self._literal(text, start)
        if kind == CursorKind.CASE_STMT or kind in {CursorKind.VAR_DECL, CursorKind.FIELD_DECL}:
            ends = (b":", b"]", b">")  # a label, a length, an argument of a template
            children = [c for c in children if not self._source[extent(c)[1] :].startswith(ends)]
        if kind in OPERATORS and "basic_string" not in cursor.type.get_canonical().spelling:
            operands = operands_of(cursor)
            mutated = self._binary(*operands) if operands else self._call(children, start, end)
            if mutated is not None:
                return mutated
        if kind == CursorKind.UNARY_OPERATOR:
            operand = self._inside(children, extent(children[0])[0], end)
            if text.startswith("-") and (number := self._new(start, "-", "+")):
                return f"mutants::minus({number}, ({operand}))"
            if text.startswith("!") and (number := self._new(start, "!", "")):
                return f"(!static_cast<bool>({operand}) != mutants::is({number}))"
            return self._between(start, extent(children[0])[0]) + operand
        return self._inside(children, start, end, cursor)

    def _inside(
        self, cursors: Iterable[Cursor], start: int, end: int, parent: Cursor | None = None
    ) -> str:
        """The source from start to end, with the mutants of the cursors that are in it."""
        out, at, todo = "", start, sorted(cursors, key=extent)
        family = list(todo)
        while todo:
            child = todo.pop(0)
            first, last = extent(child)
            if first < at:  # the second variable of a declaration begins with the type of the first
                todo = sorted([*child.get_children(), *todo], key=extent)
            elif last <= end:
                out += self._between(at, first) + self._part(child, parent, family)
                at = last
        return out + self._between(at, end)

    def _part(self, child: Cursor, parent: Cursor | None, family: list[Cursor]) -> str:
        """A child of a statement: a condition, or what may be a statement itself."""
        kind = parent.kind if parent is not None else None
        start, end = extent(child)
        if kind in BRANCHES and child == family[0]:
            return self._condition(child, kind)
        statement = kind in BLOCKS or (kind == CursorKind.IF_STMT and child != family[0])
        statement |= kind in LOOPS and child == family[-1]
        if statement and child.kind in REMOVABLE and self._source[end:].lstrip().startswith(b";"):
            text = self._between(start, end)
            if not text.startswith("throw") and (number := self._new(start, text[:40], "removed")):
                return f"(mutants::is({number}) ? void() : void({self._visit(child)}))"
        return self._visit(child)

    def _condition(self, cursor: Cursor, kind: CursorKind) -> str:
        """What never holds, and what always does unless an operator sees to that."""
        start = extent(cursor)[0]
        before = self._source[max(0, start - 20) : start]
        text = self._visit(cursor)
        if not cursor.kind.is_expression() or re.search(rb"constexpr\s*\($", before):
            return text
        decided = re.match(r"\(*(mutants::compared|!?static_cast<bool>)", text)
        becomes = ["never"] if decided or kind == CursorKind.WHILE_STMT else ["never", "always"]
        number = self._new(start, "condition", *becomes)
        if number is None:
            return text
        text = f"(static_cast<bool>({text}) && !mutants::is({number}))"
        return f"({text} || mutants::is({number + 1}))" if len(becomes) == 2 else text

    def _binary(self, left: Cursor, right: Cursor) -> str | None:
        at = extent(left)[1]
        between = self._between(at, extent(right)[0])
        operator = between.strip()
        plain = operator.removesuffix("=")
        if operator in LOGICAL and (number := self._new(at, operator, "right", "left")):
            sides = (f"static_cast<bool>({self._visit(side)})" for side in (left, right))
            mutated = [LOGICAL[operator].format(s, number + k) for k, s in enumerate(sides)]
            return f"({mutated[0]}{between}{mutated[1]})"
        if operator in EQUALITY and (number := self._new(at, operator, EQUALITY[operator])):
            equal = f"({self._visit(left)}){between}({self._visit(right)})"
            return f"(static_cast<bool>({equal}) != mutants::is({number}))"
        if operator in ORDER:
            name, (written, other, *becomes) = "compared", ORDER[operator]
        elif plain in ARITHMETIC and operator != "%=":
            name = "either" if plain == operator else "assigned"
            written, other, mutant = ARITHMETIC[plain]
            becomes = [mutant + operator.removeprefix(plain)]
        else:
            return None
        number = self._new(at, operator, *becomes)
        if number is None:
            return None
        comma = between.replace(operator, ",")
        operands = f"({self._visit(left)}){comma}({self._visit(right)})"
        return f"mutants::{name}<{written}, {other}>({number}, {operands})"

    def _call(self, children: list[Cursor], start: int, end: int) -> str | None:
        called = re.match(rb"std::(min|max|abs)\s*(<[^()]*>)?\(", self._source[start:end])
        if called is None:
            return None
        was = called[1].decode()
        name, becomes = CALLS[was]
        number = self._new(start, was, becomes)
        if number is None:
            return None
        arguments = self._inside(children, start + called.end(), end)
        return f"mutants::{name}{(called[2] or b'').decode()}({number}, {arguments}"

    def _literal(self, text: str, start: int) -> str:
        whole = re.fullmatch(r"([012])([uUlLzZ]*)", text)
        if whole is not None:
            other = LITERALS[whole[1]] + whole[2]
        elif re.fullmatch(r"\d*\.\d*(e[-+]?\d+)?", text):
            other = "1.0" if float(text) == 0 else f"2 * {text}"
        else:
            return text
        number = self._new(start, text, other)
        return text if number is None else f"(mutants::is({number}) ? {other} : {text})"

    def _new(self, offset: int, was: str, *becomes: str) -> int | None:
        """The number of the first of these mutants, or None where there are to be none."""
        line = self._source.count(b"\n", 0, offset) + 1
        column = offset - self._source.rfind(b"\n", 0, offset)
        if (line, column, was) in self._dropped:
            return None
        number = self._first + len(self.mutants)
        place = (str(self.path), line, column, self._function, was)
        text = self._lines[line - 1].strip()
        self.mutants += [Mutant(number + k, *place, b, text) for k, b in enumerate(becomes)]
        return number

    def _between(self, start: int, end: int) -> str:
        return self._source[start:end].decode()
