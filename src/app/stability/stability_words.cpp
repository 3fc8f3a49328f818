// SPDX-License-Identifier: MIT
#include "app/stability/stability_words.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "base/math.hpp"

namespace tribo::app {
namespace {

// Three digits, never more than the value.
double rounded_down(double value) {
    const double digit = std::pow(10.0, std::floor(std::log10(value)) - 2);
    return digit * std::floor(value / digit + 1e-9);
}

template <class... Values>
std::string words(const char* format, Values... values) {
    char text[200];
    std::snprintf(text, sizeof text, format, values...);
    return text;
}

}  // namespace

std::string in_words(const session::SteadyCut& cut, const dynamics::StabilityChart& chart,
                     const session::Advice& a) {
    const double rpm = cut.spindle_rpm, depth = cut.axial_depth_mm;
    std::string text;
    if (a.here.multiplier <= 1) {
        text = words("%.6g rpm and %.4g mm are stable", rpm, depth);
        text += a.limit.depth_mm
                    ? words("; at this speed the cut stays stable down to %.4g mm",
                            rounded_down(*a.limit.depth_mm))
                    : words("; at this speed the whole edge of %.4g mm is stable", cut.cutter.length_mm);
    } else {
        text = words("%.6g rpm and %.4g mm chatter at %.1f Hz; ", rpm, depth, a.here.chatter_hz);
        const char* how = a.probability ? " in nine of ten cases" : "";
        text += a.nearest_rpm ? words("nearest stable speed at this depth%s: %.6g rpm", how, *a.nearest_rpm)
                              : words("no speed from %.6g to %.6g rpm is stable at this depth%s",
                                      chart.speeds_rpm.front(), chart.speeds_rpm.back(), how);
        if (a.limit.depth_mm)
            text += words("; largest stable depth at this speed: %.4g mm", rounded_down(*a.limit.depth_mm));
    }
    if (a.probability) {
        text += "; within the band of modes and forces it chatters in " + cases_in_words(*a.probability);
        const double safe = a.safe_mm.value_or(0);
        text += safe > 0 ? words(", and %.4g mm at this speed in no more than 1 of 10", safe)
                         : ", and no depth of the chart is stable at this speed in nine of ten";
    }
    if (a.pockets.empty()) return text + ".";
    const dynamics::SafePocket& best = a.pockets.front();
    return text + words("; deepest pocket of the chart: %.6g rpm, %.4g mm%s.", best.spindle_rpm,
                        rounded_down(best.depth_mm), best.deeper ? " or more" : "");
}

std::string cases_in_words(double probability) {
    if (probability == 0) return "no case";
    if (probability == 1) return "all cases";
    const int tenths = static_cast<int>(std::lround(10 * probability));
    if (tenths == 0) return "less than 1 of 10 cases";
    return tenths == 10 ? "more than 9 of 10 cases" : words("%d of 10 cases", tenths);
}

bool is_estimated(const session::SteadyCut& cut) {
    return std::ranges::any_of(cut.modes, &dynamics::Mode::estimated);
}

std::string chart_title(const session::SteadyCut& cut) {
    return words("Stable depths: %.4g mm cutter, %d %s, engaged from %.4g to %.4g deg%s",
                 cut.cutter.diameter_mm, cut.cutter.flutes, cut.cutter.flutes == 1 ? "tooth" : "teeth",
                 cut.entry_rad() * math::kDegPerRad, cut.exit_rad() * math::kDegPerRad,
                 is_estimated(cut) ? "; modes estimated" : "");
}

}  // namespace tribo::app
