// Opening containers: from files, parts of files and memory, checked and trusted; and every way it fails.
#include <unistd.h>

#include <cstring>
#include <filesystem>
#include <fstream>

#include "api/handles.h"

namespace apitest {
namespace {

namespace fs = std::filesystem;

fs::path temporaryPath(const std::string& name) {
    return fs::path(testing::TempDir()) / ("api" + std::to_string(::getpid()) + name);
}

/// A file that goes away.
class TemporaryFile {
  public:
    TemporaryFile(const std::string& name, const std::string& bytes) : path_(temporaryPath(name)) {
        std::ofstream(path_, std::ios::binary) << bytes;
    }
    ~TemporaryFile() { fs::remove(path_); }
    std::string path() const { return path_.string(); }

  private:
    fs::path path_;
};

std::string sample(uint32_t side = 8) {
    const Container container = gridContainer(side);
    const Bytes bytes = saved(container.get());
    return {bytes.begin(), bytes.size};
}

bool isMapped(const std::string& name) {
    std::ifstream maps("/proc/self/maps");
    const std::string text{std::istreambuf_iterator<char>(maps), {}};
    return text.find(name) != std::string::npos;
}

/// Bytes at an address of choice, off a multiple of 64.
class Placed {
  public:
    // Not inlined: g++ 12 would take an empty file's bytes for a copy of nearly 2^64, and warn.
    [[gnu::noinline]] Placed(const std::string& bytes, size_t off) : memory_(bytes.size() + 128) {
        const auto address = reinterpret_cast<uintptr_t>(memory_.data());
        begin_ = memory_.data() + (64 - address % 64) + off;
        std::memcpy(begin_, bytes.data(), bytes.size());
        size_ = bytes.size();
    }
    const char* begin() const { return begin_; }
    char* begin() { return begin_; }
    size_t size() const { return size_; }
    bool holds(const void* pointer) const {
        return pointer >= static_cast<const void*>(begin_) &&
               pointer < static_cast<const void*>(begin_ + size_);
    }

