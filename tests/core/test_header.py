# SPDX-License-Identifier: GPL-3.0-or-later
"""The binding's abi.py is made from meander.h, and the library is as the header says."""

from __future__ import annotations

import ctypes
import dataclasses
import re
import subprocess
import sys
from pathlib import Path
from types import ModuleType

import pytest
from conftest import REPOSITORY
from flows import options_of
from meander import core
from meander.binding import abi, flow_options, native_library

sys.path.append(str(REPOSITORY / "scripts"))
import c_header  # noqa: E402
import dump_abi  # noqa: E402
import generate_abi  # noqa: E402

HEADER = REPOSITORY / "native/include/meander/meander.h"
TEXT = c_header.whole_text(HEADER)
FROZEN = REPOSITORY / "tests/native/abi3.txt"


def module_of(text: str) -> dict[str, object]:
    """What the module made from a header holds."""
    made = ModuleType("made")
    sys.modules[made.__name__] = made  # where its dataclasses look for it
    exec(generate_abi.Writer(c_header.Parser(text).parse()).module(), vars(made))
    return vars(made)


# ------------------------------------------------------------------------------------------------
# The module and the header


def test_the_module_in_use_is_made_from_this_header() -> None:
    parsed = c_header.Parser(TEXT).parse()
    with open(abi.__file__, encoding="utf-8") as file:
        assert file.read() == generate_abi.Writer(parsed).module()


def test_nothing_of_the_header_is_left_out() -> None:
    code = re.sub(r"/\*.*?\*/", "", TEXT, flags=re.DOTALL)
    # Every use of the macro but its definitions declares a function.
    assert len(abi.PROTOTYPES) == len(re.findall(r"^MEANDER_API\b", code, re.MULTILINE))
    assert set(abi.STRUCTS) == set(re.findall(r"^typedef struct (\w+) \{", code, re.MULTILINE))
    for name, struct in abi.STRUCTS.items():
        body = re.search(rf"typedef struct {name} \{{(.*?)\}}", code, re.DOTALL)[1]
        assert len(struct._fields_) == body.count(";"), name


def test_the_header_holds_contracts_only() -> None:
    """What it costs on one machine, and which numbers a preset is made of, change under it."""
    prose = " ".join(re.findall(r"/\*.*?\*/", TEXT, re.DOTALL))
    prose = re.sub(r"\s+\*?\s*", " ", prose)
    figure = r"(?:\b\d[\d.,]*|\bhalf an?|\btwo|\bsome|\ba few|\ba fifth of a)"
    times = rf"{figure} (?:seconds?|minutes?|(?:milli|micro|nano)seconds?|MB|GB)\b"
    shares = r"[\d.]+ %|\btimes the time|\bof the time\b|\bfirst \d+ iterations"
    found = [prose[m.start() - 30 : m.end() + 10] for m in re.finditer(f"{times}|{shares}", prose)]
    assert found == []


def test_types_are_those_of_the_header() -> None:
    result, arguments = abi.PROTOTYPES["meander_flow_create"]
    assert result is ctypes.c_int32
    assert arguments == (
        ctypes.c_void_p,  # const meander_surface*
        ctypes.POINTER(abi.SeedRecord),
        ctypes.c_void_p,  # const double*
        ctypes.c_size_t,
        ctypes.POINTER(abi.FlowOptionsRecord),
        ctypes.POINTER(ctypes.c_void_p),  # meander_flow**
        ctypes.c_void_p,  # meander_context*
        ctypes.POINTER(abi.ErrorRecord),
    )
    assert abi.PROTOTYPES["meander_version"] == (ctypes.c_char_p, ())
    assert abi.PROTOTYPES["meander_flow_destroy"] == (None, (ctypes.c_void_p,))
    assert abi.PROTOTYPES["meander_context_progress"][0] is ctypes.c_double
    assert dict(abi.ErrorRecord._fields_)["text"]._length_ == 492


