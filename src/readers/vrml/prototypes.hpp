// SPDX-License-Identifier: MIT
// The prototypes of a model and the unfolding of their instances (ISO/IEC 14772-1, 4.8 and 4.9).
#pragma once

#include "readers/vrml/tree.hpp"

namespace tribo::readers {

// Limit of the nodes, fields and links that prototypes unfold to in one model (a quarter of a gigabyte).
inline constexpr std::uint64_t kMaxUnfolded = 4'000'000;
inline constexpr int kMaxPrototypeDepth = 32;
// Limit of the fields that a prototype declares; each field of an instance is compared with them.
inline constexpr std::size_t kMaxVrmlInterface = 1000;

struct VrmlPrototype {
    std::string_view name;
    std::vector<VrmlField> interface;  // with the default values
    std::vector<VrmlNodeId> body;      // templates below the first node, then that node; ascending
    std::uint64_t cost = 0;            // size of one unfolded instance
    int depth = 1;                     // nesting of prototypes
    bool is_missing = false;           // EXTERNPROTO without its file
};

class VrmlFiles;

// Instances outside of bodies are unfolded while the text is read. Their size is counted beforehand.
class VrmlPrototypes {
  public:
    VrmlPrototypes(VrmlTree& tree, VrmlFiles& files) : tree_(tree), files_(files) {}

    // Defines a prototype and returns its number. `first` is the node that an instance stands for; without it
    // instances are empty. All nodes of the body have ids >= `body_from`.
    Result<std::uint32_t> define(std::string_view name, std::vector<VrmlField> interface,
                                 VrmlNodeId body_from, std::optional<VrmlNodeId> first, const VrmlPlace& at);
    std::uint32_t define_missing(std::string_view name);
    const VrmlPrototype& operator[](std::uint32_t number) const { return all_[number]; }

    // Returns a copy of the body with the values of `given` for its bound fields. The last node of the copy
    // stands for the instance.
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
