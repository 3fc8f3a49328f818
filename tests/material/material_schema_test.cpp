// SPDX-License-Identifier: MIT
// The description of a material file against what others have of it: the page's schema and docs/material.md
// are compared with it letter by letter, the reader holds to each range at its ends.
#include "material/material_schema.hpp"

#include <gtest/gtest.h>
#include <limits>
#include <map>

#include "base/text/decimal.hpp"
#include "files/files.hpp"
#include "files/json/json.hpp"
#include "material/material_fields.hpp"
#include "material/material_json.hpp"
#include "places.hpp"

namespace tribo::material {
namespace {

using files::Json;

std::string source(const std::string& path) {
    return files::read_file(std::string(TRIBO_SOURCE_DIR) + "/" + path, 1 << 20).value();
}

// "1e6" where format_decimal says "1e+06".
std::string number(double value) {
    std::string text = format_decimal(value);
    if (const std::size_t at = text.find("e+0"); at != text.npos) text.erase(at + 1, 2);
    return text;
}

// The page's schema
// --------------------------------------------------------------------------------------------

std::string page_field(const Field& field, const std::string& indent);

std::string page_fields(const std::vector<Field>& fields, const std::string& indent) {
    std::string text = "{\n";
    for (const Field& f : fields) {
        text += indent + "  " + std::string(f.key) + ": " + page_field(f, indent + "  ") + ",\n";
    }
    return text + indent + "}";
}

std::string page_field(const Field& field, const std::string& indent) {
    std::vector<std::string> parts;
    const bool numbers = field.kind == FieldKind::number || field.kind == FieldKind::numbers ||
                         field.kind == FieldKind::tables;
    if (field.kind == FieldKind::text) parts.push_back("text: " + std::to_string(field.most));
    if (numbers) {
        parts.push_back((field.range.above ? "above: " : "from: ") + number(field.range.min));
        parts.push_back("to: " + number(field.range.max));
    }
    if (field.kind != FieldKind::text && field.most > 0)
        parts.push_back("most: " + std::to_string(field.most));
    if (field.kind == FieldKind::tables) parts.push_back("longest: " + std::to_string(kLongestTable));
    if (!field.required) {
        const std::map<FieldKind, std::string> nothing{{FieldKind::text, "\"\""},
                                                       {FieldKind::numbers, "[]"},
                                                       {FieldKind::object, "undefined"},
                                                       {FieldKind::objects, "[]"}};
        parts.push_back("absent: " + (field.absent ? number(*field.absent) : nothing.at(field.kind)));
    }
    if (!field.heard) parts.emplace_back("unheard: true");
    const bool nested = !field.fields.empty();
    const std::string between = nested ? ",\n" + indent + "  " : ", ";
    if (nested) parts.push_back("fields: " + page_fields(field.fields, indent + "  "));
    std::string text = nested ? "{\n" + indent + "  " : "{ ";
    for (std::size_t n = 0; n < parts.size(); ++n) text += (n > 0 ? between : "") + parts[n];
    return text + (nested ? ",\n" + indent + "}" : " }");
}

// Voice for voices, LevelLaw for level_law.
std::string type_name(const Field& field) {
    std::string name;
    bool upper = true;
    for (const char c : field.key) {
        if (c == '_') {
            upper = true;
        } else {
            name += upper ? static_cast<char>(c - 'a' + 'A') : c;
            upper = false;
        }
    }
    if (field.kind == FieldKind::objects) name.pop_back();
    return name;
}

void append_types(std::string& text, const std::string& name, const std::vector<Field>& fields) {
    std::string own = "export interface " + name + " {\n";
    for (const Field& f : fields) {
        if (!f.fields.empty()) append_types(text, type_name(f), f.fields);
        const std::map<FieldKind, std::string> types{
            {FieldKind::text, "string"},       {FieldKind::number, "number"},
            {FieldKind::numbers, "number[]"},  {FieldKind::tables, "number[][]"},
            {FieldKind::object, type_name(f)}, {FieldKind::objects, type_name(f) + "[]"}};
        const bool may_lack = f.kind == FieldKind::object;
        own += "  " + std::string(f.key) + ": " + types.at(f.kind) + (may_lack ? " | undefined" : "") + ";\n";
    }
    text += own + "}\n\n";
}

std::string page_schema() {
    std::string text =
        "// SPDX-License-Identifier: MIT\n"
        "// What may stand in a material file, out of src/material/material_schema.hpp. Not to be edited:\n"
        "// tests/material/material_schema_test.cpp says what belongs here.\n\n"
        "/** Of a number `from` or `above`, and `to`; of a text its most bytes; of a list its `most` "
        "entries. */\n"
        "export interface Field {\n"
        "  from?: number;\n"
        "  above?: number;\n"
        "  to?: number;\n"
        "  text?: number;\n"
        "  most?: number;\n"
        "  /** Numbers in each list of a list. */\n"
        "  longest?: number;\n"
        "  /** What stands for it; a field without must be there. */\n"
        "  absent?: unknown;\n"
        "  /** Not among the voice numbers. */\n"
        "  unheard?: boolean;\n"
        "  fields?: Fields;\n"
        "}\n\n"
        "export type Fields = Readonly<Record<string, Field>>;\n\n";
    append_types(text, "Material", material_fields());
    text += std::string("export const kSchema = \"") + kMaterialSchema + "\";\n\n";
    return text + "export const kFields: Fields = " + page_fields(material_fields(), "") + ";\n";
}

TEST(MaterialSchema, of_the_page_is_that_of_the_engine) {
    const std::string expected = page_schema(), path = "web/touch/src/material_schema.ts";
    const auto stored = files::read_file(std::string(TRIBO_SOURCE_DIR) + "/" + path, 1 << 20);
    if (stored && *stored == expected) return;
    const std::string made = testing::TempDir() + "material_schema.ts";
    ASSERT_TRUE(files::write_file(made, expected));
    FAIL() << path << " is out of date; copy " << made << " there";
}

// The documentation
// --------------------------------------------------------------------------------------------

// "above 0 to 1e6", "up to 128 from -1 to 1"; empty for texts and objects.
std::string range_text(const Field& f) {
    if (f.kind == FieldKind::text || f.kind == FieldKind::object) return "";
    if (f.kind == FieldKind::objects) return "up to " + std::to_string(f.most);
    const std::string range =
        (f.range.above ? "above " : "") + number(f.range.min) + " to " + number(f.range.max);
    if (f.kind == FieldKind::number) return range;
    return "up to " + std::to_string(f.most) + ", each " + range;
}

std::string absent_text(const Field& f) {
    if (f.required) return "refused";
    return f.absent ? number(*f.absent) : "";
}

void append_rows(std::vector<std::string>& rows, const std::string& path, const std::vector<Field>& fields) {
    for (const Field& f : fields) {
        rows.push_back("| `" + path + std::string(f.key) + "` | " + range_text(f) + " | " + absent_text(f) +
                       " |");
        append_rows(rows, path + std::string(f.key) + ".", f.fields);
    }
}

TEST(MaterialSchema, stands_in_the_documentation) {
    std::vector<std::string> rows;
    append_rows(rows, "", material_fields());
    const std::string page = source("docs/material.md");
    std::string missing;
    std::size_t at = 0;
    for (const std::string& row : rows) {
        const std::size_t found = page.find("\n" + row, at);
        if (found == page.npos) {
            missing += row + "\n";
        } else {
            at = found;
        }
    }
    EXPECT_TRUE(missing.empty()) << "docs/material.md lacks, in this order:\n" << missing;
}

// The ends of ranges
// -------------------------------------------------------------------------------------------

struct Numeric {
    std::string path;  // as a JSON pointer
    Field field;
};

void find_numbers(std::vector<Numeric>& found, const std::string& path, const std::vector<Field>& fields) {
    for (const Field& f : fields) {
        const std::string own = path + "/" + std::string(f.key);
        const bool list = f.kind == FieldKind::objects;
        if (!f.fields.empty()) find_numbers(found, own + (list ? "/0" : ""), f.fields);
        if (f.kind == FieldKind::number) found.push_back({own, f});
        if (f.kind == FieldKind::numbers) found.push_back({own + "/0", f});
        if (f.kind == FieldKind::tables) found.push_back({own + "/0/0", f});
    }
}

TEST(MaterialSchema, is_held_to_at_both_ends_of_each_range) {
    std::vector<Numeric> numbers;
    find_numbers(numbers, "", material_fields());
    ASSERT_GT(numbers.size(), 30U);
    const Json whole = Json::parse(source("tests/material/odd/whole.json"));
    const double infinite = std::numeric_limits<double>::infinity();
    for (const auto& [path, field] : numbers) {
        const Json::json_pointer pointer(path);
        ASSERT_TRUE(whole.contains(pointer)) << path;
        const auto error_at = [&](double value) {
            Json changed = whole;
            changed[pointer] = value;
            const auto read = parse_material(changed.dump(), "m.json");
            return read ? std::string() : read.error().text();
        };
        // Another rule may refuse what is in range: then it says so in other words.
        const std::string words = "give a number " + std::string(field.range.above ? "above " : "from ");
        const Range r = field.range;
        const double low = r.above ? std::nextafter(r.min, infinite) : r.min;
        EXPECT_EQ(error_at(low).find(words), std::string::npos) << path << ": " << error_at(low);
        EXPECT_EQ(error_at(r.max).find(words), std::string::npos) << path << ": " << error_at(r.max);
        for (const double beyond : {std::nextafter(low, -infinite), std::nextafter(r.max, infinite)}) {
            const std::string error = error_at(beyond);
            EXPECT_NE(error.find(words), std::string::npos) << path << " = " << beyond << ": " << error;
            EXPECT_NE(error.find(field.key), std::string::npos) << error;
        }
    }
}

}  // namespace
}  // namespace tribo::material
