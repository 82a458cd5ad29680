// SPDX-License-Identifier: Apache-2.0
#pragma once

/// Which kinds of processors the loops made with Google Highway are compiled for; the best kind that the processor at
/// hand belongs to is chosen when the program runs. To be included before Highway's own headers.
///
/// x86-64: any at all (one number at a time), with SSE4, with AVX2; with AVX-512 only where HOMEWARD_WITH_AVX512 is
/// defined, because each kind costs compile time, and not by Clang, which does not add up what Highway and we say of a
/// processor. 64-bit ARM: NEON, which all of them have.
#if defined(HOMEWARD_WITH_AVX512) && !defined(__clang__)
#define HWY_DISABLED_TARGETS (HWY_SSSE3 | HWY_AVX3_DL | HWY_SVE | HWY_SVE2 | HWY_SVE_256 | HWY_SVE2_128)
#else
#define HWY_DISABLED_TARGETS (HWY_SSSE3 | HWY_AVX3 | HWY_AVX3_DL | HWY_SVE | HWY_SVE2 | HWY_SVE_256 | HWY_SVE2_128)
#endif
