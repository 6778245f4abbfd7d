# SPDX-License-Identifier: GPL-3.0-or-later
"""The rooms of native/src: every room includes only what stands before it."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

SOURCES = Path(__file__).resolve().parents[2] / "native" / "src"

# In the order of the data; docs/architecture.md says what each is for.
ROOMS = ("base", "mesh", "geodesic", "curve", "seed", "medial", "model", "flow", "outputs", "api")
# In quotes, or in angle brackets where what is named could be ours.
OURS = "|".join((*ROOMS, "meander"))
INCLUDE = re.compile(rf'^\s*#\s*include\s+(?:"([^"]+)"|<((?:{OURS})/[^>]+)>)', re.MULTILINE)
# Not a room: the public header and those that the build makes belong to api alone.
OF_API = {"meander/meander.h": "api", "version.h": "api", "structs.inc": "api"}

# A type or an alias that a file declares, and one that a header defines for all.
DECLARED = re.compile(r"\b(?:class|struct|union|enum|using|typename) (?:class )?(\w+)")
DEFINED = re.compile(r"^(?:struct|class|enum class|using) (\w+)\b(?=[^;]*\{| = )", re.MULTILINE)

# Who is next to whom is known by three meshes: the surface (with what the check hands to it), a
# soup with its table of edges, and the refined surface, which OpenMesh rewires. Here is what each
# of them is told by, and where that may stand.
ADJACENCY = {
    "OpenMesh": (r"#\s*include\s*<OpenMesh/", {"mesh/refined_surface.h"}),
    "half-edges that are kept": (
        r"^\s*(?:uint32_t|HalfEdge)(?: \w+(?: = \w+)?,)* (?:twin|next_half|opposite)\w*"
        r"(?: = \w+)?(?:, \w+)*;"
        r"|\b(?:vector|array|Table)<[^()]*> (?:twin|next_half|opposite)\w*;",
        # A crossing has both half-edges of its edge.
        {"mesh/surface.h", "mesh/mesh_check.h", "mesh/sheets.cpp", "mesh/surface_point.h"},
    ),
    "edges by their vertices": (
        r"std::minmax\(\w+, \w+\)|std::min\(([a-w]\w*), ([a-w]\w*)\),\s*std::max\(\1, \2\)",
        {"mesh/edge_groups.h"},
    ),
    "divided faces": (
        r"^(?:\w+ )+(?:\w+::)?(?:split_(?:edge|face|triangle)|flip)\([^)]*HalfEdge|set_next_half",
        {"mesh/refined_surface.cpp"},
    ),
}


def included_by(file: Path) -> list[str]:
    """What of the library a file includes, as it is written there."""
    found = INCLUDE.findall(file.read_text(encoding="utf-8"))
    return [quoted or angled for quoted, angled in found]


def wrong_includes(sources: Path) -> list[str]:
    """One line for every include that breaks the rule, naming the file and what it includes."""
    wrong = []
    for file in sorted(p for p in sources.rglob("*") if p.suffix in {".h", ".cpp"}):
        place = file.relative_to(sources)
        room = place.parts[0]
        if len(place.parts) != 2 or room not in ROOMS:
            wrong.append(f"{place} stands in no room")
            continue
        for name in included_by(file):
            target = OF_API.get(name, name.split("/")[0])
            if target not in ROOMS:
                wrong.append(f"{place} includes {name}, which names no room")
            elif ROOMS.index(target) > ROOMS.index(room):
                wrong.append(f"{place} includes {name} from a later room")
    return wrong


def files_in_a_circle(sources: Path) -> list[str]:
    """The files, a header and its source as one, that lead into a circle."""
    includes: dict[str, set[str]] = {}
    for file in (p for p in sources.rglob("*") if p.suffix in {".h", ".cpp"}):
        place = file.relative_to(sources).with_suffix("").as_posix()
        used = {name.removesuffix(".h") for name in included_by(file)}
        includes.setdefault(place, set()).update(used - {place})
    # What includes nothing that is left is in no circle, and neither is what only includes such.
    while free := {name for name, used in includes.items() if not used & includes.keys()}:
        includes = {name: used for name, used in includes.items() if name not in free}
    return sorted(includes)


def misplaced_constants(sources: Path) -> list[str]:
    """One line for every constant that no room uses, or an earlier one than its own does first."""
    wrong = []
    files = {p: p.read_text(encoding="utf-8") for p in sources.rglob("*.[hc]*")}
    for header in sorted(sources.glob("*/constants.h")):
        for name in re.findall(r"\b(k[A-Z]\w*) = ", files[header]):
            used = re.compile(rf"\b{name}\b(?! = )")
            rooms = {p.parent.name for p, text in files.items() if used.search(text)}
            if header.parent.name != min(rooms, key=ROOMS.index, default=None):
                wrong.append(f"{header.relative_to(sources)} has {name} for {sorted(rooms)}")
    return wrong


def doubled_constants(sources: Path) -> list[str]:
    """One line for every constant that two files of a room define, which are compiled as one."""
    files: dict[tuple[str, str], list[str]] = {}
    for file in sorted(sources.glob("*/*.cpp")):
        for statement in re.findall(r"^constexpr [^(;]*;", file.read_text("utf-8"), re.MULTILINE):
            for name in re.findall(r"\b(k[A-Z]\w*)(?:\[\w*\])? ?[={]", statement):
                files.setdefault((file.parent.name, name), []).append(file.name)
    return [f"{room}: {name} in {found}" for (room, name), found in files.items() if found[1:]]


def names_without_include(sources: Path) -> list[str]:
    """One line for every type that a file names and neither it nor what it includes declares.

    Where a room is compiled as one, the files before it may have included what a file forgets.
    """
    texts = {
        p.relative_to(sources).as_posix(): re.sub(
            r'//.*|"(?:\\.|[^"\\\n])*"', "", p.read_text(encoding="utf-8")
        )
        for p in sorted(p for p in sources.rglob("*") if p.suffix in {".h", ".cpp"})
    }
    includes = {name: set(included_by(sources / name)) for name in texts}
    declared = {name: set(DECLARED.findall(text)) for name, text in texts.items()}
    homes = {
        word: name
        for name, text in texts.items()
        if name.endswith(".h")
        for word in DEFINED.findall(text)
    }
    wrong = []
    for name, text in texts.items():
        seen, ahead = {name}, [name]
        while ahead:
            new = includes.get(ahead.pop(), set()) - seen
            seen |= new
            ahead += new
        known = set().union(*(declared.get(other, set()) for other in seen))
        # A word after "::" or "." is looked up within something else.
        words = set(re.findall(r"(?<![\w:.])\w+", text))
        wrong += [
            f"{name} names {word} without {homes[word]}"
            for word in sorted(words & homes.keys() - known)
        ]
    return wrong


def other_adjacency(sources: Path) -> list[str]:
    """One line for everything that knows neighbours by itself."""
    return [
        f"{file.relative_to(sources).as_posix()}: {what}"
        for file in sorted(p for p in sources.rglob("*") if p.suffix in {".h", ".cpp"})
        for what, (pattern, places) in ADJACENCY.items()
        if file.relative_to(sources).as_posix() not in places
        and re.search(pattern, file.read_text(encoding="utf-8"), re.MULTILINE)
    ]


def other_vectors(sources: Path) -> list[str]:
    """One line for every file that uses Eigen and does not have its packets from base/eigen.h."""
    wrong = []
    for file in sorted(p for p in sources.rglob("*") if p.suffix in {".h", ".cpp"}):
        place, text = file.relative_to(sources).as_posix(), file.read_text(encoding="utf-8")
        modules = set(re.findall(r"#\s*include\s*[<\"]Eigen/(\w+)", text))
        if place == "base/eigen.h" or not ("Eigen::" in text or modules):
            continue
        if modules & {"Core", "Dense", "Geometry"}:
            wrong.append(f"{place} includes Eigen's {min(modules)} instead of base/eigen.h")
        elif modules and "base/eigen.h" not in included_by(file):
            wrong.append(f"{place} includes Eigen's {min(modules)} without base/eigen.h")
        if re.search(r"namespace Eigen\b|Eigen::internal|EIGEN_\w*VECTORIZE", text):
            wrong.append(f"{place} changes Eigen")
    return wrong


def test_neighbours_are_known_by_three_meshes_and_no_fourth():
    assert other_adjacency(SOURCES) == []
    for pattern, places in ADJACENCY.values():
        for place in places:
            assert re.search(pattern, (SOURCES / place).read_text(encoding="utf-8"), re.MULTILINE)


def test_every_room_includes_only_what_stands_before_it():
    assert wrong_includes(SOURCES) == []


def test_every_file_includes_what_it_names(tmp_path):
    assert names_without_include(SOURCES) == []
    for name, text in (
        ("base/point.h", "struct Point {\n  double x;\n};\n"),
        ("mesh/face.h", '#include "base/point.h"\nusing Corners = Point*;\nclass Edge;\n'),
        ("mesh/area.cpp", '#include "mesh/face.h"\nPoint a;\nCorners b;\nEdge* c;\n'),
        ("mesh/edge.h", "class Edge {\n  int corner;\n};\n"),
        ("mesh/edges.cpp", "class Point;\nPoint* a;  // Corners\nEdge* b;\nother::Corners c;\n"),
    ):
        (tmp_path / name).parent.mkdir(exist_ok=True)
        (tmp_path / name).write_text(text, encoding="utf-8")
    assert names_without_include(tmp_path) == ["mesh/edges.cpp names Edge without mesh/edge.h"]


def test_eigen_has_its_packets_from_one_header(tmp_path):
    assert other_vectors(SOURCES) == []
    (tmp_path / "mesh").mkdir()
    for name, text in (
        ("core.h", "#include <Eigen/Core>\n"),
        ("solve.cpp", '#include <Eigen/Cholesky>\n#include "base/plane.h"\n'),
        ("right.cpp", '#include <Eigen/Cholesky>\n#include "base/eigen.h"\n'),
        ("own.cpp", "template <> struct Eigen::internal::packet_traits<float>;\n"),
    ):
        (tmp_path / "mesh" / name).write_text(text, encoding="utf-8")
    assert other_vectors(tmp_path) == [
        "mesh/core.h includes Eigen's Core instead of base/eigen.h",
        "mesh/own.cpp changes Eigen",
        "mesh/solve.cpp includes Eigen's Cholesky without base/eigen.h",
    ]


def test_a_constant_stands_in_the_first_room_that_uses_it():
    assert misplaced_constants(SOURCES) == []


def test_files_of_a_room_can_be_compiled_as_one(tmp_path):
    assert doubled_constants(SOURCES) == []
    (tmp_path / "mesh").mkdir()
    (tmp_path / "mesh" / "a.cpp").write_text("constexpr double kFar = 4, kNear = 0x1p-3;\n")
    (tmp_path / "mesh" / "b.cpp").write_text("constexpr int kTwo[2] = {\n  1, 2};\n")
    (tmp_path / "mesh" / "c.cpp").write_text("constexpr int kTwo = 2;\nconstexpr int kNear{};\n")
    assert doubled_constants(tmp_path) == [
        "mesh: kNear in ['a.cpp', 'c.cpp']",
        "mesh: kTwo in ['b.cpp', 'c.cpp']",
    ]


def shared_names(tests: Path) -> list[str]:
    """Native tests of which another's could meet a name when several are compiled as one."""
    wrong = []
    for file in sorted(tests.glob("test_*.cpp")):
        name = f"meander::test::{file.stem.removeprefix('test_')}_tests"
        text = file.read_text(encoding="utf-8")
        before, begin, rest = text.partition(f"namespace {name} {{\nnamespace {{\n")
        _, end, after = rest.partition(f"}}  // namespace\n}}  // namespace {name}\n")
        if not begin or not end:
            wrong.append(f"{file.name}: all in namespace {name} {{ namespace {{")
        # By themselves: cmake/tests.cmake.
        elif file.stem not in ("test_out_of_memory", "test_failing_calls"):
            outside = [line for line in (before + after).splitlines() if line]
            outside = [line for line in outside if not re.match(r"//|#\s*include\b", line)]
            wrong += [f"{file.name}: {line}" for line in outside]
            wrong += [f"{file.name}: {line}" for line in re.findall("#define.*", rest)]
    return wrong


