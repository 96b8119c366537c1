// Parts that the benchmarks share: scenes, clocks, Embree for comparison, and tables.
#pragma once

#include <embree3/rtcore.h>
#include <time.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <string>
#include <vector>

#include "importers/import.h"

namespace bvhio::bench {

inline Scene loadScene(const std::filesystem::path& path) {
    return flatten(importFile(path), {});
}

/// Wall-clock time, and processor time over all threads, which other programs disturb less.
struct Seconds {
    double wall = 0, processor = 0;
};

template <class Work>
Seconds timeOf(const Work& work) {
    const auto processor = [] {
        timespec t;
        clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
        return double(t.tv_sec) + double(t.tv_nsec) * 1e-9;
    };
    const double processorBefore = processor();
    const auto before = std::chrono::steady_clock::now();
    work();
    const double wall = std::chrono::duration<double>(std::chrono::steady_clock::now() - before).count();
    return {wall, processor() - processorBefore};
}

inline double median(std::vector<double> values) {
    const auto middle = values.begin() + std::ptrdiff_t(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
}

/// The arguments of build_bench and load_bench: [--rounds N] [--threads N] SCENE..., and one option of the
/// program's own, which may be given several times.
struct Arguments {
    int rounds = 15;
    size_t threads = 2;
    std::vector<std::filesystem::path> scenes;

    Arguments(int count, char** arguments, const char* own = "", std::vector<std::string>* values = nullptr) {
        for (int i = 1; i < count; ++i) {
            if (std::strcmp(arguments[i], "--rounds") == 0 && i + 1 < count) {
                rounds = std::max(1, std::atoi(arguments[++i]));
            } else if (std::strcmp(arguments[i], "--threads") == 0 && i + 1 < count) {
                threads = size_t(std::max(1, std::atoi(arguments[++i])));
            } else if (values != nullptr && std::strcmp(arguments[i], own) == 0 && i + 1 < count) {
                values->emplace_back(arguments[++i]);
            } else {
                scenes.emplace_back(arguments[i]);
            }
        }
    }
};

/// Rounds of one measurement.
struct Samples {
    std::vector<double> wall, processor;
    void add(const Seconds& seconds) {
        wall.push_back(seconds.wall);
        processor.push_back(seconds.processor);
    }
    double medianWall() const { return median(wall); }
    double medianProcessor() const { return median(processor); }
};

class EmbreeDevice {
  public:
    explicit EmbreeDevice(size_t threads)
        : device_(rtcNewDevice(("threads=" + std::to_string(threads)).c_str())) {}
    ~EmbreeDevice() { rtcReleaseDevice(device_); }
    EmbreeDevice(const EmbreeDevice&) = delete;
    EmbreeDevice& operator=(const EmbreeDevice&) = delete;
    RTCDevice get() const { return device_; }

  private:
    RTCDevice device_;
};

/// A Scene as Embree's triangle mesh, over our arrays; `commit` builds its hierarchy. The Scene must outlive
/// it.
class EmbreeScene {
  public:
    EmbreeScene(const EmbreeDevice& device, const Scene& scene,
                RTCBuildQuality quality = RTC_BUILD_QUALITY_MEDIUM, RTCSceneFlags flags = RTC_SCENE_FLAG_NONE)
        : scene_(rtcNewScene(device.get())) {
        rtcSetSceneBuildQuality(scene_, quality);
        rtcSetSceneFlags(scene_, flags);
        // Embree reads 16 bytes at the last vertex, so it gets its own arrays.
        const RTCGeometry geometry = rtcNewGeometry(device.get(), RTC_GEOMETRY_TYPE_TRIANGLE);
        rtcSetGeometryBuildQuality(geometry, quality);
        void* vertices = rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                                 sizeof(Vec3), scene.vertices.size());
        std::copy_n(scene.vertices.data(), scene.vertices.size(), static_cast<Vec3*>(vertices));
        void* triangles = rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                                  sizeof(TriangleIndices), scene.triangles.size());
        std::copy_n(scene.triangles.data(), scene.triangles.size(), static_cast<TriangleIndices*>(triangles));
        rtcCommitGeometry(geometry);
        rtcAttachGeometry(scene_, geometry);
        rtcReleaseGeometry(geometry);
    }
    ~EmbreeScene() { rtcReleaseScene(scene_); }
    EmbreeScene(const EmbreeScene&) = delete;
    EmbreeScene& operator=(const EmbreeScene&) = delete;

    void commit() { rtcCommitScene(scene_); }
    RTCScene get() const { return scene_; }

  private:
    RTCScene scene_;
};

/// Prints rows under a header. The first column is aligned to the left, the others to the right.
class Table {
  public:
    explicit Table(const std::vector<std::string>& header) { row(header); }
    void row(const std::vector<std::string>& cells) const {
        for (size_t i = 0; i < cells.size(); ++i) std::printf(i == 0 ? "%-32s" : "%12s", cells[i].c_str());
        std::printf("\n");
        std::fflush(stdout);
    }
};

inline std::string number(double value, int decimals) {
    char text[64];
    std::snprintf(text, sizeof text, "%.*f", decimals, value);
    return text;
}

}  // namespace bvhio::bench
