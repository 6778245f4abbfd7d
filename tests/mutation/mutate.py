# SPDX-License-Identifier: GPL-3.0-or-later
"""Mutation testing of the native library: would the tests notice if an operator were wrong?

    scripts/install_dependencies.sh --sanitizers      # has libclang for Python
    /usr/bin/python3 tests/mutation/mutate.py         # hours; interrupted, it goes on where it was

The operators of the functions in TARGETS are flipped, one at a time: arithmetic, comparisons (the
bound moved, and negated), && and ||, conditions, constants, min and max, signs; statements are left
out. All mutants of the sources are compiled at once into a copy of the project, build/mutants,
where a variable of the environment chooses one (mutants.h). First every native test runs once to
note which mutants it comes by. Then, for each mutant, the tests that come by it run, the quickest
first, up to --seconds of processor time: it is killed when one fails, crashes, or takes ten times
as long as usual. What survives is listed.

Only what is asked for is done when steps are named: write, build, reach, run, report. After a test
was added, `build reach run --again` tries the survivors again. --only takes a part of a file's
name.

build/mutants/mutants.json has the mutants, results.jsonl a line for each that was tried.
"""

from __future__ import annotations

import argparse
import json
import os
import re
import resource
import shutil
import subprocess
import sys
from collections import Counter, defaultdict
from dataclasses import asdict
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent))

from schemata import Mutant, Schemata  # noqa: E402

ROOT = Path(__file__).resolve().parents[2]
TREE = ROOT / "build" / "mutants"
HERE = Path(__file__).resolve().parent

# What is mutated: files of native/src, and functions in them.
TARGETS: dict[str, list[str]] = {
    "geodesic/geodesic_trace.cpp": ["*"],
    "curve/crossings.cpp": [
        "same",
        "between",
        "overlap",
        "FaceTest::test",
        "FaceTest::crossing",
        "FaceTest::meets",
        "touch",
    ],
    "model/energy.cpp": [
        "power",
        "medial_force",
        "medial_stiffness",
        "medial_energy",
        "across_field",
        "power_factors",
        "Assembly::wrapped",
        "Assembly::add_gradient",
        "Assembly::stiffen_along",
        "Assembly::add_length",
        "Assembly::add_field",
        "Assembly::add_medial",
        "Assembly::add_bending",
        "Assembly::eliminate_fixed",
        "add_end_term",
        "energy",
    ],
    "medial/curve_bvh.cpp": [
        "rounded_down",
        "rounded_up",
        "CurveBvh::shrinks_to",
        "CurveBvh::largest_ball_among",
    ],
    "medial/medial_axis.cpp": ["*"],
    "flow/convergence.cpp": ["*"],
    "flow/weighting.cpp": ["*"],
    "curve/retraction.cpp": ["*"],
    "curve/refinement.cpp": ["*"],
    "geodesic/surface_patches.cpp": [
        "Comparison::alike",
        "Comparison::is_stacked",
        "Comparison::compare",
        "Comparison::note_crease",
        "Comparison::measure_from",
    ],
    "mesh/mesh_check.cpp": ["*"],
}

LIMIT_FACTOR, LIMIT_LEAST = 10, 1  # of a test's usual processor time, and seconds
MEMORY = 4 << 30  # bytes
COPIED = ["CMakeLists.txt", "CMakePresets.json", "LICENSE", "THIRD_PARTY_NOTICES.md"]
COPIED += ["cmake", "native", "tests/native", "tests/sweep", "scripts", "addon/meander"]

Key = tuple[str, int, int, str, str]


def key_of(m: Mutant) -> Key:
    return (m.file, m.line, m.column, m.was, m.becomes)


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    steps = ["write", "build", "reach", "run", "report"]
    parser.add_argument("steps", nargs="*", metavar="STEP", help=f"some of: {' '.join(steps)}")
    parser.add_argument("--only", default="", help="a part of the names of the files to try")
    parser.add_argument("--seconds", type=float, default=10, help="processor time for a mutant")
    parser.add_argument("--again", action="store_true", help="try those that survived again")
    options = parser.parse_args()
    if not set(options.steps) <= set(steps):
        parser.error(f"steps are {' '.join(steps)}")
    chosen = options.steps or steps
    if "write" in chosen or "build" in chosen:
        copy_project()
    if "write" in chosen:
        write()
    if "build" in chosen:
        build()
    if "reach" in chosen:
        reach()
    if "run" in chosen:
        run(options.only, options.seconds, options.again)
    if "report" in chosen:
        report(options.only)
    return 0


# The copy of the project


