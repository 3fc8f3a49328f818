// SPDX-License-Identifier: MIT
#include "material/material_json.hpp"

#include <algorithm>

#include "files/json/json_section.hpp"
#include "material/material_fields.hpp"
#include "material/material_schema.hpp"
#include "material/material_text.hpp"

namespace tribo::material {
namespace {

std::vector<std::string_view> keys_of(const std::vector<Field>& fields) {
    std::vector<std::string_view> keys;
    keys.reserve(fields.size());
    for (const Field& field : fields) keys.push_back(field.key);
    return keys;
}

// Reads one object of a file. The first error of the file goes to `error`.
class JsonReader {
  public:
    static constexpr bool kReads = true;

    // `fields`: the valid keys of the object.
    JsonReader(const files::Json& json, std::string path, const std::vector<Field>& fields,
               std::optional<Error>& error, const std::string& file)
        : section_(json, std::move(path), keys_of(fields), error, file),
          fields_(fields),
          error_(error),
          file_(file) {}

    void schema(const char* schema) {
        const std::string read = section_.text("schema");
        expect(read == schema, "schema", ("is '" + read.substr(0, 80) + "'").c_str(),
               (std::string("give a material of schema '") + schema + "'").c_str());
    }
    void text(const char* key, std::string& value) { value = section_.text(key, "", kLongestText); }
    template <class Number>
    void number(const char* key, Number& value, Range range, std::optional<Absent> absent = {}) {
        std::optional<double> otherwise;
        if (absent) otherwise = absent->value;
        value = static_cast<Number>(section_.number(key, range, otherwise));
    }
    void numbers(const char* key, std::vector<double>& values, Range range, std::size_t most) {
        values = section_.numbers(key, range, most);
    }
    void numbers(const char* key, std::optional<std::vector<double>>& values, Range range, std::size_t most) {
        if (section_.has(key)) values = section_.numbers(key, range, most);
    }
    void tables(const char* key, std::vector<std::vector<double>>& tables, Range range, std::size_t most) {
        tables = section_.tables(key, range, most, kLongestTable);
    }
    template <class T>
    bool object(const char* key, T& value, bool) {
        const files::Json* json = section_.object(key);
        if (json == nullptr) return false;
        JsonReader inner(*json, section_.path_of(key), fields_of(key), error_, file_);
        describe(inner, value);
        return true;
    }
    template <class T>
    void object(const char* key, std::optional<T>& value) {
        T read;
        if (object(key, read, true)) value = std::move(read);
    }
    template <class Item>
    void objects(const char* key, std::size_t most, std::size_t, const Item& item) {
        const std::vector<const files::Json*> items = section_.objects(key, most);
        for (std::size_t n = 0; n < items.size() && !error_; ++n) {
            JsonReader inner(*items[n], section_.path_of(key) + "[" + std::to_string(n) + "]", fields_of(key),
                             error_, file_);
            item(inner, n);
        }
    }
    template <class Part>
    void unheard(const Part& part) {
        part(*this);
    }
    void expect(bool holds, const char* key, const char* cause, const char* remedy) {
        if (!holds) section_.fail(key, cause, remedy);
    }

  private:
    const std::vector<Field>& fields_of(std::string_view key) const {
        return std::ranges::find(fields_, key, &Field::key)->fields;
    }

    files::JsonSection section_;
    const std::vector<Field>& fields_;
    std::optional<Error>& error_;
    const std::string& file_;
};

}  // namespace

Result<Material> parse_material(std::string_view text, const std::string& source_name) {
    if (text.size() > kLargestMaterialBytes) {
        return fail_at(source_name, 0, 0, "is too large for a material",
                       "give a file that tribo learn wrote");
    }
    const Result<files::Json> json = files::parse_json(text, source_name);
    if (!json) return std::unexpected(json.error());
    std::optional<Error> error;
    JsonReader reader(*json, "", material_fields(), error, source_name);
    Material material;
    describe(reader, material);
    if (error) return std::unexpected(*std::move(error));
    return material;
}

FileResult<Material> read_material(const std::string& path) {
    const FileResult<std::string> bytes = files::read_file(path, kLargestMaterialBytes);
    if (!bytes) return std::unexpected(bytes.error());
    Result<Material> material = parse_material(*bytes, path);
    if (!material) return std::unexpected(FileFailure(material.error()));
    return *std::move(material);
}

std::string material_json(const Material& material) {
    return files::pretty(files::parse(material_text(material)));
}

bool looks_like_material(std::string_view text) {
    return text.substr(0, 4096).find("tribo.material") != std::string_view::npos;
}

}  // namespace tribo::material
