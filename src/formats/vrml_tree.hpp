// SPDX-License-Identifier: MIT
// VRML 2.0 text as a tree of nodes, DEF and USE resolved. The syntax can be read without knowing the nodes; a
// node's role (vrml_nodes.hpp) only says which field values are worth keeping.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "base/result.hpp"
#include "formats/vrml_lexer.hpp"
#include "formats/vrml_nodes.hpp"

namespace tribo::formats {

using VrmlNodeId = std::uint32_t;

struct VrmlValue {
    enum class Kind : std::uint8_t { null, booleans, numbers, strings, nodes };  // null: NULL or []
    Kind kind = Kind::null;
    bool truth = false;
    std::uint32_t first = 0, count = 0;  // of VrmlTree::numbers or VrmlTree::links
    VrmlToken start;                     // its first token
};

struct VrmlField {
    std::string_view name;
    VrmlValue value;
};

struct VrmlNode {
    const VrmlNodeType* type = nullptr;
    int line = 0, column = 0;
    std::uint32_t first_field = 0, fields = 0;
};

// Nodes stand after all nodes below them: a child's id is less than its parent's, so no walk can run in a
// circle. One node may be a child of many (USE).
struct VrmlTree {
    std::vector<VrmlNode> nodes;
    std::vector<VrmlField> fields;
    std::vector<double> numbers;  // finite
    std::vector<VrmlNodeId> links;
    std::vector<VrmlNodeId> roots;
    Warnings warnings;

    // The value given last; null where there is none.
    const VrmlValue* find(VrmlNodeId node, std::string_view field) const;
    std::span<const double> numbers_of(const VrmlValue& value) const;
    std::span<const VrmlNodeId> nodes_of(const VrmlValue& value) const;
};

inline constexpr int kMaxVrmlNesting = 256;

// Reads text whose header line has been checked.
Result<VrmlTree> read_vrml_tree(std::string_view text, const std::string& source_name);

}  // namespace tribo::formats
