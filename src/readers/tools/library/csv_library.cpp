// SPDX-License-Identifier: MIT
// CSV and tab-separated exports of Fusion and HSM. The header names each column as `Diameter (tool_diameter)`
// or as `tool_diameter`.
#include <utility>
#include <vector>

#include "readers/text/text_lines.hpp"
#include "readers/tools/folded_text.hpp"
#include "readers/tools/library/libraries.hpp"

namespace tribo::readers {
namespace {

constexpr std::size_t kMostColumns = 2000;

char separator_of(std::string_view header) {
    for (const char c : {'\t', ';'}) {
        if (header.find(c) != std::string_view::npos) return c;
    }
    return ',';
}

// Reads records whose fields may stand in quotes, with "" for a quote and line ends inside.
class CsvRecords {
  public:
    CsvRecords(std::string_view bytes, char separator) : rest_(bytes), separator_(separator) {}

    bool next(std::vector<std::string>& fields) {
        fields.clear();
        if (rest_.empty()) return false;
        line = next_line_;
        std::string field;
        bool is_quoted = false;
        std::size_t i = 0;
        for (; i < rest_.size(); ++i) {
            const char c = rest_[i];
            if (c == '\n') ++next_line_;
            if (is_quoted) {
                if (c != '"') {
                    field += c;
                } else if (i + 1 < rest_.size() && rest_[i + 1] == '"') {
                    field += c;
                    ++i;
                } else {
                    is_quoted = false;
                }
                continue;
            }
            if (c == '\n' || c == '\r') break;
            if (c == '"' && trimmed(field).empty()) {
                is_quoted = true;
                field.clear();
            } else if (c == separator_ && fields.size() < kMostColumns) {
                fields.push_back(std::exchange(field, {}));
            } else {
                field += c;
            }
        }
        fields.push_back(std::move(field));
        if (i < rest_.size() && rest_[i] == '\r' && i + 1 < rest_.size() && rest_[i + 1] == '\n') {
            ++i;
            ++next_line_;
        }
        rest_.remove_prefix(std::min(i + 1, rest_.size()));
        return true;
    }

    int line = 0;  // of the last record

  private:
    std::string_view rest_;
    char separator_;
    int next_line_ = 1;
};

// `Diameter (tool_diameter)`: tool_diameter.
std::string_view key_of(std::string_view title) {
    const std::size_t open = title.rfind('(');
    if (open != std::string_view::npos && title.ends_with(')'))
        title = title.substr(open + 1, title.size() - open - 2);
    return trimmed(title);
}

class CsvTools {
  public:
    CsvTools(const std::vector<std::string>& header, const std::vector<std::string>& fields)
        : header_(header), fields_(fields) {}

    std::string_view text(std::string_view key) const {
        for (std::size_t i = 0; i < header_.size() && i < fields_.size(); ++i) {
            if (key_of(trimmed(header_[i])) == key) return trimmed(fields_[i]);
        }
        return {};
    }
    double number(std::string_view key, double unit) const {
        const double value = quantity_of(text(key), unit).value_or(0);
        return value > 0 && value < 1e6 ? value : 0;
    }

  private:
    const std::vector<std::string>& header_;
    const std::vector<std::string>& fields_;
};

LibraryTool tool_of(const CsvTools& row) {
    LibraryTool tool;
    tool.type = row.text("tool_type");
    tool.name = row.text("tool_description");
    const double unit_mm = folded(row.text("tool_unit")).starts_with("IN") ? kMmPerInch : 1;
    if (const double number = row.number("tool_number", 1); number >= 1)
        tool.number = static_cast<int>(number);
    ToolSizes& sizes = tool.sizes;
    sizes.shape = shape_in(folded(tool.type)).shape;
    sizes.diameter_mm = row.number("tool_diameter", unit_mm);
    sizes.corner_mm = row.number("tool_cornerRadius", unit_mm);
    sizes.tip_mm = row.number("tool_tipDiameter", unit_mm);
    sizes.edge_mm = row.number("tool_fluteLength", unit_mm);
    sizes.flutes = static_cast<int>(row.number("tool_numberOfFlutes", 1));
    sizes.point_deg = row.number("tool_tipAngle", 1);
    const double side_deg = row.number("tool_taperAngle", 1);
    if (sizes.shape == ToolShape::taper || sizes.shape == ToolShape::dovetail) sizes.taper_deg = side_deg;
    if (sizes.shape == ToolShape::chamfer && side_deg > 0) sizes.point_deg = 2 * side_deg;
    const bool has_point = sizes.shape != ToolShape::flat && sizes.shape != ToolShape::ball &&
                           sizes.shape != ToolShape::bull && sizes.shape != ToolShape::face;
    if (!has_point) sizes.point_deg = sizes.tip_mm = 0;
    if (const double length = row.number("tool_assemblyGaugeLength", unit_mm); length > 0)
        tool.length_mm = length;
    return tool;
}

}  // namespace

bool is_csv_library(std::string_view bytes) {
    return bytes.substr(0, bytes.find_first_of("\r\n")).find("tool_diameter") != std::string_view::npos;
}

Result<ToolTable> read_csv_library(std::string_view bytes, const std::string& source_name) {
    if (bytes.starts_with("\xEF\xBB\xBF")) bytes.remove_prefix(3);
    CsvRecords records(bytes, separator_of(bytes.substr(0, bytes.find_first_of("\r\n"))));
    std::vector<std::string> header, fields;
    records.next(header);
    LibraryTools tools(source_name);
    while (records.next(fields)) {
        if (fields.size() == 1 && trimmed(fields[0]).empty()) continue;
        LibraryTool tool = tool_of(CsvTools(header, fields));
        tool.line = records.line;
        if (tool.type == "holder") continue;
        tools.add(std::move(tool));
    }
    return tools.finish();
}

}  // namespace tribo::readers
