// Writes the golden files into the given folder. Only for a format version that is not released yet.
#include <filesystem>
#include <fstream>
#include <iostream>

#include "golden/golden_files.h"

int main(int argc, char** argv) {
    if (argc != 2) {
        std::cerr << "usage: make_golden FOLDER\n";
        return 1;
    }
    for (const bvhio::GoldenFile& golden : bvhio::goldenFiles()) {
        std::ofstream out(std::filesystem::path(argv[1]) / (golden.name + ".bvhx"), std::ios::binary);
        bvhio::writeBvhx(out, golden.content, golden.options);
    }
}
