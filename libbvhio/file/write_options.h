// How a .bvhx file is to be written.
#pragma once

#include <string>

namespace bvhio {

enum class GeometryEncoding { raw, draco };
/// Nodes as the form has them, or only their topology: the reader fits the same boxes to the triangles again.
enum class NodeEncoding { plain, topology };

/// kept: vertices stay in order. smaller: Draco stores them in this order or in the order of first use by
/// triangles, whichever takes fewer bytes.
enum class VertexOrder { kept, smaller };

struct WriteOptions {
    std::string codec = "none";  // a row of codecs()
    int codecLevel = 0;          // 0: the codec's default
    NodeEncoding nodes = NodeEncoding::plain;
    GeometryEncoding geometry = GeometryEncoding::raw;
    int dracoPositionBits = 16;
    VertexOrder dracoVertices = VertexOrder::kept;
};

}  // namespace bvhio
