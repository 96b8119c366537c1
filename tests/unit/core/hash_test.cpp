#include "core/hash.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace bvhio {
namespace {

std::span<const std::byte> bytesOf(const std::string& text) {
    return std::as_bytes(std::span(text));
}

// Fails if another variant is used (XXH64, a seed, 128 bits): files would no longer verify.
TEST(Hash, hasThePublishedValues) {
    EXPECT_EQ(hash64({}), 0x2D06800538D394C2ull);  // the published value of XXH3-64 for no bytes
    EXPECT_EQ(hash64(bytesOf("a")), 0xE6C632B61E964E1Full);
    EXPECT_NE(hash64(bytesOf("a")), hash64(bytesOf("b")));
}

TEST(Hash, piecesGiveTheHashOfTheWhole) {
    std::string text;
    for (int i = 0; i < 5000; ++i) text += char(i * 7 + i / 256);
    for (const size_t piece : {1u, 13u, 240u, 256u, 1024u, 5000u}) {
        Hasher hasher;
        for (size_t at = 0; at < text.size(); at += piece) hasher.update(bytesOf(text.substr(at, piece)));
        EXPECT_EQ(hasher.value(), hash64(bytesOf(text))) << piece;
    }
}

TEST(Hash, goesOnAfterValue) {
    Hasher hasher;
    hasher.update(bytesOf("ab"));
    EXPECT_EQ(hasher.value(), hash64(bytesOf("ab")));
    Hasher moved = std::move(hasher);
    moved.update(bytesOf("c"));
    EXPECT_EQ(moved.value(), hash64(bytesOf("abc")));
    EXPECT_EQ(Hasher().value(), hash64({}));
}

}  // namespace
}  // namespace bvhio
