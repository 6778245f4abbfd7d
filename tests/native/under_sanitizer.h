// SPDX-License-Identifier: GPL-3.0-or-later
//
// Defines MEANDER_UNDER_ASAN where a test is compiled with AddressSanitizer by Clang, and takes eight times as long.
#pragma once

#if defined(__has_feature)
#if __has_feature(address_sanitizer)
#define MEANDER_UNDER_ASAN
#endif
#endif
