// SPDX-License-Identifier: MIT
#include "readers/vrml/tree.hpp"

#include <utility>

namespace tribo::readers {
namespace {

constexpr std::size_t kMaxWarnings = 32;

}  // namespace

const VrmlNodeType& skipped_vrml_node() {
    static constexpr VrmlNodeType type{"", VrmlRole::silent};
    return type;
}

const VrmlValue* VrmlTree::find(VrmlNodeId node, std::string_view field) const {
    const VrmlNode& n = nodes[node];
    for (std::uint32_t i = n.first_field; i < n.first_field + n.fields; ++i) {
        if (fields[i].name == field) return &fields[i].value;
    }
    return nullptr;
}

std::span<const double> VrmlTree::numbers_of(const VrmlValue& value) const {
    if (value.kind != VrmlValue::Kind::numbers) return {};
    return std::span(numbers).subspan(value.first, value.count);
}

std::span<const std::string_view> VrmlTree::strings_of(const VrmlValue& value) const {
    if (value.kind != VrmlValue::Kind::strings) return {};
    return std::span(strings).subspan(value.first, value.count);
}

std::span<const VrmlNodeId> VrmlTree::nodes_of(const VrmlValue& value) const {
    if (value.kind != VrmlValue::Kind::nodes) return {};
    return std::span(links).subspan(value.first, value.count);
}

VrmlNodeId VrmlTree::add(const VrmlNodeType& type, const VrmlPlace& at, std::span<const VrmlField> with) {
    VrmlNode node;
    node.type = &type;
    node.place = at;
    node.first_field = static_cast<std::uint32_t>(fields.size());
    node.fields = static_cast<std::uint32_t>(with.size());
    nodes.push_back(node);
    fields.insert(fields.end(), with.begin(), with.end());
    return static_cast<VrmlNodeId>(nodes.size() - 1);
}

std::unexpected<Error> VrmlTree::refuse(const VrmlPlace& at, std::string cause, std::string remedy) const {
    return fail_at(files[at.file].name, at.line, at.column, std::move(cause), std::move(remedy));
}

void VrmlTree::warn_once(const VrmlPlace& at, std::string text) {
    if (warnings.size() >= kMaxWarnings) return;
    for (const Warning& w : warnings) {
        if (w.text == text) return;
    }
    warnings.push_back({files[at.file].name, at.line, std::move(text)});
}

}  // namespace tribo::readers
