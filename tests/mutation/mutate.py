# SPDX-License-Identifier: GPL-3.0-or-later
"""Mutation testing of the native library: would the tests notice if an operator were wrong?

    scripts/install_dependencies.sh --sanitizers      # has libclang for Python
    /usr/bin/python3 tests/mutation/mutate.py         # hours; interrupted, it goes on where it was

The operators of TARGETS are changed, one at a time: arithmetic, comparisons (the bound moved, and
negated), operands of && and ||, conditions, constants, min and max, signs; statements are left out.
All mutants of the sources are compiled at once into a copy of the project, build/mutants, where a
variable of the environment chooses one (mutants.h). First every native test runs once to note which
mutants it comes by. Then, for each mutant, the tests that come by it run, the quickest first, up to
--seconds of processor time: it is killed when one fails, crashes, or takes ten times as long as
usual. What survives is listed.

After a test was added, --again tries the survivors again. --only takes a part of a file's name.

build/mutants/results.jsonl has a line for each that was tried.
"""

from __future__ import annotations

import argparse
import json
import os
import re
import resource
import subprocess
import sys
from collections import Counter, defaultdict
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent))

from schemata import Mutant, Schemata  # noqa: E402

ROOT = Path(__file__).resolve().parents[2]
TREE = ROOT / "build" / "mutants"

# What is mutated: files of native/src, of some of them only these functions and classes.
TARGETS = {
    "geodesic/geodesic_trace.cpp": "",
    "curve/crossings.cpp": "same between overlap FaceTest touch",
    "model/energy.cpp": "power medial_force medial_stiffness medial_energy across_field"
    " power_factors Assembly add_end_term energy",
    "medial/lanes.h": "rounded_down rounded_up",
    "medial/ball_limit.h": "take shrink lanes_inside",
    "medial/empty_balls.h": "largest_ball",
    "medial/medial_axis.cpp": "",
    "flow/convergence.cpp": "",
    "flow/weighting.cpp": "",
    "curve/retraction.cpp": "",
    "curve/refinement.cpp": "",
    "geodesic/patch_comparison.cpp": "Comparison",
    "mesh/mesh_check.cpp": "",
}

LIMIT_FACTOR, LIMIT_LEAST = 10, 1  # of a test's usual processor time, and seconds
MEMORY = 4 << 30  # bytes
COPIED = ["CMakeLists.txt", "CMakePresets.json", "LICENSE", "THIRD_PARTY_NOTICES.md"]
COPIED += ["cmake", "native", "tests/native", "tests/sweep", "scripts", "addon/meander"]

Tests = list[tuple[float, str, str]]  # seconds, program, test


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--only", default="", help="a part of the names of the files to try")
    parser.add_argument("--seconds", type=float, default=10, help="processor time for a mutant")
    parser.add_argument("--again", action="store_true", help="try those that survived again")
    options = parser.parse_args()
    copy_project()
    mutants = write()
    subprocess.run(["ninja", "-C", TREE / "build", "-j1", *programs()], check=True)
    reach()
    run([m for m in mutants if options.only in m.file], options.seconds, options.again)
    report(mutants)
    return 0


# The copy of the project


def copy_project() -> None:
    """Brings what has changed into the copy, and configures it with checks of indices and the like,
    so that a mutant that reads beyond an end dies of it."""
    for source in (ROOT / part for part in COPIED):
        for file in [source] if source.is_file() else source.rglob("*"):
            name = file.relative_to(ROOT)
            mutated = str(name).removeprefix("native/src/") in TARGETS
            if file.is_file() and file.suffix not in {".so", ".pyc"} and not mutated:
                put(TREE / name, file.read_bytes())
    put(TREE / "native/src/mutants.h", Path(__file__).with_name("mutants.h").read_bytes())
    for name in TARGETS:
        if not (TREE / "native/src" / name).exists():
            put(TREE / "native/src" / name, b"")
    if not (TREE / "build/build.ninja").exists():
        options = [
            "-DCMAKE_CXX_FLAGS=-D_GLIBCXX_ASSERTIONS",
            "-DMEANDER_UNITY=ON",
            "-DMEANDER_STAGE=OFF",
            "-DPython3_EXECUTABLE=/usr/bin/python3",
        ]
        command = ["cmake", "-S", TREE, "-B", TREE / "build", "-G", "Ninja", *options]
        subprocess.run(command, check=True, stdout=subprocess.DEVNULL)


