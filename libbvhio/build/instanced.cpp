#include "build/instanced.h"

#include "build/binned.h"
#include "build/spatial.h"

namespace bvhio {

InstancedBvh buildInstanced(const Scene& scene, const Builder& builder, const BuildOptions& options) {
    BuildOptions own = options;
    own.progress = nullptr;
    InstancedBvh result;
    if (options.progress) options.progress->start(scene.triangles.size());
    for (const SceneMesh& mesh : scene.meshes) {
        result.meshes.push_back(builder.function(sceneOfMesh(scene, mesh), own));
        if (options.progress) options.progress->add(mesh.triangleCount);
    }
    own.maxLeafSize = 1;
    const auto build = builder.function.run == buildSpatial ? buildBinned : builder.function.run;
    result.top = build(sceneOfInstances(scene), own);
    return result;
}

}  // namespace bvhio
