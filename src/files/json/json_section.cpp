// SPDX-License-Identifier: MIT
#include "files/json/json_section.hpp"

#include <algorithm>
#include <set>

#include "base/text/decimal.hpp"
#include "base/text/limit_text.hpp"
#include "base/text/nearest.hpp"

namespace tribo::files {
namespace {

// No file of Tribo has deeper nesting.
constexpr int kDeepest = 32;

struct Place {
    int line = 1, column = 1;
};

Place place_of(std::string_view text, std::size_t byte) {
    Place place;
    for (const char c : text.substr(0, std::min(byte, text.size()))) {
        if (c == '\n') {
            ++place.line;
            place.column = 1;
        } else {
            ++place.column;
        }
    }
    return place;
}

std::string range_text(Range range) {
    return std::string(range.above ? "above " : "from ") + plain_number(range.min) + " to " +
           plain_number(range.max);
}

const char* kind_of(const Json& value) {
    return value.is_null() ? "null" : value.type_name();
}

}  // namespace

Result<Json> parse_json(std::string_view text, const std::string& file) {
    std::vector<std::set<std::string>> seen;
    std::string doubled;
    bool deep = false;
    const auto watch = [&](int depth, Json::parse_event_t event, Json& parsed) {
        if (depth > kDeepest) {
            deep = true;
            return false;
        }
        if (event == Json::parse_event_t::object_start) {
            seen.emplace_back();
        } else if (event == Json::parse_event_t::object_end) {
            if (!seen.empty()) seen.pop_back();
        } else if (event == Json::parse_event_t::key && !seen.empty()) {
            const std::string key = parsed.get<std::string>();
            if (!seen.back().insert(key).second && doubled.empty()) doubled = key;
        }
        return true;
    };
    try {
        Json json = Json::parse(text, watch);
        if (deep) return fail_at(file, 0, 0, "is nested too deeply", "give a file that tribo wrote");
        if (!doubled.empty()) {
            return fail_at(file, 0, 0, "the key '" + doubled + "' stands twice in one object", "keep one");
        }
        return json;
    } catch (const Json::parse_error& error) {
        const Place place = place_of(text, error.byte > 0 ? error.byte - 1 : 0);
        std::string what = error.what();
        // The text of the library after its own error number and place.
        if (const std::size_t colon = what.rfind("; "); colon != what.npos) what = what.substr(colon + 2);
        const bool ends = error.byte > text.size();
        return fail_at(file, place.line, place.column,
                       ends ? "the text ends too early" : "is not JSON here (" + what + ")",
                       ends ? "give the whole file" : "correct it, or write the file anew");
    } catch (const Json::exception& error) {
        return fail_at(file, 0, 0, std::string("cannot be read as JSON: ") + error.what(),
                       "write the file anew");
    }
}

JsonSection::JsonSection(const Json& object, std::string path, std::span<const std::string_view> keys,
                         std::optional<Error>& error, const std::string& file)
    : object_(object), path_(std::move(path)), error_(error), file_(file) {
    if (!object.is_object()) {
        fail("", std::string("is ") + kind_of(object) + " and not an object", "put {...} there");
        return;
    }
    for (const auto& [key, value] : object.items()) {
        if (std::ranges::find(keys, key) == keys.end()) {
            fail(key, "is no known key", suggestion(key, keys));
            return;
        }
    }
}

std::string JsonSection::path_of(std::string_view key) const {
    if (key.empty()) return path_;
    return (path_.empty() ? "" : path_ + ".") + std::string(key);
}

void JsonSection::fail(std::string_view key, std::string cause, std::string remedy) {
    if (error_) return;
    const std::string path = path_of(key);
    error_ = Error{file_, 0, 0, path.empty() ? std::move(cause) : path + " " + cause, std::move(remedy)};
}

const Json* JsonSection::find(std::string_view key) const {
    if (error_ || !object_.is_object()) return nullptr;
    const auto found = object_.find(std::string(key));
    return found == object_.end() ? nullptr : &*found;
}

bool JsonSection::has(std::string_view key) const {
    return find(key) != nullptr;
}

bool JsonSection::in_range(std::string_view key, const Json& value, Range range) {
    if (!value.is_number()) {
        fail(key, std::string("is ") + kind_of(value) + " and not a number",
             "give a number " + range_text(range));
        return false;
    }
    const double number = value.get<double>();
    if (range.contains(number)) return true;
    fail(key, "is " + format_decimal(number), "give a number " + range_text(range));
    return false;
}

double JsonSection::number(std::string_view key, Range range, std::optional<double> otherwise) {
    const Json* value = find(key);
    if (value == nullptr) {
        if (!otherwise) fail(key, "is missing", "give a number " + range_text(range));
        return otherwise.value_or(range.max);
    }
    return in_range(key, *value, range) ? value->get<double>() : range.max;
}

std::string JsonSection::text(std::string_view key, const std::optional<std::string>& otherwise,
                              std::size_t longest) {
    const Json* value = find(key);
    if (value == nullptr) {
        if (!otherwise) fail(key, "is missing", "give a text");
        return otherwise.value_or("");
    }
    if (!value->is_string()) {
        fail(key, std::string("is ") + kind_of(*value) + " and not a text", "put it in quotes");
        return "";
    }
    std::string text = value->get<std::string>();
    if (text.size() > longest) {
        fail(key, "is longer than " + std::to_string(longest) + " bytes", "shorten it");
        return "";
    }
    return text;
}

std::vector<double> JsonSection::numbers_of(const std::string& key, const Json& value, Range range,
                                            std::size_t most) {
    if (!value.is_array()) {
        fail(key, std::string("is ") + kind_of(value) + " and not an array", "put [...] there");
        return {};
    }
    if (value.size() > most) {
        fail(key, "has " + std::to_string(value.size()) + " numbers", "give at most " + std::to_string(most));
        return {};
    }
    std::vector<double> numbers;
    for (std::size_t n = 0; n < value.size(); ++n) {
        if (!in_range(key + "[" + std::to_string(n) + "]", value[n], range)) return {};
        numbers.push_back(value[n].get<double>());
    }
    return numbers;
}

std::vector<double> JsonSection::numbers(std::string_view key, Range range, std::size_t most) {
    const Json* value = find(key);
    if (value != nullptr) return numbers_of(std::string(key), *value, range, most);
    fail(key, "is missing", "give an array of numbers");
    return {};
}

std::vector<std::vector<double>> JsonSection::tables(std::string_view key, Range range, std::size_t most,
                                                     std::size_t longest) {
    const Json* value = find(key);
    if (value == nullptr || !value->is_array() || value->size() > most) {
        fail(key, "is not an array of at most " + std::to_string(most) + " arrays", "put [[...], ...] there");
        return {};
    }
    std::vector<std::vector<double>> tables;
    tables.reserve(value->size());
    for (std::size_t n = 0; n < value->size(); ++n) {
        tables.push_back(
            numbers_of(std::string(key) + "[" + std::to_string(n) + "]", (*value)[n], range, longest));
    }
    return tables;
}

std::vector<const Json*> JsonSection::objects(std::string_view key, std::size_t most) {
    const Json* value = find(key);
    if (value == nullptr) return {};
    if (!value->is_array() || value->size() > most) {
        fail(key,
             value->is_array() ? "has " + std::to_string(value->size()) + " entries"
                               : std::string("is ") + kind_of(*value) + " and not an array",
             "give an array of at most " + std::to_string(most) + " objects");
        return {};
    }
    std::vector<const Json*> objects;
    for (const Json& item : *value) objects.push_back(&item);
    return objects;
}

const Json* JsonSection::object(std::string_view key) {
    return find(key);
}

}  // namespace tribo::files
