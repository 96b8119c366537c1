#include "importers/ply_header.h"

#include <algorithm>

#include "core/error.h"
#include "core/plural.h"
#include "importers/text_cursor.h"

namespace bvhio {

namespace {

std::optional<PlyType> typeNamed(std::string_view name) {
    struct Row {
        std::string_view name, alias;
        PlyType type;
    };
    static constexpr Row kTypes[] = {
        {"char", "int8", PlyType::int8},        {"uchar", "uint8", PlyType::uint8},
        {"short", "int16", PlyType::int16},     {"ushort", "uint16", PlyType::uint16},
        {"int", "int32", PlyType::int32},       {"uint", "uint32", PlyType::uint32},
        {"float", "float32", PlyType::float32}, {"double", "float64", PlyType::float64},
    };
    for (const Row& row : kTypes)
        if (name == row.name || name == row.alias) return row.type;
    return std::nullopt;
}

}  // namespace

size_t PlyElement::minBytes() const {
    size_t bytes = 0;
    for (const PlyProperty& property : properties)
        bytes += byteSize(property.listCount.value_or(property.type));
    return bytes;
}

bool PlyElement::hasList() const {
    return std::any_of(properties.begin(), properties.end(),
                       [](const PlyProperty& p) { return p.listCount.has_value(); });
}

int PlyElement::find(const std::string& property) const {
    for (size_t i = 0; i < properties.size(); ++i)
        if (properties[i].name == property) return int(i);
    return -1;
}

PlyHeader readPlyHeader(std::span<const std::byte> bytes, const std::string& name) {
    TextCursor cursor(bytes);
    PlyHeader header;
    const auto fail = [&](const std::string& what) -> void {
        throw Error(ErrorKind::invalid,
                    name + ": PLY header, line " + std::to_string(cursor.lineNumber()) + ": " + what);
    };
    const auto readType = [&]() -> PlyType {
        const std::string_view word = cursor.word();
        const std::optional<PlyType> type = typeNamed(word);
        if (!type) fail("'" + std::string(word) + "' is not a type");
        return *type;
    };

    cursor.skipLine();  // "ply", which made the file be read as one
    bool formatSeen = false;
    for (;; cursor.skipLine()) {
        if (cursor.atEnd()) fail("the file ends before end_header");
        const std::string_view keyword = cursor.word();
        if (keyword == "end_header") break;
        if (keyword == "format") {
            const std::string_view format = cursor.word();
            formatSeen = true;
            if (format == "ascii") {
                header.format = PlyFormat::ascii;
            } else if (format == "binary_little_endian") {
                header.format = PlyFormat::littleEndian;
            } else if (format == "binary_big_endian") {
                header.format = PlyFormat::bigEndian;
            } else {
                fail("the format must be ascii, binary_little_endian or binary_big_endian");
            }
        } else if (keyword == "element") {
            PlyElement element;
            element.name = cursor.word();
            long long count = 0;
            if (!cursor.integer(count) || count < 0) fail("the element does not have a count");
            element.count = uint64_t(count);
            header.elements.push_back(std::move(element));
        } else if (keyword == "property") {
            if (header.elements.empty()) fail("a property comes before the first element");
            PlyProperty property;
            TextCursor ahead = cursor;
            if (ahead.word() == "list") {
                cursor.word();
                property.listCount = readType();
                if (*property.listCount >= PlyType::float32) fail("a list's length must be an integer");
            }
            property.type = readType();
            property.name = cursor.word();
            header.elements.back().properties.push_back(std::move(property));
        }
    }
    if (!formatSeen) fail("the format is missing");

    // The body begins after exactly one line end: binary data may begin with bytes that look like another.
    cursor.skipLine();
    header.size = cursor.offset();
    uint64_t bytesLeft = bytes.size() - header.size;
    for (const PlyElement& element : header.elements) {
        // In text, a value takes at least a digit and a space; the file's last value needs no space.
        const uint64_t each =
            header.format == PlyFormat::ascii ? 2 * element.properties.size() : uint64_t(element.minBytes());
        if (each > 0 && element.count > (bytesLeft + 1) / each)
            throw Error(ErrorKind::invalid, name + ": the header claims " +
                                                counted(element.count, "element") + " '" + element.name +
                                                "', more than the file can hold: it is cut short or damaged");
        if (each == 0 && element.count > 0 && header.format != PlyFormat::ascii) continue;
        bytesLeft -= std::min(bytesLeft, element.count * each);
    }
    return header;
}

}  // namespace bvhio
