# SPDX-License-Identifier: GPL-3.0-or-later
"""Packs the add-on into a zip that contains one folder, the only form that both Blender 3.4 and the
extensions of 4.2 and later install. The manifest inside names the platforms whose libraries it has.

The same contents give the same bytes: entries are sorted, and have a fixed time and permissions.
Blender reads the add-on's version without running its code, so the copies of the version are
literals, which cannot be derived; they are compared with the project's instead.
"""

import argparse
import ast
import hashlib
import re
import sys
import tomllib
import zipfile
from pathlib import Path
from typing import Any

FOLDER = "meander"
MANIFEST = "blender_manifest.toml"
# As manifests call them; a library lies in the folder of its platform.
PLATFORMS = (
    "linux-x64", "linux-arm64", "macos-x64", "macos-arm64", "windows-x64", "windows-arm64"
)  # fmt: skip
LIBRARIES = {".so", ".dylib", ".dll"}
# The earliest time that a zip can store.
TIMESTAMP = (1980, 1, 1, 0, 0, 0)
# Made by the build or by running the code, and never part of the sources.
SKIPPED_FOLDERS = {"__pycache__", "native"}
SKIPPED_SUFFIXES = {".pyc", ".pyo"}


def literal(python_file: Path, name: str) -> Any:
    """The literal that a module assigns to `name`, read without running the module."""
    for statement in ast.parse(python_file.read_text(encoding="utf-8")).body:
        if isinstance(statement, ast.Assign) and any(
            isinstance(target, ast.Name) and target.id == name for target in statement.targets
        ):
            return ast.literal_eval(statement.value)
    raise SystemExit(f"{python_file}: no {name} = ... at the top level, which Meander reads there")


def manifest_version(manifest_file: Path) -> str:
    with manifest_file.open("rb") as file:
        return tomllib.load(file)["version"]


def check_versions(addon: Path, version: str) -> None:
    bl_info = literal(addon / "__init__.py", "bl_info")
    found = {
        "__init__.py": ".".join(str(part) for part in bl_info["version"]),
        "blender_manifest.toml": manifest_version(addon / MANIFEST),
        "binding/abi.py": literal(addon / "binding" / "abi.py", "VERSION"),
    }
    wrong = [f"{addon / name}: {other}" for name, other in found.items() if other != version]
    if wrong:
        raise SystemExit(
            "\n".join(wrong) + f"\nCMakeLists.txt says {version}: change the files above to match."
        )


def of_platform(text: str) -> tuple[str, Path]:
    """PLATFORM=FILE of a flag: ("linux-x64", path)."""
    platform, equals, path = text.partition("=")
    if not equals or platform not in PLATFORMS:
        raise argparse.ArgumentTypeError(
            f"{text!r} must be PLATFORM=FILE, PLATFORM one of {', '.join(PLATFORMS)}"
        )
    return platform, Path(path)


def manifest_for(manifest_file: Path, platforms: list[str], wheels: list[Path]) -> bytes:
    """The manifest, with these as its platforms, and the wheels that Blender is to install."""
    named = ", ".join(f'"{platform}"' for platform in platforms)
    text, count = re.subn(
        r"(?m)^platforms = \[.*\]$",
        f"platforms = [{named}]",
        manifest_file.read_text(encoding="utf-8"),
    )
    if count != 1:
        raise SystemExit(f"{manifest_file}: no line platforms = [...], which is replaced in a zip")
    if wheels:
        paths = ", ".join(f'"./wheels/{wheel.name}"' for wheel in wheels)
        text = re.sub(r"(?m)^(platforms = .*)$", rf"\1\nwheels = [{paths}]", text)
    return text.encode()


def record_of(library: Path) -> tuple[str, bytes]:
    """The file beside a packed library by which `binding` knows that it is whole: its name and what
    it holds, the size and the digest."""
    data = library.read_bytes()
    return f"{library.name}.record", f"{len(data)} {hashlib.sha256(data).hexdigest()}\n".encode()


