#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Compare an old and a new build of the library, or one build with the authors' program.

    bench.py NEW [options]            measure one build
    bench.py OLD NEW [options]        measure two, case by case in turns: A B A B ...
    bench.py NEW --group scale        large curves from a mesh file to a curve file, see scale.py

A build is a folder that holds meander_bench and lib/, or a library file. Two library files, and a
file beside a folder, are measured by the same meander_bench: the folder's, or the one in build/.
Two folders use their own, which is what to do once the ABI has changed between them.

Prints one JSON object per line: a row for every case with the medians of both sides and the ratio
old / new (above 1: the new build is faster), then one with the geometric means. docs/performance.md
explains the keys. A table for people goes to stderr.
"""

from __future__ import annotations

import argparse
import json
import math
import os
import statistics
import subprocess
import sys
from pathlib import Path

import scale

# Seconds of the authors' program, single-threaded, which is its fastest: medians of 3.
AUTHORS_SECONDS = {"bunny": 2.23, "spot": 3.55, "hand_closed": 2.65, "stuffedtoy": 19.95}

FIGURES = (
    "seconds",
    "cpu_seconds",
    "iteration_seconds",
    "iteration_cpu_seconds",
    "floor_ratio",
    "floor_cpu_ratio",
    "memory_bytes",
)
QUALITY = (
    "faces",
    "nodes",
    "iterations",
    "packing",
    "near_target",
    "spacing_p05",
    "coverage_p99",
    "coverage_max",
)


def geometric_mean(values: list[float]) -> float:
    return math.exp(statistics.fmean(math.log(v) for v in values))


class Build:
    def __init__(self, name: str, path: Path, default_program: Path | None):
        self.name = name
        if path.is_dir():
            self.program, self.library = path / "meander_bench", None
        else:
            self.program, self.library = default_program, path
        for file in (self.program, self.library):
            if file is not None and not file.is_file():
                sys.exit(f"bench.py: {file} is not there; build it first")

    def run(self, arguments: list[str]) -> str:
        command = [str(self.program.resolve()), *arguments]
        if self.library:
            command += ["--library", str(self.library.resolve())]
        done = subprocess.run(command, stdout=subprocess.PIPE, text=True)
        # 1: a case failed, and its row says so.
        if done.returncode not in (0, 1):
            sys.exit(f"bench.py: {self.program} ended with code {done.returncode}")
        return done.stdout

    def measure(self, case: tuple[str, str, str, str], common: list[str]) -> dict:
        group, name, preset, threads = case
        out = self.run(
            ["--group", group, "--case", name, "--preset", preset, "--threads", threads, *common]
        )
        return next(row for row in map(json.loads, out.splitlines()) if row["row"] == "case")


def summary_of(runs: list[dict]) -> dict:
    """Medians of the figures; quality does not vary between runs of the same build."""
    row = {key: statistics.median(run[key] for run in runs) for key in FIGURES}
    row["all_seconds"] = [run["seconds"] for run in runs]
    row["all_cpu_seconds"] = [run["cpu_seconds"] for run in runs]
    row.update({key: runs[0][key] for key in QUALITY})
    row["stop_reason"] = runs[0]["stop_reason"]
    row["stages"] = {
        key: statistics.median(run["stages"][key] for run in runs) for key in runs[0]["stages"]
    }
    row["fingerprints"] = sorted({run["fingerprint"] for run in runs})
    return row


def compare(case: tuple[str, str, str, str], runs: dict[str, list[dict]], by: str) -> dict:
    group, name, preset, threads = case
    row = {"row": "pair" if "old" in runs else "single", "group": group, "case": name}
    row.update(preset=preset, threads=int(threads))
    errors = [run["error"] for side in runs.values() for run in side if "error" in run]
    if errors:
        row["error"] = errors[0]
        return row
    for side, measured in runs.items():
        row[side] = summary_of(measured)
    if "old" in runs:
        row["ratio"] = row["old"][by] / row["new"][by]
        row["iteration_ratio"] = row["old"]["iteration_cpu_seconds"] / row["new"][
            "iteration_cpu_seconds"]
        # Each new run against the old run just before it: load from other programs hits both alike.
        row["all_ratios"] = [o[by] / n[by] for o, n in zip(runs["old"], runs["new"])]
        row["same_bytes"] = row["old"]["fingerprints"] == row["new"]["fingerprints"]
    if name in AUTHORS_SECONDS and group in ("models", "threads"):
        row["authors_ratio"] = AUTHORS_SECONDS[name] / row["new"][by]
    return row


def print_line(row: dict, by: str) -> None:
    head = f"{row['group']:<10}{row['case']:<20}{row['preset']:<7}{row['threads']:>3}"
    if "error" in row:
        print(f"{head}  {row['error']}", file=sys.stderr)
        return
    new = row["new"]
    line = f"{head}{new['nodes']:>9}{new['iterations']:>6}"
    line += f"{row['old'][by]:>10.3f}" if "old" in row else f"{'':>10}"
    line += f"{new[by]:>10.3f}"
    line += f"{row['ratio']:>8.2f}" if "ratio" in row else f"{'':>8}"
    line += f"{row['authors_ratio']:>9.2f}" if "authors_ratio" in row else f"{'':>9}"
    line += f"{new['floor_cpu_ratio']:>8.2f}{new['near_target']:>7.3f}{new['coverage_p99']:>6.2f}"
    if "same_bytes" in row:
        line += "  same bytes" if row["same_bytes"] else "  other curve"
    print(line, file=sys.stderr, flush=True)


def means_of(rows: list[dict]) -> list[dict]:
    """Geometric means for every group, preset and number of threads."""
    groups = {}
    for row in rows:
        if "error" not in row:
            groups.setdefault((row["group"], row["preset"], row["threads"]), []).append(row)
    means = []
    for (group, preset, threads), chosen in groups.items():
        mean = {"row": "mean", "group": group, "preset": preset, "threads": threads}
        mean["cases"] = len(chosen)
        for key in ("ratio", "iteration_ratio", "authors_ratio"):
            values = [r[key] for r in chosen if key in r]
            if values:
                mean[key] = geometric_mean(values)
                mean["least_" + key] = min(values)
        means.append(mean)
    return means


def parsed_arguments() -> argparse.Namespace:
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("builds", nargs="+", type=Path, help="[OLD] NEW: folders or libraries")
    parser.add_argument("--repeat", type=int, default=3, help="rounds of A B (default: 3)")
    parser.add_argument(
        "--by",
        choices=("seconds", "cpu_seconds"),
        default="seconds",
        help="what ratios are made of; cpu_seconds with --threads 1 on a busy machine",
    )
    for option in ("--group", "--case"):
        parser.add_argument(option, action="append", default=[], help="may be given again")
    for option in ("--preset", "--threads", "--models", "--iterations", "--most-nodes"):
        parser.add_argument(option, help="as meander_bench has it")
    parser.add_argument(
        "--check", action="store_true",
        help="of the group scale: write curves as .npz, and look for crossings in the files",
    )  # fmt: skip
    given = parser.parse_args()
    if len(given.builds) > 2:
        parser.error("one build or two")
    if given.repeat < 1:
        parser.error("--repeat wants a positive number")
    return given


def measure_scale(given: argparse.Namespace) -> None:
    """The group measured through the batch command: up to a million nodes, or --most-nodes."""
    build = given.builds[-1]
    library = next(build.glob("lib/libmeander-*.so")) if build.is_dir() else build
    most = int(given.most_nodes or 1_000_000)
    failed = False
    threads = given.threads or str(os.cpu_count())
    for row in scale.rows(library.resolve(), most, threads, given.check):
        print(json.dumps(row), flush=True)
        failed |= "error" in row
    if failed:
        sys.exit(1)


def main() -> None:
    given = parsed_arguments()
    if given.group == ["scale"]:
        measure_scale(given)
        return
    folders = [path for path in given.builds if path.is_dir()]
    beside = folders[-1] if folders else Path(__file__).resolve().parents[1] / "build"
    names = ["new"] if len(given.builds) == 1 else ["old", "new"]
    builds = [
        Build(name, path, beside / "meander_bench") for name, path in zip(names, given.builds)
    ]

    common = []
    for option in ("models", "iterations"):
        if getattr(given, option):
            common += [f"--{option}", getattr(given, option)]
    selection = list(common)
    for option in ("group", "case"):
        for value in getattr(given, option):
            selection += [f"--{option}", value]
    for option in ("preset", "threads", "most_nodes"):
        if getattr(given, option):
            selection += [f"--{option.replace('_', '-')}", getattr(given, option)]
    cases = [tuple(line.split()) for line in builds[-1].run(["--list", *selection]).splitlines()]

    print(
        f"{'group':<10}{'case':<20}{'preset':<7}{'thr':>3}{'nodes':>9}{'iter':>6}{'old':>10}"
        f"{'new':>10}{'ratio':>8}{'authors':>9}{'/floor':>8}{'near':>7}{'p99':>6}",
        file=sys.stderr,
    )
    rows = []
    for case in cases:
        runs = {build.name: [] for build in builds}
        for _ in range(given.repeat):
            for build in builds:
                runs[build.name].append(build.measure(case, common))
        row = compare(case, runs, given.by)
        rows.append(row)
        print(json.dumps(row), flush=True)
        print_line(row, given.by)
    for mean in means_of(rows):
        print(json.dumps(mean))
        figures = ", ".join(f"{k} {v:.3f}" for k, v in mean.items() if isinstance(v, float))
        if figures:
            name = f"{mean['group']} {mean['preset']}, {mean['threads']} threads"
            print(f"geometric means, {name}, {mean['cases']} cases: {figures}", file=sys.stderr)
    if any("error" in row for row in rows):
        sys.exit(1)


if __name__ == "__main__":
    main()
