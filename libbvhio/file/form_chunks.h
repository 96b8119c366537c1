// The chunks of a tree: its parameters (format-spec/chunks.md 7), then those of its form (the form's page).
#pragma once

#include "compress/forms.h"
#include "file/chunks.h"
#include "file/write_options.h"
#include "tree/sah_cost.h"

namespace bvhio {

/// Writes the chunks of a tree. `scene` is the scene that a reader will see.
void writeTree(ContainerWriter& writer, const EncodedBvh& bvh, const SahCosts& costs, const Scene& scene,
               NodeEncoding encoding);

/// Returns the tree with boxes fitted to the scene's vertices, which have moved.
EncodedBvh refitTo(const EncodedBvh& bvh, const Scene& scene);

struct StoredTree {
    EncodedBvh bvh;
    SahCosts costs;
};

/// Reads a tree over the scene's triangles. Throws FindingError if it is not valid.
StoredTree readTree(ChunkSequence& chunks, const Scene& scene);

}  // namespace bvhio
