// SPDX-License-Identifier: MIT
// The files of a model: its own and those that Inline and EXTERNPROTO name, each read once.
#pragma once

#include <map>

#include "readers/mesh/model.hpp"
#include "readers/vrml/prototypes.hpp"

namespace tribo::readers {

// Of all files together, unpacked, bytes.
inline constexpr std::uint64_t kMaxVrmlText = 64 * 1024 * 1024;
inline constexpr std::size_t kMaxVrmlFiles = 1000;
inline constexpr int kMaxVrmlFileDepth = 8;

// What one text defines at its top.
struct VrmlTop {
    std::vector<VrmlNodeId> roots;
    std::vector<std::pair<std::string_view, std::uint32_t>> prototypes;  // in their order
};

class VrmlFiles {
  public:
    VrmlFiles(VrmlTree& tree, const ModelOptions& options)
        : tree_(tree), options_(options), prototypes_(tree, *this) {}

    // The model's own text, whose header has been checked.
    Result<void> read_model(std::string_view text);
    // Adds an Inline node after the nodes of the first file of its `url` that can be read, which stand in its
    // field `children`; why none can be goes to the tree's refusals.
    VrmlNodeId add_inline(const VrmlNodeType& type, const VrmlPlace& at, std::span<const VrmlField> fields);
    // The prototype that the urls (file.wrl#Name) lead to.
    Result<std::uint32_t> read_external(std::span<const std::string_view> urls, const VrmlPlace& at);

    VrmlPrototypes& prototypes() { return prototypes_; }

  private:
    struct Known {
        std::string name;
        bool is_open = false;  // being read: who asks for it now stands inside it
        Result<VrmlTop> top;
    };
    Result<const VrmlTop*> open(std::string_view url, const VrmlPlace& at);
    Result<void> load(Known& known, ModelNeighbour file, const VrmlPlace& at);

    VrmlTree& tree_;
    const ModelOptions& options_;
    VrmlPrototypes prototypes_;
    std::deque<Known> known_;
    std::map<std::pair<std::uint32_t, std::string_view>, Result<std::size_t>> asked_;  // by file and url
    std::uint64_t text_bytes_ = 0;
    int depth_ = 0;
};

// The file's first line says what it is; other formats are refused by name.
Result<void> check_vrml_header(std::string_view text, const std::string& file, bool may_be_missing);

}  // namespace tribo::readers
