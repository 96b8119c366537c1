#include "container/codecs.h"

#include <gtest/gtest.h>

#include <cstring>

#include "container/digest.h"
#include "core/random.h"

namespace bvhio {
namespace {

/// Returns numbers of several kinds: ascending ids, ids with jumps, the extremes, and noise.
std::vector<uint32_t> awkwardNumbers(size_t count) {
    Random random(5);
    std::vector<uint32_t> numbers(count);
    for (size_t i = 0; i < count; ++i) {
        const uint32_t kind = uint32_t(i / 1000 % 4);
        numbers[i] = kind == 0   ? uint32_t(i)
                     : kind == 1 ? uint32_t(i) * 7 + random.below(5)
                     : kind == 2 ? (i % 2 == 0 ? 0xFFFFFFFFu : 0)
                                 : random.below(0xFFFFFFFFu) ^ 0x80000000u;
    }
    return numbers;
}

void expectComesBack(const Codec& codec, std::span<const std::byte> raw) {
    const auto stored = codec.function.encode(raw, codec.function.defaultLevel);
    ASSERT_TRUE(stored) << codec.name << ' ' << raw.size();
    EXPECT_LE(raw.size(), stored->size() * kMaxExpansion) << codec.name << ' ' << raw.size();
    AlignedVector<std::byte> back(raw.size());
    ASSERT_TRUE(codec.function.decode(*stored, back)) << codec.name << ' ' << raw.size();
    EXPECT_TRUE(std::equal(raw.begin(), raw.end(), back.begin())) << codec.name << ' ' << raw.size();
    if (stored->size() > 0) {
        EXPECT_FALSE(codec.function.decode(std::span(*stored).first(stored->size() - 1), back));
    }
}

TEST(Codecs, numbersComeBackFromEachCodec) {
    for (const uint32_t id : {1u, 2u, 3u})
        for (const size_t count : {size_t(100), kBlockSize / 4, kBlockSize / 4 + 1, kBlockSize / 2 + 2}) {
            const auto numbers = awkwardNumbers(count);
            expectComesBack(*findCodec(id), std::as_bytes(std::span(numbers)));
        }
}

// Frames that would expand too much begin with a raw block: for equal bytes, in one frame and in several.
TEST(Codecs, zerosExpandNoMoreThanReadersTake) {
    for (const uint32_t id : {1u, 2u, 3u})
        for (const size_t size : {size_t(1200), size_t(100000), kBlockSize, 3 * kBlockSize + 40}) {
            const std::vector<std::byte> zeros(size);
            expectComesBack(*findCodec(id), zeros);
            const auto stored = findCodec(id)->function.encode(zeros, 3);
            EXPECT_LE(stored->size(), size / 32 + 100 * (size / kBlockSize + 1)) << id << ' ' << size;
        }
}

TEST(Codecs, differencesAreOfWholeNumbers) {
    const std::vector<std::byte> raw(1001);
    for (const uint32_t id : {2u, 3u}) {
        EXPECT_FALSE(findCodec(id)->function.encode(raw, 3));
        const auto stored = findCodec(1)->function.encode(raw, 3);
        AlignedVector<std::byte> back(raw.size());
        EXPECT_FALSE(findCodec(id)->function.decode(*stored, back));
    }
}

TEST(Codecs, differencesAreTakenWhereTheyHelp) {
    const Codec& zstd = choose(codecs(), "codec", "zstd");
    std::vector<uint32_t> ids(5000), triples(6000);
    Random random(1);
    for (size_t i = 0; i < ids.size(); ++i) ids[i] = uint32_t(3 * i) + random.below(4);
    for (size_t i = 0; i < triples.size(); ++i)
        triples[i] = uint32_t(i % 3) * 0x10000000u + uint32_t(i) * 99 + random.below(50);
    const auto codecOf = [&](std::span<const uint32_t> numbers, Numbers kind) {
        return encodePayload(zstd, 3, std::as_bytes(numbers), kind)->codec;
    };
    EXPECT_EQ(codecOf(ids, Numbers::single), 2u);
    EXPECT_EQ(codecOf(triples, Numbers::triples), 3u);
    EXPECT_EQ(codecOf(ids, Numbers::none), 1u);
    std::vector<uint32_t> repeated(5000);  // noise that repeats: matches beat differences
    for (size_t i = 0; i < repeated.size(); ++i)
        repeated[i] = i < 500 ? random.below(0xFFFFFFFFu) : repeated[i - 1 - random.below(499)];
    EXPECT_EQ(codecOf(repeated, Numbers::single), 1u);
    EXPECT_FALSE(
        encodePayload(choose(codecs(), "codec", "none"), 0, std::as_bytes(std::span(ids)), Numbers::single));
}

}  // namespace
}  // namespace bvhio
