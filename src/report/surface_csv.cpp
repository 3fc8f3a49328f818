// SPDX-License-Identifier: MIT
#include "report/surface_csv.hpp"

#include <cmath>

#include "readers/text/decimal_text.hpp"

namespace tribo::report {
namespace {

constexpr int kDecimals = 6, kNormalDecimals = 4;

void append(std::string& csv, Vec3 value, int decimals) {
    for (int k = 0; k < 3; ++k) {
        csv += ',';
        readers::append_fixed(csv, value[k], decimals);
    }
}

}  // namespace

std::string surface_csv_header() {
    return "t_s,line,x_mm,y_mm,z_mm,nx,ny,nz,displaced_mm,left_mm\n";
}

void append_surface_rows(std::string& csv, const surface::ToothTrace& trace,
                         const surface::ToothTraces& traces) {
    for (std::size_t n = trace.first; n < trace.first + trace.count; ++n) {
        const surface::ToothMark& mark = traces.marks[n];
        const double at = double{mark.at};
        readers::append_fixed(csv, std::lerp(trace.start_s, trace.end_s, at), kDecimals);
        csv += ',';
        csv += std::to_string(trace.line);
        append(csv, lerp(trace.from_mm, trace.to_mm, at), kDecimals);
        append(csv, trace.normal, kNormalDecimals);
        for (const float error : {mark.displaced_mm, mark.left_mm}) {
            csv += ',';
            readers::append_fixed(csv, double{error}, kDecimals);
        }
        csv += '\n';
    }
}

}  // namespace tribo::report
