// SPDX-License-Identifier: MIT
// The files of a model: its own, and those named by Inline and EXTERNPROTO, each read once.
#pragma once

#include <map>

#include "readers/mesh/model.hpp"
#include "readers/vrml/prototypes.hpp"

namespace tribo::readers {

// Limit of all files together after unpacking, bytes.
inline constexpr std::uint64_t kMaxVrmlText = 64 * 1024 * 1024;
inline constexpr std::size_t kMaxVrmlFiles = 1000;
inline constexpr int kMaxVrmlFileDepth = 8;
// Limits of the files that one node names, and of Inline nodes.
inline constexpr std::size_t kMaxVrmlUrls = 100, kMaxVrmlInlines = 100'000;

// The top-level definitions of one text.
struct VrmlTop {
    std::vector<VrmlNodeId> roots;
    std::vector<std::pair<std::string_view, std::uint32_t>> prototypes;  // in order
};

class VrmlFiles {
  public:
    VrmlFiles(VrmlTree& tree, const ModelOptions& options)
        : tree_(tree), options_(options), prototypes_(tree, *this) {}

    // Reads the text of the model. Its header must be checked before.
    Result<void> read_model(std::string_view text);
    // Adds an Inline node. Its field `children` holds the nodes of the first file of its `url` that can be
    // read. If none can be read, the first error goes to the refusals of the tree.
    VrmlNodeId add_inline(const VrmlNodeType& type, const VrmlPlace& at, std::span<const VrmlField> fields);
    // Returns the prototype that the urls (file.wrl#Name) lead to.
    Result<std::uint32_t> read_external(std::span<const std::string_view> urls, const VrmlPlace& at);

    VrmlPrototypes& prototypes() { return prototypes_; }

  private:
    struct Known {
        std::string name;
        bool is_open = false;  // being read: a request for it now comes from inside it
        Result<VrmlTop> top;
        // Made at the first use: its roots among the links of the tree, its first prototype of each name.
        std::optional<std::uint32_t> first_link{};
        std::map<std::string_view, std::uint32_t> prototypes{};
    };
    Result<Known*> open(std::string_view url, const VrmlPlace& at);
    std::uint32_t refusal(Error error);
    std::unexpected<Error> refuse_urls(const VrmlPlace& at) const;
    Result<void> load(Known& known, ModelNeighbour file, const VrmlPlace& at);

    VrmlTree& tree_;
    const ModelOptions& options_;
    VrmlPrototypes prototypes_;
    std::deque<Known> known_;
    std::map<std::pair<std::uint32_t, std::string_view>, Result<std::size_t>> asked_;  // by file and url
    std::uint64_t text_bytes_ = 0;
    int depth_ = 0;
    std::size_t inlines_ = 0;
    std::uint32_t too_many_inlines_ = 0;  // refusal; 0: not so far
};

// Checks the format by the first line of the file. Other formats are refused by name.
Result<void> check_vrml_header(std::string_view text, const std::string& file, bool may_be_missing);

}  // namespace tribo::readers
