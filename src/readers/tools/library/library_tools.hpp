// SPDX-License-Identifier: MIT
// Collects the tools of a library of a CAM system into a tool table, and says which of them cannot be used.
// Any thread; allocates.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <string_view>

#include "readers/tables/tool_table.hpp"
#include "readers/tools/declared_tool.hpp"

namespace tribo::readers {

// One entry. Lengths in mm.
struct LibraryTool {
    std::optional<int> number;  // by which a program calls it; none: the library states none
    std::string name;           // for messages
    std::string type;           // as the library writes it; decides the shape where `sizes` has none
    int line = 0;
    ToolSizes sizes;
    std::optional<double> length_mm;  // from the spindle nose to the tip
    double stickout_mm = 0, shank_mm = 0;
    std::vector<motion::DeclaredStep> holder;  // from its face up
};

class LibraryTools {
  public:
    explicit LibraryTools(std::string source_name) : source_name_(std::move(source_name)) {}

    void add(LibraryTool tool);
    void warn(int line, std::string text);
    // Refuses a library without a usable tool.
    Result<ToolTable> finish() const;

  private:
    std::string source_name_;
    ToolTable table_;
    std::map<int, std::size_t> index_;  // of a number in the table
    std::optional<motion::DeclaredTool> unnumbered_;
    int unnumbered_count_ = 0, entries_ = 0;
};

// Reads the first number of a text: 6, "6.00 mm", "0.25 in", "6,5", "90 deg". Without a unit of its own a
// length is in `unit_mm`. None if there is no number.
std::optional<double> quantity_of(std::string_view text, double unit_mm);

}  // namespace tribo::readers
