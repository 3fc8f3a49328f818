// SPDX-License-Identifier: MIT
#include "readers/tools/library/library_tools.hpp"

#include <cmath>
#include <utility>

#include "base/limits.hpp"
#include "base/text/printable.hpp"
#include "readers/text/text_lines.hpp"
#include "readers/tools/folded_text.hpp"
#include "readers/tools/text_tokens.hpp"
#include "readers/tools/tool_shape.hpp"

namespace tribo::readers {
namespace {

constexpr std::size_t kLongestName = 60;
// Two entries of one number whose diameters and corners differ by less are one tool with two sets of cutting
// data, mm.
constexpr double kSameTool = 1e-6;

std::string title_of(const LibraryTool& tool) {
    std::string title = tool.number ? "T" + std::to_string(*tool.number) : "a tool";
    const std::string& name = tool.name.empty() ? tool.type : tool.name;
    if (!name.empty()) title += " (" + printable(name.substr(0, kLongestName)) + ")";
    return title;
}

bool is_same(const motion::DeclaredTool& a, const motion::DeclaredTool& b) {
    return std::abs(a.diameter_mm - b.diameter_mm) < kSameTool &&
           std::abs(a.corner_mm - b.corner_mm) < kSameTool;
}

}  // namespace

void LibraryTools::warn(int line, std::string text) {
    constexpr std::size_t most = 200;
    if (table_.warnings.size() > most) return;
    if (table_.warnings.size() == most) text = "more entries are not used, too: they are not listed";
    table_.warnings.push_back({source_name_, line, std::move(text)});
}

void LibraryTools::add(LibraryTool tool) {
    ++entries_;
    if (tool.sizes.shape == ToolShape::unstated) tool.sizes.shape = shape_in(folded(tool.type)).shape;
    motion::DeclaredTool declared;
    std::string remark;
    declared.line = tool.line;
    declared.table = source_name_.empty() ? "tool library" : source_name_;
    if (!set_shape(declared, tool.sizes, remark)) {
        warn(tool.line, title_of(tool) + " is not used: " + remark);
        return;
    }
    if (tool.length_mm && kLimits.tool_length.range.contains(*tool.length_mm))
        declared.length_mm = tool.length_mm;
    if (kLimits.shank_diameter.range.contains(tool.shank_mm)) declared.shank_mm = tool.shank_mm;
    // A stick-out within the edges is none.
    if (kLimits.stickout.range.contains(tool.stickout_mm) && tool.stickout_mm >= declared.edge_mm) {
        declared.stickout_mm = tool.stickout_mm;
        declared.holder = std::move(tool.holder);
    }
    const bool has_number = tool.number && *tool.number > 0 &&
                            kLimits.tool_number.range.contains(static_cast<double>(*tool.number));
    if (!has_number) {
        ++unnumbered_count_;
        if (!unnumbered_) unnumbered_ = declared;
        if (entries_ > 1) warn(tool.line, title_of(tool) + " is not used: the library gives it no number");
        return;
    }
    if (!remark.empty()) warn(tool.line, title_of(tool) + ": " + remark);
    declared.number = *tool.number;
    const auto known = index_.find(declared.number);
    if (known != index_.end()) {
        if (!is_same(table_.tools[known->second], declared))
            warn(tool.line, title_of(tool) + " is not used: another tool of this number stands before it");
        return;
    }
    index_.emplace(declared.number, table_.tools.size());
    table_.tools.push_back(declared);
}

Result<ToolTable> LibraryTools::finish() const {
    ToolTable table = table_;
    // One tool alone stands for every number.
    if (entries_ == 1 && unnumbered_) table.tools.push_back(*unnumbered_);
    if (!table.tools.empty()) return table;
    std::string cause = "the tool library holds no tool that can be used";
    if (!table.warnings.empty()) cause += "; the first: " + table.warnings.front().text;
    return fail_at(
        source_name_, 0, 0, std::move(cause),
        "give its tools numbers and diameters, or write them as CSV: number, diameter_mm, corner_mm, flutes");
}

std::optional<double> quantity_of(std::string_view text, double unit_mm) {
    const std::string plain = folded(trimmed(text));
    for (const TextToken& token : tokens_of(plain)) {
        if (!token.is_number()) continue;
        const double unit = token.is_angle ? 1 : token.unit_mm > 0 ? token.unit_mm : unit_mm;
        const double value = token.value * unit;
        return plain.starts_with('-') ? -value : value;
    }
    return std::nullopt;
}

}  // namespace tribo::readers