def test_native_tests_can_be_compiled_as_one(tmp_path):
    assert shared_names(SOURCES.parents[1] / "tests" / "native") == []
    text = "#include <cmath>\n\nnamespace meander::test::NAME_tests {\nnamespace {\n"
    text += "}  // namespace\n}  // namespace meander::test::NAME_tests\n"
    flat = text.replace("NAME", "flat")
    for name, contents in {
        "flat": flat,
        "near": flat,
        "left": text.replace("NAME", "left") + "int left;\n",
        "known": "using namespace meander;\n" + text.replace("NAME", "known"),
        "short": text.replace("NAME", "short").replace("}  //", "#define SHORT\n}  //", 1),
    }.items():
        (tmp_path / f"test_{name}.cpp").write_text(contents)
    assert shared_names(tmp_path) == [
        "test_known.cpp: using namespace meander;",
        "test_left.cpp: int left;",
        "test_near.cpp: all in namespace meander::test::near_tests { namespace {",
        "test_short.cpp: #define SHORT",
    ]


def test_lines_of_native_code_have_120_characters_at_most():
    folders = (SOURCES, SOURCES.parents[1] / "tests", SOURCES.parents[1] / "benchmarks")
    sources = [p for folder in folders for p in folder.rglob("*.*") if p.suffix in (".h", ".cpp")]
    for path in sources:
        lines = path.read_text(encoding="utf-8").splitlines()
        assert [k for k, line in enumerate(lines, 1) if len(line) > 120] == [], path


