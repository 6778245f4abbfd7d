# SPDX-License-Identifier: GPL-3.0-or-later
"""The libraries that scripts/package.sh has built, looked into and run.

MEANDER_PLATFORMS  which of them, default: all that are there
MEANDER_LONG       if set, also what takes minutes
"""

import os
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
sys.path.append(str(ROOT / "tests"))

from processor_time import pytest_runtest_protocol  # noqa: E402, F401

TOOLS = ROOT / "build/package-tools"
TARGETS = {
    "linux-x64": "x86_64-linux-gnu.2.28",
    "linux-arm64": "aarch64-linux-gnu.2.28",
    "windows-x64": "x86_64-windows-gnu",
    "windows-arm64": "aarch64-windows-gnu",
    "macos-x64": "x86_64-macos.11.0",
    "macos-arm64": "aarch64-macos.11.0",
}


def library_of(platform: str) -> Path | None:
    folder = ROOT / "build/package" / platform / "lib"
    found = [path for path in folder.glob("*meander-*") if path.suffix in (".so", ".dll", ".dylib")]
    return found[0] if found else None


def platforms() -> list[str]:
    named = os.environ.get("MEANDER_PLATFORMS", "").split()
    return named or [platform for platform in TARGETS if library_of(platform) is not None]


def pytest_generate_tests(metafunc: pytest.Metafunc) -> None:
    """A test with the argument `platform` runs for each, one with `linux` for those of Linux."""
    for name in ("platform", "linux", "windows", "macos"):
        if name in metafunc.fixturenames:
            chosen = [p for p in platforms() if name in ("platform", p.partition("-")[0])]
            metafunc.parametrize(name, chosen)


@pytest.fixture(scope="session")
def zig() -> Callable[..., None]:
    """Runs Zig, with what it builds cached where package.sh has it.

    From another folder than those above Zig: below the working directory it names its own files by
    another path, finds nothing in the cache, and builds its runtime once more, for a minute.
    """
    environment = os.environ | {
        "ZIG_GLOBAL_CACHE_DIR": str(TOOLS / "cache"), "ZIG_LOCAL_CACHE_DIR": str(TOOLS / "cache")
    }

    def run(*arguments: str | Path) -> None:
        subprocess.run([TOOLS / "zig", *arguments], env=environment, cwd=ROOT / "tests", check=True,
                       timeout=900)

    return run


@pytest.fixture(scope="session")
def runner(tmp_path_factory: pytest.TempPathFactory) -> Callable[..., str]:
    """Runs a program of a platform, by Wine or qemu where it is not this machine's; its output."""
    wine_home = tmp_path_factory.mktemp("wine")

    def run(platform: str, program: Path, *arguments: str, timeout: float = 600) -> str:
        emulator = {
            "linux-x64": [],
            "linux-arm64": ["qemu-aarch64", "-L", "/usr/aarch64-linux-gnu"],
            "windows-x64": ["wine"],
        }[platform]
        environment = os.environ | {"WINEPREFIX": str(wine_home / "prefix"), "WINEDEBUG": "-all"}
        done = subprocess.run([*emulator, program, *arguments], env=environment,
                              capture_output=True, text=True, timeout=timeout)
        assert done.returncode == 0, done.stdout + done.stderr
        return done.stdout.replace("\r\n", "\n")

    return run
