# SPDX-License-Identifier: GPL-3.0-or-later
"""Writes all mutants of a C++ source into it at once: the operators of chosen functions become
calls of mutants.h, where an environment variable chooses the one mutant that is alive.

libclang says where expressions begin and end. What it finds in types, constants of the compiler and
macros is left alone; what does not compile afterwards is dropped by mutate.py, and counted.
"""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import dataclass, field
from pathlib import Path

from clang.cindex import Cursor, CursorKind, Index, TranslationUnit

BINARY = {
    "+": ("add", ["-"]),
    "-": ("sub", ["+"]),
    "*": ("mul", ["/"]),
    "/": ("div", ["*"]),
    "%": ("mod", ["left"]),
    "<": ("less", ["<=", ">="]),
    "<=": ("less_equal", ["<", ">"]),
    ">": ("greater", [">=", "<="]),
    ">=": ("greater_equal", [">", "<"]),
    "==": ("equal", ["!="]),
    "!=": ("unequal", ["=="]),
    "+=": ("add_to", ["-="]),
    "-=": ("take_from", ["+="]),
    "*=": ("scale_by", ["/="]),
    "/=": ("divide_by", ["*="]),
}
LOGICAL = {"&&": ("and", ["||", "right", "left"]), "||": ("or", ["&&", "right", "left"])}
BOOLEAN = {"<", "<=", ">", ">=", "==", "!=", "&&", "||"}
LITERALS = {"0": "1", "1": "0", "2": "1"}

FUNCTIONS = {
    CursorKind.FUNCTION_DECL,
    CursorKind.CXX_METHOD,
    CursorKind.CONSTRUCTOR,
    CursorKind.CONVERSION_FUNCTION,
    CursorKind.FUNCTION_TEMPLATE,
}
OPERATORS = {
    CursorKind.BINARY_OPERATOR,
    CursorKind.COMPOUND_ASSIGNMENT_OPERATOR,
    CursorKind.CALL_EXPR,
}
LOOPS = {CursorKind.FOR_STMT, CursorKind.CXX_FOR_RANGE_STMT, CursorKind.WHILE_STMT}
# Statements that can be left out; a declaration cannot, and a block is looked into.
REMOVABLE = {
    CursorKind.CALL_EXPR,
    CursorKind.BINARY_OPERATOR,
    CursorKind.COMPOUND_ASSIGNMENT_OPERATOR,
    CursorKind.UNARY_OPERATOR,
    CursorKind.UNEXPOSED_EXPR,
    CursorKind.RETURN_STMT,
    CursorKind.CONTINUE_STMT,
    CursorKind.BREAK_STMT,
}


def operands_of(cursor: Cursor) -> list[Cursor]:
    """Of one of OPERATORS."""
    called = cursor.kind == CursorKind.CALL_EXPR
    return list(cursor.get_arguments() if called else cursor.get_children())


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


@dataclass
class Edit:
    offset: int
    rank: tuple[int, int]  # among edits at the same place
    removed: int
    text: str