def test_no_file_includes_itself_by_others():
    assert files_in_a_circle(SOURCES) == []


@pytest.mark.parametrize(
    ("file", "include", "complaint"),
    [
        ("base/plane.h", "mesh/surface.h", "later room"),
        ("curve/refinement.cpp", "seed/seed.h", "later room"),
        ("medial/frames.cpp", "flow/flow.h", "later room"),
        ("flow/flow.h", "outputs/cut_surface.h", "later room"),
        ("outputs/job.h", "meander/meander.h", "later room"),
        ("mesh/fields.cpp", "surface.h", "names no room"),
        ("stray.h", "base/plane.h", "stands in no room"),
    ],
)
def test_a_wrong_include_is_found(tmp_path, file, include, complaint):
    path = tmp_path / file
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(f'#pragma once\n#include "{include}"\n', encoding="utf-8")
    (found,) = wrong_includes(tmp_path)
    assert file in found
    assert complaint in found


@pytest.mark.parametrize(
    ("file", "text", "what"),
    [
        ("base/triangulation.h", "  std::vector<uint32_t> twins_;\n", "half-edges that are kept"),
        ("mesh/half.h", "    uint32_t to, next, opposite;\n", "half-edges that are kept"),
        ("mesh/half.h", "    uint32_t twin = kNothing;\n", "half-edges that are kept"),
        ("outputs/cut.cpp", "= {std::min(a, b), std::max(a, b), e};\n", "edges by their vertices"),
        ("outputs/cut.cpp", "edges.insert(std::minmax(a, b));\n", "edges by their vertices"),
        ("geodesic/front.h", "#include <OpenMesh/Core/Mesh/TriConnectivity.hh>\n", "OpenMesh"),
        ("mesh/half.cpp", "uint32_t HalfedgeMesh::split_edge(HalfEdge h) {\n", "divided faces"),
    ],
)
def test_a_fourth_mesh_is_found(tmp_path, file, text, what):
    path = tmp_path / file
    path.parent.mkdir(parents=True)
    path.write_text(text, encoding="utf-8")
    assert other_adjacency(tmp_path) == [f"{file}: {what}"]


