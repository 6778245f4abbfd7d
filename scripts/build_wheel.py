# SPDX-License-Identifier: GPL-3.0-or-later
"""Packs the Python package into a wheel: `binding`, `core`, `model`, `cli` and `jobs` of the
add-on, the modules in python/meander, and one platform's library.

    python3 scripts/build_wheel.py [--library FILE] [--platform TAG] [--folder FOLDER]

By itself it takes the library that scripts/build.sh has made for this machine. The same contents
give the same bytes. Where there is no library yet `pip install .` builds one (pyproject.toml).
"""

from __future__ import annotations

import argparse
import base64
import hashlib
import importlib
import sys
import sysconfig
import tomllib
import types
import zipfile
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from make_addon_zip import SKIPPED_FOLDERS, SKIPPED_SUFFIXES, TIMESTAMP, literal, record_of

ROOT = Path(__file__).resolve().parents[1]
ADDON = ROOT / "addon" / "meander"
OWN = ROOT / "python" / "meander"
# What knows nothing of Blender: .importlinter holds that.
ROOMS = ("binding", "core.py", "model", "cli", "jobs")
PACKAGE = "meander"


def project() -> dict[str, Any]:
    """The table [project] of pyproject.toml, with the version."""
    with (ROOT / "pyproject.toml").open("rb") as file:
        table = tomllib.load(file)["project"]
    return table | {"version": literal(ADDON / "binding" / "abi.py", "VERSION")}


def this_platform() -> str:
    """The platform tag of the Python that runs this."""
    return sysconfig.get_platform().replace("-", "_").replace(".", "_")


def built_library() -> Path:
    """The library of this machine. Raises SystemExit where there is none or several."""
    names = ("libmeander-*.so", "libmeander-*.dylib", "meander-*.dll")
    found = [path for name in names for path in sorted((ADDON / "native").glob(f"*/{name}"))]
    if len(found) != 1:
        raise SystemExit(
            f"{len(found)} libraries in {ADDON / 'native'}: run scripts/build.sh stage, or name "
            "one with --library"
        )
    return found[0]


def _system_of(library: Path) -> str:
    """What a library was built for, as `binding` calls it and looks for it: "linux-x64"."""
    # Without the package around it, which is for Blender.
    package = types.ModuleType("meander_binding")
    package.__path__ = [str(ADDON / "binding")]
    sys.modules["meander_binding"] = package
    system = importlib.import_module("meander_binding.library_file").built_for(library)
    if system is None:
        raise SystemExit(f"{library} is not a library of a platform that Meander knows")
    return system


def contents(library: Path) -> dict[str, bytes]:
    """Name inside the wheel -> what it holds."""
    files: dict[str, Path] = {}
    for base, rooms in ((OWN, ["."]), (ADDON, ROOMS)):
        for room in rooms:
            place = base / room
            for path in [place] if place.is_file() else sorted(place.rglob("*")):
                inside = path.relative_to(base)
                skipped = SKIPPED_FOLDERS.intersection(inside.parts)
                if path.is_file() and not skipped and path.suffix not in SKIPPED_SUFFIXES:
                    name = f"{PACKAGE}/{inside.as_posix()}"
                    if name in files:
                        raise SystemExit(f"{path} and {files[name]} have the same place")
                    files[name] = path
    place = f"{PACKAGE}/native/{_system_of(library)}"
    files[f"{place}/{library.name}"] = library
    name, record = record_of(library)
    return {name: path.read_bytes() for name, path in files.items()} | {f"{place}/{name}": record}


def metadata(about: Mapping[str, Any]) -> str:
    """The file METADATA: what pip and indexes show."""
    lines = [
        "Metadata-Version: 2.4",
        f"Name: {about['name']}",
        f"Version: {about['version']}",
        f"Summary: {about['description']}",
        f"Keywords: {','.join(about['keywords'])}",
        *(f"Author: {author['name']}" for author in about["authors"]),
        f"License-Expression: {about['license']}",
        *(f"License-File: {name}" for name in about["license-files"]),
        *(f"Classifier: {name}" for name in about["classifiers"]),
        *(f"Project-URL: {name}, {address}" for name, address in about["urls"].items()),
        f"Requires-Python: {about['requires-python']}",
        *(f"Requires-Dist: {wanted}" for wanted in about["dependencies"]),
    ]
    for extra, wanted in about["optional-dependencies"].items():
        lines.append(f"Provides-Extra: {extra}")
        lines += [f'Requires-Dist: {name} ; extra == "{extra}"' for name in wanted]
    lines += ["Description-Content-Type: text/markdown", ""]
    return "\n".join(lines) + "\n" + (ROOT / about["readme"]).read_text(encoding="utf-8")


def write_wheel(folder: Path, library: Path, platform: str) -> Path:
    """Writes meander-VERSION-py3-none-PLATFORM.whl into a folder, whole, and returns its path."""
    about = project()
    stem = f"{PACKAGE}-{about['version']}"
    information, tag = f"{stem}.dist-info", f"py3-none-{platform}"
    entries = dict(sorted(contents(library).items()))
    for name in about["license-files"]:
        entries[f"{information}/licenses/{name}"] = (ROOT / name).read_bytes()
    scripts = [f"{name} = {target}" for name, target in about["scripts"].items()]
    texts = {
        "METADATA": metadata(about),
        "WHEEL": "Wheel-Version: 1.0\nGenerator: meander\nRoot-Is-Purelib: false\n"
        f"Tag: {tag}\n",
        "entry_points.txt": "\n".join(["[console_scripts]", *scripts]) + "\n",
    }
    for name, text in texts.items():
        entries[f"{information}/{name}"] = text.encode()
    record = [f"{name},{_digest(data)},{len(data)}" for name, data in entries.items()]
    record.append(f"{information}/RECORD,,")
    entries[f"{information}/RECORD"] = ("\n".join(record) + "\n").encode()

    folder.mkdir(parents=True, exist_ok=True)
    wheel = folder / f"{stem}-{tag}.whl"
    unfinished = wheel.with_suffix(".part")
    with zipfile.ZipFile(unfinished, "w", zipfile.ZIP_DEFLATED, compresslevel=9) as archive:
        for name, data in entries.items():
            entry = zipfile.ZipInfo(name, TIMESTAMP)
            entry.compress_type = zipfile.ZIP_DEFLATED
            entry.create_system = 3  # Unix, on any machine: the permissions below are Unix's
            entry.external_attr = (0o755 if name.endswith(library.suffix) else 0o644) << 16
            archive.writestr(entry, data)
    unfinished.replace(wheel)
    return wheel


def _digest(data: bytes) -> str:
    digest = base64.urlsafe_b64encode(hashlib.sha256(data).digest()).rstrip(b"=")
    return f"sha256={digest.decode()}"


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("--library", type=Path, help="default: the one built for this machine")
    parser.add_argument("--platform", metavar="TAG", help="such as manylinux_2_28_x86_64")
    parser.add_argument("--folder", type=Path, default=ROOT / "build", help="default: build")
    arguments = parser.parse_args()
    if arguments.library is not None and arguments.platform is None:
        parser.error("--library needs --platform, which says what it is for")
    library = arguments.library or built_library()
    wheel = write_wheel(arguments.folder, library, arguments.platform or this_platform())
    print(f"{wheel}: {wheel.stat().st_size / 1024:.0f} KiB")
    return 0


if __name__ == "__main__":
    sys.exit(main())
