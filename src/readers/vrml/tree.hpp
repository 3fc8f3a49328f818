// SPDX-License-Identifier: MIT
// VRML 2.0 text as a tree of nodes: DEF and USE resolved, prototypes unfolded, files that it names read in. A
// node's role (vrml_nodes.hpp) only says which field values are worth keeping.
#pragma once

#include <deque>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "base/result.hpp"
#include "readers/vrml/lexer.hpp"
#include "readers/vrml/nodes.hpp"

namespace tribo::readers {

using VrmlNodeId = std::uint32_t;

// Where something is written.
struct VrmlPlace {
    std::uint32_t file = 0;  // of VrmlTree::files
    int line = 0, column = 0;
    std::uint32_t offset = 0;  // in the file's text
};

struct VrmlValue {
    enum class Kind : std::uint8_t {
        null,  // NULL or []
        booleans,
        numbers,
        strings,
        nodes,
        bound  // IS: the value that an instance gives; found in templates only
    };
    Kind kind = Kind::null;
    bool truth = false;
    std::uint32_t first = 0,
                  count = 0;  // of numbers, strings or links; bound: number of the interface's field
    VrmlPlace start;          // of its first word
};

struct VrmlField {
    std::string_view name;
    VrmlValue value;
};

struct VrmlNode {
    const VrmlNodeType* type = nullptr;
    VrmlPlace place;
    std::uint32_t first_field = 0, fields = 0;
    std::uint32_t number = 0;  // role instance: of its prototype; inline_file: of its refusal, from 1, or 0
    bool is_template = false;  // stands in the body of a prototype: copied, never seen itself
};

struct VrmlFile {
    std::string name;
    std::string bytes;      // empty for the first file, whose bytes are the caller's
    std::string_view text;  // without a byte order mark
};

// Nodes stand after all nodes below them: a child's id is less than its parent's, so no walk can run in a
// circle. One node may be a child of many (USE).
struct VrmlTree {
    std::deque<VrmlFile> files;  // the model's own first; words in the tree point into their texts
    std::vector<VrmlNode> nodes;
    std::vector<VrmlField> fields;
    std::vector<double> numbers;  // finite
    std::vector<std::string_view> strings;
    std::vector<VrmlNodeId> links;
    std::vector<VrmlNodeId> roots;
    std::vector<Error> refusals;  // why files of Inline nodes were not read: told where they would be seen
    Warnings warnings;

    // The value given last; null where there is none.
    const VrmlValue* find(VrmlNodeId node, std::string_view field) const;
    std::span<const double> numbers_of(const VrmlValue& value) const;
    std::span<const std::string_view> strings_of(const VrmlValue& value) const;
    std::span<const VrmlNodeId> nodes_of(const VrmlValue& value) const;

    VrmlNodeId add(const VrmlNodeType& type, const VrmlPlace& at, std::span<const VrmlField> with);
    std::unexpected<Error> refuse(const VrmlPlace& at, std::string cause, std::string remedy) const;
    // Each text once, and no more of them than are worth reading.
    void warn_once(const VrmlPlace& at, std::string text);
};

// What stands for a node that is passed over.
const VrmlNodeType& skipped_vrml_node();

inline constexpr int kMaxVrmlNesting = 256;

}  // namespace tribo::readers
