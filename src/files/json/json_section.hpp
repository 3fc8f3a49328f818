// SPDX-License-Identifier: MIT
// One object of a JSON file, read key by key with checks of types and ranges, as TomlSection does for TOML.
// The first error is kept, with its path ("voices[2].speed_mm_per_s"); all later reads return empty values.
// Includes the JSON library.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/range.hpp"
#include "base/result.hpp"
#include "files/json/json.hpp"

namespace tribo::files {

// Parses the text. Errors of syntax have line and column; duplicate keys are refused. Never throws.
Result<Json> parse_json(std::string_view text, const std::string& file);

class JsonSection {
  public:
    // `path`: name of the object in messages; empty for the whole file. `keys`: all valid keys. `error`
    // collects the error for all sections of a file.
    JsonSection(const Json& object, std::string path, std::span<const std::string_view> keys,
                std::optional<Error>& error, const std::string& file);

    bool has(std::string_view key) const;
    double number(std::string_view key, Range range, std::optional<double> otherwise = {});
    std::string text(std::string_view key, const std::optional<std::string>& otherwise = {},
                     std::size_t longest = 10'000);
    std::vector<double> numbers(std::string_view key, Range range, std::size_t most);
    // Reads an array of at most `most` arrays of numbers. Each must be valid for numbers() with `longest`.
    std::vector<std::vector<double>> tables(std::string_view key, Range range, std::size_t most,
                                            std::size_t longest);
    // Returns the objects under a key; none if it is absent.
    std::vector<const Json*> objects(std::string_view key, std::size_t most);
    // Returns the object under a key; null if it is absent.
    const Json* object(std::string_view key);

    void fail(std::string_view key, std::string cause, std::string remedy);
    std::string path_of(std::string_view key) const;

  private:
    const Json* find(std::string_view key) const;
    bool in_range(std::string_view key, const Json& value, Range range);
    std::vector<double> numbers_of(const std::string& key, const Json& value, Range range, std::size_t most);

    const Json& object_;
    std::string path_;
    std::optional<Error>& error_;
    const std::string& file_;
};

}  // namespace tribo::files
