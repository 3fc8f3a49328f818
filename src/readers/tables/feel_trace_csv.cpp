// SPDX-License-Identifier: MIT
#include "readers/tables/feel_trace_csv.hpp"

#include "readers/text/decimal_text.hpp"

namespace tribo::readers {

void append_feel_trace_row(std::string& csv, const FeelTraceRow& row) {
    constexpr int decimals = 6;
    const auto [p, f] = std::pair(row.position_mm, row.force_n);
    append_fixed(csv, row.t_s, decimals);
    for (const double value : {p.x, p.y, p.z, f.x, f.y, f.z}) {
        csv += ',';
        append_fixed(csv, value, decimals);
    }
    csv += row.contact ? ",1\n" : ",0\n";
}

}  // namespace tribo::readers
