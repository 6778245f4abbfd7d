# SPDX-License-Identifier: GPL-3.0-or-later
"""Writes what only repeats meander.h: the Python module that declares the C API,
addon/meander/binding/abi.py, the module of the same for JavaScript, and the tables of its structs
that the library itself needs.

The module contains ctypes structs, enumerations, constants and prototypes, and nothing that is not
in the header. The C++ header has the layout of every struct, its name, and the _init functions. The
build makes both together with the library, so nothing can disagree. The parser knows the few forms
of C that the header uses, and stops at anything else.

    generate_abi.py --header native/include/meander/meander.h --output addon/meander/binding/abi.py
    generate_abi.py --header native/include/meander/meander.h --structs build/generated/structs.inc
    generate_abi.py --header native/include/meander/meander.h --javascript build/package/web/abi.mjs
"""

from __future__ import annotations

import argparse
import re
import sys
from dataclasses import dataclass, field
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
GUARD = re.compile(r"#ifndef MEANDER_H\n#define MEANDER_H\n(.*)#endif\s*\Z", re.DOTALL)
API_MACRO = re.compile(r"#if defined\(MEANDER_STATIC\)\n.*?^#endif$", re.DOTALL | re.MULTILINE)
EXTERN_C = re.compile(r'#ifdef __cplusplus\n(?:extern "C" \{|\})\n#endif\n')
INCLUDE = re.compile(r"#include <\w+\.h>\n")
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


@dataclass
class Header:
    """Everything that the header declares, in its order."""

    constants: dict[str, int] = field(default_factory=dict)
    scalars: dict[str, str] = field(default_factory=dict)  # meander_status: int32_t
    enums: dict[str, dict[str, int]] = field(default_factory=dict)  # of those that have one
    opaque: list[str] = field(default_factory=list)
    structs: dict[str, list[tuple[str, CType]]] = field(default_factory=dict)
    functions: dict[str, tuple[CType, list[tuple[str, CType]]]] = field(default_factory=dict)


class Parser:
    def __init__(self, text: str) -> None:
        self.header = Header()
        self._tokens = self._split(self._without_preprocessor(text))
        self._at = 0

    def _without_preprocessor(self, text: str) -> str:
        text = re.sub(r"/\*.*?\*/", "", text, flags=re.DOTALL)
        text = re.sub(r"[ \t]+$", "", text, flags=re.MULTILINE)
        guarded = GUARD.fullmatch(text.strip() + "\n")
        if not guarded:
            raise ParseError("there is no include guard MEANDER_H around the whole header")
        text, count = API_MACRO.subn("", guarded[1])
        if count != 1:
            raise ParseError(
                "MEANDER_API is not defined in one block that starts with MEANDER_STATIC"
            )
        text = INCLUDE.sub("", EXTERN_C.sub("", text))
        for name, value in CONSTANT.findall(text):
            self.header.constants[name] = int(value)
        text = CONSTANT.sub("", text)
        if "#" in text:
            raise ParseError(
                f"unknown preprocessor line: {text[text.index('#') :].splitlines()[0]}"
            )
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
                kind = CType(kind.base, kind.pointers, self._number())
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
        if self._peek() == "const":
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
        return CType(base, stars)


# ------------------------------------------------------------------------------------------------
# Writing


def class_name(c_name: str) -> str:
    """meander_stop_rule: StopRule."""
    return "".join(part.capitalize() for part in c_name.removeprefix("meander_").split("_"))


def record_name(c_name: str) -> str:
    """meander_seed: SeedRecord."""
    return class_name(c_name) + "Record"


