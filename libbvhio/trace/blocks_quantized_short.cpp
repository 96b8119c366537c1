// Tracing the quantized-short form in triangle blocks.
#define BVHIO_TRACED_FORM QuantizedShortForm
#include "trace/blocks_targets.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "trace/trace_blocks_simd.h"
#include <hwy/foreach_target.h>

#include "trace/trace_blocks_simd.h"
