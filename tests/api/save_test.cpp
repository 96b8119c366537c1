// Saving: whole files or none, over the file that is open too, and to memory.
#include <sys/stat.h>
#include <unistd.h>

#include <cstring>
#include <filesystem>
#include <fstream>

#include "api/handles.h"

namespace apitest {
namespace {

namespace fs = std::filesystem;

/// An empty folder that goes away.
class Folder {
  public:
    Folder() : path_(fs::path(testing::TempDir()) / ("apisave" + std::to_string(::getpid()))) {
        fs::create_directory(path_);
    }
    ~Folder() { fs::remove_all(path_); }
    std::string file(const std::string& name) const { return (path_ / name).string(); }
    size_t count() const {
        return size_t(std::distance(fs::directory_iterator(path_), fs::directory_iterator()));
    }
    std::string path() const { return path_.string(); }

  private:
    fs::path path_;
};

std::string contentOf(const std::string& path) {
    std::ifstream in(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
}

TEST(Save, toMemoryAndToAFileAreTheSameBytes) {
    const Folder folder;
    const Container container = gridContainer();
    const Bytes bytes = saved(container.get());
    EXPECT_EQ(reinterpret_cast<uintptr_t>(bytes.begin()) % 64, 0u);
    ASSERT_EQ(bvhioSaveFile(container.get(), folder.file("a.bvhx").c_str(), nullptr), BVHIO_OK)
        << bvhioLastError();
    EXPECT_TRUE(contentOf(folder.file("a.bvhx")) == std::string(bytes.begin(), bytes.size));
    EXPECT_EQ(folder.count(), 1u);
}

TEST(Save, replacesTheFileThatIsOpen) {
    const Folder folder;
    const std::string path = folder.file("scene.bvhx");
    ASSERT_EQ(bvhioSaveFile(gridContainer(40).get(), path.c_str(), nullptr), BVHIO_OK);
    fs::permissions(path, fs::perms(0600));
    BvhioContainer *opened = nullptr, *changed = nullptr;
    ASSERT_EQ(bvhioOpenFile(path.c_str(), 0, nullptr, &opened), BVHIO_OK);
    const char* options[] = {"layout=bfs", nullptr};
    ASSERT_EQ(bvhioRelayout(opened, options, nullptr, &changed), BVHIO_OK);
    ASSERT_EQ(bvhioSaveFile(changed, path.c_str(), nullptr), BVHIO_OK) << bvhioLastError();
    EXPECT_EQ(fs::status(path).permissions(), fs::perms(0600));
    EXPECT_EQ(folder.count(), 1u);

    // The old one is still whole, and the new one is what was saved.
    const Bytes old = saved(opened), fresh = saved(changed);
    EXPECT_NE(contentOf(path), std::string(old.begin(), old.size));
    EXPECT_EQ(contentOf(path), std::string(fresh.begin(), fresh.size));
    bvhioClose(opened);
    bvhioClose(changed);
}

TEST(Save, throughALinkKeepsTheLink) {
    const Folder folder;
    const Container container = gridContainer();
    std::ofstream(folder.file("target.bvhx")) << "old";
    fs::create_symlink(folder.file("target.bvhx"), folder.file("link.bvhx"));
    ASSERT_EQ(bvhioSaveFile(container.get(), folder.file("link.bvhx").c_str(), nullptr), BVHIO_OK);
    EXPECT_TRUE(fs::is_symlink(folder.file("link.bvhx")));
    EXPECT_NE(contentOf(folder.file("target.bvhx")), "old");
}

TEST(Save, failuresLeaveNothingBehind) {
    const Folder folder;
    const Container container = gridContainer();
    EXPECT_EQ(bvhioSaveFile(container.get(), "/no/such/folder/x.bvhx", nullptr), BVHIO_IO);
    EXPECT_TRUE(lastErrorHas("/no/such/folder/x.bvhx")) << bvhioLastError();
    EXPECT_EQ(bvhioSaveFile(container.get(), folder.path().c_str(), nullptr), BVHIO_IO);
    EXPECT_EQ(bvhioSaveFile(container.get(), "/dev/null", nullptr), BVHIO_IO);
    EXPECT_TRUE(lastErrorHas("not a regular file")) << bvhioLastError();
    EXPECT_EQ(bvhioSaveFile(nullptr, folder.file("x").c_str(), nullptr), BVHIO_USAGE);
    EXPECT_EQ(bvhioSaveFile(container.get(), nullptr, nullptr), BVHIO_USAGE);
    void* bytes = nullptr;
    size_t size = 5;
    EXPECT_EQ(bvhioSaveMemory(nullptr, nullptr, &bytes, &size), BVHIO_USAGE);
    EXPECT_EQ(size, 0u);
    EXPECT_EQ(bvhioSaveMemory(container.get(), nullptr, nullptr, &size), BVHIO_USAGE);
    EXPECT_EQ(bvhioSaveMemory(container.get(), nullptr, &bytes, nullptr), BVHIO_USAGE);
    EXPECT_EQ(folder.count(), 0u);
    bvhioFree(nullptr);
}

TEST(Save, comesBackTheSame) {
    for (const Container& container : {gridContainer(30), build(instancedScene().get())}) {
        const Bytes bytes = saved(container.get());
        BvhioContainer* handle = nullptr;
        ASSERT_EQ(bvhioOpenMemory(bytes.data.get(), bytes.size, 0, nullptr, &handle), BVHIO_OK)
            << bvhioLastError();
        const Container opened(handle);
        const Bytes again = saved(handle);
        ASSERT_EQ(again.size, bytes.size);
        EXPECT_EQ(std::memcmp(again.begin(), bytes.begin(), bytes.size), 0);
    }
}

}  // namespace
}  // namespace apitest
