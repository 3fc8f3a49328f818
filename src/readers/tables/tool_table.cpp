// SPDX-License-Identifier: MIT
#include "readers/tables/tool_table.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <set>

#include "base/text/decimal.hpp"
#include "base/text/limit_text.hpp"
#include "base/text/nearest.hpp"
#include "readers/text/csv_fields.hpp"
#include "readers/text/model_text.hpp"
#include "readers/text/text_lines.hpp"
#include "readers/tools/library/libraries.hpp"
#include "readers/tools/tool_notes.hpp"

namespace tribo::readers {
namespace {

using namespace std::string_view_literals;

constexpr std::array kToolColumns{"number"sv, "diameter_mm"sv, "corner_mm"sv, "flutes"sv, "length_mm"sv};

struct Field {
    std::string_view text;
    int column = 1;
};

std::vector<Field> fields_of(std::string_view line) {
    std::vector<Field> fields;
    for (std::size_t at = 0;;) {
        const bool is_last = fields.size() + 1 == kMostFields;
        const std::size_t end = is_last ? line.size() : std::min(line.find_first_of(",;", at), line.size());
        const std::string_view text = trimmed(line.substr(at, end - at));
        fields.push_back(
            {text,
             static_cast<int>((text.empty() ? at : static_cast<std::size_t>(text.data() - line.data()))) +
                 1});
        if (end == line.size()) return fields;
        at = end + 1;
    }
}

class ToolTableReader {
  public:
    ToolTableReader(std::string_view bytes, const ToolTableOptions& options)
        : lines_(bytes), options_(options) {}

    Result<ToolTable> read() {
        while (const auto line = lines_.next()) {
            const std::string_view text = trimmed(*line);
            if (text.empty() || text[0] == ';' || text[0] == '#') continue;
            if (columns_.empty() && table_.tools.empty() &&
                text.find_first_of(",;") != std::string_view::npos && to_upper(text[0]) != 'T') {
                if (auto done = read_header(*line); !done) return std::unexpected(done.error());
                continue;
            }
            auto tool = columns_.empty() ? read_words(*line) : read_row(*line);
            if (!tool) return std::unexpected(tool.error());
            if (auto done = add(*tool); !done) return std::unexpected(done.error());
        }
        if (table_.tools.empty()) {
            return fail_at(
                options_.source_name, 0, 0, "the tool table holds no tool",
                "write a line as T1 P1 D6 Z50 for each, or a CSV table with number and diameter_mm");
        }
        return std::move(table_);
    }

  private:
    std::unexpected<Error> refuse(int column, std::string cause, std::string remedy) const {
        return fail_at(options_.source_name, lines_.number(), column, std::move(cause), std::move(remedy));
    }

    Result<void> read_header(std::string_view line) {
        for (const Field& field : fields_of(line)) {
            std::string name(field.text);
            std::transform(name.begin(), name.end(), name.begin(), [](char c) {
                return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
            });
            const auto known = std::find(kToolColumns.begin(), kToolColumns.end(), name);
            if (known == kToolColumns.end()) {
                table_.warnings.push_back(
                    {options_.source_name, lines_.number(),
                     "the column " + quoted(name) + " is not read; " + suggestion(name, kToolColumns)});
            }
            columns_.push_back(static_cast<std::size_t>(known - kToolColumns.begin()));
        }
        for (std::size_t needed : {std::size_t{0}, std::size_t{1}}) {
            if (std::find(columns_.begin(), columns_.end(), needed) != columns_.end()) continue;
            return refuse(1, "the table has no column '" + std::string(kToolColumns[needed]) + "'",
                          "name its columns number, diameter_mm, corner_mm, flutes, length_mm");
        }
        return {};
    }

    Result<motion::DeclaredTool> read_row(std::string_view line) {
        const std::vector<Field> fields = fields_of(line);
        motion::DeclaredTool tool;
        for (std::size_t i = 0; i < fields.size() && i < columns_.size(); ++i) {
            if (columns_[i] == kToolColumns.size() || fields[i].text.empty()) continue;
            const auto value = number_of(fields[i].text);
            if (!value) {
                return refuse(fields[i].column,
                              "'" + std::string(fields[i].text.substr(0, 20)) + "' is no number",
                              "correct it");
            }
            if (auto done = set(tool, columns_[i], *value, fields[i].column); !done) {
                return std::unexpected(done.error());
            }
        }
        return tool;
    }