DECLARATION = "MEANDER_API uint32_t meander_abi_version(void);"


@pytest.mark.parametrize(
    ("new", "complaint"),
    [
        ("MEANDER_API short meander_abi_version(void);", "unknown type short"),
        ("MEANDER_API uint32_t meander_abi_version(int x[3]);", "unknown type int"),
        ("MEANDER_API uint32_t meander_abi_version(double);", "expected a name"),
        ("MEANDER_API uint32_t abi_version(void);", "does not begin with meander_"),
        (DECLARATION + DECLARATION, "declared twice"),
        ("MEANDER_API uint32_t meander_abi_version(double** x);", "no ctypes for double**"),
        ("static uint32_t meander_abi_version(void);", "unknown declaration"),
        ("typedef uint32_t meander_kind;", "expected 'enum'"),
        ("typedef uint32_t meander_kind; enum { MEANDER_SORT_A = 0 };", "does not begin with"),
        ("typedef uint32_t meander_kind; enum { MEANDER_KIND_A };", "expected '='"),
        ("typedef uint32_t meander_kind; enum { MEANDER_KIND_A = 1 << 2 };", "unknown character"),
        ("typedef struct meander_x { short y; } meander_x;", "unknown type short"),
        ("typedef struct meander_x { uint32_t a : 3; } meander_x;", "unknown character"),
        ("typedef struct meander_x { union { double a; } b; } meander_x;", "unknown type union"),
        ("#define MEANDER_API_2 MEANDER_API\n", "unknown preprocessor line"),
        ("#pragma pack(1)\n", "unknown preprocessor line"),
    ],
)
def test_what_is_not_understood_stops_the_build(new: str, complaint: str) -> None:
    assert TEXT.count(DECLARATION) == 1
    with pytest.raises(c_header.ParseError, match=re.escape(complaint)):
        module_of(TEXT.replace(DECLARATION, new))


def test_the_document_lists_every_function() -> None:
    document = (REPOSITORY / "docs/c-api.md").read_text(encoding="utf-8")
    table = document.split("## All functions")[1].split("## ")[0]
    assert sorted(re.findall(r"`(meander_\w+)`", table)) == sorted(abi.PROTOTYPES)


# ------------------------------------------------------------------------------------------------
# The library and the header


def test_abi_and_version_are_the_same_everywhere() -> None:
    cmake = (REPOSITORY / "CMakeLists.txt").read_text(encoding="utf-8")
    version = re.search(r"project\(\s*\w+\s+VERSION\s+([\d.]+)", cmake)[1]
    macros = [
        re.search(rf"^#define MEANDER_VERSION_{part} (\d+)$", TEXT, re.MULTILINE)[1]
        for part in ("MAJOR", "MINOR", "PATCH")
    ]
    assert version == ".".join(macros) == core.VERSION == core.library_version()
    assert native_library.native().meander_abi_version() == core.ABI_VERSION


@pytest.mark.parametrize("name", sorted(abi.STRUCTS))
def test_struct_layout_is_that_of_the_library(name: str) -> None:
    ours, theirs = core.struct_layouts()[name]
    assert ours == theirs


def test_unknown_struct_has_no_layout() -> None:
    assert native_library.native().meander_struct_layout(b"meander_nothing", None, 0) == 0


def test_every_option_is_a_field_of_the_struct() -> None:
    fields = {field[0] for field in abi.FlowOptionsRecord._fields_}
    ours = {field.name for field in dataclasses.fields(core.FlowOptions)}
    assert fields - ours == {"struct_size", "reserved"}
    assert set(core.default_options().tunings) == set(flow_options.tuning_names())


def test_tunings_are_the_presets_until_they_are_set() -> None:
    even, finest = core.default_options("even"), core.default_options("finest")
    assert even.tunings["polish_length_gain"] != finest.tunings["polish_length_gain"]
    even.tunings["polish_length_gain"] = 3.5
    record = flow_options.options_record(even)
    place = flow_options.tuning_names().index("polish_length_gain")
    assert record.tunings[place] == 3.5
    assert core.default_options("even").tunings["polish_length_gain"] != 3.5


