/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Included before everything else on ARM. Eigen calls fused multiply-add by name where the compiler says that the
 * processor has it, whatever the option about contraction; without this word it multiplies and adds, as on x86-64.
 * The compiler's own header needs the word, so it is read first. */
#if defined(__cplusplus)
#include <arm_neon.h>
#undef __ARM_FEATURE_FMA
#endif
