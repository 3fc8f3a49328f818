// SPDX-License-Identifier: MIT
// Field values of a node as numbers and flags, refused where they cannot be meant.
#pragma once

#include "readers/text/model_text.hpp"
#include "readers/vrml/tree.hpp"

namespace tribo::readers {

class VrmlFields {
  public:
    VrmlFields(const VrmlTree& tree, VrmlNodeId node) : tree_(tree), node_(node) {}

    // Sets `out` where the node has the field.
    template <std::size_t N>
    Result<void> read(std::string_view field, double (&out)[N]) const {
        const VrmlValue* value = tree_.find(node_, field);
        if (!value) return {};
        const auto numbers = tree_.numbers_of(*value);
        if (numbers.size() != N) {
            return refuse(*value, quoted(field) + " must have " + std::to_string(N) +
                                      (N == 1 ? " number" : " numbers"));
        }
        for (std::size_t i = 0; i < N; ++i) out[i] = numbers[i];
        return {};
    }
    Result<void> read_flag(std::string_view field, bool& out) const;
    // One number of at least `least`, or above it where it may not be that itself.
    Result<void> read_size(std::string_view field, double& out, double least, bool may_be_least) const;
    // A list of vectors of `width` numbers; empty where there is none.
    Result<std::span<const double>> read_list(std::string_view field, std::size_t width) const;
    // The place of a list's number `at`, found by reading its text again.
    VrmlPlace place_of_number(const VrmlValue& list, std::size_t at) const;

    std::unexpected<Error> refuse(const VrmlValue& value, std::string cause) const;
    // At the field's value, or at the node where it has no such field.
    std::unexpected<Error> refuse_field(std::string_view field, std::string cause) const;

  private:
    const VrmlTree& tree_;
    VrmlNodeId node_;
};

}  // namespace tribo::readers