class Writer:
    def __init__(self, header: Header) -> None:
        self._header = header

    def module(self) -> str:
        h = self._header
        version = [h.constants[f"MEANDER_VERSION_{part}"] for part in ("MAJOR", "MINOR", "PATCH")]
        lines = [
            "# SPDX-License-Identifier: GPL-3.0-or-later",
            "# Made from meander.h by scripts/generate_abi.py in every build; changes are lost.",
            '"""``meander.h`` as ctypes sees it: enumerations, structs, prototypes."""',
            "",
            "from __future__ import annotations",
            "",
            "from ctypes import (",
            "    POINTER,",
            "    Structure,",
            *(f"    {name}," for name in sorted([*NUMBERS.values(), "c_char_p", "c_void_p"])),
            ")",
            "from dataclasses import dataclass",
            "from enum import IntEnum",
            "from typing import Any",
            "",
            f'VERSION = "{".".join(map(str, version))}"',
            f"ABI_VERSION = {h.constants['MEANDER_ABI_VERSION']}",
        ]
        for name, members in h.enums.items():
            lines += ["", "", f"class {class_name(name)}(IntEnum):", f'    """{name}"""', ""]
            prefix = name.upper() + "_"
            lines += [f"    {member.removeprefix(prefix)} = {n}" for member, n in members.items()]
        for name, fields in h.structs.items():
            lines += ["", "", f"class {record_name(name)}(Structure):", f'    """{name}"""', ""]
            lines += ["    _fields_ = ["]
            lines += [f'        ("{member}", {self._field(kind)}),' for member, kind in fields]
            lines += ["    ]"]
            arrays = [
                (m, kind.base) for m, kind in fields if kind.pointers and kind.base in NUMBERS
            ]
            if arrays:
                lines += ["    _arrays_ = {"]
                lines += [f'        "{member}": {NUMBERS[base]},' for member, base in arrays]
                lines += ["    }"]
        lines += ["", "", "@dataclass", "class FlowOptionFields:"]
        lines += ['    """Those of meander_flow_options, each described there."""', ""]
        for name, kind in h.structs["meander_flow_options"]:
            if kind.length is None and name not in ("struct_size", "reserved32"):
                lines.append(f"    {name}: {self._hint(kind.base)}")
        lines += ["", "", "STRUCTS: dict[str, type[Structure]] = {"]
        lines += [f'    "{name}": {record_name(name)},' for name in h.structs]
        lines += [
            "}",
            "",
            "# name -> (result, arguments). Arrays and opaque handles are void pointers.",
        ]
        lines += ["PROTOTYPES: dict[str, tuple[Any, tuple[Any, ...]]] = {"]
        for name, (result, arguments) in h.functions.items():
            lines += [f'    "{name}": (', f"        {self._argument(result)},"]
            if not arguments:
                lines += ["        (),", "    ),"]
                continue
            lines += ["        ("]
            lines += [f"            {self._argument(kind)},  # {arg}" for arg, kind in arguments]
            lines += ["        ),", "    ),"]
        return "\n".join([*lines, "}", ""])

    def _number(self, base: str) -> str:
        return NUMBERS[self._header.scalars.get(base, base)]

    def _hint(self, base: str) -> str:
        """What Python has for a number of C."""
        if base in self._header.enums:
            return class_name(base)
        return "float" if base == "double" else "int"

    def _field(self, kind: CType) -> str:
        if kind.pointers:
            return "c_void_p"
        number = self._number(kind.base)
        return number if kind.length is None else f"{number} * {kind.length}"

    def _argument(self, kind: CType) -> str:
        h = self._header
        match (kind.pointers, kind.base):
            case (0, "void"):
                return "None"
            case (0, _):
                return self._number(kind.base)
            case (1, "char"):
                return "c_char_p"
            case (1, "size_t"):
                return "POINTER(c_size_t)"
            case (1, base) if base in NUMBERS or base in h.opaque:
                return "c_void_p"
            case (1, base) if base in h.structs:
                return f"POINTER({record_name(base)})"
            case (2, base) if base in h.opaque:
                return "POINTER(c_void_p)"
        raise ParseError(f"no ctypes for {kind.base}{'*' * kind.pointers}")


# Bytes of a number where pointers have four, and a number of these bytes is aligned to as many.
WASM_BYTES = {"char": 1, "uint8_t": 1, "float": 4, "int32_t": 4, "uint32_t": 4, "size_t": 4}
WASM_BYTES |= {"double": 8, "uint64_t": 8}