def put(path: Path, content: bytes) -> None:
    """Writes the file unless it is like that already, so that nothing is compiled in vain."""
    if not path.exists() or path.read_bytes() != content:
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_bytes(content)


def compiler_arguments() -> list[str]:
    folders = [ROOT / "native/src", ROOT / "native/include", TREE / "build/generated"]
    folders += [TREE / "native/src"]  # mutants.h
    eigen = subprocess.run(
        ["pkg-config", "--cflags", "eigen3"], capture_output=True, text=True, check=True
    )
    vectors = ["-DEIGEN_DONT_VECTORIZE", "-DEIGEN_VECTORIZE"]  # as cmake/library.cmake has them
    included = (f"-I{folder}" for folder in folders)
    return ["-xc++", "-std=c++20", "-w", *vectors, *included, *eigen.stdout.split()]


def write() -> list[Mutant]:
    """Writes the mutated sources, without the mutants that do not compile."""
    arguments = compiler_arguments()
    every: list[Mutant] = []
    for name, functions in TARGETS.items():
        source, first = ROOT / "native/src" / name, len(every) + 1
        dropped: set[tuple[int, int, str]] = set()
        while True:
            schemata = Schemata(source, arguments, functions.split(), first, dropped)
            put(TREE / "native/src" / name, schemata.mutated.encode())
            more = not_compiling(TREE / "native/src" / name, arguments, schemata.mutants)
            if not more:
                break
            dropped |= more
        for mutant in schemata.mutants:
            mutant.file = name
        every += schemata.mutants
        print(f"{name}: {len(schemata.mutants)} mutants, not in {len(dropped)} places", flush=True)
    return every


def not_compiling(
    path: Path, arguments: list[str], mutants: list[Mutant]
) -> set[tuple[int, int, str]]:
    """Which to leave out next: the constants that are nearest to errors, or else all that are."""
    command = ["g++", *arguments, "-fsyntax-only", str(path)]
    done = subprocess.run(command, capture_output=True, text=True)
    if done.returncode == 0:
        return set()
    said = re.compile(rf"^{re.escape(str(path))}:(\d+):\d+:.*(?:error:|required from)", re.M)
    lines = {int(line) for line in said.findall(done.stderr)}
    if not lines or not mutants:
        raise SystemExit(f"{path} does not compile:\n{done.stderr[:3000]}")
    # An expression may begin lines before its error.
    faulty: set[tuple[int, int, str]] = set()
    for line in lines:
        least = min(abs(m.line - line) for m in mutants)
        faulty |= {m.place for m in mutants if abs(m.line - line) == least}
    return {place for place in faulty if place[2][0].isdigit()} or faulty


def programs() -> list[str]:
    return sorted(f.stem for f in (ROOT / "tests/native").glob("test_*.cpp"))


# Which test comes by which mutant


def reach() -> None:
    """Runs every test by itself, unless its program is older than what is known of it."""
    for program in programs():
        binary, file = TREE / "build" / program, TREE / "reached" / f"{program}.txt"
        if file.exists() and file.stat().st_mtime > binary.stat().st_mtime:
            continue
        file.parent.mkdir(exist_ok=True)
        part = file.with_suffix(".part")
        lines = []
        for test in tests_of(binary):
            environment = {**os.environ, "MEANDER_MUTANT": "-1", "MEANDER_REACHED": str(part)}
            begin = resource.getrusage(resource.RUSAGE_CHILDREN)
            command = [binary, f"--gtest_filter={test}"]
            done = subprocess.run(command, env=environment, capture_output=True)
            if done.returncode != 0:
                said = done.stdout.decode()[-2000:]
                raise SystemExit(f"{program} fails without a mutant:\n{said}")
            end = resource.getrusage(resource.RUSAGE_CHILDREN)
            seconds = end.ru_utime - begin.ru_utime + end.ru_stime - begin.ru_stime
            lines.append(f"{test} {seconds:.3f} {' '.join(part.read_text().split())}")
        part.unlink()
        file.write_text("\n".join(lines))
        print(f"{program} was run", flush=True)


def tests_of(program: Path) -> list[str]:
    """The names of its tests, of which GoogleTest lists each suite's below the suite."""
    listed = subprocess.run([program, "--gtest_list_tests"], capture_output=True, text=True)
    suite, names = "", []
    for line in listed.stdout.splitlines():
        name = line.split("#")[0].rstrip()
        if name.startswith(" "):
            names.append(suite + name.strip())
        elif name.endswith("."):
            suite = name
    return names


