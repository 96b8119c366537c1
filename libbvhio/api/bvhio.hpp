// bvhio for C++20: a thin layer over bvhio.h, which is the manual. Handles close themselves, arrays are spans,
// and failures are exceptions.
//
// Everything is in the inline namespace bvhio::api. So programs write bvhio::Container, but the symbols differ
// from those of the same name inside the library, which a program also has if it links the static library.
#ifndef BVHIO_HPP
#define BVHIO_HPP

#if __cplusplus < 202002L && (!defined(_MSVC_LANG) || _MSVC_LANG < 202002L)
#error "bvhio.hpp needs C++20 (-std=c++20, or target_compile_features(... cxx_std_20)); bvhio.h needs only C"
#endif

#include <array>
#include <cstddef>
#include <cstdint>
#include <exception>
#include <functional>
#include <initializer_list>
#include <memory>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "bvhio.h"

namespace bvhio {
inline namespace api {

using Ray = BvhioRay;
using Hit = BvhioHit;
using Node = BvhioNode;
using Info = BvhioInfo;
using Chunk = BvhioChunk;
using Geometry = BvhioGeometry;
using Mesh = BvhioMesh;
using Instance = BvhioInstance;
using History = BvhioHistory;
using Primitive = BvhioPrimitive;
using Placement = BvhioPlacement;

/// A failure. what() is bvhioLastError.
class Error : public std::runtime_error {
  public:
    Error(BvhioStatus status, uint32_t finding, const char* message)
        : std::runtime_error(message), status_(status), finding_(finding) {}
    BvhioStatus status() const { return status_; }
    /// The number of the finding about a file, or 0.
    uint32_t finding() const { return finding_; }

  private:
    BvhioStatus status_;
    uint32_t finding_;
};

/// Throws Error unless a C function succeeded.
inline void check(BvhioStatus status) {
    if (status != BVHIO_OK) throw Error(status, bvhioLastFinding(), bvhioLastError());
}

/// How calls run, like BvhioContext.
struct Context {
    uint32_t threads = 0;
    /// Returns false to cancel: the pass then throws Error with BVHIO_CANCELLED. If it throws, the pass throws
    /// that exception.
    std::function<bool(uint64_t done, uint64_t total)> progress = {};
    std::string program = {}, programVersion = {};
};

/// The options of a pass: {"builder=sweep", "max-leaf-size=8"}.
using Options = std::vector<std::string>;

namespace detail {

template <auto Close>
struct Closer {
    template <class Handle>
    void operator()(Handle* handle) const {
        Close(handle);
    }
};

/// A Context and Options as C functions take them.
class Call {
  public:
    explicit Call(const Context& context, const Options& options = {}) : given_(context) {
        context_.threads = context.threads;
        context_.program = context.program.empty() ? nullptr : context.program.c_str();
        context_.programVersion = context.programVersion.empty() ? nullptr : context.programVersion.c_str();
        if (context.progress) {
            context_.progress = &Call::forward;
            context_.progressUser = this;
        }
        for (const std::string& option : options) options_.push_back(option.c_str());
        options_.push_back(nullptr);
    }
    Call(const Call&) = delete;

    const BvhioContext* context() const { return &context_; }
    const char* const* options() const { return options_.data(); }
    /// Throws unless the function succeeded; an exception of the progress function takes precedence.
    void finish(BvhioStatus status) const {
        if (thrown_) std::rethrow_exception(thrown_);
        check(status);
    }

  private:
    static int forward(void* user, uint64_t done, uint64_t total) noexcept {
        auto* call = static_cast<Call*>(user);
        try {
            return call->given_.progress(done, total) ? 0 : 1;
        } catch (...) {
            call->thrown_ = std::current_exception();
            return 1;
        }
    }

    const Context& given_;
    BvhioContext context_{};
    std::vector<const char*> options_;
    std::exception_ptr thrown_;
};

template <class Element>
std::vector<Element> allOf(const BvhioContainer* container, uint64_t count,
                           BvhioStatus (*get)(const BvhioContainer*, uint64_t, Element*)) {
    std::vector<Element> elements(static_cast<size_t>(count));
    for (uint64_t i = 0; i < count; ++i) check(get(container, i, &elements[static_cast<size_t>(i)]));
    return elements;
}

}  // namespace detail

/// The library's version, as a number like BVHIO_VERSION.
inline uint32_t version() {
    return bvhioVersion();
}

/// A tree, as BvhioTree.
struct Tree {
    std::span<const Node> nodes;
    std::span<const uint32_t> primitives;
};

/// How a file is opened.
struct OpenOptions {
    bool trusted = false;  // see BVHIO_TRUSTED
    uint32_t threads = 0;
    uint32_t flags() const { return trusted ? BVHIO_TRUSTED : 0; }
};

/// A block of memory that bvhioSaveMemory gave.
class Memory {
  public:
    Memory(void* bytes, size_t size) : bytes_(bytes), size_(size) {}
    std::span<const std::byte> bytes() const { return {static_cast<const std::byte*>(bytes_.get()), size_}; }

  private:
    std::unique_ptr<void, detail::Closer<bvhioFree>> bytes_;
    size_t size_;
};

/// A scene and its tree. Moves, but is not copied; spans and texts that it gives live as long as the
/// container.
class Container {
  public:
    static Container open(const std::string& path, const OpenOptions& options = {}) {
        return make(
            [&](const BvhioContext* context, BvhioContainer** handle) {
                return bvhioOpenFile(path.c_str(), options.flags(), context, handle);
            },
            {options.threads});
    }
    /// A part of a larger file; length 0: up to the file's end.
    static Container openRange(const std::string& path, uint64_t offset, uint64_t length,
                               const OpenOptions& options = {}) {
        return make(
            [&](const BvhioContext* context, BvhioContainer** handle) {
                return bvhioOpenFileRange(path.c_str(), offset, length, options.flags(), context, handle);
            },
            {options.threads});
    }
    /// Uses the bytes in place: keep them unchanged while the container exists.
    static Container openMemory(std::span<const std::byte> bytes, const OpenOptions& options = {}) {
        return make(
            [&](const BvhioContext* context, BvhioContainer** handle) {
                return bvhioOpenMemory(bytes.data(), bytes.size(), options.flags(), context, handle);
            },
            {options.threads});
    }
    /// Takes over a handle of the C API.
    explicit Container(BvhioContainer* handle) : handle_(handle) {}

    const BvhioContainer* handle() const { return handle_.get(); }

    Info info() const {
        Info info;
        check(bvhioGetInfo(handle(), &info));
        return info;
    }
    std::vector<Chunk> chunks() const { return detail::allOf(handle(), info().chunkCount, bvhioGetChunk); }
    std::vector<Geometry> geometries() const {
        return detail::allOf(handle(), info().geometryCount, bvhioGetGeometry);
    }
    std::vector<Mesh> meshes() const { return detail::allOf(handle(), info().meshCount, bvhioGetMesh); }
    std::vector<Instance> instances() const {
        return detail::allOf(handle(), info().instanceCount, bvhioGetInstance);
    }
    std::vector<History> history() const {
        return detail::allOf(handle(), info().historyCount, bvhioGetHistory);
    }

    std::span<const std::array<float, 3>> vertices() const {
        const float* values = nullptr;
        uint64_t count = 0;
        check(bvhioGetVertices(handle(), &values, &count));
        return triples(values, count);
    }
    std::span<const std::array<uint32_t, 3>> triangles() const {
        const uint32_t* values = nullptr;
        uint64_t count = 0;
        check(bvhioGetTriangles(handle(), &values, &count));
        return triples(values, count);
    }
    /// Empty if triangles are numbered in order.
    std::span<const uint32_t> sourceIds() const {
        const uint32_t* values = nullptr;
        uint64_t count = 0;
        check(bvhioGetSourceIds(handle(), &values, &count));
        return {values, static_cast<size_t>(count)};
    }
    Tree tree(uint64_t index = 0) const {
        BvhioTree tree;
        check(bvhioGetTree(handle(), index, &tree));
        return {{tree.nodes, static_cast<size_t>(tree.nodeCount)},
                {tree.primitives, static_cast<size_t>(tree.primitiveCount)}};
    }
    Primitive primitive(uint32_t number) const {
        Primitive primitive;
        check(bvhioGetPrimitive(handle(), number, &primitive));
        return primitive;
    }
    double cost() const {
        double cost = 0;
        check(bvhioGetCost(handle(), &cost));
        return cost;
    }

    Container restructure(const Options& options = {}, const Context& context = {}) const {
        return pass(bvhioRestructure, options, context);
    }
    Container relayout(const Options& options = {}, const Context& context = {}) const {
        return pass(bvhioRelayout, options, context);
    }
    Container compress(const Options& options = {}, const Context& context = {}) const {
        return pass(bvhioCompress, options, context);
    }

    void save(const std::string& path, uint32_t threads = 0) const {
        const Context context{threads};
        const detail::Call call(context);
        check(bvhioSaveFile(handle(), path.c_str(), call.context()));
    }
    Memory saveMemory(uint32_t threads = 0) const {
        const Context context{threads};
        const detail::Call call(context);
        void* bytes = nullptr;
        size_t size = 0;
        check(bvhioSaveMemory(handle(), call.context(), &bytes, &size));
        return {bytes, size};
    }

  private:
    template <class Open>
    static Container make(const Open& open, const Context& context) {
        const detail::Call call(context);
        BvhioContainer* handle = nullptr;
        check(open(call.context(), &handle));
        return Container(handle);
    }
    template <class Pass>
    Container pass(const Pass& run, const Options& options, const Context& context) const {
        const detail::Call call(context, options);
        BvhioContainer* result = nullptr;
        call.finish(run(handle(), call.options(), call.context(), &result));
        return Container(result);
    }
    template <class T>
    static std::span<const std::array<T, 3>> triples(const T* values, uint64_t count) {
        static_assert(sizeof(std::array<T, 3>) == 3 * sizeof(T));
        return {reinterpret_cast<const std::array<T, 3>*>(values), static_cast<size_t>(count)};
    }

    std::unique_ptr<BvhioContainer, detail::Closer<bvhioClose>> handle_;
};

/// The arrays of a scene, like BvhioSceneArrays; a span for an array that the scene does not have is empty.
struct SceneArrays {
    std::span<const float> vertices;    // three for each vertex, unless vertexStride says otherwise
    uint64_t vertexStride = 0;          // bytes; 0: 12
    std::span<const uint32_t> indices;  // three for each triangle

    struct Part {
        std::string name;
        uint32_t triangleCount = 0;
    };
    std::vector<Part> parts = {};
    std::span<const uint32_t> sourceIds = {};
    std::span<const uint32_t> meshes = {};
    std::span<const Placement> placements = {};
};

/// A scene, checked. Moves, but is not copied.
class Scene {
  public:
    explicit Scene(const SceneArrays& from) {
        BvhioSceneArrays arrays{};
        std::vector<BvhioPart> parts;
        for (const SceneArrays::Part& part : from.parts)
            parts.push_back({part.name.c_str(), part.triangleCount});
        arrays.vertices = from.vertices.data();
        arrays.vertexStride = from.vertexStride == 0 ? 3 * sizeof(float) : from.vertexStride;
        // The last vertex need not be followed by a whole stride.
        const uint64_t bytes = from.vertices.size_bytes();
        arrays.vertexCount =
            bytes < 3 * sizeof(float) ? 0 : (bytes - 3 * sizeof(float)) / arrays.vertexStride + 1;
        arrays.indices = from.indices.data();
        arrays.triangleCount = from.indices.size() / 3;
        if (from.indices.size() % 3 != 0)
            throw Error(BVHIO_USAGE, 0, "indices are not three for each triangle");
        if (!from.sourceIds.empty() && from.sourceIds.size() != arrays.triangleCount)
            throw Error(BVHIO_USAGE, 0, "sourceIds are not one for each triangle");
        arrays.parts = parts.empty() ? nullptr : parts.data();
        arrays.partCount = parts.size();
        arrays.sourceIds = from.sourceIds.empty() ? nullptr : from.sourceIds.data();
        arrays.meshes = from.meshes.data();
        arrays.meshCount = from.meshes.size();
        arrays.placements = from.placements.data();
        arrays.placementCount = from.placements.size();
        BvhioScene* handle = nullptr;
        check(bvhioCreateScene(&arrays, &handle));
        handle_.reset(handle);
    }

    const BvhioScene* handle() const { return handle_.get(); }

    Container build(const Options& options = {}, const Context& context = {}) const {
        const detail::Call call(context, options);
        BvhioContainer* result = nullptr;
        call.finish(bvhioBuild(handle(), call.options(), call.context(), &result));
        return Container(result);
    }

  private:
    std::unique_ptr<BvhioScene, detail::Closer<bvhioDestroyScene>> handle_;
};

/// Traces rays through a container, from any thread. Does not need the container any more. Moves, but is not
/// copied.
class Tracer {
  public:
    /// With `copiesTriangles` false: see BVHIO_NO_COPY.
    explicit Tracer(const Container& container, bool copiesTriangles = true, uint32_t threads = 0) {
        const Context context{threads};
        const detail::Call call(context);
        BvhioTracer* handle = nullptr;
        check(bvhioCreateTracer(container.handle(), copiesTriangles ? 0 : BVHIO_NO_COPY, call.context(),
                                &handle));
        handle_.reset(handle);
    }

    const BvhioTracer* handle() const { return handle_.get(); }

    /// Whether the ray hits something. Fills `hit` and `primitive` with the closest hit and its primitive's
    /// number.
    bool trace(const Ray& ray, Hit& hit, uint32_t* primitive = nullptr) const {
        return bvhioTraceRay(handle(), &ray, &hit, primitive) != 0;
    }
    bool isOccluded(const Ray& ray) const { return bvhioIsOccluded(handle(), &ray) != 0; }

    /// All spans have the same size; `primitives` may be empty.
    void traceClosest(std::span<const Ray> rays, std::span<Hit> hits, std::span<uint32_t> primitives = {},
                      uint32_t threads = 0) const {
        requireSize(hits.size(), rays.size());
        if (!primitives.empty()) requireSize(primitives.size(), rays.size());
        check(bvhioTraceClosest(handle(), rays.data(), rays.size(), hits.data(),
                                primitives.empty() ? nullptr : primitives.data(), threads));
    }
    void traceAny(std::span<const Ray> rays, std::span<uint8_t> occluded, uint32_t threads = 0) const {
        requireSize(occluded.size(), rays.size());
        check(bvhioTraceAny(handle(), rays.data(), rays.size(), occluded.data(), threads));
    }

  private:
    static void requireSize(size_t size, size_t rays) {
        if (size != rays) throw Error(BVHIO_USAGE, 0, "there are not as many results as rays");
    }

    std::unique_ptr<BvhioTracer, detail::Closer<bvhioDestroyTracer>> handle_;
};

/// The names of a kind's methods; the first is the default.
inline std::vector<std::string_view> methodNames(BvhioMethod kind) {
    std::vector<std::string_view> names;
    for (uint64_t i = 0; i < bvhioMethodCount(kind); ++i) names.emplace_back(bvhioMethodName(kind, i));
    return names;
}

}  // namespace api
}  // namespace bvhio

#endif
