# SPDX-License-Identifier: GPL-3.0-or-later
"""Writes down an ABI: names, types, numbers and layouts of all that meander.h declares, without a
word of what it means; and makes a C header of what was written down, for programs as they were.

    dump_abi.py --header native/include/meander/meander.h > abi.txt
    dump_abi.py --dump tests/native/abi3.txt --c build/generated/abi3/meander.h

Offsets and sizes are those where pointers have 8 bytes. tests/core/test_header.py compares the
present header with the dump of when its ABI began.
"""

from __future__ import annotations

import argparse
import re
from dataclasses import dataclass, field
from pathlib import Path

from c_header import CType, Header, layout, read_header

POINTER = 8


@dataclass
class Dump:
    """What was written down, in lines of C for all but layouts."""

    constants: dict[str, int] = field(default_factory=dict)
    scalars: dict[str, str] = field(default_factory=dict)
    enums: dict[str, dict[str, int]] = field(default_factory=dict)
    opaque: list[str] = field(default_factory=list)
    sizes: dict[str, int] = field(default_factory=dict)
    fields: dict[str, dict[str, tuple[int, str]]] = field(default_factory=dict)  # offset and type
    functions: dict[str, str] = field(default_factory=dict)


def declared(kind: CType, name: str) -> str:
    """As C has it: const double* vertices."""
    length = "" if kind.length is None else f"[{kind.length}]"
    constant = "const " if kind.constant else ""
    return f"{constant}{kind.base}{'*' * kind.pointers} {name}{length}".rstrip()


def dump_of(header: Header) -> Dump:
    dump = Dump(header.constants, header.scalars, header.enums, header.opaque)
    for name, fields in header.structs.items():
        offsets, dump.sizes[name] = layout(header, fields, POINTER)
        dump.fields[name] = {
            member: (at, declared(kind, member))
            for (member, kind), at in zip(fields, offsets, strict=True)
        }
    for name, (result, arguments) in header.functions.items():
        listed = ", ".join(declared(kind, argument) for argument, kind in arguments)
        dump.functions[name] = f"{declared(result, name)}({listed or 'void'})"
    return dump


def text_of(dump: Dump) -> str:
    lines = [f"constant {name} {value}" for name, value in dump.constants.items()]
    for name, base in dump.scalars.items():
        lines += [f"number {name} {base}"]
        lines += [f"  {value} {member}" for member, value in dump.enums[name].items()]
    lines += [f"handle {name}" for name in dump.opaque]
    for name, fields in dump.fields.items():
        lines += [f"struct {name} {dump.sizes[name]}"]
        lines += [f"  {at} {what}" for at, what in fields.values()]
    lines += [f"call {what}" for what in dump.functions.values()]
    return "\n".join([*lines, ""])


def name_in(declaration: str) -> str:
    """Of `const double* vertices`, `char text[492]` or `double f(void)`."""
    return re.findall(r"\w+", re.sub(r"[\[(].*", "", declaration))[-1]


def read_dump(text: str) -> Dump:
    dump, inside = Dump(), ""
    for line in text.splitlines():
        word, rest = line.split(maxsplit=1)
        match line[0] == " ", word, rest.split():
            case True, _, _ if inside in dump.enums:
                dump.enums[inside][rest] = int(word)
            case True, _, _:
                dump.fields[inside][name_in(rest)] = int(word), rest
            case _, "constant", [name, value]:
                dump.constants[name] = int(value)
            case _, "number", [name, base]:
                inside, dump.scalars[name], dump.enums[name] = name, base, {}
            case _, "handle", [name]:
                dump.opaque.append(name)
            case _, "struct", [name, size]:
                inside, dump.sizes[name], dump.fields[name] = name, int(size), {}
            case _, "call", _:
                dump.functions[name_in(rest)] = rest
            case _:
                raise ValueError(f"unknown line of a dump: {line}")
    return dump


def c_header_of(dump: Dump) -> str:
    """The declarations for programs that are linked with a shared library."""
    lines = ["/* Made by scripts/dump_abi.py; changes are lost. */", "#include <stddef.h>"]
    lines += ["#include <stdint.h>"]
    lines += [f"#define {name} {value}" for name, value in dump.constants.items()]
    for name, base in dump.scalars.items():
        members = ", ".join(f"{member} = {value}" for member, value in dump.enums[name].items())
        lines += [f"typedef {base} {name};", f"enum {{ {members} }};"]
    lines += [f"typedef struct {name} {name};" for name in dump.opaque]
    for name, fields in dump.fields.items():
        members = " ".join(f"{what};" for _, what in fields.values())
        lines += [f"typedef struct {name} {{ {members} }} {name};"]
    lines += [f"{what};" for what in dump.functions.values()]
    return "\n".join([*lines, ""])


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--header", type=Path, help="the header to write down")
    parser.add_argument("--dump", type=Path, help="what was written down")
    parser.add_argument("--c", type=Path, help="the header to make of it")
    arguments = parser.parse_args()
    if arguments.header:
        print(text_of(dump_of(read_header(arguments.header))), end="")
    if arguments.dump:
        arguments.c.parent.mkdir(parents=True, exist_ok=True)
        arguments.c.write_text(
            c_header_of(read_dump(arguments.dump.read_text(encoding="utf-8"))), encoding="utf-8"
        )


if __name__ == "__main__":
    main()
