// Compares loading with rebuilding. Loading opens a .bvhx file, checks all of it and traces one ray.
// Rebuilding is Embree's medium build over triangles that are in memory already. Files are in the page cache,
// so the times are those of the processor alone. The break-even says how fast a disk must be for loading to
// win if nothing of the file is cached.
// Usage: load_bench [--rounds N] [--threads N] SCENE...

#include <stdlib.h>

#include <cstdlib>
#include <fstream>
#include <optional>

#include "bench_common.h"
#include "build/builders.h"
#include "core/parallel.h"
#include "file/bvhx_file.h"
#include "trace/trace.h"

namespace {

using namespace bvhio;
using namespace bvhio::bench;
namespace fs = std::filesystem;

/// A new directory, which is removed with its files.
class TemporaryDirectory {
  public:
    TemporaryDirectory() {
        std::string pattern = (fs::temp_directory_path() / "load_bench.XXXXXX").string();
        if (!mkdtemp(pattern.data())) throw Error(ErrorKind::io, pattern + ": cannot make this directory");
        path_ = pattern;
    }
    ~TemporaryDirectory() {
        std::error_code ignored;
        fs::remove_all(path_, ignored);
    }
    TemporaryDirectory(const TemporaryDirectory&) = delete;
    const fs::path& path() const { return path_; }

  private:
    fs::path path_;
};

/// A file with one codec, and how long it takes to load.
struct Stored {
    std::string codec;
    fs::path path;
    Samples samples;
};

Stored store(const fs::path& folder, const BvhxFile& content, const std::string& codec, NodeEncoding nodes) {
    const std::string name = nodes == NodeEncoding::topology ? "topology" : codec;
    Stored stored{name, folder / (name + ".bvhx"), {}};
    std::ofstream out(stored.path, std::ios::binary);
    WriteOptions options;
    options.codec = codec;
    options.nodes = nodes;
    writeBvhx(out, content, options);
    out.close();
    if (!out) throw Error(ErrorKind::io, stored.path.string() + ": cannot write");
    return stored;
}

/// Returns a ray from a corner of the scene's box to the middle of a triangle, which surely hits.
Ray firstRay(const Scene& scene, const Bvh& bvh) {
    const Triangle triangle = scene.triangle(scene.triangles.size() / 2);
    const Vec3 middle = (triangle.v0 + triangle.v1 + triangle.v2) * (1.0f / 3);
    Ray ray;
    ray.origin = bvh.nodes[0].bounds.min;
    ray.direction = middle - ray.origin;
    return ray;
}

void measure(const fs::path& path, int rounds, const EmbreeDevice& device, const Table& table) {
    const Scene scene = loadScene(path);
    const Bvh bvh = builders().front().function(scene, {});
    const Ray ray = firstRay(scene, bvh);
    const TemporaryDirectory folder;
    std::vector<Stored> files;
    for (const auto& [codec, nodes] : {std::pair{"none", NodeEncoding::plain},
                                       {"zstd", NodeEncoding::plain},
                                       {"zstd", NodeEncoding::topology}})
        files.push_back(store(folder.path(), {scene, AabbForm(bvh), {}, {}, {}}, codec, nodes));

    Samples embrees;
    for (int round = 0; round < rounds; ++round) {
        {
            EmbreeScene embree(device, scene);
            embrees.add(timeOf([&] { embree.commit(); }));
        }
        for (Stored& stored : files) {
            std::optional<BvhxFile> loaded;
            Hit hit;
            stored.samples.add(timeOf([&] {
                loaded = readBvhx(stored.path);
                const Tracer tracer(loaded->scene, loaded->bvh, TriangleSource::indexed);
                tracer.closestHits({&ray, 1}, {&hit, 1});
            }));
            if (hit.isMiss()) throw Error(ErrorKind::invalid, path.string() + ": the first ray misses");
        }
    }
    for (const Stored& stored : files) {
        const double bytes = double(fs::file_size(stored.path));
        const double saved = embrees.medianWall() - stored.samples.medianWall();
        table.row({path.filename().string() + " " + stored.codec, number(bytes * 1e-6, 1),
                   number(stored.samples.medianWall() * 1e3, 1), number(embrees.medianWall() * 1e3, 1),
                   number(stored.samples.medianWall() / embrees.medianWall(), 3),
                   number(stored.samples.medianProcessor() / embrees.medianProcessor(), 3),
                   saved > 0 ? number(bytes * 1e-9 / saved, 2) : "none"});
    }
}

}  // namespace

int main(int count, char** arguments) {
    const Arguments options(count, arguments);
    if (options.scenes.empty()) {
        std::fprintf(stderr, "usage: load_bench [--rounds N] [--threads N] SCENE...\n");
        return 1;
    }
    try {
        const ThreadLimit limit(options.threads);
        const EmbreeDevice device(options.threads);
        std::printf("GB/s: a disk faster than this loads the file sooner than Embree rebuilds the tree.\n");
        const Table table({"scene and codec", "MB", "load ms", "embree ms", "ratio", "cpu ratio", "GB/s"});
        for (const auto& path : options.scenes) measure(path, options.rounds, device, table);
    } catch (const Error& error) {
        std::fprintf(stderr, "load_bench: %s\n", error.what());
        return int(error.kind());
    }
}
