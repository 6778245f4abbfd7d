# SPDX-License-Identifier: GPL-3.0-or-later
"""What a file is by its first bytes, and its text as one encoding; no bpy."""

from __future__ import annotations

import codecs
from pathlib import Path

from ... import core
from .whole import FileError, read_bytes

# The beginning of a file, and what that makes it. What is read under its own suffix only is no
# business of this table.
_OTHERS = (
    (b"\x1f\x8b", "a file packed by gzip"),
    (b"pk\x03\x04", "a packed archive (zip, or 3MF)"),
    (b"\x28\xb5\x2f\xfd", "a file packed by Zstandard"),
    (b"version https://git-lfs", "a note of Git LFS in place of the file, which is not there yet"),
    (b"<!doctype html", "a web page"),
    (b"<html", "a web page"),
    (b"<?xml", "an XML file"),
    (b"kaydara fbx binary", "an FBX file"),
    (b"gltf", "a glTF file"),
    (b"blender-v", "a .blend file"),
    (b"ply\n", "a PLY file"),
    (b"ply\r", "a PLY file"),
    (b"off\n", "an OFF file"),
    (b"iso-10303-21", "a STEP file"),
)
_LONGEST = max(len(begin) for begin, _what in _OTHERS)

# Byte order marks, the longer ones first, and the encodings that they mark.
_MARKS = (
    (codecs.BOM_UTF32_LE, "utf-32"),
    (codecs.BOM_UTF32_BE, "utf-32"),
    (codecs.BOM_UTF16_LE, "utf-16"),
    (codecs.BOM_UTF16_BE, "utf-16"),
)


def in_file(path: Path, refusal: core.MeanderError) -> FileError:
    """What the library refuses of a text, as it is said of its file."""
    said = str(refusal)
    return FileError(f"{path}, {said[:1].lower()}{said[1:].removesuffix('.')}")


def read_plain(path: Path, may_be_empty: bool = False) -> bytes:
    """What is in a file, its text as UTF-8 without a byte order mark where it has one.

    Raises FileError: it cannot be read, is empty, or is marked as text that it does not hold.
    """
    data = read_bytes(path)
    if not data and not may_be_empty:
        raise FileError(f"{path} is empty; export it again")
    if data.startswith(codecs.BOM_UTF8):
        return data[len(codecs.BOM_UTF8) :]
    encoding = next((name for mark, name in _MARKS if data.startswith(mark)), None)
    if encoding is None:
        head = data[:64]
        # Plain letters in two bytes each, without a mark.
        if len(head) >= 8 and head[1:8:2] == bytes(4) and all(32 <= b < 127 for b in head[0:8:2]):
            encoding = "utf-16-le"
        elif len(head) >= 8 and head[0:8:2] == bytes(4) and all(32 <= b < 127 for b in head[1:8:2]):
            encoding = "utf-16-be"
        else:
            return data
    try:
        return data.decode(encoding).encode("utf-8")
    except UnicodeError as problem:
        name = encoding[:6].upper()
        raise FileError(
            f"{path} begins as {name} text but is none to its end; save it again as UTF-8"
        ) from problem


def told_apart(data: bytes, suffix: str) -> str:
    """What else a file is, by its beginning, as the middle of a sentence; empty: nothing known.

    suffix   that it was read by: a file of its own kind is nothing else
    """
    head = data[:_LONGEST + 8].lstrip().lower()
    for begin, what in _OTHERS:
        if head.startswith(begin) and not (suffix == ".ply" and begin.startswith(b"ply")):
            return what
    return ""
