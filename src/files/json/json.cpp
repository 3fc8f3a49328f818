// SPDX-License-Identifier: MIT
#include "files/json/json.hpp"

#include <algorithm>

template class nlohmann::basic_json<nlohmann::ordered_map>;

namespace tribo::files {
namespace {

bool fits_a_line(const Json& json) {
    return json.empty() || !json.is_structured() ||
           (json.is_array() && std::all_of(json.begin(), json.end(), [](const Json& item) {
                return !item.is_object() && fits_a_line(item);
            }));
}

void append_inline(std::string& text, const Json& json) {
    if (!json.is_array()) {
        text += dump(json);
        return;
    }
    text += '[';
    for (std::size_t i = 0; i < json.size(); ++i) {
        if (i > 0) text += ", ";
        append_inline(text, json[i]);
    }
    text += ']';
}

void append(std::string& text, const Json& json, std::size_t depth) {
    if (fits_a_line(json)) return append_inline(text, json);
    const bool object = json.is_object();
    text += object ? "{" : "[";
    bool first = true;
    for (const auto& [key, value] : json.items()) {
        text += (first ? "\n" : ",\n") + std::string(2 * depth + 2, ' ');
        if (object) text += dump(Json(key)) + ": ";
        append(text, value, depth + 1);
        first = false;
    }
    text += "\n" + std::string(2 * depth, ' ') + (object ? "}" : "]");
}

}  // namespace

Json parse(std::string_view text) {
    return Json::parse(text, nullptr, false);
}

std::string dump(const Json& json) {
    return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

std::string pretty(const Json& json) {
    std::string text;
    append(text, json, 0);
    return text + "\n";
}

}  // namespace tribo::files
