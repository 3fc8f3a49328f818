// SPDX-License-Identifier: MIT
#include "job/toml/toml_section.hpp"

#include <cmath>
#include <utility>

#include "base/text/decimal.hpp"
#include "base/text/file_names.hpp"
#include "base/text/limit_text.hpp"
#include "job/toml/toml_key_parts.hpp"

namespace tribo::job {
namespace {

std::string in_quotes(std::string_view word) {
    return "'" + std::string(word) + "'";
}

const char* type_name(const toml::node& node) {
    switch (node.type()) {
        case toml::node_type::table:
            return "a table";
        case toml::node_type::array:
            return "an array";
        case toml::node_type::string:
            return "a string";
        case toml::node_type::integer:
        case toml::node_type::floating_point:
            return "a number";
        case toml::node_type::boolean:
            return "true or false";
        default:
            return "a date or time";
    }
}

}  // namespace

std::string TomlFile::beside(const std::string& path) const {
    return file_beside(name_, path);
}

std::string TomlFile::beside(const std::string& path, std::string_view key,
                             const toml::source_region& where) {
    named_.push_back({beside(path), std::string(key), static_cast<int>(where.begin.line),
                      static_cast<int>(where.begin.column)});
    return named_.back().path;
}

void TomlFile::fail(const toml::source_region& where, std::string cause, std::string remedy) {
    fail(Error{name_, static_cast<int>(where.begin.line), static_cast<int>(where.begin.column),
               std::move(cause), std::move(remedy)});
}

void TomlFile::fail(Error error) {
    if (!error_) error_ = std::move(error);
}

TomlSection::TomlSection(TomlFile& file, const toml::table& table, std::string label,
                         std::span<const std::string_view> keys)
    : file_(file), table_(table), label_(std::move(label)) {
    const toml::key* first = nullptr;
    for (const auto& [key, value] : table_) {
        if (std::find(keys.begin(), keys.end(), key.str()) != keys.end()) continue;
        // Tables are sorted by key; the reader of the message wants the first in the file.
        if (!first || key.source().begin < first->source().begin) first = &key;
    }
    if (first) {
        const std::string_view name = first->str();
        file_.fail(first->source(),
                   "unknown key " + in_quotes(name) + (label_.empty() ? "" : " in " + label_),
                   suggestion(name, keys));
    }
}

void TomlSection::fail(std::string_view key, std::string cause, std::string remedy) {
    const toml::node* node = table_.get(key);
    file_.fail(node ? node->source() : table_.source(), std::move(cause), std::move(remedy));
}

void TomlSection::missing(std::string_view key) {
    fail(key, in_quotes(key) + " is missing" + (label_.empty() ? "" : " in " + label_),
         label_.empty() ? "add [" + std::string(key) + "]" : "add it under " + label_);
}

void TomlSection::wrong_type(std::string_view key, const toml::node& node, const char* wanted) {
    file_.fail(node.source(), in_quotes(key) + " must be " + wanted + ", not " + type_name(node),
               node.is_string() ? "take the quotes away" : std::string("write ") + wanted);
}

std::optional<double> TomlSection::number_of(std::string_view key, const toml::node& node,
                                             const Limit& limit) {
    if (!node.is_number()) {
        wrong_type(key, node, "a number");
        return {};
    }
    const double value = *node.value<double>();
    if (!std::isfinite(value)) {
        file_.fail(node.source(), in_quotes(key) + " is not a finite number", "write a plain number");
        return {};
    }
    if (!limit.range.contains(value)) {
        file_.fail(node.source(), in_quotes(key) + " is " + plain_number(value), range_remedy(limit));
        return {};
    }
    return value;
}

std::optional<double> TomlSection::number(std::string_view key, const Limit& limit) {
    const toml::node* node = table_.get(key);
    return node ? number_of(key, *node, limit) : std::nullopt;
}

std::optional<double> TomlSection::number_or_zero(std::string_view key, const Limit& limit) {
    const toml::node* node = table_.get(key);
    if (node && node->is_number() && *node->value<double>() == 0) return 0.0;
    return number(key, limit);
}

std::optional<int> TomlSection::integer(std::string_view key, const Limit& limit) {
    const std::optional<double> value = number(key, limit);
    if (!value) return {};
    if (*value != std::floor(*value)) {
        fail(key, in_quotes(key) + " must be a whole number, not " + format_decimal(*value),
             "try " + format_decimal(std::floor(*value)));
        return {};
    }
    return static_cast<int>(*value);
}

std::optional<bool> TomlSection::flag(std::string_view key) {
    const toml::node* node = table_.get(key);
    if (node && !node->is_boolean()) wrong_type(key, *node, "true or false");
    return node ? node->value_exact<bool>() : std::nullopt;
}

std::optional<std::string> TomlSection::text(std::string_view key) {
    const toml::node* node = table_.get(key);
    if (!node) return {};
    const std::optional<std::string> value = node->is_string() ? node->value<std::string>() : std::nullopt;
    if (!value) {
        wrong_type(key, *node, "a string");
    } else if (value->empty()) {
        fail(key, in_quotes(key) + " is empty", "write a value or remove the key");
    }
    return value;
}

std::optional<std::size_t> TomlSection::word(std::string_view key, std::span<const std::string_view> words) {
    const std::optional<std::string> value = text(key);
    if (!value) return {};
    for (std::size_t i = 0; i < words.size(); ++i) {
        if (*value == words[i]) return i;
    }
    std::string list;
    for (const std::string_view w : words) list += (list.empty() ? "" : ", ") + std::string(w);
    const std::string_view near = nearest(*value, words);
    fail(key, in_quotes(key) + " cannot be " + in_quotes(*value),
         is_close(*value, near) ? "try " + in_quotes(near) + " (one of " + list + ")" : "try one of " + list);
    return {};
}

std::optional<std::string> TomlSection::path(std::string_view key) {
    const std::optional<std::string> value = text(key);
    if (!value || value->empty()) return {};
    if (value->find('\0') != std::string::npos) {
        fail(key, in_quotes(key) + " holds a zero byte", "write a file name");
        return {};
    }
    return file_.beside(*value, key, table_.get(key)->source());
}

std::optional<Vec3> TomlSection::point_of(std::string_view key, const toml::node& node, const Limit& limit,
                                          const char* wanted) {
    const toml::array* array = node.as_array();
    if (!array || array->size() != 3) {
        file_.fail(node.source(), in_quotes(key) + " must be " + wanted,
                   "write them in brackets, with commas");
        return {};
    }
    Vec3 point;
    for (int i = 0; i < 3; ++i) {
        const std::optional<double> value = number_of(key, *array->get(static_cast<std::size_t>(i)), limit);
        if (!value) return {};
        point[i] = *value;
    }
    return point;
}

std::optional<Vec3> TomlSection::point(std::string_view key, const Limit& limit) {
    const toml::node* node = table_.get(key);
    return node ? point_of(key, *node, limit, "three numbers [x, y, z]") : std::nullopt;
}

std::optional<Box3> TomlSection::box(std::string_view key) {
    constexpr const char* kWanted = "two corners [[x, y, z], [x, y, z]]";
    const toml::node* node = table_.get(key);
    if (!node) return {};
    const toml::array* array = node->as_array();
    if (!array || array->size() != 2) {
        fail(key, in_quotes(key) + " must be " + kWanted, "write them in brackets, with commas");
        return {};
    }
    Box3 box;
    for (std::size_t i = 0; i < 2; ++i) {
        const std::optional<Vec3> corner = point_of(key, *array->get(i), kLimits.coordinate, kWanted);
        if (!corner) return {};
        box.include(*corner);
    }
    const Vec3 size = box.size();
    if (!(size.x > 0 && size.y > 0 && size.z > 0)) {
        const char* axis = size.x <= 0 ? "x" : size.y <= 0 ? "y" : "z";
        fail(key, in_quotes(key) + " has no room: both corners have the same " + axis,
             "write two opposite corners of a box");
        return {};
    }
    return box;
}

std::optional<std::vector<double>> TomlSection::numbers(std::string_view key, const Limit& limit) {
    const toml::node* node = table_.get(key);
    if (!node) return {};
    std::vector<double> values;
    if (const toml::array* array = node->as_array()) {
        for (const toml::node& item : *array) {
            const std::optional<double> value = number_of(key, item, limit);
            if (!value) return {};
            values.push_back(*value);
        }
        return values;
    }
    if (const std::optional<double> value = number_of(key, *node, limit)) return std::vector<double>{*value};
    return {};
}

std::optional<std::vector<std::array<double, 3>>> TomlSection::triples(std::string_view key,
                                                                       const std::array<Limit, 3>& limits,
                                                                       const char* wanted,
                                                                       std::size_t least) {
    const toml::node* node = table_.get(key);
    if (!node) return {};
    const auto refuse = [&](const toml::node& where) {
        file_.fail(where.source(), in_quotes(key) + " must be " + wanted,
                   "write them in brackets, with commas");
        return std::nullopt;
    };
    const toml::array* rows = node->as_array();
    if (!rows || rows->empty() || rows->size() > kMostTables) return refuse(*node);
    std::vector<std::array<double, 3>> all;
    for (const toml::node& row : *rows) {
        const toml::array* numbers = row.as_array();
        if (!numbers || numbers->size() < least || numbers->size() > 3) return refuse(row);
        std::array<double, 3>& triple = all.emplace_back();
        for (std::size_t n = 0; n < numbers->size(); ++n) {
            const std::optional<double> value = number_of(key, *numbers->get(n), limits[n]);
            if (!value) return {};
            triple[n] = *value;
        }
    }
    return all;
}

double TomlSection::required_number(std::string_view key, const Limit& limit) {
    if (!has(key)) missing(key);
    return number(key, limit).value_or(0);
}

std::string TomlSection::required_path(std::string_view key) {
    if (!has(key)) missing(key);
    return path(key).value_or("");
}

std::vector<const toml::table*> TomlSection::tables(std::string_view key) {
    const toml::node* node = table_.get(key);
    if (!node) return {};
    if (const toml::table* table = node->as_table()) return {table};
    std::vector<const toml::table*> found;
    if (const toml::array* array = node->as_array()) {
        if (array->size() > kMostTables) {
            file_.fail(array->get(kMostTables)->source(),
                       std::to_string(array->size()) + " tables " + in_quotes(key) + ", more than " +
                           std::to_string(kMostTables),
                       "leave out what is not used, or join several into one");
            return {};
        }
        for (const toml::node& item : *array) {
            if (const toml::table* table = item.as_table()) {
                found.push_back(table);
            } else {
                wrong_type(key, item, "a table");
            }
        }
        return found;
    }
    wrong_type(key, *node, "a table");
    return {};
}

const toml::table* TomlSection::only_table(std::string_view key) {
    const std::vector<const toml::table*> found = tables(key);
    if (found.size() > 1) fail(key, "there may be only one [" + std::string(key) + "]", "remove the others");
    return found.empty() ? nullptr : found.front();
}

Result<toml::table> parse_toml(std::string_view text, const std::string& file) {
    if (text.size() > kLargestJobBytes) {
        return fail_at(file, 0, 0,
                       "the file has " + std::to_string(text.size()) + " bytes, more than " +
                           std::to_string(kLargestJobBytes),
                       "check that it is the right one: jobs, machines and profiles are written by hand");
    }
    if (auto good = check_key_parts(text, file); !good) return std::unexpected(good.error());
    toml::parse_result parsed = toml::parse(text, file);
    if (parsed) return std::move(parsed).table();
    const toml::parse_error& error = parsed.error();
    const bool bytes = error.description().find("utf-8") != std::string_view::npos;
    return fail_at(file, static_cast<int>(error.source().begin.line),
                   static_cast<int>(error.source().begin.column),
                   "not valid TOML: " + std::string(error.description()),
                   bytes ? "save the file as UTF-8" : "write key = value, text in quotes, lists in brackets");
}

}  // namespace tribo::job
