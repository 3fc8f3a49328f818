// SPDX-License-Identifier: MIT
// Field values of a node as numbers and flags. Invalid values are refused.
#pragma once

#include "readers/text/model_text.hpp"
#include "readers/vrml/tree.hpp"

namespace tribo::readers {

class VrmlFields {
  public:
    VrmlFields(const VrmlTree& tree, VrmlNodeId node) : tree_(tree), node_(node) {}

    // Sets `out` if the node has the field.
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
    // Reads one number >= `least`, or > `least` if `may_be_least` is false.
    Result<void> read_size(std::string_view field, double& out, double least, bool may_be_least) const;
    // Reads a list of vectors of `width` numbers; empty if the node has none.
    Result<std::span<const double>> read_list(std::string_view field, std::size_t width) const;
    // Returns the place of number `at` of a list. Reads the text of the list again.
    VrmlPlace place_of_number(const VrmlValue& list, std::size_t at) const;

    std::unexpected<Error> refuse(const VrmlValue& value, std::string cause) const;
    // The error is at the value of the field, or at the node if it has no such field.
    std::unexpected<Error> refuse_field(std::string_view field, std::string cause) const;

  private:
    const VrmlTree& tree_;
    VrmlNodeId node_;
};

}  // namespace tribo::readers
