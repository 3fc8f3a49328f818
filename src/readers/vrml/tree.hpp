// SPDX-License-Identifier: MIT
// VRML 2.0 text as a tree of nodes: DEF and USE are resolved, prototypes unfolded, named files read. The role
// of a node (nodes.hpp) determines only which field values are kept.
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

// Place of a word in the text.
struct VrmlPlace {
    std::uint32_t file = 0;  // index into VrmlTree::files
    int line = 0, column = 0;
    std::uint32_t offset = 0;  // in the text of the file
};

struct VrmlValue {
    enum class Kind : std::uint8_t {
        null,  // NULL or []
        booleans,
        numbers,
        strings,
        nodes,
        bound  // IS: the value given by an instance; in templates only
    };
    Kind kind = Kind::null;
    bool truth = false;
    std::uint32_t first = 0,
                  count = 0;  // of numbers, strings or links; bound: index of the field in the interface
    VrmlPlace start;          // of the first word
};

struct VrmlField {
    std::string_view name;
    VrmlValue value;
};

struct VrmlNode {
    const VrmlNodeType* type = nullptr;
    VrmlPlace place;
    std::uint32_t first_field = 0, fields = 0;
    std::uint32_t number = 0;  // role instance: its prototype; inline_file: its refusal, from 1, or 0
    bool is_template = false;  // part of the body of a prototype: copied, never visible itself
};

struct VrmlFile {
    std::string name;
    std::string bytes;      // empty for the first file: the caller owns its bytes
    std::string_view text;  // without a byte order mark
};

// Nodes are stored after all nodes below them: the id of a child is less than that of its parent, so no walk
// can run in a circle. A node may have many parents (USE).
struct VrmlTree {
    std::deque<VrmlFile> files;  // the file of the model first; words in the tree point into the texts
    std::vector<VrmlNode> nodes;
    std::vector<VrmlField> fields;
    std::vector<double> numbers;  // finite
    std::vector<std::string_view> strings;
    std::vector<VrmlNodeId> links;
    std::vector<VrmlNodeId> roots;
    std::vector<Error> refusals;  // of Inline files that were not read; reported if visible
    Warnings warnings;

    // Returns the value given last; null if there is none.
    const VrmlValue* find(VrmlNodeId node, std::string_view field) const;
    std::span<const double> numbers_of(const VrmlValue& value) const;
    std::span<const std::string_view> strings_of(const VrmlValue& value) const;
    std::span<const VrmlNodeId> nodes_of(const VrmlValue& value) const;

    VrmlNodeId add(const VrmlNodeType& type, const VrmlPlace& at, std::span<const VrmlField> with);
    std::unexpected<Error> refuse(const VrmlPlace& at, std::string cause, std::string remedy) const;
    // Adds each text once, and only a limited number of texts.
    void warn_once(const VrmlPlace& at, std::string text);
};

// Stands for a node that is skipped.
const VrmlNodeType& skipped_vrml_node();

inline constexpr int kMaxVrmlNesting = 256;

}  // namespace tribo::readers