def test_an_unknown_tuning_is_refused_by_a_sentence_that_lists_the_names() -> None:
    options = options_of(radius=0.1)
    options.tunings["polish_length_game"] = 1.0
    with pytest.raises(core.MeanderError) as refusal:
        core.estimate_cost(core.Extent(10, 1.0, 1.0, 1.0), options)
    assert all(name in str(refusal.value) for name in flow_options.tuning_names())
    assert "polish_length_game" in str(refusal.value)
    options.tunings = {"polish_length_gain": -1.0}
    with pytest.raises(core.MeanderError, match="polish_length_gain is -1; it must be between 0 "):
        core.estimate_cost(core.Extent(10, 1.0, 1.0, 1.0), options)


def test_the_page_lists_the_tunings() -> None:
    page = (REPOSITORY / "docs/c-api.md").read_text(encoding="utf-8")
    table = page.split("## Tunings")[1].split("\n## ")[0]
    assert re.findall(r"^\| `(\w+)` \|", table, re.MULTILINE) == list(flow_options.tuning_names())


# ------------------------------------------------------------------------------------------------
# The header of yesterday


def now() -> dump_abi.Dump:
    return dump_abi.dump_of(c_header.Parser(TEXT).parse())


def then() -> dump_abi.Dump:
    return dump_abi.read_dump(FROZEN.read_text(encoding="utf-8"))


def test_what_is_written_down_can_be_read_again() -> None:
    assert dump_abi.text_of(then()) == FROZEN.read_text(encoding="utf-8")
    assert dump_abi.read_dump(dump_abi.text_of(now())) == now()


def test_layouts_are_written_down_as_the_library_has_them() -> None:
    for name, record in abi.STRUCTS.items():
        offsets = {member: at for member, (at, _) in now().fields[name].items()}
        assert offsets == {m: getattr(record, m).offset for m, _ in record._fields_}, name
        assert now().sizes[name] == ctypes.sizeof(record), name


def test_what_was_declared_when_this_abi_began_still_stands() -> None:
    old, new = then(), now()
    assert old.constants["MEANDER_ABI_VERSION"] == new.constants["MEANDER_ABI_VERSION"]
    assert old.functions.items() <= new.functions.items()
    assert old.scalars.items() <= new.scalars.items()
    for name, members in old.enums.items():
        assert members.items() <= new.enums[name].items()
    assert set(old.opaque) <= set(new.opaque)


def test_structs_have_only_grown_since_this_abi_began() -> None:
    old, new = then(), now()
    for name, fields in old.fields.items():
        assert new.sizes[name] >= old.sizes[name], name
        kept = {field: what for field, what in fields.items() if not field.startswith("reserved")}
        assert kept.items() <= new.fields[name].items(), name
        if "reserved" in fields:
            # Fields that came later were cut from the beginning of the reserve.
            ends = [end_of_reserve(dump, name) for dump in (old, new)]
            assert ends[0] == ends[1] == old.sizes[name], name


def end_of_reserve(dump: dump_abi.Dump, name: str) -> int:
    at, what = dump.fields[name]["reserved"]
    base, length = re.fullmatch(r"(\w+) reserved\[(\d+)\]", what).groups()
    return at + int(length) * c_header.BYTES.get(base, dump_abi.POINTER)


@pytest.mark.parametrize("file", sorted(HEADER.parent.glob("*.h")), ids=lambda path: path.name)
def test_a_header_brings_what_it_needs(file: Path) -> None:
    command = ["cc", "-std=c99", "-pedantic", "-Wall", "-Wextra", "-Werror", "-fsyntax-only"]
    done = subprocess.run([*command, "-x", "c", file], capture_output=True, text=True, timeout=60)
    assert done.returncode == 0, done.stderr
