# SPDX-License-Identifier: GPL-3.0-or-later
"""abi.py mirrors meander.h: the header is read here, and both sides are compared."""

from __future__ import annotations

import ctypes
import dataclasses
import re

import pytest
from conftest import REPOSITORY
from meander import core
from meander.binding import abi, native_library

HEADER = (REPOSITORY / "native/include/meander/meander.h").read_text(encoding="utf-8")
CODE = re.sub(r"/\*.*?\*/", "", HEADER, flags=re.DOTALL)

NUMBERS = {
    "void": None,
    "double": ctypes.c_double,
    "size_t": ctypes.c_size_t,
    "uint32_t": ctypes.c_uint32,
    "int32_t": ctypes.c_int32,
    "meander_status": ctypes.c_int32,
}


def declared_functions() -> dict[str, tuple[str, list[str]]]:
    """name -> (C result type, C argument types) of every exported function."""
    functions = {}
    for match in re.finditer(r"MEANDER_API\s+([^;(]*?)(meander_\w+)\s*\(([^)]*)\)\s*;", CODE):
        result, name, arguments = match.groups()
        kinds = [re.sub(r"\w+$", "", part.strip()).strip() for part in arguments.split(",")]
        functions[name] = (result.strip(), [] if arguments.strip() == "void" else kinds)
    return functions


def declared_structs() -> dict[str, list[str]]:
    """name -> C declarations of the fields, in order."""
    structs = {}
    for match in re.finditer(r"typedef struct (\w+) \{(.*?)\} \1;", CODE, flags=re.DOTALL):
        name, body = match.groups()
        structs[name] = [" ".join(line.split()) for line in body.split(";") if line.strip()]
    return structs


def declared_constants() -> dict[str, int]:
    """Every enumerator, by name."""
    bodies = re.findall(r"enum \{(.*?)\}", CODE, flags=re.DOTALL)
    return {
        name: int(value) for body in bodies for name, value in re.findall(r"(\w+) = (\d+)", body)
    }


def test_header_was_understood() -> None:
    # Every use of the macro but its two definitions is a function.
    assert len(declared_functions()) == len(re.findall(r"^MEANDER_API\b", CODE, re.MULTILINE))
    assert declared_structs() and declared_constants()


def test_every_function_has_a_prototype_and_no_other() -> None:
    assert set(declared_functions()) == set(abi.PROTOTYPES)


@pytest.mark.parametrize("name", sorted(declared_functions()))
def test_prototype_is_that_of_the_header(name: str) -> None:
    result, arguments = declared_functions()[name]
    our_result, our_arguments = abi.PROTOTYPES[name]
    assert _matches(result, our_result), f"result of {name}"
    assert len(arguments) == len(our_arguments)
    for at, (theirs, ours) in enumerate(zip(arguments, our_arguments, strict=True)):
        assert _matches(theirs, ours), f"argument {at} of {name}: {theirs} against {ours}"


def _matches(c_type: str, ours: type | None) -> bool:
    bare = c_type.replace("const", "").strip()
    if not bare.endswith("*"):
        return ours is NUMBERS[bare]
    target = bare[:-1].strip()
    if ours is ctypes.c_void_p:  # arrays and opaque handles
        return target in ("double", "uint32_t", "uint8_t") or target in OPAQUE
    if ours is ctypes.c_char_p:
        return target == "char"
    if target.endswith("*"):
        return ours is ctypes.POINTER(ctypes.c_void_p) and target[:-1].strip() in OPAQUE
    if target in abi.STRUCTS:
        return ours is ctypes.POINTER(abi.STRUCTS[target])
    return ours is ctypes.POINTER(NUMBERS[target])


OPAQUE = ("meander_context", "meander_surface", "meander_flow")


def test_every_struct_is_mirrored_field_by_field() -> None:
    structs = declared_structs()
    assert set(structs) == set(abi.STRUCTS)
    for name, declarations in structs.items():
        fields = abi.STRUCTS[name]._fields_
        assert len(fields) == len(declarations), name
        for (field, kind, *_), declaration in zip(fields, declarations, strict=True):
            match = re.fullmatch(r"(.*?)(\w+)(?:\[(\d+)\])?", declaration)
            c_type, c_name, length = match.groups()
            assert c_name == field, name
            if length:
                assert kind is not None and kind._length_ == int(length)
                assert ctypes.sizeof(kind) == int(length)
            elif c_type.strip().endswith("*"):
                assert kind is ctypes.c_void_p
            else:
                assert kind is NUMBERS[c_type.strip()], f"{name}.{field}"


def test_constants_are_those_of_the_header() -> None:
    constants = declared_constants()
    ours = {f"MEANDER_{status.name}": int(status) for status in core.Status}
    ours |= {
        f"MEANDER_ELEMENT_{(kind or 'none').upper()}": at
        for at, kind in enumerate(core.ELEMENT_KINDS)
    }
    ours |= {f"MEANDER_PRESET_{name.upper()}": at for at, name in enumerate(core.PRESETS)}
    ours |= {f"MEANDER_BOUNDARY_{rule.name}": int(rule) for rule in core.BoundaryRule}
    ours |= {f"MEANDER_MEDIAL_AXIS_{axis.name}": int(axis) for axis in core.MedialAxis}
    ours |= {f"MEANDER_STOP_{rule.name}": int(rule) for rule in core.StopRule}
    for prefix, names in (
        ("CURVATURE", core.CURVATURES),
        ("DIRECTIONS", core.DIRECTIONS),
        ("ALIGN", core.ALIGNMENTS),
    ):
        ours |= {f"MEANDER_{prefix}_{name.upper()}": at for at, name in enumerate(names)}
    # The C name of 'cancelled' differs, since MEANDER_CANCELLED is the status.
    reasons = ["STOPPED" if name == "cancelled" else name.upper() for name in core.STOP_REASONS]
    ours |= {f"MEANDER_{name}": at for at, name in enumerate(reasons)}
    assert ours == constants


def test_abi_and_version_are_the_same_everywhere() -> None:
    abi_version = int(re.search(r"#define MEANDER_ABI_VERSION (\d+)", HEADER)[1])
    assert abi_version == core.ABI_VERSION
    cmake = (REPOSITORY / "CMakeLists.txt").read_text(encoding="utf-8")
    version = re.search(r"project\(\s*\w+\s+VERSION\s+([\d.]+)", cmake)[1]
    assert version == core.VERSION == core.library_version()


@pytest.mark.parametrize("name", sorted(abi.STRUCTS))
def test_struct_layout_is_that_of_the_library(name: str) -> None:
    ours, theirs = core.struct_layouts()[name]
    assert ours == theirs


def test_unknown_struct_has_no_layout() -> None:
    assert native_library.native().meander_struct_layout(b"meander_nothing", None, 0) == 0


def test_option_names_are_those_of_the_struct() -> None:
    names = [field[0] for field in abi.FlowOptionsRecord._fields_]
    hidden = {"struct_size", "reserved"}
    ours = [field.name for field in dataclasses.fields(core.FlowOptions)]
    assert ours == [name for name in names if name not in hidden]
