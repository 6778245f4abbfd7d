# SPDX-License-Identifier: GPL-3.0-or-later
"""The zip by itself: its shape, its contents, its manifest."""

import hashlib
import io
import os
import posixpath
import re
import shutil
import subprocess
import sys
import tomllib
import zipfile
from html.parser import HTMLParser
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]


@pytest.fixture(scope="module")
def names(addon_zip: Path) -> list[str]:
    with zipfile.ZipFile(addon_zip) as archive:
        assert archive.testzip() is None
        return archive.namelist()


@pytest.fixture(scope="module")
def manifest(addon_zip: Path) -> dict:
    with zipfile.ZipFile(addon_zip) as archive:
        return tomllib.loads(archive.read("meander/blender_manifest.toml").decode())


def project_version() -> str:
    text = (ROOT / "CMakeLists.txt").read_text()
    return re.search(r"project\(Meander VERSION ([0-9.]+)", text).group(1)


def test_one_folder(names: list[str]) -> None:
    # Blender 3.4 cannot install a zip with its files at the root.
    assert {name.split("/")[0] for name in names} == {"meander"}


def test_the_folder_has_an_entry(names: list[str]) -> None:
    # What Blender 3.4 goes by when it removes the version that was there.
    assert names[0] == "meander/"


def test_holds_everything_and_nothing_else(names: list[str]) -> None:
    version = project_version()
    assert "meander/__init__.py" in names
    assert "meander/batch.py" in names
    assert {"meander/farm.py", "meander/jobs/meander_fill.js"} <= set(names)
    assert "meander/LICENSE" in names
    assert "meander/THIRD_PARTY_NOTICES.md" in names
    assets = {name for name in names if name.startswith("meander/assets/")}
    assert assets == {
        f"meander/assets/{name}"
        for name in ("meander.blend", "blender_assets.cats.txt", "LICENSE.txt")
    }
    libraries = sorted(name for name in names if name.startswith("meander/native/"))
    library = f"meander/native/linux-x64/libmeander-{version}.so"
    assert libraries == [library, f"{library}.record"]
    wheels = [Path(name).name for name in names if name.startswith("meander/wheels/")]
    wanted = re.findall(r"(?m)^(\w+)==([\d.]+) ", (ROOT / "scripts/wheels.txt").read_text())
    assert [tuple(name.split("-")[:2]) for name in wheels] == wanted
    presets = {name for name in names if name.startswith("meander/presets/meander/")}
    assert {Path(name).stem for name in presets} == {
        "Even", "Flowing", "Organic", "Few_Corners", "Rows", "As_Published"
    }
    assert {"meander/docs/index.html", "meander/docs/make/rows.html"} <= set(names)
    assert not [name for name in names if name.startswith("meander/docs/") and "html" not in name]
    assert not [name for name in names if "__pycache__" in name or name.endswith(".pyc")]


def test_the_record_beside_the_library_is_of_its_bytes(addon_zip: Path) -> None:
    with zipfile.ZipFile(addon_zip) as archive:
        library = f"meander/native/linux-x64/libmeander-{project_version()}.so"
        data, record = archive.read(library), archive.read(f"{library}.record").decode()
    assert record == f"{len(data)} {hashlib.sha256(data).hexdigest()}\n"


class Page(HTMLParser):
    """What a page links to, its headings' names, and its text."""

    def __init__(self, text: str) -> None:
        super().__init__()
        self.links: list[str] = []
        self.names: set[str] = set()
        self.loaded: list[str] = []
        self.text = ""
        self.feed(text)

    def handle_starttag(self, tag: str, attributes: list) -> None:
        given = dict(attributes)
        self.links += [given["href"]] if "href" in given else []
        self.names |= {given["id"]} if "id" in given else set()
        self.loaded += [tag] if tag in {"img", "script", "link"} else []

    def handle_data(self, data: str) -> None:
        self.text += data


def test_every_page_of_the_help_reads_by_itself(addon_zip: Path) -> None:
    with zipfile.ZipFile(addon_zip) as archive:
        pages = {
            name: Page(archive.read(name).decode())
            for name in archive.namelist()
            if name.startswith("meander/docs/")
        }
    assert len(pages) > 20
    for name, page in pages.items():
        assert not page.loaded, f"{name} loads something from elsewhere"
        assert "\n|" not in page.text and "](" not in page.text, f"{name} shows Markdown"
        for link in page.links:
            if link.startswith("http"):
                continue
            path, _mark, heading = link.partition("#")
            target = posixpath.normpath(posixpath.join(posixpath.dirname(name), path or name))
            target = name if not path else target
            assert target in pages, f"{name}: {link}"
            assert not heading or heading in pages[target].names, f"{name}: {link}"


