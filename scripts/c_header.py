# SPDX-License-Identifier: GPL-3.0-or-later
"""Reads meander.h and the headers that it includes.

The parser knows the few forms of C that they use, and stops at anything else.
"""

from __future__ import annotations

import re
from dataclasses import dataclass, field, replace
from pathlib import Path

# In C and in ctypes.
NUMBERS = {
    "char": "c_char",
    "double": "c_double",
    "float": "c_float",
    "int32_t": "c_int32",
    "size_t": "c_size_t",
    "uint8_t": "c_uint8",
    "uint32_t": "c_uint32",
    "uint64_t": "c_uint64",
}

# Blocks of preprocessor lines that mean nothing to a binding.
GUARD = re.compile(r"#ifndef (MEANDER_(?:\w+_)?H)\n#define \1\n")
API_MACRO = re.compile(r"#if defined\(MEANDER_STATIC\)\n.*?^#endif$", re.DOTALL | re.MULTILINE)
EXTERN_C = re.compile(r'#ifdef __cplusplus\n(?:extern "C" \{|\})\n#endif\n')
INCLUDE = re.compile(r"#include <\w+\.h>\n")
OWN_INCLUDE = re.compile(r'#include "(\w+\.h)"\n')
CONSTANT = re.compile(r"#define (MEANDER_\w+) (\d+)\n")
TOKEN = re.compile(r"\s*([A-Za-z_]\w*|\d+|[{}();,=*\[\]])")


class ParseError(Exception):
    """Something in the header that the parser does not understand."""


@dataclass(frozen=True)
class CType:
    """A type of an argument, a field or a result: `base` and as many stars as `pointers`."""

    base: str
    pointers: int = 0
    length: int | None = None  # of an array within a struct
    constant: bool = False


@dataclass
class Header:
    """Everything that the header declares, in its order."""

    constants: dict[str, int] = field(default_factory=dict)
    scalars: dict[str, str] = field(default_factory=dict)  # meander_status: int32_t
    enums: dict[str, dict[str, int]] = field(default_factory=dict)  # of those that have one
    opaque: list[str] = field(default_factory=list)
    structs: dict[str, list[tuple[str, CType]]] = field(default_factory=dict)
    functions: dict[str, tuple[CType, list[tuple[str, CType]]]] = field(default_factory=dict)


# Bytes of a number, which is aligned to as many; size_t is as large as a pointer.
BYTES = {"char": 1, "uint8_t": 1, "float": 4, "int32_t": 4, "uint32_t": 4, "double": 8}
BYTES |= {"uint64_t": 8}


def layout(
    header: Header, fields: list[tuple[str, CType]], pointer: int
) -> tuple[list[int], int]:
    """Where the fields of a struct are where pointers have so many bytes, and its size."""
    at, widest, offsets = 0, 1, []
    for _, kind in fields:
        base = "size_t" if kind.pointers else header.scalars.get(kind.base, kind.base)
        size = BYTES.get(base, pointer)
        at += -at % size
        offsets.append(at)
        at += size * (kind.length or 1)
        widest = max(widest, size)
    return offsets, at + -at % widest


def whole_text(path: Path) -> str:
    """A header with those of ours that it includes in the places where they come first."""
    seen: set[str] = set()

    def text_of(name: str) -> str:
        if name in seen:
            return ""
        seen.add(name)
        text = (path.parent / name).read_text(encoding="utf-8")
        return OWN_INCLUDE.sub(lambda include: text_of(include[1]), text)

    return text_of(path.name)


def read_header(path: Path) -> Header:
    return Parser(whole_text(path)).parse()