def copy_project() -> None:
    """Brings what has changed into the copy; mutated sources keep what `write` has made of them."""
    for part in COPIED:
        source = ROOT / part
        files = [source] if source.is_file() else sorted(f for f in source.rglob("*"))
        for file in files:
            name = file.relative_to(ROOT)
            mutated = str(name).removeprefix("native/src/") in TARGETS
            if file.is_file() and file.suffix not in {".so", ".pyc"} and not mutated:
                put(TREE / name, file.read_bytes())
    put(TREE / "native/src/mutants.h", (HERE / "mutants.h").read_bytes())
    put(TREE / "tests/native/reached.cpp", (HERE / "reached.cpp").read_bytes())


def put(path: Path, content: bytes) -> None:
    """Writes the file unless it is like that already, so that nothing is compiled in vain."""
    if not path.exists() or path.read_bytes() != content:
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_bytes(content)


def compiler_arguments() -> list[str]:
    folders = [ROOT / "native/src", ROOT / "native/include", TREE / "build/generated"]
    eigen = subprocess.run(
        ["pkg-config", "--cflags", "eigen3"], capture_output=True, text=True, check=True
    )
    return ["-xc++", "-std=c++20", "-w", *(f"-I{f}" for f in folders), *eigen.stdout.split()]


def write() -> None:
    """Writes the mutated sources, without the mutants that do not compile."""
    configure()
    arguments = compiler_arguments()
    first, every, left_out = 1, [], 0
    for name, functions in TARGETS.items():
        dropped: frozenset[tuple[int, int, str]] = frozenset()
        while True:
            schemata = Schemata(ROOT / "native/src" / name, name, functions, first, dropped)
            schemata.collect(arguments)
            missing = set(functions) - schemata.found - {"*"}
            if missing:
                raise SystemExit(f"{name} has no function {', '.join(sorted(missing))}")
            put(TREE / "native/src" / name, schemata.mutated().encode())
            more = not_compiling(TREE / "native/src" / name, schemata)
            if not more:
                break
            dropped |= more
        complete = Schemata(ROOT / "native/src" / name, name, functions, first)
        complete.collect(arguments)
        left_out += len(complete.mutants) - len(schemata.mutants)
        every += schemata.mutants
        first += len(schemata.mutants)
        print(f"{name}: {len(schemata.mutants)} mutants", flush=True)
    table = {"mutants": [asdict(m) for m in every], "left out": left_out}
    put(TREE / "mutants.json", json.dumps(table, indent=1).encode())
    print(f"{len(every)} mutants; {left_out} more do not compile")


def not_compiling(path: Path, schemata: Schemata) -> frozenset[tuple[int, int, str]]:
    """Which mutants to leave out next: constants near errors, or else all that are near them."""
    command = ["g++", *compiler_arguments(), "-fsyntax-only", str(path)]
    command[1:1] = [f"-I{TREE / 'native/src'}"]
    done = subprocess.run(command, capture_output=True, text=True)
    if done.returncode == 0:
        return frozenset()
    said = re.compile(rf"^{re.escape(str(path))}:(\d+):\d+:.*(?:error:|required from)", re.M)
    lines = {int(line) for line in said.findall(done.stderr)}
    if not lines:
        raise SystemExit(f"{path} does not compile:\n{done.stderr[:3000]}")
    faulty: list[Mutant] = []
    for around in range(100):  # an expression may begin lines before its error
        if not faulty:
            near = {line + k for line in lines for k in (-around, around)}
            faulty = [m for m in schemata.mutants if m.line in near]
    constants = [m for m in faulty if m.was[0].isdigit()]
    return frozenset((m.line, m.column, m.was) for m in constants or faulty)


def configure() -> None:
    """With checks of indices and the like, so that a mutant that reads beyond an end dies of it."""
    if not (TREE / "build/build.ninja").exists():
        options = [
            "-DCMAKE_CXX_FLAGS=-D_GLIBCXX_ASSERTIONS",
            "-DMEANDER_UNITY=ON",
            "-DMEANDER_STAGE=OFF",
            "-DPython3_EXECUTABLE=/usr/bin/python3",
        ]
        command = ["cmake", "-S", TREE, "-B", TREE / "build", "-G", "Ninja", *options]
        subprocess.run(command, check=True, stdout=subprocess.DEVNULL)


def programs() -> list[str]:
    return sorted(f.stem for f in (ROOT / "tests/native").glob("test_*.cpp"))


def build() -> None:
    configure()
    subprocess.run(["ninja", "-C", TREE / "build", "-j1", *programs()], check=True)


# Which test comes by which mutant


def reach() -> None:
    """Runs every test once, unless its program is older than what is known of it."""
    for program in programs():
        binary, file = TREE / "build" / program, TREE / "reached" / f"{program}.txt"
        if not binary.exists():
            raise SystemExit(f"{program} is not built: mutate.py build")
        if file.exists() and file.stat().st_mtime > binary.stat().st_mtime:
            continue
        file.parent.mkdir(exist_ok=True)
        part = file.with_suffix(".part")
        part.unlink(missing_ok=True)
        environment = {**os.environ, "MEANDER_MUTANT": "-1", "MEANDER_REACHED": str(part)}
        done = subprocess.run([binary, "--gtest_brief=1"], env=environment, capture_output=True)
        if done.returncode != 0:
            raise SystemExit(f"{program} fails without a mutant:\n{done.stdout.decode()[-2000:]}")
        part.rename(file)
        print(f"{program} was run", flush=True)