@pytest.mark.parametrize("include", ["flow/flow.h", "meander/meander.h"])
def test_angle_brackets_hide_nothing(tmp_path, include):
    (tmp_path / "mesh").mkdir()
    path = tmp_path / "mesh" / "surface.h"
    path.write_text(f"#include <vector>\n#include <{include}>\n", encoding="utf-8")
    (found,) = wrong_includes(tmp_path)
    assert f"includes {include} from a later room" in found


@pytest.mark.parametrize(("user", "rooms"), [(None, "[]"), ("model", "['model']")])
def test_a_misplaced_constant_is_found(tmp_path, user, rooms):
    (tmp_path / "flow").mkdir()
    (tmp_path / "flow" / "constants.h").write_text("inline constexpr double kTurn = 2;\n")
    if user:
        (tmp_path / user).mkdir()
        (tmp_path / user / "weights.cpp").write_text("double a = kTurn;\n")
    assert misplaced_constants(tmp_path) == [f"flow/constants.h has kTurn for {rooms}"]


def test_a_circle_is_found(tmp_path):
    (tmp_path / "mesh").mkdir()
    for name, other in (("a.h", "b"), ("b.h", "c"), ("c.cpp", "a"), ("d.h", "a"), ("e.cpp", "f")):
        text = f'#include "mesh/{name[0]}.h"\n#include "mesh/{other}.h"\n'
        (tmp_path / "mesh" / name).write_text(text, encoding="utf-8")
    # d leads into the circle, and e and f are in none.
    assert files_in_a_circle(tmp_path) == [f"mesh/{name}" for name in "abcd"]


def test_the_picture_of_the_rooms_has_them_all_in_their_order() -> None:
    picture = SOURCES.parents[1] / "docs" / "images" / "architecture.svg"
    names = re.findall(r'<text class="name"[^>]*>([^<]+)</text>', picture.read_text("utf-8"))
    # The Python package comes first, and has a room of the same name as one of these.
    first = names.index(ROOMS[0])
    assert names[first : first + len(ROOMS)] == list(ROOMS)


def test_the_page_of_the_rooms_has_them_all_in_their_order() -> None:
    page = (SOURCES.parents[1] / "docs" / "architecture.md").read_text("utf-8")
    (order,) = re.findall(r"^\| `native/src` \| ([^|]+) \|", page, re.MULTILINE)
    assert re.findall(r"`(\w+)`", order) == list(ROOMS)
    assert re.findall(r"^\| `native/src/(\w+)` \|", page, re.MULTILINE) == list(ROOMS)
