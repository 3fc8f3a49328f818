// SPDX-License-Identifier: MIT
#include "files/model/gltf_document.hpp"

#include <algorithm>
#include <array>
#include <cstdint>

#include "files/json/json.hpp"

namespace tribo::files {
namespace {

// Real files have about a dozen levels of nesting. This many are far below the limit of any stack.
constexpr int kDeepest = 100;
constexpr std::size_t kMostBuffers = 1000;
// Without these extensions other triangles would be read, or none.
constexpr std::array<std::string_view, 3> kUnreadExtensions{
    "KHR_draco_mesh_compression", "EXT_meshopt_compression", "EXT_mesh_gpu_instancing"};

// Returns the JSON chunk of a binary file, or a whole text file; none if the file is too short.
std::string_view json_of(std::string_view bytes) {
    constexpr std::size_t kHeaders = 20;
    if (!bytes.starts_with("glTF")) return bytes;
    if (bytes.size() < kHeaders) return {};
    std::uint32_t length = 0;
    for (std::size_t k = 4; k-- > 0;) length = length << 8 | static_cast<unsigned char>(bytes[12 + k]);
    return length <= bytes.size() - kHeaders ? bytes.substr(kHeaders, length) : std::string_view();
}

}  // namespace

Result<void> check_gltf_document(std::string_view bytes, const std::string& source_name) {
    const auto refused = [&](std::string cause, const char* remedy) {
        return fail_at(source_name, 0, 0, std::move(cause), remedy);
    };
    const std::string_view text = json_of(bytes);
    if (text.empty()) return refused("the glTF file is cut off", "export or copy it again");
    bool too_deep = false;
    const auto some_keys = [&](int depth, nlohmann::json::parse_event_t event, nlohmann::json& parsed) {
        too_deep = too_deep || depth > kDeepest;
        return !too_deep && (depth != 1 || event != nlohmann::json::parse_event_t::key ||
                             parsed == "buffers" || parsed == "asset" || parsed == "extensionsRequired");
    };
    const nlohmann::json document = nlohmann::json::parse(text, some_keys, false);
    if (too_deep) return refused("the glTF file nests too deeply", "export the model again");
    if (!document.is_object()) {
        return refused("the glTF file is not the JSON that it should be", "export or copy it again");
    }
    const auto asset = document.find("asset");
    if (asset != document.end() && asset->is_object() && asset->contains("version") &&
        (*asset)["version"].is_string() &&
        (*asset)["version"].get_ref<const std::string&>().starts_with("1."))
        return refused("the file is glTF 1.0, and 2.0 is read", "export the model as glTF 2.0");
    const auto required = document.find("extensionsRequired");
    if (required != document.end() && required->is_array()) {
        for (const nlohmann::json& one : *required) {
            const std::string name = one.is_string() ? one.get<std::string>() : std::string();
            if (std::ranges::find(kUnreadExtensions, name) == kUnreadExtensions.end()) continue;
            return refused("the triangles are packed by " + name + ", which is not read",
                           "export the model without it: no compression, no instancing");
        }
    }
    const auto buffers = document.find("buffers");
    if (buffers == document.end() || !buffers->is_array()) return {};
    std::size_t in_chunk = 0;
    for (const nlohmann::json& buffer : *buffers) {
        const auto uri = buffer.is_object() ? buffer.find("uri") : buffer.end();
        if (uri == buffer.end()) {
            ++in_chunk;
        } else if (!uri->is_string() || !uri->get_ref<const std::string&>().starts_with("data:")) {
            const std::string name = uri->is_string() ? uri->get<std::string>().substr(0, 80) : "?";
            return refused("the glTF file has its data in another file, " + name,
                           "export the model as one .glb file");
        }
    }
    if (in_chunk > 1 || buffers->size() > kMostBuffers) {
        return refused("the glTF file has more buffers than it has data",
                       "export the model again as one .glb file");
    }
    return {};
}

}  // namespace tribo::files
