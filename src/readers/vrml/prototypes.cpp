// SPDX-License-Identifier: MIT
#include "readers/vrml/prototypes.hpp"

#include <algorithm>
#include <utility>

#include "readers/text/model_text.hpp"
#include "readers/vrml/files.hpp"

namespace tribo::readers {

Result<std::uint32_t> VrmlPrototypes::define(std::string_view name, std::vector<VrmlField> interface,
                                             VrmlNodeId body_from, std::optional<VrmlNodeId> first,
                                             const VrmlPlace& at) {
    constexpr std::uint64_t enough = std::uint64_t{1} << 60;  // upper limit of the sum, against overflow
    VrmlPrototype made;
    made.name = name;
    made.interface = std::move(interface);
    // Templates are stored after their children. Backwards from the first node, each is visited after all its
    // parents.
    std::vector<bool> reached(first ? *first - body_from + 1 : 0);
    if (first) reached.back() = true;
    for (std::size_t i = reached.size(); i-- > 0;) {
        if (!reached[i]) continue;
        const auto id = static_cast<VrmlNodeId>(body_from + i);
        const VrmlNode& node = tree_.nodes[id];
        made.body.push_back(id);
        made.cost += std::uint64_t{1} + node.fields;
        for (std::uint32_t f = node.first_field; f < node.first_field + node.fields; ++f) {
            for (const VrmlNodeId child : tree_.nodes_of(tree_.fields[f].value)) {
                ++made.cost;
                if (tree_.nodes[child].is_template) reached[child - body_from] = true;
            }
        }
        if (node.type->role == VrmlRole::instance) {
            const VrmlPrototype& inner = all_[node.number];
            made.cost += inner.cost;
            made.depth = std::max(made.depth, 1 + inner.depth);
        }
        made.cost = std::min(enough, made.cost);
    }
    std::reverse(made.body.begin(), made.body.end());
    if (made.depth > kMaxPrototypeDepth) {
        return tree_.refuse(
            at,
            "prototypes stand within prototypes more than " + std::to_string(kMaxPrototypeDepth) + " deep",
            "export the model without prototypes");
    }
    all_.push_back(std::move(made));
    return static_cast<std::uint32_t>(all_.size() - 1);
}

std::uint32_t VrmlPrototypes::define_missing(std::string_view name) {
    VrmlPrototype made;
    made.name = name;
    made.is_missing = true;
    all_.push_back(std::move(made));
    return static_cast<std::uint32_t>(all_.size() - 1);
}

Result<VrmlNodeId> VrmlPrototypes::unfold(std::uint32_t number, std::span<const VrmlField> given,
                                          const VrmlPlace& at) {
    unfolded_ += all_[number].cost;
    if (unfolded_ > kMaxUnfolded) {
        return tree_.refuse(at, "the prototypes unfold to more than 4 million nodes and fields",
                            "export the model without prototypes");
    }
    return copy(number, given);
}

std::optional<VrmlValue> VrmlPrototypes::bound_value(const VrmlPrototype& prototype, std::uint32_t field,
                                                     std::span<const VrmlField> given) const {
    const VrmlField& declared = prototype.interface[field];
    for (const VrmlField& f : given) {
        if (f.name == declared.name) return f.value;
    }
    if (declared.value.kind == VrmlValue::Kind::null) return std::nullopt;
    return declared.value;
}

// Recursive, at most kMaxPrototypeDepth deep.
Result<VrmlNodeId> VrmlPrototypes::copy(std::uint32_t number, std::span<const VrmlField> given) {
    const VrmlPrototype& prototype = all_[number];
    const std::vector<VrmlNodeId>& body = prototype.body;
    std::vector<VrmlNodeId> copies;
    copies.reserve(body.size());
    std::vector<VrmlField> fields;
    for (const VrmlNodeId id : body) {
        const VrmlNode node = tree_.nodes[id];
        fields.clear();
        for (std::uint32_t i = node.first_field; i < node.first_field + node.fields; ++i) {
            VrmlField field = tree_.fields[i];
            if (field.value.kind == VrmlValue::Kind::bound) {
                const auto value = bound_value(prototype, field.value.first, given);
                if (!value) continue;
                field.value = *value;
            } else if (field.value.kind == VrmlValue::Kind::nodes) {
                const std::uint32_t from = field.value.first;
                field.value.first = static_cast<std::uint32_t>(tree_.links.size());
                for (std::uint32_t k = from; k < from + field.value.count; ++k) {
                    const VrmlNodeId child = tree_.links[k];
                    const auto place = std::lower_bound(body.begin(), body.end(), child);
                    const bool is_inside = place != body.end() && *place == child;
                    tree_.links.push_back(is_inside ? copies[static_cast<std::size_t>(place - body.begin())]
                                                    : child);
                }
            }
            fields.push_back(field);
        }
        if (node.type->role == VrmlRole::instance) {
            const auto inner = copy(node.number, fields);
            if (!inner) return inner;
            copies.push_back(*inner);
        } else if (node.type->role == VrmlRole::inline_file) {
            copies.push_back(files_.add_inline(*node.type, node.place, fields));
        } else {
            copies.push_back(tree_.add(*node.type, node.place, fields));
        }
    }
    return copies.empty() ? tree_.add(skipped_vrml_node(), {}, {}) : copies.back();
}

}  // namespace tribo::readers
