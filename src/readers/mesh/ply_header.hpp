// SPDX-License-Identifier: MIT
// The header of a PLY file: its elements and their types.
#pragma once

#include "readers/text/model_text.hpp"

namespace tribo::readers {

enum class PlyEncoding { text, little_endian, big_endian };
enum class PlyType : std::uint8_t { none, int8, uint8, int16, uint16, int32, uint32, float32, float64 };

std::size_t size_of(PlyType type);
inline bool is_integer(PlyType type) {
    return type != PlyType::float32 && type != PlyType::float64;
}

struct PlyProperty {
    std::string_view name;
    PlyType type = PlyType::none;
    PlyType count_type = PlyType::none;  // type of the length of a list; none: a single value

    bool is_list() const { return count_type != PlyType::none; }
};

struct PlyElement {
    std::string_view name;
    std::uint64_t count = 0;
    int line = 0;
    std::vector<PlyProperty> properties;

    // Returns the index of the property; -1 if there is none.
    int find(std::string_view property) const;
};

struct PlyHeader {
    PlyEncoding encoding = PlyEncoding::text;
    std::vector<PlyElement> elements;
};

// Reads up to and including `end_header` and its line end. The names in the header point into the text of the
// cursor.
Result<PlyHeader> read_ply_header(TextCursor& cursor, const std::string& source_name);

}  // namespace tribo::readers