class Parser:
    def __init__(self, text: str) -> None:
        self.header = Header()
        self._tokens = self._split(self._without_preprocessor(text))
        self._at = 0

    def _without_preprocessor(self, text: str) -> str:
        text = re.sub(r"/\*.*?\*/", "", text, flags=re.DOTALL)
        text = re.sub(r"[ \t]+$", "", text, flags=re.MULTILINE)
        text, count = API_MACRO.subn("", text)
        if count != 1:
            raise ParseError(
                "MEANDER_API is not defined in one block that starts with MEANDER_STATIC"
            )
        text = self._without_guards(EXTERN_C.sub("", text).strip() + "\n")
        text = INCLUDE.sub("", text)
        for name, value in CONSTANT.findall(text):
            self.header.constants[name] = int(value)
        text = CONSTANT.sub("", text)
        if "#" in text:
            raise ParseError(
                f"unknown preprocessor line: {text[text.index('#') :].splitlines()[0]}"
            )
        return text

    @staticmethod
    def _without_guards(text: str) -> str:
        if not (text.startswith("#ifndef MEANDER_H\n") and text.endswith("#endif\n")):
            raise ParseError("there is no include guard MEANDER_H around the whole header")
        text, begun = GUARD.subn("", text)
        text, ended = re.subn(r"^#endif\n", "", text, flags=re.MULTILINE)
        if begun != ended:
            raise ParseError(f"{begun} include guards begin, and {ended} end")
        return text

    @staticmethod
    def _split(text: str) -> list[str]:
        tokens, at = [], 0
        text = text.rstrip()
        while at < len(text):
            match = TOKEN.match(text, at)
            if not match:
                raise ParseError(f"unknown character before: {text[at : at + 60]!r}")
            tokens.append(match[1])
            at = match.end()
        return tokens

    def _peek(self, ahead: int = 0) -> str:
        at = self._at + ahead
        return self._tokens[at] if at < len(self._tokens) else ""

    def _next(self) -> str:
        token = self._peek()
        self._at += 1
        return token

    def _expect(self, wanted: str) -> None:
        if self._peek() != wanted:
            around = " ".join(self._tokens[max(0, self._at - 8) : self._at + 4])
            raise ParseError(f"expected {wanted!r} instead of {self._peek()!r} in: {around}")
        self._at += 1

    def _name(self) -> str:
        token = self._next()
        if not re.fullmatch(r"[A-Za-z_]\w*", token):
            raise ParseError(f"expected a name instead of {token!r}")
        return token

    def _number(self) -> int:
        token = self._next()
        if not token.isdigit():
            raise ParseError(f"expected a number instead of {token!r}")
        return int(token)

    def parse(self) -> Header:
        while self._at < len(self._tokens):
            if self._peek() == "MEANDER_API":
                self._function()
            elif self._peek() == "typedef" and self._peek(1) == "struct":
                self._struct()
            elif self._peek() == "typedef":
                self._scalar()
            else:
                raise ParseError(f"unknown declaration: {' '.join(self._tokens[self._at :][:8])}")
        return self.header

    def _scalar(self) -> None:
        """typedef uint32_t meander_x; enum { MEANDER_X_A = 0, ... };"""
        self._expect("typedef")
        base, name = self._name(), self._name()
        self._expect(";")
        if base not in NUMBERS:
            raise ParseError(f"{name} stands for {base}, which is no number")
        self.header.scalars[name] = base
        self._expect("enum")
        self._expect("{")
        members: dict[str, int] = {}
        while True:
            member = self._name()
            if not member.startswith(name.upper() + "_"):
                raise ParseError(f"{member} does not begin with {name.upper()}_")
            self._expect("=")
            members[member] = self._number()
            if self._next() == "}":
                break
        self._expect(";")
        self.header.enums[name] = members

    def _struct(self) -> None:
        """typedef struct x x; or typedef struct x { ... } x;"""
        self._expect("typedef")
        self._expect("struct")
        name = self._name()
        if self._peek() != "{":
            self._expect(name)
            self._expect(";")
            self.header.opaque.append(name)
            return
        self._expect("{")
        fields: list[tuple[str, CType]] = []
        while self._peek() != "}":
            kind = self._type()
            member = self._name()
            if self._peek() == "[":
                self._expect("[")
                kind = replace(kind, length=self._number())
                self._expect("]")
            self._expect(";")
            if kind.base == "void" or kind.base in self.header.structs:
                raise ParseError(f"{name}.{member} is of type {kind.base}")
            fields.append((member, kind))
        self._expect("}")
        self._expect(name)
        self._expect(";")
        self.header.structs[name] = fields

    def _function(self) -> None:
        self._expect("MEANDER_API")
        result, name = self._type(), self._name()
        self._expect("(")
        arguments: list[tuple[str, CType]] = []
        if self._peek() == "void" and self._peek(1) == ")":
            self._expect("void")
        while self._peek() != ")":
            kind = self._type()
            arguments.append((self._name(), kind))
            if self._peek() != ")":
                self._expect(",")
        self._expect(")")
        self._expect(";")
        if not name.startswith("meander_") or name in self.header.functions:
            raise ParseError(f"{name} is declared twice, or does not begin with meander_")
        self.header.functions[name] = (result, arguments)

    def _type(self) -> CType:
        constant = self._peek() == "const"
        if constant:
            self._expect("const")
        base, h = self._name(), self.header
        if base not in (*NUMBERS, "void", *h.scalars, *h.opaque, *h.structs):
            raise ParseError(f"unknown type {base}")
        stars = 0
        while self._peek() == "*":
            self._expect("*")
            stars += 1
        if stars == 0 and base in (*h.opaque, *h.structs):
            raise ParseError(f"{base} is passed by value")
        return CType(base, stars, constant=constant)
