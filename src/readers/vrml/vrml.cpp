// SPDX-License-Identifier: MIT
#include "readers/vrml/vrml.hpp"

#include "readers/text/model_text.hpp"
#include "readers/vrml/files.hpp"
#include "readers/vrml/scene.hpp"

namespace tribo::readers {
namespace {

bool is_x3d(std::string_view text) {
    return text.starts_with("#X3D") || text.starts_with("<X3D") ||
           (text.starts_with("<?xml") && text.substr(0, 4096).find("X3D") != std::string_view::npos);
}

}  // namespace

Result<void> check_vrml_header(std::string_view text, const std::string& file, bool may_be_missing) {
    const auto refuse = [&](std::string what, std::string remedy) {
        return fail_at(file, 1, 1, std::move(what), std::move(remedy));
    };
    if (text.starts_with("\x1f\x8b")) return refuse("a gzip file, still packed", "unpack it with gunzip");
    if (text.starts_with("#VRML V1.0")) return refuse("a VRML 1.0 file", "convert it to VRML 2.0");
    if (text.starts_with("#Inventor")) return refuse("an Open Inventor file", "convert it to VRML 2.0");
    if (is_x3d(text)) return refuse("an X3D file", "convert it to VRML 2.0");
    if (!text.starts_with("#VRML V2.0 utf8") && (!may_be_missing || text.starts_with("#VRML"))) {
        return refuse("no '#VRML V2.0 utf8' at the start", "check that this is a VRML 2.0 file");
    }
    if (text.size() > kMaxVrmlText)
        return refuse("more than 64 MB of VRML", "simplify the model, or export it as STL");
    return {};
}

bool looks_like_vrml(std::string_view bytes) {
    const std::string_view text = without_byte_order_mark(bytes);
    return text.starts_with("#VRML") || text.starts_with("#Inventor") || is_x3d(text);
}

Result<Model> read_vrml(std::string_view bytes, const ModelOptions& options) {
    const std::string_view text = without_byte_order_mark(bytes);
    if (auto ok = check_vrml_header(text, options.source_name, false); !ok)
        return std::unexpected(ok.error());
    VrmlTree tree;
    VrmlFiles files(tree, options);
    if (auto ok = files.read_model(text); !ok) return std::unexpected(ok.error());
    return read_vrml_scene(tree, options);
}

}  // namespace tribo::readers
