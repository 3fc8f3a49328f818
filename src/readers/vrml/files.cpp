// SPDX-License-Identifier: MIT
#include "readers/vrml/files.hpp"

#include <utility>

#include "readers/text/model_text.hpp"
#include "readers/vrml/parser.hpp"
#include "readers/vrml/vrml.hpp"

namespace tribo::readers {

Result<void> VrmlFiles::read_model(std::string_view text) {
    text_bytes_ = text.size();
    tree_.files.push_back({options_.source_name, {}, text});
    known_.push_back({options_.source_name, true, VrmlTop{}});
    auto top = parse_vrml(tree_, *this, 0);
    if (!top) return std::unexpected(top.error());
    tree_.roots = std::move(top->roots);
    return {};
}

Result<void> VrmlFiles::load(Known& known, ModelNeighbour file, const VrmlPlace& at) {
    if (tree_.files.size() >= kMaxVrmlFiles) {
        return tree_.refuse(at, "the model has more than " + std::to_string(kMaxVrmlFiles) + " files",
                            "export it as one file");
    }
    if (depth_ >= kMaxVrmlFileDepth) {
        return tree_.refuse(at,
                            "files name each other more than " + std::to_string(kMaxVrmlFileDepth) + " deep",
                            "export the model as one file");
    }
    text_bytes_ += file.bytes.size();
    tree_.files.push_back({std::move(file.name), std::move(file.bytes), {}});
    VrmlFile& kept = tree_.files.back();
    kept.text = without_byte_order_mark(kept.bytes);
    if (auto ok = check_vrml_header(kept.text, kept.name, true); !ok) return ok;
    const auto number = static_cast<std::uint32_t>(tree_.files.size() - 1);
    if (!kept.text.starts_with("#VRML")) {
        tree_.warn_once({number, 1, 1, 0}, "no '#VRML V2.0 utf8' at the start: read all the same");
    }
    known.is_open = true;
    ++depth_;
    known.top = parse_vrml(tree_, *this, number);
    --depth_;
    known.is_open = false;
    if (!known.top) return std::unexpected(known.top.error());
    return {};
}

Result<VrmlFiles::Known*> VrmlFiles::open(std::string_view url, const VrmlPlace& at) {
    const std::string remedy = "put the file beside the model, or export the model as one file";
    const auto key = std::pair(at.file, url);
    auto asked = asked_.find(key);
    if (asked == asked_.end()) {
        const auto refused = [&](const std::string& cause) {
            return tree_.refuse(at, "the file " + quoted(url) + " is not read: " + cause, remedy);
        };
        Result<std::size_t> number = std::size_t{0};
        if (!options_.neighbours) {
            number = refused("the model was given without its folder");
        } else if (text_bytes_ >= kMaxVrmlText) {
            number = refused("the model's files hold more than 64 MB");
        } else if (auto file =
                       options_.neighbours(url, tree_.files[at.file].name, kMaxVrmlText - text_bytes_);
                   !file) {
            number = refused(file.error().cause);
        } else {
            std::size_t n = 0;
            while (n < known_.size() && known_[n].name != file->name) ++n;
            number = n;
            if (n == known_.size()) {
                known_.push_back({file->name, false, VrmlTop{}});
                if (auto ok = load(known_[n], *std::move(file), at); !ok)
                    known_[n].top = std::unexpected(ok.error());
            }
        }
        asked = asked_.emplace(key, std::move(number)).first;
    }
    if (!asked->second) return std::unexpected(asked->second.error());
    Known& known = known_[*asked->second];
    if (known.is_open) {
        return tree_.refuse(at, "the file " + quoted(url) + " names itself, directly or through others",
                            "break the circle");
    }
    if (!known.top) return std::unexpected(known.top.error());
    if (!known.first_link) {
        known.first_link = static_cast<std::uint32_t>(tree_.links.size());
        tree_.links.insert(tree_.links.end(), known.top->roots.begin(), known.top->roots.end());
        known.prototypes.insert(known.top->prototypes.begin(), known.top->prototypes.end());
    }
    return &known;
}

std::unexpected<Error> VrmlFiles::refuse_urls(const VrmlPlace& at) const {
    return tree_.refuse(at, "a node names more than " + std::to_string(kMaxVrmlUrls) + " files",
                        "name the file that it shows");
}

// Returns the number for VrmlNode::number.
std::uint32_t VrmlFiles::refusal(Error error) {
    tree_.refusals.push_back(std::move(error));
    return static_cast<std::uint32_t>(tree_.refusals.size());
}

VrmlNodeId VrmlFiles::add_inline(const VrmlNodeType& type, const VrmlPlace& at,
                                 std::span<const VrmlField> fields) {
    std::vector<std::string_view> urls;
    VrmlField children{"children", {}};
    for (const VrmlField& field : fields) {
        if (field.name != "url") continue;
        const auto given = tree_.strings_of(field.value);
        urls.assign(given.begin(), given.end());
        children.value.start = field.value.start;
    }
    if (++inlines_ > kMaxVrmlInlines) {
        const VrmlNodeId node = tree_.add(type, at, {});
        if (too_many_inlines_ == 0) {
            too_many_inlines_ = refusal(
                tree_
                    .refuse(at,
                            "the model has more than " + std::to_string(kMaxVrmlInlines) + " Inline nodes",
                            "export it as one file")
                    .error());
        }
        tree_.nodes[node].number = too_many_inlines_;
        return node;
    }
    std::optional<Error> first_error;
    if (urls.size() > kMaxVrmlUrls) {
        first_error = refuse_urls(children.value.start).error();
        urls.clear();
    }
    for (const std::string_view url : urls) {
        const auto file = open(url, children.value.start);
        if (!file) {
            if (!first_error) first_error = file.error();
            continue;
        }
        const std::size_t roots = (*file)->top->roots.size();
        if (roots == 0) return tree_.add(type, at, {});
        children.value.kind = VrmlValue::Kind::nodes;
        children.value.first = *(*file)->first_link;
        children.value.count = static_cast<std::uint32_t>(roots);
        return tree_.add(type, at, std::span(&children, 1));
    }
    const VrmlNodeId node = tree_.add(type, at, {});
    if (first_error) tree_.nodes[node].number = refusal(*std::move(first_error));
    return node;
}

Result<std::uint32_t> VrmlFiles::read_external(std::span<const std::string_view> urls, const VrmlPlace& at) {
    std::optional<Error> first_error;
    if (urls.size() > kMaxVrmlUrls) return refuse_urls(at);
    for (const std::string_view url : urls) {
        const std::size_t hash = url.find('#');
        const auto file = open(url.substr(0, hash), at);
        if (!file) {
            if (!first_error) first_error = file.error();
            continue;
        }
        const auto& in_order = (*file)->top->prototypes;
        if (hash == std::string_view::npos) {
            if (!in_order.empty()) return in_order.front().second;
        } else if (const auto named = (*file)->prototypes.find(url.substr(hash + 1));
                   named != (*file)->prototypes.end()) {
            return named->second;
        }
        if (!first_error) {
            first_error =
                tree_.refuse(at, "the file of " + quoted(url) + " has no such prototype", "correct the url")
                    .error();
        }
    }
    if (first_error) return std::unexpected(*std::move(first_error));
    return tree_.refuse(at, "EXTERNPROTO without a url", "name the file");
}

}  // namespace tribo::readers
