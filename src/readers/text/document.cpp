// SPDX-License-Identifier: MIT
#include "readers/text/document.hpp"

namespace tribo::readers {

const DocumentNode* Document::child(const DocumentNode& node, std::string_view name) const {
    for (const std::uint32_t place : node.children) {
        if (nodes[place].name == name) return &nodes[place];
    }
    return nullptr;
}

std::string_view Document::text(const DocumentNode& node, std::string_view name) const {
    const DocumentNode* found = child(node, name);
    return found == nullptr ? std::string_view() : std::string_view(found->text);
}

}  // namespace tribo::readers