    // T1 P1 D6.0 Z+50.2 ;comment
    Result<motion::DeclaredTool> read_words(std::string_view line) {
        motion::DeclaredTool tool;
        const double unit = mm_per(options_.unit);
        for (std::size_t at = 0; at < line.size();) {
            if (is_blank(line[at])) {
                ++at;
                continue;
            }
            if (line[at] == ';') {
                read_comment(tool, line.substr(at + 1), unit);
                break;
            }
            const int column = static_cast<int>(at) + 1;
            const char letter = to_upper(line[at]);
            double value = 0;
            const std::size_t length = parse_decimal(line.substr(at + 1), value, DecimalExponent::none);
            if (!is_letter(letter) || length == 0) {
                return refuse(column, "a tool's line is words such as T1 P1 D6 Z50, and this is none",
                              "correct it, or give a CSV table with a header");
            }
            at += 1 + length;
            std::optional<std::size_t> what;
            if (letter == 'T') what = 0;
            if (letter == 'D') what = 1;
            if (letter == 'Z') what = 4;
            if (!what) continue;  // pocket, offsets of other axes, lathe angles
            if (auto done = set(tool, *what, *what == 0 ? value : value * unit, column); !done) {
                return std::unexpected(done.error());
            }
        }
        return tool;
    }

    // T2 P2 D8 ;8 mm ball end mill 2 flutes
    void read_comment(motion::DeclaredTool& tool, std::string_view comment, double unit) {
        const ToolText text = read_tool_text(comment);
        if (!text.names_tool) return;
        ToolSizes sizes = sizes_of(text, unit);
        if (tool.diameter_mm > 0) sizes.diameter_mm = tool.diameter_mm;
        motion::DeclaredTool shaped = tool;
        std::string remark;
        if (!(sizes.diameter_mm > 0) || !set_shape(shaped, sizes, remark)) return;
        tool = shaped;
        if (!remark.empty()) {
            table_.warnings.push_back(
                {options_.source_name, lines_.number(), "T" + std::to_string(tool.number) + ": " + remark});
        }
    }

    Result<void> set(motion::DeclaredTool& tool, std::size_t what, double value, int column) {
        static constexpr std::array kColumnLimits{kLimits.tool_number, kLimits.cutter_diameter,
                                                  kLimits.corner_radius, kLimits.flutes, kLimits.tool_length};
        const Limit& limit = kColumnLimits[what];
        // Tool 0 is the empty spindle; a tool without a diameter is a probe, or described elsewhere.
        const bool may_be_none = what <= 1 && value == 0;
        if (!limit.range.contains(value) && !may_be_none)
            return refuse(column, out_of_range(limit, value), range_remedy(limit));
        if ((what == 0 || what == 3) && value != std::floor(value)) {
            return refuse(column,
                          std::string(limit.quantity) + ": " + plain_number(value) + " is not a whole number",
                          "correct it");
        }
        switch (what) {
            case 0:
                tool.number = static_cast<int>(value);
                break;
            case 1:
                tool.diameter_mm = value;
                break;
            case 2:
                tool.corner_mm = value;
                break;
            case 3:
                tool.flutes = static_cast<int>(value);
                break;
            default:
                tool.length_mm = value;
                break;
        }
        return {};
    }

    Result<void> add(motion::DeclaredTool tool) {
        tool.line = lines_.number();
        tool.table = options_.source_name.empty() ? "tool table" : options_.source_name;
        if (2 * tool.corner_mm > tool.diameter_mm) {
            return refuse(1, "the corner radius is more than half the diameter", "correct one of them");
        }
        if (tool.number == 0) return {};  // entry of tool.tbl for the empty spindle
        if (!numbers_.insert(tool.number).second) {
            return refuse(1, "tool " + std::to_string(tool.number) + " stands in the table twice",
                          "delete one of the lines");
        }
        table_.tools.push_back(std::move(tool));
        return {};
    }

    TextLines lines_;
    const ToolTableOptions& options_;
    std::vector<std::size_t> columns_;  // of CSV: content of each column
    std::set<int> numbers_;
    ToolTable table_;
};

}  // namespace

bool is_tool_table(std::string_view bytes, std::string_view name) {
    std::string ending(name.substr(std::min(name.rfind('.'), name.size())));
    std::ranges::transform(ending, ending.begin(), to_upper);
    constexpr std::array endings{".TBL"sv, ".FCTB"sv, ".TOOLS"sv, ".JSON"sv, ".XML"sv};
    if (std::ranges::find(endings, ending) != endings.end()) return true;
    const std::string_view header = bytes.substr(0, bytes.find_first_of("\r\n"));
    return ending == ".CSV" &&
           (is_csv_library(bytes) || header.find("diameter_mm") != std::string_view::npos);
}

Result<ToolTable> read_tool_table(std::string_view bytes, const ToolTableOptions& options) {
    const std::size_t first = bytes.find_first_not_of("\xEF\xBB\xBF \t\r\n");
    const char begin = first == std::string_view::npos ? ' ' : bytes[first];
    if (begin == '{' || begin == '[') return read_json_library(bytes, options.source_name);
    if (begin == '<') return read_xml_library(bytes, options.source_name);
    if (is_csv_library(bytes)) return read_csv_library(bytes, options.source_name);
    if (bytes.starts_with("PK\x03\x04")) {
        return fail_at(options.source_name, 0, 0, "the tool library is still packed (zip)",
                       "unpack it and give the tools.json in it");
    }
    return ToolTableReader(bytes, options).read();
}

}  // namespace tribo::readers
