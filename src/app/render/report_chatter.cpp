// SPDX-License-Identifier: MIT
#include "app/render/report_chatter.hpp"

#include <cstdio>

#include "app/stability/stability_words.hpp"
#include "report/stability_picture.hpp"
#include "session/chatter/probability.hpp"
#include "session/chatter/simulated_cut.hpp"

namespace tribo::app {
namespace {

constexpr double kLastsS = 0.2;    // of the vibration
constexpr std::size_t kEvery = 3;  // of its samples is shown: 16 kHz
constexpr double kCoarser = 2;     // than the chart of tribo stability

}  // namespace

report::ReportChatter report_chatter(const session::ProgramChatter& chatter, const session::MillSetup& setup,
                                     const ParallelFor& parallel) {
    report::ReportChatter shown;
    const milling::CutRow* worst = chatter.worst();
    if (worst == nullptr) {
        shown.advice = "No multiplier is known in any row (see the warnings).";
        return shown;
    }
    const session::SteadyCut cut = session::steady_cut_of(*worst, setup, session::kRowBands);
    char text[160];
    std::snprintf(text, sizeof text, "Line %d at %.5g s: ", cut.line, *cut.t_s);
    shown.advice = text;
    if (cut.spindle_rpm < cut.least_rpm(cut.cutter.length_mm)) {
        shown.advice += "the spindle is too slow for a chart.";
    } else {
        dynamics::ChartRange range = session::default_speeds(cut);
        session::add_default_depths(cut, range);
        range.step_rpm *= kCoarser;
        range.step_mm *= kCoarser;
        dynamics::StabilityChart chart = dynamics::stability_chart(
            range, [&](double rpm, double depth_mm) { return cut.at(rpm, depth_mm); }, parallel);
        session::add_probability(cut, chart, parallel, {}, session::kFewCases);
        const session::Advice advice = session::advise(cut, chart, parallel);
        shown.advice += in_words(cut, chart, advice);
        shown.chart_svg = report::svg_of(
            report::draw_stability(chart, {chart_title(cut), cut.spindle_rpm, cut.axial_depth_mm,
                                           advice.here.multiplier <= 1, advice.probability}));
    }
    std::snprintf(text, sizeof text,
                  "The tool against the part in this cut, from rest: line %d, %.6g rpm, %.4g mm deep",
                  cut.line, cut.spindle_rpm, cut.axial_depth_mm);
    shown.label = text;
    shown.rate_hz = session::kVibrationHz / kEvery;
    const int turns = std::max(1, static_cast<int>(kLastsS * cut.spindle_rpm / 60));
    session::simulate(cut, {cut.spindle_rpm, cut.axial_depth_mm, turns},
                      [&](std::size_t n, const dynamics::VibrationSample& sample) {
                          if (n % kEvery == 0)
                              shown.displacement_mm.emplace_back(
                                  static_cast<float>(sample.displacement_mm.x),
                                  static_cast<float>(sample.displacement_mm.y));
                          return static_cast<double>(n) < kLastsS * session::kVibrationHz;
                      });
    return shown;
}

}  // namespace tribo::app