  private:
    std::vector<char> memory_;
    char* begin_;
    size_t size_;
};

const float* verticesOf(const Container& container) {
    const float* xyz = nullptr;
    uint64_t count = 0;
    EXPECT_EQ(bvhioGetVertices(container.get(), &xyz, &count), BVHIO_OK);
    return xyz;
}

Container opened(const Placed& bytes, uint32_t flags = 0) {
    BvhioContainer* container = nullptr;
    EXPECT_EQ(bvhioOpenMemory(bytes.begin(), bytes.size(), flags, nullptr, &container), BVHIO_OK)
        << bvhioLastError();
    return Container(container);
}

TEST(Open, mapsAFileThatMayThenBeRemoved) {
    const std::string bytes = sample();
    Container container;
    {
        const TemporaryFile file("map.bvhx", bytes);
        BvhioContainer* handle = nullptr;
        ASSERT_EQ(bvhioOpenFile(file.path().c_str(), 0, nullptr, &handle), BVHIO_OK) << bvhioLastError();
        container.reset(handle);
    }
    EXPECT_TRUE(isMapped("map.bvhx"));
    EXPECT_EQ(infoOf(container.get()).triangleCount, 128u);
    container.reset();
    EXPECT_FALSE(isMapped("map.bvhx"));
}

TEST(Open, usesMemoryInPlaceWhereItIsAligned) {
    const Placed bytes(sample(), 0);
    const Container container = opened(bytes);
    EXPECT_TRUE(bytes.holds(verticesOf(container)));
    BvhioTree tree;
    ASSERT_EQ(bvhioGetTree(container.get(), 0, &tree), BVHIO_OK);
    EXPECT_TRUE(bytes.holds(tree.nodes));
    EXPECT_TRUE(bytes.holds(tree.primitives));
}

TEST(Open, copiesFromMemoryThatIsNotAligned) {
    const std::string sampled = sample();
    for (const size_t off : {1u, 4u, 16u, 63u}) {
        Placed bytes(sampled, off);
        const Container container = opened(bytes);
        EXPECT_FALSE(bytes.holds(verticesOf(container)));
        EXPECT_EQ(reinterpret_cast<uintptr_t>(verticesOf(container)) % 64, 0u);
        std::memset(bytes.begin(), 0xFF, bytes.size());
        const Bytes again = saved(container.get());
        ASSERT_EQ(again.size, sampled.size());
        EXPECT_EQ(std::memcmp(again.data.get(), sampled.data(), sampled.size()), 0);
    }
}

TEST(Open, opensAPartOfALargerFile) {
    const std::string bytes = sample();
    for (const size_t before : {0u, 64u, 1000u, 4096u, 12345u}) {
        const TemporaryFile file("pack.bin", std::string(before, 'x') + bytes + "behind");
        BvhioContainer* handle = nullptr;
        ASSERT_EQ(bvhioOpenFileRange(file.path().c_str(), before, bytes.size(), 0, nullptr, &handle),
                  BVHIO_OK)
            << bvhioLastError();
        const Container container(handle);
        EXPECT_EQ(infoOf(handle).triangleCount, 128u);
        EXPECT_EQ(isMapped("pack.bin"), before % 64 == 0) << before;
    }
    // Up to the end.
    const TemporaryFile file("pack.bin", std::string(64, 'x') + bytes);
    BvhioContainer* handle = nullptr;
    ASSERT_EQ(bvhioOpenFileRange(file.path().c_str(), 64, 0, 0, nullptr, &handle), BVHIO_OK)
        << bvhioLastError();
    bvhioClose(handle);
}

TEST(Open, refusesRangesThatAreNotInTheFile) {
    const std::string bytes = sample();
    const TemporaryFile file("range.bin", bytes);
    const uint64_t ranges[][2] = {
        {bytes.size(), 0}, {0, bytes.size() + 1}, {64, bytes.size()}, {UINT64_MAX, 1}, {64, UINT64_MAX}};
    for (const auto& range : ranges) {
        BvhioContainer* handle = nullptr;
        EXPECT_EQ(bvhioOpenFileRange(file.path().c_str(), range[0], range[1], 0, nullptr, &handle),
                  BVHIO_INVALID);
        EXPECT_EQ(handle, nullptr);
        EXPECT_TRUE(lastErrorHas("is not within the file's")) << bvhioLastError();
    }
    BvhioContainer* handle = nullptr;
    EXPECT_EQ(bvhioOpenFileRange(file.path().c_str(), 64, bytes.size() - 64, 0, nullptr, &handle),
              BVHIO_INVALID);
    EXPECT_EQ(bvhioLastFinding(), 1001u);  // the signature
}

TEST(Open, failsWithTheStatusOfWhatIsWrong) {
    BvhioContainer* handle = nullptr;
    EXPECT_EQ(bvhioOpenFile("/no/such/file.bvhx", 0, nullptr, &handle), BVHIO_IO);
    EXPECT_TRUE(lastErrorHas("/no/such/file.bvhx")) << bvhioLastError();
    EXPECT_EQ(bvhioLastFinding(), 0u);
    EXPECT_EQ(bvhioOpenFileRange("/no/such/file.bvhx", 0, 0, 0, nullptr, &handle), BVHIO_IO);
    EXPECT_EQ(bvhioOpenFile(testing::TempDir().c_str(), 0, nullptr, &handle), BVHIO_IO);
    EXPECT_EQ(bvhioOpenMemory("not a container", 15, 0, nullptr, &handle), BVHIO_INVALID);
    EXPECT_EQ(bvhioLastFinding(), 1001u);
    EXPECT_EQ(bvhioOpenMemory("", 0, 0, nullptr, &handle), BVHIO_INVALID);
    EXPECT_EQ(bvhioOpenFile(nullptr, 0, nullptr, &handle), BVHIO_USAGE);
    EXPECT_STREQ(bvhioLastError(), "path is NULL");
    EXPECT_EQ(bvhioOpenFileRange(nullptr, 0, 0, 0, nullptr, &handle), BVHIO_USAGE);
    EXPECT_EQ(bvhioOpenMemory(nullptr, 9, 0, nullptr, &handle), BVHIO_USAGE);
    EXPECT_EQ(bvhioOpenMemory("", 0, 0, nullptr, nullptr), BVHIO_USAGE);
    EXPECT_EQ(bvhioOpenMemory("", 0, 2, nullptr, &handle), BVHIO_USAGE);
    EXPECT_TRUE(lastErrorHas("flags")) << bvhioLastError();
    EXPECT_EQ(handle, nullptr);
    bvhioClose(nullptr);
}

TEST(Open, checkedFindsEveryDamageOfAPayloadAndTrustedSkipsTheSearch) {
    const std::string sampled = sample();
    const size_t vertices = sampled.find("VERT") + 64, nodes = sampled.find("NODE") + 64;
    for (const size_t at : {vertices, nodes}) {
        Placed bytes(sampled, 0);
        bytes.begin()[at + 5] ^= 1;
        BvhioContainer* handle = nullptr;
        EXPECT_EQ(bvhioOpenMemory(bytes.begin(), bytes.size(), 0, nullptr, &handle), BVHIO_INVALID);
        EXPECT_EQ(bvhioLastFinding(), 1016u) << bvhioLastError();
        EXPECT_EQ(handle, nullptr);
        const Container trusted = opened(bytes, BVHIO_TRUSTED);
        EXPECT_EQ(infoOf(trusted.get()).triangleCount, 128u);
    }
    // What holds the file together is still checked.
    Placed bytes(sampled, 0);
    bytes.begin()[sampled.find("VERT") + 16] ^= 1;
    BvhioContainer* handle = nullptr;
    EXPECT_EQ(bvhioOpenMemory(bytes.begin(), bytes.size(), BVHIO_TRUSTED, nullptr, &handle), BVHIO_INVALID);
    EXPECT_EQ(bvhioOpenMemory(bytes.begin(), bytes.size() - 64, BVHIO_TRUSTED, nullptr, &handle),
              BVHIO_INVALID);
}

TEST(Open, trustedGivesTheSameContent) {
    for (const Container& made : {gridContainer(), build(instancedScene().get())}) {
        const Bytes bytes = saved(made.get());
        const Placed placed({bytes.begin(), bytes.size}, 0);
        const Container checked = opened(placed), trusted = opened(placed, BVHIO_TRUSTED);
        EXPECT_EQ(infoOf(checked.get()).contentHash, infoOf(trusted.get()).contentHash);
        EXPECT_NE(infoOf(checked.get()).contentHash, 0u);
        const Bytes again = saved(trusted.get());
        ASSERT_EQ(again.size, bytes.size);
        EXPECT_EQ(std::memcmp(again.data.get(), bytes.data.get(), bytes.size), 0);
    }
}

struct Found {
    std::vector<std::string> lines;
    static void add(void* user, uint32_t id, int isError, const char* message, const char* chunk,
                    uint64_t offset, uint64_t node) {
        static_cast<Found*>(user)->lines.push_back(
            std::to_string(id) + (isError != 0 ? " error " : " warning ") + chunk + " " +
            (node == UINT64_MAX ? "" : "node ") + (offset == UINT64_MAX ? "" : "offset ") + message);
    }
};

TEST(Check, reportsAllFindings) {
    std::string bytes = sample();
    Found found;
    EXPECT_EQ(bvhioCheckMemory(bytes.data(), bytes.size(), nullptr, Found::add, &found), BVHIO_OK);
    EXPECT_TRUE(found.lines.empty());

    bytes[bytes.find("VERT") + 64] ^= 1;
    const TemporaryFile file("check.bvhx", bytes);
    EXPECT_EQ(bvhioCheckFile(file.path().c_str(), nullptr, Found::add, &found), BVHIO_OK) << bvhioLastError();
    ASSERT_EQ(found.lines.size(), 1u);
    EXPECT_EQ(found.lines[0].substr(0, 22), "1016 error VERT offset") << found.lines[0];

    EXPECT_EQ(bvhioCheckFile("/no/such/file.bvhx", nullptr, Found::add, &found), BVHIO_IO);
    EXPECT_EQ(bvhioCheckFile(nullptr, nullptr, Found::add, &found), BVHIO_USAGE);
    EXPECT_EQ(bvhioCheckMemory(nullptr, 5, nullptr, Found::add, &found), BVHIO_USAGE);
    EXPECT_EQ(bvhioCheckMemory("", 0, nullptr, nullptr, &found), BVHIO_USAGE);
}

/// The process's memory in pages.
long residentPages() {
    long size = 0, resident = 0;
    std::ifstream("/proc/self/statm") >> size >> resident;
    return resident;
}

TEST(Open, aHundredThousandTimesLeavesMemoryFlat) {
    const std::string bytes = sample(1);
    const TemporaryFile file("many.bvhx", bytes);
    const std::string path = file.path();
    const BvhioContext one{1, nullptr, nullptr, nullptr, nullptr};
    const auto openAndClose = [&](int times) {
        for (int i = 0; i < times; ++i) {
            BvhioContainer* handle = nullptr;
            ASSERT_EQ(bvhioOpenFile(path.c_str(), 0, &one, &handle), BVHIO_OK) << bvhioLastError();
            if (i % 100 == 0) {
                const Tracer tracer = makeTracer(handle);
                const BvhioRay ray = rayDown(0.25f, 0.25f);
                ASSERT_EQ(bvhioIsOccluded(tracer.get(), &ray), 1);
            }
            bvhioClose(handle);
        }
    };
    openAndClose(2000);
#ifdef BVHIO_SANITIZED
    GTEST_SKIP() << "sanitizers keep freed memory for a while, so it cannot be flat";
#endif
    const long before = residentPages();
    openAndClose(100000);
    EXPECT_LE(residentPages() - before, 256) << "pages";
}

}  // namespace
}  // namespace apitest
