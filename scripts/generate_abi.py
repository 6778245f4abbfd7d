# SPDX-License-Identifier: GPL-3.0-or-later
"""Writes what only repeats meander.h: the Python module that declares the C API,
addon/meander/binding/abi.py, the module of the same for JavaScript, and the tables of its structs
that the library itself needs.

The module contains ctypes structs, enumerations, constants and prototypes, and nothing that is not
in the header. The C++ header has the layout of every struct, its name, and the _init functions. The
build makes both together with the library, so nothing can disagree.

    generate_abi.py --header native/include/meander/meander.h --output addon/meander/binding/abi.py
    generate_abi.py --header native/include/meander/meander.h --structs build/generated/structs.inc
    generate_abi.py --header native/include/meander/meander.h --javascript build/package/web/abi.mjs
"""

from __future__ import annotations

import argparse
import sys
from pathlib import Path

from c_header import NUMBERS, CType, Header, ParseError, layout, read_header


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
        offsets, size = layout(header, fields, pointer=4)
        entries = []
        for (member, kind), at in zip(fields, offsets, strict=True):
            base = "size_t" if kind.pointers else header.scalars.get(kind.base, kind.base)
            element = kind.base if kind.base in NUMBERS else "size_t"
            what = f'"{element}*"' if kind.pointers else f'"{base}"'
            length = "" if kind.length is None else f", {kind.length}"
            entries.append(f"    {member}: [{at}, {what}{length}],")
        lines += [f"export const {record_name(name)} = {{", f"  size: {size},", "  fields: {"]
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
        header = read_header(arguments.header)
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
