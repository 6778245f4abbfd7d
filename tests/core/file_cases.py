# SPDX-License-Identifier: GPL-3.0-or-later
"""What readers of mesh files take, repair and refuse: one small file for each.

docs/files.md is made from these cases by scripts/write_files_page.py, and test_file_cases.py reads
every one of them.
"""

from __future__ import annotations

import struct
from dataclasses import dataclass

# A square of 2 by 2 with a corner cut out: its area is 3, and fanned from its first corner it is 4.
ELL = [(0, 0), (2, 0), (2, 1), (1, 1), (1, 2), (0, 2)]
SQUARE = [(0, 0), (1, 0), (1, 1), (0, 1)]
# A square of 4 by 4 around one of 2 by 2: its rim and its hole joined by a bridge.
FRAME = [(0, 0), (4, 0), (4, 4), (0, 4), (0, 0), (1, 1), (1, 3), (3, 3), (3, 1), (1, 1)]


@dataclass(frozen=True)
class Case:
    """A file, and what is to come of it.

    kind    obj, ply or stl
    title   what is in the file, for the page
    data    the file
    area    of the mesh that is read; 0: the file is refused
    said    the remark of the reader, or its refusal, without the name of the file
    """

    kind: str
    title: str
    data: bytes
    area: float = 0.0
    said: str = ""


def points(places, letter: str = "v") -> str:
    return "".join(f"{letter} {x} {y} 0\n" for x, y in places)


def obj(places, lines: str) -> bytes:
    return (points(places) + lines).encode()


def ply(body: str, faces: int, vertices: int = 4, extra: str = "") -> bytes:
    return (
        f"ply\nformat ascii 1.0\n{extra}element vertex {vertices}\nproperty float x\n"
        f"property float y\nproperty float z\nelement face {faces}\n"
        f"property list uchar int vertex_indices\nend_header\n{body}"
    ).encode()


def flat(places) -> str:
    return "".join(f"{x} {y} 0\n" for x, y in places)


def binary_ply(faces: list[tuple[int, ...]], order: str = "<", tail: bytes = b"") -> bytes:
    name = "little" if order == "<" else "big"
    head = (
        f"ply\nformat binary_{name}_endian 1.0\nelement vertex 4\nproperty float x\n"
        f"property float y\nproperty float z\nelement face {len(faces)}\n"
        "property list uchar int vertex_indices\nend_header\n"
    )
    rows = b"".join(struct.pack(order + "fff", x, y, 0) for x, y in SQUARE)
    rows += b"".join(struct.pack(f"{order}B{len(f)}i", len(f), *f) for f in faces)
    return head.encode() + rows + tail


def _with_returns(data: bytes) -> bytes:
    head, end, rows = data.partition(b"end_header\n")
    return (head + end).replace(b"\n", b"\r") + rows


HALVES = [[(0, 0), (1, 0), (1, 1)], [(0, 0), (1, 1), (0, 1)]]


def facet(corners, keyword: str = "vertex") -> str:
    inner = "".join(f"{keyword} {x} {y} 0\n" for x, y in corners)
    return f"facet normal 0 0 1\nouter loop\n{inner}endloop\nendfacet\n"


def stl(head: str = "solid a\n", tail: str = "endsolid a\n", keyword: str = "vertex") -> bytes:
    return (head + "".join(facet(corners, keyword) for corners in HALVES) + tail).encode()


def binary_stl(count: int = 2, head: bytes = b"", tail: bytes = b"") -> bytes:
    rows = b"".join(
        struct.pack("<12fH", 0, 0, 1, *(value for x, y in corners for value in (x, y, 0)), 0)
        for corners in HALVES
    )
    return head.ljust(80, b"\0") + struct.pack("<I", count) + rows + tail


STRIP = (
    "ply\nformat ascii 1.0\nelement vertex 6\n"
    "property float x\nproperty float y\nproperty float z\n"
    "element tristrips 1\nproperty list int int vertex_indices\nend_header\n"
    f"{flat([(0, 0), (0, 1), (1, 0), (1, 1), (2, 0), (2, 1)])}"
)
PLAIN = obj(SQUARE, "f 1 2 3 4\n")

