// SPDX-License-Identifier: GPL-3.0-or-later
//
// What WebAssembly tells exceptions of C++ by; LLVM expects every program to define it once.
__asm__(".globl __cpp_exception\n"
        ".tagtype __cpp_exception i32\n"
        "__cpp_exception:\n");
