// SPDX-License-Identifier: MIT
// The keys of a material file as a list, for those who need names and ranges without a material: the JSON
// reader knows by it which keys there are, the page's reader and docs/material.md are compared with it.
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
    Range range{};                   // of a number, or of each in a list
    std::optional<double> absent{};  // what stands for a number that is absent
    bool required = false;
    std::size_t most = 0;         // bytes of a text, numbers, tables or objects of a list
    bool heard = true;            // a finger's sound needs it; it goes into the voice numbers
    std::vector<Field> fields{};  // of an object
};

// Of the whole file, in its order. The first call allocates.
const std::vector<Field>& material_fields();

}  // namespace tribo::material
