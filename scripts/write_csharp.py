# SPDX-License-Identifier: GPL-3.0-or-later
"""Writes native/csharp/Meander.cs, the declarations of meander.h for C#, as Rhino, Grasshopper and
Unity call the library.

    python3 scripts/write_csharp.py [--check]

--check writes nothing, and fails when the file is not what would be written.
"""

from __future__ import annotations

import argparse
import sys
from pathlib import Path

from c_header import CType, Header, read_header
from generate_abi import class_name

ROOT = Path(__file__).resolve().parents[1]
HEADER = ROOT / "native" / "include" / "meander" / "meander.h"
OUTPUT = ROOT / "native" / "csharp" / "Meander.cs"

NUMBERS = {
    "char": "byte",
    "double": "double",
    "float": "float",
    "int32_t": "int",
    "size_t": "UIntPtr",
    "uint8_t": "byte",
    "uint32_t": "uint",
    "uint64_t": "ulong",
    "void": "void",
}
# Names in the header that C# has for itself.
KEYWORDS = {"fixed", "object", "params", "ref", "in", "out", "string", "event", "base", "checked"}

HEAD = """\
// SPDX-License-Identifier: GPL-3.0-or-later
// Made from meander.h by scripts/write_csharp.py; changes are lost.
//
// meander.h as C# calls it, for Rhino, Grasshopper, Unity and .NET; what each call and each field
// means stands there. Names of functions and fields are those of C.
//
//   handles          IntPtr, of the _create functions by `out`
//   structs          classes, which marshal as pointers: null is NULL. New<T>() makes one with
//                    struct_size set, for the _init function
//   arrays           pinned while a call lasts; null is NULL. Arrays of a result are IntPtr in its
//                    struct: copy them before meander_result_destroy
//
// The library is meander.dll, libmeander.so or libmeander.dylib on the path of the program.
using System;
using System.Runtime.InteropServices;

namespace Meander
{
    public static class Api
    {
        const string Library = "meander";
"""

HELPERS = """
        /// <summary>A struct of zeros, and its size for its _init function.</summary>
        public static T New<T>(out UIntPtr size) where T : class, new()
        {
            size = (UIntPtr)(uint)Marshal.SizeOf(typeof(T));
            return new T();
        }

        /// <summary>A text of the library, such as that of meander_version.</summary>
        public static string Text(IntPtr text)
        {
            return Marshal.PtrToStringAnsi(text);
        }

        /// <summary>The sentence of an error.</summary>
        public static string Sentence(Error error)
        {
            byte[] text = error.text ?? new byte[0];
            int end = Array.IndexOf(text, (byte)0);
            return System.Text.Encoding.UTF8.GetString(text, 0, end < 0 ? text.Length : end);
        }

        /// <summary>An array of a result, whose pointer and count the struct has.</summary>
        public static double[] Doubles(IntPtr array, int count)
        {
            var copy = new double[count];
            if (count > 0) Marshal.Copy(array, copy, 0, count);
            return copy;
        }

        /// <summary>The same of indices, offsets of 32 bits.</summary>
        public static int[] Integers(IntPtr array, int count)
        {
            var copy = new int[count];
            if (count > 0) Marshal.Copy(array, copy, 0, count);
            return copy;
        }

        /// <summary>The same of offsets of 64 bits.</summary>
        public static long[] Longs(IntPtr array, int count)
        {
            var copy = new long[count];
            if (count > 0) Marshal.Copy(array, copy, 0, count);
            return copy;
        }
    }
"""


def name_of(name: str) -> str:
    return f"@{name}" if name in KEYWORDS else name


class Writer:
    def __init__(self, header: Header) -> None:
        self._header = header

    def text(self) -> str:
        h = self._header
        lines = [HEAD]
        lines += [
            f"        public const uint {name.removeprefix('MEANDER_')} = {value};"
            for name, value in h.constants.items()
        ]
        for name, (result, arguments) in h.functions.items():
            typed = [(self._argument(name, kind), name_of(arg)) for arg, kind in arguments]
            given = ", ".join(" ".join(pair) for pair in typed)
            lines += [
                "",
                "        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]",
                f"        public static extern {self._result(result)} {name}({given});",
            ]
        lines.append(HELPERS)
        for name, members in h.enums.items():
            prefix = name.upper() + "_"
            lines += [
                f"    public enum {class_name(name)} : {NUMBERS[h.scalars[name]]}",
                "    {",
                *(f"        {member.removeprefix(prefix)} = {n}," for member, n in members.items()),
                "    }",
                "",
            ]
        for name, fields in h.structs.items():
            lines += [
                "    [StructLayout(LayoutKind.Sequential)]",
                f"    public class {class_name(name)}",
                "    {",
                *(line for member, kind in fields for line in self._field(member, kind)),
                "    }",
                "",
            ]
        return "\n".join([*lines[:-1], "}", ""])

    def _number(self, base: str) -> str:
        return class_name(base) if base in self._header.enums else NUMBERS[base]

    def _result(self, kind: CType) -> str:
        return "IntPtr" if kind.pointers else self._number(kind.base)

    def _field(self, member: str, kind: CType) -> list[str]:
        if kind.pointers:
            return [f"        public IntPtr {name_of(member)};"]
        number = self._number(kind.base)
        if kind.length is None:
            return [f"        public {number} {name_of(member)};"]
        return [
            f"        [MarshalAs(UnmanagedType.ByValArray, SizeConst = {kind.length})]",
            f"        public {number}[] {name_of(member)};",
        ]

    def _argument(self, function: str, kind: CType) -> str:
        h = self._header
        if kind.pointers == 0:
            return self._number(kind.base)
        if kind.base in h.opaque:
            return "out IntPtr" if kind.pointers == 2 else "IntPtr"
        if kind.base in h.structs:
            return f"[In, Out] {class_name(kind.base)}"
        if kind.base == "char" and function not in _BYTES:
            return "string"
        return f"[In, Out] {self._number(kind.base)}[]"


# Functions whose text has a length of its own, or is written by the library.
_BYTES = (
    "meander_text_read_polygons",
    "meander_text_read_numbers",
    "meander_flow_options_get_warning",
)


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--check", action="store_true", help="write nothing; fail if out of date")
    check = parser.parse_args().check
    text = Writer(read_header(HEADER)).text()
    if OUTPUT.is_file() and OUTPUT.read_text(encoding="utf-8") == text:
        return 0
    if check:
        print(f"{OUTPUT} is out of date; run python3 scripts/write_csharp.py")
        return 1
    OUTPUT.write_text(text, encoding="utf-8")
    return 0


if __name__ == "__main__":
    sys.exit(main())
