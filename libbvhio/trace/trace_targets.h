// The kinds of processor for which the timed loops are compiled. Must be included before Highway. The loops
// use four lanes, with which AVX-512 was not faster than AVX2, and each additional kind takes time to
// compile.
#pragma once

#ifndef HWY_DISABLED_TARGETS
#define HWY_DISABLED_TARGETS (HWY_SSSE3 | HWY_AVX3)
#endif
