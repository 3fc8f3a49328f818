// SPDX-License-Identifier: MIT
// The keys of a material file as a list, with names and ranges. The JSON reader uses it as the list of valid
// keys. The reader of the page and docs/material.md are compared with it.
#pragma once

#include <cstddef>
#include <optional>
#include <string_view>
#include <vector>

#include "base/range.hpp"

namespace tribo::material {

enum class FieldKind { text, number, numbers, tables, object, objects };

struct Field {
    std::string_view key;
    FieldKind kind = FieldKind::text;
    Range range{};                   // of a number, or of each number in a list
    std::optional<double> absent{};  // value of an absent number
    bool required = false;
    std::size_t most = 0;         // bytes of a text; numbers, tables or objects of a list
    bool heard = true;            // needed for the sound of a finger; included in the voice numbers
    std::vector<Field> fields{};  // of an object
};

// The fields of the whole file, in its order. The first call allocates.
const std::vector<Field>& material_fields();

}  // namespace tribo::material
