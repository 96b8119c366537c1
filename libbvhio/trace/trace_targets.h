// The kinds of processor that the timed loops are compiled for, included before anything of Highway: they use
// four lanes, with which AVX-512 was no faster than AVX2, and each more takes its time to compile.
#pragma once

#ifndef HWY_DISABLED_TARGETS
#define HWY_DISABLED_TARGETS (HWY_SSSE3 | HWY_AVX3)
#endif
