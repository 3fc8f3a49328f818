// SPDX-License-Identifier: MIT
// One table of a TOML file, read key by key with types, ranges and words checked. The first thing wrong is
// kept with its place; whatever is read after it comes back empty, so that a reader runs through without
// branches and looks once at the end. Private to job/: it brings in the TOML library.
#pragma once

// The library asserts that its own parser met what it expects; damaged input breaks that, and it reports an
// error all the same once the assertion is passed.
#define TOML_ASSERT(condition) static_cast<void>(0)
#define TOML_EXCEPTIONS 0
#define TOML_ENABLE_FORMATTERS 0
#define TOML_ENABLE_WINDOWS_COMPAT 0
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>
#ifdef __wasi__
#include "job/toml/toml_for_wasm.hpp"
#endif
#include <toml++/toml.h>

#include "base/range.hpp"
#include "base/result.hpp"
#include "base/text/nearest.hpp"
#include "base/vec3.hpp"

namespace tribo::job {

inline constexpr Range kAnyNumber{};
inline constexpr Range kPositive{0, std::numeric_limits<double>::max(), true};
inline constexpr Range kNotNegative{0};

// The file, and the first thing found wrong in it.
class TomlFile {
  public:
    explicit TomlFile(std::string name) : name_(std::move(name)) {}

    bool ok() const { return !error_.has_value(); }
    const Error& error() const { return *error_; }
    const std::string& name() const { return name_; }
    // The path of a file that this one names: as it is when absolute, else from this one's folder.
    std::string beside(const std::string& path) const;

    void fail(const toml::source_region& where, std::string cause, std::string remedy = {});
    void fail(Error error);

  private:
    std::string name_;
    std::optional<Error> error_;
};

class TomlSection {
  public:
    // `label` is how messages call the table ("[cutter]"); `keys` are all that it may hold. Refuses others.
    TomlSection(TomlFile& file, const toml::table& table, std::string label,
                std::span<const std::string_view> keys);

    bool has(std::string_view key) const { return table_.contains(key); }
    bool has_text(std::string_view key) const { return table_[key].is_string(); }
    std::optional<double> number(std::string_view key, Range range = kAnyNumber);
    std::optional<int> integer(std::string_view key, int min, int max);
    std::optional<std::string> text(std::string_view key);
    // The index of the word among `words`.
    std::optional<std::size_t> word(std::string_view key, std::span<const std::string_view> words);
    // A file's path, joined with the folder of the file that names it.
    std::optional<std::string> path(std::string_view key);
    std::optional<Vec3> point(std::string_view key);
    // [[x,y,z],[x,y,z]]: two opposite corners with room between them.
    std::optional<Box3> box(std::string_view key);
    // One number or an array of them.
    std::optional<std::vector<double>> numbers(std::string_view key, Range range = kAnyNumber);

    // The same, but absence is an error too; the value is then anything.
    double required_number(std::string_view key, Range range = kAnyNumber);
    std::string required_path(std::string_view key);

    // The tables under a key: of one table, or of an array of tables.
    std::vector<const toml::table*> tables(std::string_view key);
    // The one table under a key, null where it is absent; several are an error.
    const toml::table* only_table(std::string_view key);

    // Reports at the key's value, or at the table where the key is absent.
    void fail(std::string_view key, std::string cause, std::string remedy = {});
    void missing(std::string_view key);
    TomlFile& file() { return file_; }
    const std::string& label() const { return label_; }

  private:
    std::optional<double> number_of(std::string_view key, const toml::node& node, Range range);
    void wrong_type(std::string_view key, const toml::node& node, const char* wanted);
    std::optional<Vec3> point_of(std::string_view key, const toml::node& node, const char* wanted);

    TomlFile& file_;
    const toml::table& table_;
    std::string label_;
};

// Job and machine files are written by hand; larger ones are something else.
inline constexpr std::uint64_t kLargestJobBytes = std::uint64_t{4} << 20;

// Parses; an Error with its place where this is not TOML.
Result<toml::table> parse_toml(std::string_view text, const std::string& file);

}  // namespace tribo::job
