#include "build/builders.h"

#include "build/binned.h"
#include "build/lbvh.h"
#include "build/median.h"
#include "build/ploc.h"
#include "build/spatial.h"
#include "build/sweep.h"

namespace bvhio {

std::span<const Builder> builders() {
    static constexpr Builder kTable[] = {
        {"binned", "SAH over bins of centroids: fast, good trees", {buildBinned, kUsesBins}},
        {"sweep",
         "SAH over all planes between centroids: twice the time of binned, mostly better trees",
         {buildSweep, kUsesNothing}},
        {"spatial",
         "SAH that may split triangles between nodes (SBVH): better trees, more references",
         {buildSpatial, kUsesBins | kUsesSplitBudget}},
        {"lbvh",
         "order along the Morton curve: several times faster to build, worse trees",
         {buildLbvh, kUsesNothing}},
        {"ploc",
         "clustering of near triangles from the leaves up: often better than binned",
         {buildPloc, kUsesNothing}},
        {"median",
         "object median along the longest axis: the simplest tree, without SAH",
         {buildMedian, kUsesNothing}},
    };
    return kTable;
}

}  // namespace bvhio
