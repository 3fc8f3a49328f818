// SPDX-License-Identifier: MIT
// The prototypes of a model and what their instances unfold to (ISO/IEC 14772-1, 4.8 and 4.9).
#pragma once

#include "readers/vrml/tree.hpp"

namespace tribo::readers {

// Nodes, fields and links that prototypes may unfold to in one model: a quarter of a gigabyte.
inline constexpr std::uint64_t kMaxUnfolded = 4'000'000;
inline constexpr int kMaxPrototypeDepth = 32;

struct VrmlPrototype {
    std::string_view name;
    std::vector<VrmlField> interface;  // with the values that hold where an instance gives none
    std::vector<VrmlNodeId> body;      // templates below the first node and that node itself, ascending
    std::uint64_t cost = 0;            // what one instance unfolds to
    int depth = 1;                     // of prototypes within prototypes
    bool is_missing = false;           // EXTERNPROTO whose file was not read
};

class VrmlFiles;

// Instances are unfolded while the text is read, outside of bodies; what they cost is counted beforehand.
class VrmlPrototypes {
  public:
    VrmlPrototypes(VrmlTree& tree, VrmlFiles& files) : tree_(tree), files_(files) {}

    // `first` is the node that an instance stands for; without it instances are nothing. All nodes of the
    // body have ids from `body_from` on. Gives its number.
    Result<std::uint32_t> define(std::string_view name, std::vector<VrmlField> interface,
                                 VrmlNodeId body_from, std::optional<VrmlNodeId> first, const VrmlPlace& at);
    std::uint32_t define_missing(std::string_view name);
    const VrmlPrototype& operator[](std::uint32_t number) const { return all_[number]; }

    // A copy of the body with `given` in the place of what it binds; its last node stands for the instance.
    Result<VrmlNodeId> unfold(std::uint32_t number, std::span<const VrmlField> given, const VrmlPlace& at);

  private:
    Result<VrmlNodeId> copy(std::uint32_t number, std::span<const VrmlField> given);
    std::optional<VrmlValue> bound_value(const VrmlPrototype& prototype, std::uint32_t field,
                                         std::span<const VrmlField> given) const;

    VrmlTree& tree_;
    VrmlFiles& files_;
    std::deque<VrmlPrototype> all_;
    std::uint64_t unfolded_ = 0;
};

}  // namespace tribo::readers