def javascript(header: Header) -> str:
    """An ES module: the version, the names of enumerations by number, and where WebAssembly has the
    fields of every struct.
    """
    version = [header.constants[f"MEANDER_VERSION_{part}"] for part in ("MAJOR", "MINOR", "PATCH")]
    lines = [
        "// SPDX-License-Identifier: GPL-3.0-or-later",
        "// Made from meander.h by scripts/generate_abi.py in every build; changes are lost.",
        f'export const VERSION = "{".".join(map(str, version))}";',
        f"export const ABI_VERSION = {header.constants['MEANDER_ABI_VERSION']};",
    ]
    for name, members in header.enums.items():
        short = [member.removeprefix(name.upper() + "_").lower() for member in members]
        pairs = ", ".join(f"{key}: {number}" for key, number in zip(short, members.values()))
        lines.append(f"export const {class_name(name)} = {{ {pairs} }};")
    lines.append("// Name of a field: offset, kind, and of an array in place its length.")
    for name, fields in header.structs.items():
        at, widest, entries = 0, 1, []
        for member, kind in fields:
            base = "size_t" if kind.pointers else header.scalars.get(kind.base, kind.base)
            size = WASM_BYTES[base]
            at += -at % size
            element = kind.base if kind.base in NUMBERS else "size_t"
            what = f'"{element}*"' if kind.pointers else f'"{base}"'
            length = "" if kind.length is None else f", {kind.length}"
            entries.append(f"    {member}: [{at}, {what}{length}],")
            at += size * (kind.length or 1)
            widest = max(widest, size)
        at += -at % widest
        lines += [f"export const {record_name(name)} = {{", f"  size: {at},", "  fields: {"]
        lines += [*entries, "  },", "};"]
    return "\n".join([*lines, ""])


def structs_in_cpp(header: Header) -> str:
    """A C++ header, for the namespace meander: the name and the layout of every struct, and a list
    of those that an _init function prepares by their size alone.
    """
    lines = ["// Made from meander.h by scripts/generate_abi.py in every build.", ""]
    for name in header.structs:
        lines.append(f'constexpr const char* name_of(const {name}*) {{ return "{name}"; }}')
    for name, fields in header.structs.items():
        offsets = "".join(f",\n    offsetof({name}, {member})" for member, _ in fields)
        lines += ["", f"inline constexpr size_t kLayoutOf{class_name(name)}[] = {{"]
        lines += [f"    sizeof({name}){offsets}}};"]
    lines += ["", "inline constexpr StructLayout kStructLayouts[] = {"]
    lines += [f'    {{"{name}", kLayoutOf{class_name(name)}}},' for name in header.structs]
    numbers = [
        name for name, kind in header.structs["meander_flow_options"] if kind == CType("double")
    ]
    lines += ["};", "", "inline constexpr NumberField kNumbersOfFlowOptions[] = {"]
    lines += [f'    {{"{name}", &meander_flow_options::{name}}},' for name in numbers]
    plain = [s for s in header.structs if len(header.functions.get(f"{s}_init", (0, ""))[1]) == 2]
    lines += ["};", "", f"#define MEANDER_PLAIN_STRUCTS(OF) {' '.join(f'OF({s})' for s in plain)}"]
    return "\n".join([*lines, ""])


def _write(output: Path, text: str) -> None:
    """Writes a file where that changes it."""
    if output.is_file() and output.read_text(encoding="utf-8") == text:
        return
    # Written under a temporary name and renamed: a Blender that starts now finds the old module or
    # the new one, whole.
    unfinished = output.with_suffix(output.suffix + ".part")
    unfinished.write_text(text, encoding="utf-8")
    unfinished.replace(output)


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--header", type=Path, required=True)
    parser.add_argument("--output", type=Path, help="the Python module")
    parser.add_argument("--structs", type=Path, help="the C++ header of the structs")
    parser.add_argument("--javascript", type=Path, help="the ES module")
    arguments = parser.parse_args()
    try:
        header = Parser(arguments.header.read_text(encoding="utf-8")).parse()
        if arguments.output:
            _write(arguments.output, Writer(header).module())
        if arguments.javascript:
            _write(arguments.javascript, javascript(header))
        if arguments.structs:
            _write(arguments.structs, structs_in_cpp(header))
    except ParseError as problem:
        print(f"{arguments.header}: {problem}", file=sys.stderr)
        return 1
    return 0


if __name__ == "__main__":
    sys.exit(main())