Reached = dict[int, list[tuple[float, str, str]]]


def tests_of_mutants() -> Reached:
    """For every number the tests that come by it: seconds, program, test."""
    table: Reached = defaultdict(list)
    for file in sorted((TREE / "reached").glob("*.txt")):
        for line in file.read_text().splitlines():
            name, seconds, *numbers = line.split()
            for number in numbers:
                table[int(number)].append((float(seconds), file.stem, name))
    return table


# One mutant after another


def run(only: str, seconds: float, again: bool) -> None:
    table = tests_of_mutants()
    known = results()
    killers: dict[str, Counter[str]] = defaultdict(Counter)  # of each file's mutants
    # Every third one first, so that a run that is interrupted is a sample of the whole.
    for mutant in sorted(mutants(), key=lambda m: m.number % 3):
        before = known.get(key_of(mutant))
        if only not in mutant.file:
            continue
        if before and (before["outcome"] == "killed" or not again):
            continue
        result = {"key": key_of(mutant), "function": mutant.function}
        tests = table.get(mutant.number, [])
        own = f"test_{Path(mutant.file).stem}"
        result |= try_mutant(mutant.number, tests, seconds, own, killers[mutant.file])
        with (TREE / "results.jsonl").open("a") as file:
            file.write(json.dumps(result) + "\n")
        if result["outcome"] != "killed":
            print(f"{result['outcome']}: {in_words(mutant)}", flush=True)


def try_mutant(
    number: int,
    tests: list[tuple[float, str, str]],
    seconds: float,
    own: str,
    killers: Counter[str],
) -> dict[str, object]:
    """Runs the tests of one mutant, the quickest first, until one fails.

    `own` is the program that is named like the file: it begins, and all of its tests run. Programs
    that have killed many mutants of the file follow; this one's is added to `killers`.
    """
    if not tests:
        return {"outcome": "not reached"}
    spent = 0.0
    groups: dict[str, list[tuple[float, str]]] = defaultdict(list)
    for cost, program, test in sorted(tests):
        if spent + cost > seconds and program != own:
            continue
        spent += cost
        groups[program].append((cost, test))
    cost_of = {program: sum(cost for cost, _ in chosen) for program, chosen in groups.items()}
    order = sorted(groups, key=lambda p: (p != own, -killers[p], cost_of[p]))
    for program in order:
        chosen = groups[program]
        how = failure(
            TREE / "build" / program, [test for _, test in chosen], number, cost_of[program]
        )
        if how:
            killers[program] += 1
            return {"outcome": "killed", "by": program, "how": how}
    return {
        "outcome": "survived",
        "seconds": round(spent, 2),
        "of": round(sum(t[0] for t in tests), 2),
    }


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


def mutants() -> list[Mutant]:
    return [Mutant(**m) for m in json.loads((TREE / "mutants.json").read_text())["mutants"]]


def results() -> dict[Key, dict[str, str]]:
    path = TREE / "results.jsonl"
    lines = path.read_text().splitlines() if path.exists() else []
    return {tuple(r["key"]): r for r in map(json.loads, lines)}


def in_words(m: Mutant) -> str:
    return f"{m.file}:{m.line}:{m.column} {m.function}: {m.was} -> {m.becomes}    {m.text}"


def report(only: str) -> None:
    """Prints how many mutants of each file were killed, by which program, and what survived."""
    known = results()
    rows: dict[str, Counter[str]] = defaultdict(Counter)
    by: Counter[str] = Counter()
    alive = []
    for mutant in mutants():
        result = known.get(key_of(mutant), {"outcome": "not tried"})
        rows[mutant.file][result["outcome"]] += 1
        if result["outcome"] == "killed":
            by[result["by"]] += 1
        elif only in mutant.file:
            alive.append(f"{result['outcome']}: {in_words(mutant)}")
    print("\n".join(alive))
    for file, counts in rows.items():
        row = {"row": "mutants", "file": file, "mutants": sum(counts.values())}
        row |= {"killed": counts["killed"], "not tried": counts["not tried"]}
        print(json.dumps(row | {"alive": counts["survived"] + counts["not reached"]}))
    print("killed by:", ", ".join(f"{name} {count}" for name, count in by.most_common()))


if __name__ == "__main__":
    shutil.which("ninja") or sys.exit("ninja is missing: scripts/install_dependencies.sh")
    sys.exit(main())
