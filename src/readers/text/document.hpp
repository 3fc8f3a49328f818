// SPDX-License-Identifier: MIT
// JSON and XML texts as one tree of named nodes. The readers are for tool libraries: bounded in depth and in
// number, and without the parts of XML that read other files. Any thread; allocates.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "base/result.hpp"

namespace tribo::readers {

inline constexpr int kDeepestDocument = 64;
inline constexpr std::size_t kMostDocumentNodes = 1'000'000;

struct DocumentNode {
    // The key in a JSON object, empty in a JSON array. The name of an XML element without its prefix; of an
    // attribute after '@'.
    std::string name;
    // Of a JSON string without its escapes, of a number or word as written; of an XML element or attribute.
    std::string text;
    int line = 0;
    bool is_array = false, is_object = false;  // of JSON; an XML element is an object
    std::vector<std::uint32_t> children;       // places in Document::nodes
};

struct Document {
    std::vector<DocumentNode> nodes;  // [0] is the root; children stand behind their parents

    const DocumentNode& root() const { return nodes.front(); }
    // Returns the first child of this name, or null.
    const DocumentNode* child(const DocumentNode& node, std::string_view name) const;
    // Returns the child's text; empty if there is none.
    std::string_view text(const DocumentNode& node, std::string_view name) const;
};

// RFC 8259. A byte order mark is skipped.
Result<Document> read_json(std::string_view bytes, const std::string& source_name);
// XML 1.0 without entities of its own: a DOCTYPE is skipped, and what it would read or define is not.
Result<Document> read_xml(std::string_view bytes, const std::string& source_name);

}  // namespace tribo::readers
