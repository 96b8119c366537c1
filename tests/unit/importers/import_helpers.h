// Small inputs for import tests, made in memory, and the check that damage never does more than throw.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <string>
#include <string_view>
#include <vector>

#include "core/error.h"
#include "importers/import.h"

namespace bvhio {

inline std::span<const std::byte> asBytes(std::string_view text) {
    return std::as_bytes(std::span(text));
}

inline Mesh triangleMesh(const std::string& name) {
    return {name, {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}};
}
inline Transform translation(double x, double y, double z) {
    return {1, 0, 0, x, 0, 1, 0, y, 0, 0, 1, z};
}

inline ImportedScene importText(std::string_view text, const std::string& name) {
    return importBytes(asBytes(text), name, ".");
}

inline Scene sceneFrom(std::string_view text, const std::string& name,
                       OnDegenerate choice = OnDegenerate::keep) {
    return flatten(importText(text, name), {choice});
}

/// The message of the Error that the input is refused with; its kind must be as expected.
inline std::string refusal(std::string_view text, const std::string& name,
                           ErrorKind kind = ErrorKind::invalid, OnDegenerate choice = OnDegenerate::keep) {
    try {
        sceneFrom(text, name, choice);
    } catch (const Error& error) {
        EXPECT_EQ(error.kind(), kind) << error.what();
        EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos) << error.what();
        return error.what();
    }
    ADD_FAILURE() << name << " was not refused";
    return "";
}

/// Appends plain values as the machine (little-endian) stores them, or reversed.
class Binary {
  public:
    explicit Binary(bool bigEndian = false) : bigEndian_(bigEndian) {}
    template <class T>
    Binary& add(T value) {
        char bytes[sizeof(T)];
        std::memcpy(bytes, &value, sizeof(T));
        if (bigEndian_) std::reverse(bytes, bytes + sizeof(T));
        text.append(bytes, sizeof(T));
        return *this;
    }
    template <class T>
    Binary& addAll(std::initializer_list<T> values) {
        for (const T value : values) add(value);
        return *this;
    }
    std::string text;

  private:
    bool bigEndian_;
};

/// Imports the input cut at every length and with every bit flipped, or every bitStep-th. Anything but a
/// scene or an Error fails.
inline void damageEverywhere(const std::string& whole, const std::string& name, size_t bitStep = 1) {
    const auto attempt = [&](std::string_view text) {
        // A copy of exactly this size, so that a sanitizer sees a read past its end.
        const std::vector<char> exact(text.begin(), text.end());
        try {
            sceneFrom({exact.data(), exact.size()}, name);
        } catch (const Error&) {
        }
    };
    for (size_t length = 0; length < whole.size(); ++length)
        attempt(std::string_view(whole).substr(0, length));
    for (size_t bit = 0; bit < 8 * whole.size(); bit += bitStep) {
        std::string damaged = whole;
        damaged[bit / 8] = char(damaged[bit / 8] ^ (1 << bit % 8));
        attempt(damaged);
    }
}

}  // namespace bvhio
