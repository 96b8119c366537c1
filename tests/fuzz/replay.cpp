// Runs a fuzz harness without libFuzzer: with every file below the given folders, and with mutations of these
// files that are the same in every run. Usage: replay_NAME FOLDER...
#include <algorithm>
#include <chrono>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <vector>

#include "core/random.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size);

namespace {

constexpr uint32_t kRounds = 20;                   // mutations of each file
constexpr auto kBudget = std::chrono::seconds(2);  // for mutations; only slow machines reach it

using Input = std::vector<uint8_t>;

/// Flips, sets, cuts, repeats or overwrites a few bytes.
Input mutated(const Input& original, const Input& other, bvhio::Random& random) {
    Input input = original;
    for (uint32_t changes = 1 + random.below(3); changes > 0 && !input.empty(); --changes) {
        const size_t at = random.below(uint32_t(input.size()));
        switch (random.below(6)) {
            case 0:
                input[at] = uint8_t(input[at] ^ (1u << random.below(8)));
                break;
            case 1:
                input[at] = uint8_t(random.next());
                break;
            case 2:
                input[at] = random.below(2) != 0 ? 0xFF : 0;
                break;
            case 3:
                input.resize(at);
                break;
            case 4:
                for (size_t i = at; i < std::min(at + 4, input.size()); ++i)
                    input[i] = uint8_t(random.next());
                break;
            default:
                if (!other.empty()) input[at] = other[at % other.size()];
                break;
        }
    }
    return input;
}

}  // namespace

int main(int argc, char** argv) {
    std::vector<std::filesystem::path> paths;
    for (int i = 1; i < argc; ++i)
        if (std::filesystem::exists(argv[i]))
            for (const auto& entry : std::filesystem::recursive_directory_iterator(argv[i]))
                if (entry.is_regular_file()) paths.push_back(entry.path());
    std::sort(paths.begin(), paths.end());

    std::vector<Input> inputs;
    for (const auto& path : paths) {
        std::ifstream in(path, std::ios::binary);
        inputs.push_back({std::istreambuf_iterator<char>(in), {}});
        LLVMFuzzerTestOneInput(inputs.back().data(), inputs.back().size());
    }
    const auto end = std::chrono::steady_clock::now() + kBudget;
    bvhio::Random random(1);
    size_t runs = 0;
    for (uint32_t round = 0; round < kRounds && std::chrono::steady_clock::now() < end; ++round)
        for (size_t i = 0; i < inputs.size(); ++i, ++runs) {
            const Input input = mutated(inputs[i], inputs[(i + 1) % inputs.size()], random);
            LLVMFuzzerTestOneInput(input.data(), input.size());
        }
    std::printf("%zu files, %zu mutations\n", inputs.size(), runs);
    return inputs.empty() ? 1 : 0;
}