@dataclass
class Schemata:
    """The mutants of one file, and the file with all of them."""

    path: Path
    name: str
    functions: Sequence[str]  # their names, or ["*"] for all
    first: int  # number of the first mutant
    dropped: frozenset[tuple[int, int, str]] = frozenset()  # places and operators to leave alone
    mutants: list[Mutant] = field(default_factory=list)
    found: set[str] = field(default_factory=set)  # the functions that were in the file

    def __post_init__(self) -> None:
        self.source = self.path.read_bytes()
        self._edits: list[Edit] = []
        self._sequence = 0
        self._next = self.first
        self._function = ""

    def collect(self, arguments: Sequence[str]) -> None:
        """Finds the mutants; `arguments` are the compiler's."""
        unit = Index.create().parse(str(self.path), args=list(arguments))
        errors = [d for d in unit.diagnostics if d.severity >= 3]
        if errors:
            raise ValueError(f"{self.path} does not parse: {errors[0]}")
        self._look_for_functions(unit)

    def mutated(self) -> str:
        """The source with its mutants, line for line where it was."""
        out, at = [], 0
        for edit in sorted(self._edits, key=lambda e: (e.offset, e.rank)):
            out.append(self.source[at : edit.offset])
            out.append(edit.text.encode())
            at = max(at, edit.offset + edit.removed)
        out.append(self.source[at:])
        return '#include "mutants.h"\n#line 1\n' + b"".join(out).decode()

    # Functions

    def _look_for_functions(self, unit: TranslationUnit) -> None:
        def visit(cursor: Cursor, scope: str) -> None:
            for child in cursor.get_children():
                file = child.location.file
                if file is None or Path(file.name) != self.path:
                    continue
                name = f"{scope}{child.spelling}"
                if child.kind in FUNCTIONS and child.is_definition():
                    parent = child.semantic_parent
                    in_class = parent is not None and parent.kind in {
                        CursorKind.CLASS_DECL,
                        CursorKind.STRUCT_DECL,
                        CursorKind.CLASS_TEMPLATE,
                    }
                    name = f"{parent.spelling}::{child.spelling}" if in_class else child.spelling
                    name = name.split("<")[0]
                    self._function_found(child, name)
                elif child.kind in {
                    CursorKind.NAMESPACE,
                    CursorKind.CLASS_DECL,
                    CursorKind.STRUCT_DECL,
                    CursorKind.CLASS_TEMPLATE,
                    CursorKind.UNEXPOSED_DECL,
                }:
                    visit(child, scope)

        visit(unit.cursor, "")

    def _function_found(self, cursor: Cursor, name: str) -> None:
        if "*" not in self.functions and name not in self.functions:
            return
        body = [c for c in cursor.get_children() if c.kind == CursorKind.COMPOUND_STMT]
        if not body or "constexpr" in self._text(cursor).split("{")[0]:
            return
        self.found.add(name)
        self._function = name
        self._last = list(body[0].get_children())[-1:]
        for child in cursor.get_children():
            # Members that a constructor initializes, and the body; not parameters and types.
            if child.kind.is_expression() or child.kind == CursorKind.COMPOUND_STMT:
                self._visit(child, cursor, cursor)

    # Expressions and statements

    def _visit(self, cursor: Cursor, parent: Cursor, grandparent: Cursor) -> None:
        if cursor.kind in {
            CursorKind.STATIC_ASSERT,
            CursorKind.TYPE_REF,
            CursorKind.STRUCT_DECL,
            CursorKind.CLASS_DECL,
        }:
            return
        if cursor.kind == CursorKind.DECL_STMT and "constexpr" in self._text(cursor).split("=")[0]:
            return
        children = list(cursor.get_children())
        if self._is_statement(cursor, parent):
            self._statement(cursor, parent, grandparent)
        self._operator(cursor)
        if cursor.kind in {CursorKind.INTEGER_LITERAL, CursorKind.FLOATING_LITERAL}:
            self._literal(cursor, parent)
        if cursor.kind in {CursorKind.IF_STMT, CursorKind.WHILE_STMT} and children:
            self._condition(children[0])
        if cursor.kind == CursorKind.CONDITIONAL_OPERATOR:
            self._condition(children[0])
        if cursor.kind == CursorKind.CASE_STMT:
            children = children[1:]
        if cursor.kind == CursorKind.LAMBDA_EXPR:
            self._last += list(children[-1].get_children())[-1:]
        for child in children:
            self._visit(child, cursor, parent)

    def _is_statement(self, cursor: Cursor, parent: Cursor) -> bool:
        if cursor.kind not in REMOVABLE:
            return False
        if parent.kind in {CursorKind.COMPOUND_STMT, CursorKind.CASE_STMT}:
            return True
        if parent.kind == CursorKind.DEFAULT_STMT:
            return True
        siblings = list(parent.get_children())
        if parent.kind == CursorKind.IF_STMT:
            return cursor != siblings[0]
        return parent.kind in LOOPS and cursor == siblings[-1]

    def _statement(self, cursor: Cursor, parent: Cursor, grandparent: Cursor) -> None:
        start, end = self._extent(cursor)
        text = self._text(cursor)
        semicolon = re.match(rb"\s*;", self.source[end:])
        if semicolon is None or text.startswith("throw"):
            return
        if cursor.kind == CursorKind.RETURN_STMT:
            # What ends without its value may do anything, so early returns only.
            branch = grandparent if parent.kind == CursorKind.COMPOUND_STMT else parent
            if branch.kind != CursorKind.IF_STMT or any(branch == last for last in self._last):
                return
        number = self._new(start, text if len(text) < 40 else text[:37] + "...", ["removed"])
        if number is None:
            return
        self._open(start, f"{{ if (mutants::keeps({number})) ")
        self._close(end + semicolon.end(), " }")

    def _operator(self, cursor: Cursor) -> None:
        start, end = self._extent(cursor)
        if "basic_string" in cursor.type.get_canonical().spelling:
            return  # joined text
        if cursor.kind in OPERATORS:
            operands = operands_of(cursor)
            if len(operands) == 2 and all(o is not None for o in operands):
                (left, left_end), (right, right_end) = map(self._extent, operands)
                operator = self.source[left_end:right].decode().strip()
                if left == start and right_end == end and operator in BINARY | LOGICAL:
                    self._binary(operator, start, left_end, right, end)
                    return
            if cursor.kind == CursorKind.CALL_EXPR:
                self._call(cursor, start, len(operands))
        elif cursor.kind == CursorKind.UNARY_OPERATOR:
            operand = self._extent(next(cursor.get_children()))[0]
            operator = self.source[start:operand].decode().strip()
            if operator == "-":
                self._wrap(start, operand, end, "-", "+", "mutants::minus({}, (", "))")
            elif operator == "!":
                self._wrap(start, start, end, "!", "", "mutants::condition({}, (", "))")

    def _binary(self, operator: str, start: int, left_end: int, right: int, end: int) -> None:
        name, becomes = (BINARY | LOGICAL)[operator]
        number = self._new(left_end, operator, becomes)
        if number is None:
            return
        if operator in BINARY:
            self._open(start, f"mutants::{name}({number}, (")
            self._replace(left_end, right - left_end, "), (")
            self._close(end, "))")
        else:
            to_bool = "static_cast<bool>("
            self._open(
                start, f"mutants::{name}_both({number}, mutants::{name}_left({number}, {to_bool}"
            )
            self._replace(
                left_end,
                right - left_end,
                f")) {operator} mutants::{name}_right({number}, {to_bool}",
            )
            self._close(end, ")))")

    def _call(self, cursor: Cursor, start: int, operands: int) -> None:
        called = re.match(rb"std::(min|max|abs)\s*(<[^()]*>)?\(", self.source[start:])
        if called is None or operands != (1 if called[1] == b"abs" else 2):
            return
        name, becomes = {
            b"min": ("least", "max"),
            b"max": ("most", "min"),
            b"abs": ("magnitude", "itself"),
        }[called[1]]
        number = self._new(start, called[1].decode(), [becomes])
        if number is not None:
            kind = (called[2] or b"").decode()
            self._replace(start, called.end(), f"mutants::{name}{kind}({number}, ")

    def _literal(self, cursor: Cursor, parent: Cursor) -> None:
        start, end = self._extent(cursor)
        text = self.source[start:end].decode()
        if parent.kind in {CursorKind.VAR_DECL, CursorKind.FIELD_DECL} and self.source[
            end : end + 1
        ] in {b"]", b">"}:
            return
        number = re.fullmatch(r"(\d+)([uUlLzZ]*)", text)
        if number is not None:
            if number[1] not in LITERALS:
                return
            other = LITERALS[number[1]] + number[2]
        elif re.fullmatch(r"\d*\.\d*(e[-+]?\d+)?", text):
            other = "1.0" if float(text) == 0 else f"2 * {text}"
        else:
            return
        self._wrap(start, end, end, text, other, "mutants::literal({}, " + f"{text}, {other}", ")")

    def _condition(self, cursor: Cursor) -> None:
        """Negates a condition that is no comparison, which is negated as such."""
        if not cursor.kind.is_expression():
            return
        inner = cursor
        while inner.kind in {CursorKind.UNEXPOSED_EXPR, CursorKind.PAREN_EXPR}:
            children = list(inner.get_children())
            if len(children) != 1:
                break
            inner = children[0]
        start, end = self._extent(cursor)
        if re.search(rb"constexpr\s*\($", self.source[:start]):
            return
        if inner.kind in OPERATORS:
            operands = operands_of(inner)
            if len(operands) == 2 and all(o is not None for o in operands):
                between = self.source[self._extent(operands[0])[1] : self._extent(operands[1])[0]]
                if between.decode().strip() in BOOLEAN:
                    return
        if self.source[start : start + 1] == b"!" and inner.kind == CursorKind.UNARY_OPERATOR:
            return
        wrapper = "mutants::condition({}, static_cast<bool>("
        self._wrap(start, start, end, "condition", "negated", wrapper, "))")

    # Edits

    def _wrap(
        self, start: int, rest: int, end: int, was: str, becomes: str, opening: str, closing: str
    ) -> None:
        """Replaces start to rest by `opening`, with the number in it, and appends `closing`."""
        number = self._new(start, was, [becomes])
        if number is not None:
            self._replace(start, rest - start, opening.format(number))
            self._close(end, closing)

    def _new(self, offset: int, was: str, becomes: Sequence[str]) -> int | None:
        line = self.source.count(b"\n", 0, offset) + 1
        column = offset - (self.source.rfind(b"\n", 0, offset) + 1) + 1
        if (line, column, was) in self.dropped:
            return None
        number = self._next
        text = self.source.splitlines()[line - 1].decode().strip()
        for each in becomes:
            self.mutants.append(
                Mutant(self._next, self.name, line, column, self._function, was, each, text)
            )
            self._next += 1
        return number

    def _open(self, offset: int, text: str) -> None:
        self._replace(offset, 0, text)

    def _replace(self, offset: int, removed: int, text: str) -> None:
        self._sequence += 1
        self._edits.append(Edit(offset, (1, self._sequence), removed, text))

    def _close(self, offset: int, text: str) -> None:
        self._sequence += 1
        self._edits.append(Edit(offset, (0, -self._sequence), 0, text))

    def _extent(self, cursor: Cursor) -> tuple[int, int]:
        return cursor.extent.start.offset, cursor.extent.end.offset

    def _text(self, cursor: Cursor) -> str:
        start, end = self._extent(cursor)
        return self.source[start:end].decode()