def test_wheels_are_those_of_the_list_with_their_licences(addon_zip: Path, manifest: dict) -> None:
    with zipfile.ZipFile(addon_zip) as archive:
        wheels = [name for name in archive.namelist() if name.endswith(".whl")]
        assert manifest["wheels"] == [f"./{name.removeprefix('meander/')}" for name in wheels]
        notices = archive.read("meander/THIRD_PARTY_NOTICES.md").decode()
        for name in wheels:
            data = archive.read(name)
            assert hashlib.sha256(data).hexdigest() in (ROOT / "scripts/wheels.txt").read_text()
            assert name.endswith("-none-any.whl"), "it has to serve every system and Python"
            with zipfile.ZipFile(io.BytesIO(data)) as wheel:
                (licence,) = (one for one in wheel.namelist() if one.endswith("dist-info/LICENSE"))
                text = " ".join(wheel.read(licence).decode().split())
            assert text.partition("Permission is hereby")[2] in " ".join(notices.split()), name
            assert f"## {Path(name).name.split('-')[0]}" in notices


def test_name_and_manifest_carry_the_version(addon_zip: Path, manifest: dict) -> None:
    assert addon_zip.name == f"meander-{project_version()}.zip"
    assert manifest["version"] == project_version()


def test_manifest_has_what_blender_does_not_check(manifest: dict) -> None:
    assert manifest["id"] == "meander"
    assert manifest["license"] == ["SPDX:GPL-3.0-or-later"]
    assert manifest["platforms"] == ["linux-x64"]  # what the libraries inside are built for
    assert tuple(map(int, manifest["blender_version_min"].split("."))) >= (4, 2, 0)
    assert len(manifest["tagline"]) <= 64
    assert manifest["tagline"][-1].isalnum()
    # The batch command writes files, but only where its user says, from outside of Blender's
    # interface; an add-on that asks for no permission is one that needs none.
    assert not {"network", "clipboard", "camera", "microphone"} & set(
        manifest.get("permissions", {})
    )


def test_blender_validates_it(addon_zip: Path, bpy_python: Path, tmp_path: Path) -> None:
    script = (
        "import sys, bpy\n"
        "from bl_pkg.bl_extension_cli import cli_extension_handler\n"
        "sys.exit(cli_extension_handler(['validate', sys.argv[1]]))\n"
    )
    # bl_pkg is one of Blender's own add-ons and lies beside the module.
    script = "import sys, bpy, addon_utils\nsys.path[:0] = addon_utils.paths()\n" + script
    environment = {**os.environ, "HOME": str(tmp_path), "BLENDER_USER_RESOURCES": str(tmp_path)}
    done = subprocess.run(
        [bpy_python, "-c", script, addon_zip],
        env=environment, capture_output=True, text=True, timeout=120,
    )
    assert done.returncode == 0, done.stdout + done.stderr


def test_same_contents_give_same_bytes(addon_zip: Path, tmp_path: Path) -> None:
    with zipfile.ZipFile(addon_zip) as archive:
        archive.extractall(tmp_path)
    folder = tmp_path / "meander"
    libraries = tmp_path / "libraries"
    shutil.move(folder / "native", libraries)
    texts = [shutil.move(folder / name, tmp_path / name)
             for name in ("LICENSE", "THIRD_PARTY_NOTICES.md")]
    shutil.rmtree(folder / "docs")
    (folder / "__pycache__").mkdir()
    (folder / "__pycache__" / "core.cpython-311.pyc").write_bytes(b"left behind by a run")

    command = [sys.executable, ROOT / "scripts/make_addon_zip.py", "--addon", folder,
               "--version", project_version(), "--pages", ROOT / "docs",
               "--output", tmp_path / "again.zip"]
    for library in sorted(libraries.glob("*/*.so"), reverse=True):
        command += ["--native", f"{library.parent.name}={library}"]
    for text in texts:
        command += ["--licence", text]
    subprocess.run(command, check=True, timeout=60)
    assert (tmp_path / "again.zip").read_bytes() == addon_zip.read_bytes()


@pytest.mark.parametrize("file", ["__init__.py", "blender_manifest.toml", "binding/abi.py"])
def test_a_version_that_differs_stops_the_build(file: str, tmp_path: Path) -> None:
    addon = tmp_path / "meander"
    shutil.copytree(ROOT / "addon/meander", addon)
    command = [sys.executable, ROOT / "scripts/make_addon_zip.py", "--addon", addon,
               "--version", project_version(), "--check-only"]
    assert subprocess.run(command, timeout=60).returncode == 0

    version = project_version()
    literal = repr(tuple(map(int, version.split(".")))) if file == "__init__.py" else f'"{version}"'
    other = "(99, 0, 0)" if file == "__init__.py" else '"99.0.0"'
    text = (addon / file).read_text()
    assert literal in text
    (addon / file).write_text(text.replace(literal, other, 1))
    done = subprocess.run(command, capture_output=True, text=True, timeout=60)
    assert done.returncode == 1
    assert file in done.stderr and "99.0.0" in done.stderr