def tests_of_mutants() -> dict[int, Tests]:
    """For every number the tests that come by it."""
    table: dict[int, Tests] = defaultdict(list)
    for file in (TREE / "reached").glob("*.txt"):
        for line in file.read_text().splitlines():
            name, seconds, *numbers = line.split()
            for number in numbers:
                table[int(number)].append((float(seconds), file.stem, name))
    return table


# One mutant after another


def run(mutants: list[Mutant], seconds: float, again: bool) -> None:
    table, known = tests_of_mutants(), results()
    # Every third one first, so that a run that is interrupted is a sample of the whole.
    for mutant in sorted(mutants, key=lambda m: m.number % 3):
        outcome = known.get(in_words(mutant))
        if outcome == "killed" or (outcome and not again):
            continue
        own = f"test_{Path(mutant.file).stem}"
        result = try_mutant(mutant.number, table.get(mutant.number, []), seconds, own)
        with (TREE / "results.jsonl").open("a") as file:
            file.write(json.dumps({"mutant": in_words(mutant), **result}) + "\n")
        if result["outcome"] != "killed":
            print(f"{result['outcome']}: {in_words(mutant)}", flush=True)


def try_mutant(number: int, tests: Tests, seconds: float, own: str) -> dict[str, object]:
    """Runs the tests of one mutant, the quickest first, until one fails.

    `own` is the program that is named like the file: it begins, and all of its tests run.
    """
    spent = 0.0
    groups: dict[str, Tests] = defaultdict(list)
    for test in sorted(tests):
        if spent + test[0] <= seconds or test[1] == own:
            spent += test[0]
            groups[test[1]].append(test)
    usual = {program: sum(test[0] for test in chosen) for program, chosen in groups.items()}
    for program in sorted(groups, key=lambda p: (p != own, usual[p])):
        names = [test[2] for test in groups[program]]
        how = failure(TREE / "build" / program, names, number, usual[program])
        if how:
            return {"outcome": "killed", "by": program, "how": how}
    return {"outcome": "survived" if tests else "not reached", "seconds": round(spent, 2)}


def failure(program: Path, tests: list[str], number: int, usual: float) -> str | None:
    """How these tests of a program end with a mutant, or None if they pass."""
    limit = int(LIMIT_FACTOR * usual + LIMIT_LEAST)

    def limits() -> None:
        resource.setrlimit(resource.RLIMIT_CPU, (limit, limit))
        resource.setrlimit(resource.RLIMIT_AS, (MEMORY, MEMORY))
        resource.setrlimit(resource.RLIMIT_CORE, (0, 0))

    command = [program, f"--gtest_filter={':'.join(tests)}", "--gtest_fail_fast"]
    try:
        done = subprocess.run(
            command,
            env={**os.environ, "MEANDER_MUTANT": str(number)},
            capture_output=True,
            preexec_fn=limits,
            timeout=60 + 20 * limit,  # of a process that sleeps for ever
        )
    except subprocess.TimeoutExpired:
        return "waits"
    if done.returncode == 0:
        return None
    failed = re.search(rb"\[  FAILED  \] (\S+)", done.stdout)
    if failed and done.returncode == 1:
        return failed[1].decode().rstrip(",")
    return "time" if done.returncode in {-24, -9} else "crash"


# What came of it


def in_words(m: Mutant) -> str:
    return f"{m.file}:{m.line}:{m.column} {m.function}: {m.was} -> {m.becomes}    {m.text}"


def results() -> dict[str, str]:
    """What came of each mutant, in words."""
    path = TREE / "results.jsonl"
    lines = path.read_text().splitlines() if path.exists() else []
    return {found["mutant"]: found["outcome"] for found in map(json.loads, lines)}


def report(mutants: list[Mutant]) -> None:
    """Prints what survived, and how many mutants of each file were killed."""
    known = results()
    rows: dict[str, Counter[str]] = defaultdict(Counter)
    for mutant in mutants:
        outcome = known.get(in_words(mutant), "not tried")
        rows[mutant.file][outcome] += 1
        if outcome != "killed":
            print(f"{outcome}: {in_words(mutant)}")
    for file, counts in rows.items():
        row = {"row": "mutants", "file": file, "mutants": sum(counts.values())}
        row |= {"killed": counts["killed"], "not tried": counts["not tried"]}
        print(json.dumps(row | {"alive": counts["survived"] + counts["not reached"]}))


if __name__ == "__main__":
    sys.exit(main())