CASES = (
    # ---- OBJ: taken
    Case("obj", "a concave polygon", obj(ELL, "f 1 2 3 4 5 6\n"), 3.0),
    Case("obj", "the same from another corner", obj(ELL, "f 4 5 6 1 2 3\n"), 3.0),
    Case("obj", "a hole that a bridge joins to the rim",
         obj(FRAME[:4] + FRAME[5:9], "f 1 2 3 4 1 5 6 7 8 5\n"), 12.0),
    Case("obj", "the same with vertices of its own on both sides of the bridge",
         obj(FRAME, "f 1 2 3 4 5 6 7 8 9 10\n"), 12.0),
    Case("obj", "a polygon that goes to a vertex and straight back",
         obj([*SQUARE, (0.5, 0.5)], "f 1 2 3 5 3 4\n"), 1.0),
    Case("obj", "a byte order mark of UTF-8", b"\xef\xbb\xbf" + PLAIN, 1.0),
    Case("obj", "UTF-16 with a mark", PLAIN.decode().encode("utf-16"), 1.0),
    Case("obj", "UTF-16 without one", PLAIN.decode().encode("utf-16-le"), 1.0),
    Case("obj", "lines that end with a carriage return", PLAIN.replace(b"\n", b"\r"), 1.0),
    Case("obj", "no end of the last line", PLAIN[:-1], 1.0),
    Case("obj", "comments behind numbers", PLAIN.replace(b"\n", b" # 1 2\n"), 1.0),
    Case("obj", "comments without a blank before them", PLAIN.replace(b"\n", b"#1 2\n"), 1.0),
    Case("obj", "a comment that ends with a backslash", b"# C:\\models\\\n" + PLAIN, 1.0),
    Case("obj", "a line that a backslash continues", obj(SQUARE, "f 1 2 \\\n3 4\n"), 1.0),
    Case("obj", "blanks behind such a backslash", obj(SQUARE, "f 1 2 \\  \n3 4\n"), 1.0),
    Case("obj", "a backslash at the end of the file", PLAIN[:-1] + b" \\", 1.0),
    Case("obj", "names that are keywords", b"o v 1 2\ng f\nusemtl l\n" + PLAIN, 1.0),
    Case("obj", "weights or colors behind coordinates",
         PLAIN.replace(b" 0\nf", b" 0 1 .5 .5\nf"), 1.0),
    Case("obj", "texture and normal references", obj(SQUARE, "vt 0 0\nf 1/1 2//1 3/1/1 4/\n"), 1.0),
    Case("obj", "references that count back", obj(SQUARE, "f -4 -3 -2 -1\n"), 1.0),
    Case("obj", "a face before its vertices", b"f 1 2 3 4\n" + points(SQUARE).encode(), 1.0),
    Case("obj", "not a number at a vertex that no face uses",
         b"v 0 0 0\n" + PLAIN.replace(b"f 1 2 3 4", b"v nan 1.#QNAN -1.#IND\nf 2 3 4 5").replace(
             b"v 0 0 0\n", b"v 0 0 0\n", 1), 1.0),
    Case("obj", "lines, points and curved surfaces beside faces",
         PLAIN + b"l 1 2\np 1\ncstype bezier\nvp 1\n", 1.0),
    # ---- OBJ: repaired
    Case("obj", "a face of two corners", PLAIN + b"f 1 2\n", 1.0,
         "left out 1 face of fewer than three corners"),
    Case("obj", "faces of one corner and of none", PLAIN + b"f 1\nf\n", 1.0,
         "left out 2 faces of fewer than three corners"),
    # ---- OBJ: refused
    Case("obj", "a vertex that is not there", obj(SQUARE, "f 1 2 9\n"), 0.0,
         ", line 5: there is no vertex 9, the file has 4; correct the file"),
    Case("obj", "a reference that counts back too far", obj(SQUARE, "f 1 2 -9\n"), 0.0,
         ", line 5: there is no vertex -9, as only 4 stand before this line; correct the file"),
    Case("obj", "vertices counted from 0", obj(SQUARE, "f 0 1 2\n"), 0.0,
         ", line 5: 'f 0 1 2' is not a face of vertices, counted from 1; correct the file"),
    Case("obj", "a number of a vertex that no computer could hold",
         obj(SQUARE, "f 1 2 99999999999999999999/1\n"), 0.0,
         ", line 5: there is no vertex 99999999999999999999; correct the file"),
    Case("obj", "a number of a vertex beyond 32 bits", obj(SQUARE, "f 1 2 4294967297\n"), 0.0,
         ", line 5: there is no vertex 4294967297; correct the file"),
    Case("obj", "a word in a face", obj(SQUARE, "f 1 2 x\n"), 0.0,
         ", line 5: 'f 1 2 x' is not a face of vertices, counted from 1; correct the file"),
    Case("obj", "commas in numbers", b"v 0,5 1 0\n" + PLAIN, 0.0,
         ", line 1: 'v 0,5 1 0' is not a vertex with three coordinates (numbers have a point, not "
         "a comma); correct the file"),
    Case("obj", "a vertex of two numbers", b"v 0 0\n" + PLAIN, 0.0,
         ", line 1: 'v 0 0' is not a vertex with three coordinates; correct the file"),
    Case("obj", "no faces", points(SQUARE).encode(), 0.0,
         " has no faces; give a mesh with v and f lines"),
    Case("obj", "lines only", obj(SQUARE, "l 1 2 3\n"), 0.0,
         " has lines, and no faces; give a mesh with v and f lines, or give it to --seed"),
    Case("obj", "curved surfaces only", obj(SQUARE, "cstype bezier\nsurf 0 1 0 1 1 2 3 4\n"), 0.0,
         " holds curved surfaces, and no faces; export it with faces"),
    Case("obj", "bytes that are no text", bytes(range(16)), 0.0,
         " is not text, so it is no OBJ file; export the mesh as one"),
    Case("obj", "nothing", b"", 0.0, " is empty; export it again"),
    Case("obj", "UTF-16 that is cut off", PLAIN.decode().encode("utf-16")[:-1], 0.0,
         " begins as UTF-16 text but is none to its end; save it again as UTF-8"),
    Case("obj", "a file packed by gzip", b"\x1f\x8b\x08\0\0\0\0\0", 0.0,
         " is a file packed by gzip, and no OBJ file; export the mesh as one"),
    Case("obj", "a PLY file by the name of an OBJ file", ply(flat(SQUARE) + "4 0 1 2 3\n", 1), 0.0,
         " is a PLY file, and no OBJ file; export the mesh as one"),
    # ---- PLY: taken
    Case("ply", "a concave polygon", ply(flat(ELL) + "6 0 1 2 3 4 5\n", 1, 6), 3.0),
    Case("ply", "a hole that a bridge joins to the rim",
         ply(flat(FRAME) + "10 0 1 2 3 4 5 6 7 8 9\n", 1, 10), 12.0),
    Case("ply", "polygons of several sizes", binary_ply([(0, 1, 2, 3), (0, 2, 1)]), 1.5),
    Case("ply", "the same, most significant byte first", binary_ply([(0, 1, 2, 3), (0, 2, 1)], ">"),
         1.5),
    Case("ply", "a strip of triangles", (STRIP + "6 0 1 2 3 4 5\n").encode(), 2.0),
    Case("ply", "strips with -1 between them", (STRIP + "9 0 1 2 3 -1 2 3 4 5\n").encode(), 2.0),
    Case("ply", "a byte order mark of UTF-8",
         b"\xef\xbb\xbf" + ply(flat(SQUARE) + "4 0 1 2 3\n", 1), 1.0),
    Case("ply", "lines that end with a carriage return",
         ply(flat(SQUARE) + "4 0 1 2 3\n", 1).replace(b"\n", b"\r"), 1.0),
    Case("ply", "the same before bytes", _with_returns(binary_ply([(0, 1, 2, 3)])), 1.0),
    Case("ply", "comments that hold keywords",
         ply(flat(SQUARE) + "4 0 1 2 3\n", 1,
             extra="comment end_header\nobj_info element face 9\n"), 1.0),
    Case("ply", "more behind what the header counts, in text",
         ply(flat(SQUARE) + "4 0 1 2 3\nend of file\n", 1), 1.0),
    Case("ply", "more behind what the header counts, in bytes",
         binary_ply([(0, 1, 2, 3)], tail=b"\x01\x02\x03"), 1.0),
    Case("ply", "not a number at a vertex that no face uses",
         ply(flat(SQUARE) + "nan nan nan\n4 0 1 2 3\n", 1, 5), 1.0),
    # ---- PLY: repaired
    Case("ply", "a face of two corners", ply(flat(SQUARE) + "4 0 1 2 3\n2 0 1\n", 2), 1.0,
         "left out 1 face of fewer than three corners"),
    # ---- PLY: refused
    Case("ply", "fewer rows than the header counts", ply(flat(SQUARE) + "4 0 1 2 3\n", 2), 0.0,
         " ends before the last face that its header counts (2); export it again"),
    Case("ply", "a word among numbers", ply(flat(SQUARE) + "4 0 1 two 3\n", 1), 0.0,
         " holds something that is no number in line 14 ('two'); export it again"),
    Case("ply", "an unknown type", ply("", 1).replace(b"float z", b"real z"), 0.0,
         " has a line in its PLY header that means nothing (property real z); export it again"),
    Case("ply", "points only", ply(flat(SQUARE), 0), 0.0,
         " has no faces; give a mesh with triangles"),
    Case("ply", "an STL file by the name of a PLY file", stl(), 0.0,
         " is no PLY file; export it again"),
    # ---- STL: taken
    Case("stl", "text", stl(), 1.0),
    Case("stl", "text without the line solid", stl("", ""), 1.0),
    Case("stl", "a name that holds keywords", stl("solid vertex 1 2 3 facet\n"), 1.0),
    Case("stl", "keywords in capitals", stl(keyword="VERTEX").replace(b"endloop", b"ENDLOOP"), 1.0),
    Case("stl", "text in one line", stl().replace(b"\n", b" "), 1.0),
    Case("stl", "several solids",
         stl() + stl("solid b\n", "endsolid b\n").replace(b" 0\n", b" 1\n"), 2.0),
    Case("stl", "a loop of four corners",
         ("solid a\n" + facet(SQUARE) + "endsolid a\n").encode(), 1.0),
    Case("stl", "a byte order mark of UTF-8", b"\xef\xbb\xbf" + stl(), 1.0),
    Case("stl", "UTF-16", stl().decode().encode("utf-16"), 1.0),
    Case("stl", "bytes", binary_stl(), 1.0),
    Case("stl", "bytes that begin as text does", binary_stl(head=b"solid made by hand"), 1.0),
    Case("stl", "text with zeros behind it", stl(tail="endsolid a\n\0\0\0"), 1.0),
    # ---- STL: repaired
    Case("stl", "text without its last line", stl(tail=""), 1.0,
         " has no endsolid, so it may have been cut off; 2 triangles stood there"),
    Case("stl", "text that ends between two triangles",
         stl().partition(b"facet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 1 0")[0], 0.5,
         " has no endsolid, so it may have been cut off; 1 triangle stood there"),
    Case("stl", "more bytes than its count", binary_stl(tail=b"\0\0"), 1.0,
         " says that it has 2 triangles, which were read; 2 bytes stand behind them, and were "
         "passed over"),
    Case("stl", "a loop of two corners", stl("solid a\n" + facet(SQUARE[:2])), 1.0,
         "left out 1 face of fewer than three corners"),
    # ---- STL: refused
    Case("stl", "fewer bytes than its count", binary_stl(3), 0.0,
         " says that it has 3 triangles, but it has room for 2; export it again"),
    Case("stl", "a count of 0 before triangles", binary_stl(0), 0.0,
         " says that it has 0 triangles, but it has room for 2; export it again"),
    Case("stl", "text that ends within a triangle", stl().partition(b"vertex 0 1 0")[0], 0.0,
         ", line 11: the file ends within a triangle; export it again"),
    Case("stl", "a word in a vertex", stl().replace(b"vertex 1 1 0", b"vertex 1 x 0", 1), 0.0,
         ", line 6: 'vertex 1 x 0' is not a vertex with three coordinates; correct the file"),
    Case("stl", "no triangles", b"solid a\nendsolid a\n", 0.0,
         " has no faces; give a mesh with triangles"),
    Case("stl", "a few bytes", b"\x01\x02\x03", 0.0, " is no STL file; export the mesh as STL"),
    Case("stl", "a packed archive by the name of an STL file", b"PK\x03\x04" + bytes(90), 0.0,
         " is a packed archive (zip, or 3MF); export the mesh as STL"),
)  # fmt: skip
