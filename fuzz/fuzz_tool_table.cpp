// SPDX-License-Identifier: MIT
// Any bytes give tools within their ranges, which survive being written as a table and read, or an error with
// a remedy.
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <set>
#include <string>
#include <string_view>

#include "base/limits.hpp"
#include "base/text/decimal.hpp"
#include "readers/tables/tool_table.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace tribo;
    constexpr std::size_t largest = 1 << 17;
    if (size > largest) return 0;
    const std::string_view bytes{reinterpret_cast<const char*>(data), size};
    for (const readers::LengthUnit unit : {readers::LengthUnit::millimetre, readers::LengthUnit::inch}) {
        const auto table = readers::read_tool_table(bytes, {.source_name = "fuzz.tbl", .unit = unit});
        if (!table) {
            if (table.error().cause.empty() || table.error().remedy.empty()) std::abort();
            continue;
        }
        if (table->tools.empty()) std::abort();
        std::set<int> numbers;
        bool has_numbers = true;
        std::string text = "number,diameter_mm,corner_mm,flutes,length_mm\n";
        for (const motion::DeclaredTool& tool : table->tools) {
            // A library without numbers gives one tool, which stands for every number.
            const bool has_number = kLimits.tool_number.range.contains(tool.number);
            if (!has_number && (tool.number != 0 || table->tools.size() != 1)) std::abort();
            if (!numbers.insert(tool.number).second) std::abort();
            has_numbers = has_numbers && has_number;
            if (tool.diameter_mm != 0 && !kLimits.cutter_diameter.range.contains(tool.diameter_mm))
                std::abort();
            if (!(tool.corner_mm >= 0 && 2 * tool.corner_mm <= tool.diameter_mm)) std::abort();
            if (tool.flutes < 0 || tool.flutes > 64) std::abort();
            if (tool.length_mm && !kLimits.tool_length.range.contains(*tool.length_mm)) std::abort();
            text += std::to_string(tool.number) + ',' + format_decimal(tool.diameter_mm) + ',' +
                    format_decimal(tool.corner_mm) + ',' +
                    (tool.flutes > 0 ? std::to_string(tool.flutes) : "") + ',' +
                    (tool.length_mm ? format_decimal(*tool.length_mm) : "") + '\n';
        }
        if (!has_numbers) continue;
        const auto again = readers::read_tool_table(text, {.source_name = "again.csv"});
        if (!again || again->tools.size() != table->tools.size()) std::abort();
        for (std::size_t n = 0; n < again->tools.size(); ++n) {
            const motion::DeclaredTool &a = table->tools[n], &b = again->tools[n];
            if (a.number != b.number || a.diameter_mm != b.diameter_mm || a.corner_mm != b.corner_mm ||
                a.flutes != b.flutes || a.length_mm != b.length_mm)
                std::abort();
        }
    }
    return 0;
}