def contents(
    addon: Path,
    native: list[tuple[str, Path]],
    licences: list[Path],
    pages: Path | None,
    wheels: list[Path],
) -> dict[str, Path | bytes]:
    """Name inside the zip -> file, or what it holds."""
    files: dict[str, Path | bytes] = {}
    for path in addon.rglob("*"):
        inside = path.relative_to(addon)
        skipped = SKIPPED_FOLDERS.intersection(inside.parts) or path.suffix in SKIPPED_SUFFIXES
        if path.is_file() and not skipped:
            files[f"{FOLDER}/{inside.as_posix()}"] = path
    for platform, path in native:
        name, record = record_of(path)
        files[f"{FOLDER}/native/{platform}/{path.name}"] = path
        files[f"{FOLDER}/native/{platform}/{name}"] = record
    for path in licences:
        files[f"{FOLDER}/{path.name}"] = path
    for path in wheels:
        files[f"{FOLDER}/wheels/{path.name}"] = path
    if pages is not None:
        from help_pages import help_pages  # needs a package that nobody else here does

        menu = [(name, label) for name, label, _tip in literal(addon / "ui" / "help.py", "PAGES")]
        for name, page in help_pages(pages, menu).items():
            files[f"{FOLDER}/docs/{name}"] = page
    return files


def write_zip(output: Path, files: dict[str, Path | bytes], manifest: bytes) -> None:
    # Written under a temporary name and renamed, so that a zip is always whole.
    unfinished = output.with_suffix(".zip.part")
    with zipfile.ZipFile(unfinished, "w", zipfile.ZIP_DEFLATED, compresslevel=9) as archive:
        # If the folder has an entry of its own, Blender 3.4 removes the installed folder first. If
        # not, it writes into the existing files: a library in use then crashes, and files that the
        # new version does not have would stay.
        folder = zipfile.ZipInfo(f"{FOLDER}/", TIMESTAMP)
        folder.create_system = 3
        folder.external_attr = (0o40755 << 16) | 0x10
        archive.writestr(folder, b"")
        for name, content in sorted(files.items()):
            entry = zipfile.ZipInfo(name, TIMESTAMP)
            entry.compress_type = zipfile.ZIP_DEFLATED
            entry.create_system = 3  # Unix, on any machine: the permissions below are Unix's
            entry.external_attr = (0o755 if Path(name).suffix in LIBRARIES else 0o644) << 16
            if name == f"{FOLDER}/{MANIFEST}":
                content = manifest
            archive.writestr(entry, content if isinstance(content, bytes) else content.read_bytes())
    unfinished.replace(output)


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--addon", type=Path, required=True, help="folder of the add-on's sources")
    parser.add_argument("--version", required=True, help="the project's version")
    parser.add_argument("--native", type=of_platform, action="append", default=[],
                        metavar="PLATFORM=FILE", help="a library, linux-x64=FILE")  # fmt: skip
    parser.add_argument("--licence", type=Path, action="append", default=[], help="a text to add")
    parser.add_argument("--wheels", type=Path, help="folder of the wheels that scripts/wheels.txt "
                        "names; where it is missing, the zip has none")  # fmt: skip
    parser.add_argument("--pages", type=Path, help="folder of the pages that the panel opens")
    parser.add_argument("--output", type=Path, help="the zip to write")
    parser.add_argument("--check-only", action="store_true", help="compare versions, write nothing")
    arguments = parser.parse_args()

    check_versions(arguments.addon, arguments.version)
    if arguments.check_only:
        return 0
    if arguments.output is None:
        parser.error("--output is needed unless --check-only is given")
    wheels = [] if arguments.wheels is None else sorted(arguments.wheels.glob("*.whl"))
    files = contents(arguments.addon, arguments.native, arguments.licence, arguments.pages, wheels)
    if not arguments.native:
        parser.error("--native is needed: a zip without a library would not work")
    platforms = sorted({platform for platform, _path in arguments.native})
    manifest = manifest_for(arguments.addon / MANIFEST, platforms, wheels)
    write_zip(arguments.output, files, manifest)
    size = arguments.output.stat().st_size / 1024
    without = "" if wheels else ", without wheels: scripts/install_dependencies.sh fetches them"
    print(f"{arguments.output}: {len(files)} files, {size:.0f} KiB{without}")
    return 0


if __name__ == "__main__":
    sys.exit(main())
