// SPDX-License-Identifier: MIT
// report.html: one file that opens offline and shows a render: the part in 3D, figures, warnings, force along
// the program and along the path, one turn of the spindle with its spectrum, chatter along the program and at
// its worst place, the sound and its waveforms, and the assumptions. Text, style and script of the page are
// in page/ and are built in; the scripts are made from web/report/.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "base/vec3.hpp"
#include "report/html_parts.hpp"
#include "report/report_part.hpp"
#include "report/summary_json.hpp"

namespace tribo::report {

// One piece of the cut.
struct ReportRow {
    double t_s = 0, duration_s = 0;
    int line = 0;
    Vec3 tip_mm;
    double mean_n = 0, peak_n = 0;           // |mean force| over a turn, largest |F| in a turn
    double peak_low_n = 0, peak_high_n = 0;  // the latter as it may be in truth
    double entry_deg = 0, exit_deg = 0, depth_mm = 0;
    double rpm = 0, feed_mm_per_min = 0;
    // Of a job with modes; a multiplier of 0 is unknown.
    double multiplier = 0, displacement_mm = 0;
    std::size_t cutter = 0;
};

// Chatter of a job with modes: its worst place.
struct ReportChatter {
    std::string advice;     // a sentence
    std::string chart_svg;  // of stable speeds and depths there; empty: none
    // The vibration of that cut from rest, in the plane across the axis: x along the feed.
    std::string label;
    double rate_hz = 48000;
    std::vector<std::pair<float, float>> displacement_mm;
};

// The turn with the largest force.
struct ReportTurn {
    double t_s = 0, rpm = 0;
    int line = 0;
    std::vector<Vec3> force_n;  // at equal steps over 360 degrees, without the end point
    std::vector<std::pair<double, double>> spectrum;  // Hz and N, ascending
};

// A piece of sound pressure, short enough to see its shape.
struct ReportWave {
    std::string label;
    double rate_hz = 48000;
    std::vector<float> pascal;
};

struct ReportSound {
    double seconds = 0;                                    // of the whole sound
    std::vector<std::pair<float, float>> envelope_pascal;  // minimum and maximum in equal steps, whole sound
    std::vector<ReportWave> waves;                         // two, as in figure 8 of the paper
    // Sound played by the page: from heard_from_s on, interleaved stereo samples, full scale 1, at most
    // kReportSoundS (the rest is left out).
    double heard_from_s = 0, rate_hz = 48000;
    std::vector<float> stereo;
};
inline constexpr double kReportSoundS = 10;  // 2.6 MB of the 5 MB limit of the page

struct ReportData {
    std::string title, subtitle;
    Summary summary;
    std::string picture_png;         // bytes of a PNG; empty: no picture
    std::optional<ReportPart> part;  // shown in 3D instead of the picture, if the browser can
    std::vector<ReportRow> rows;     // in the order of time
    std::optional<ReportTurn> turn;
    std::optional<ReportSound> sound;
    std::optional<ReportChatter> chatter;                    // if the job has modes
    std::vector<std::pair<std::string, std::string>> facts;  // basis of the results: name, text
    std::vector<ReportRow> worst;                            // worst_lines() of all rows
    std::vector<HtmlTable> sheet;                            // set-up, tools, files
};

// Returns at most `most` rows. Neighbours without a gap are joined; a joined row has the position of the
// largest force and the mean over time.
std::vector<ReportRow> thin_rows(const std::vector<ReportRow>& rows, std::size_t most);

// The lines with the largest forces, the largest first: at most kWorstLines, each at its worst row.
inline constexpr std::size_t kWorstLines = 10;
std::vector<ReportRow> worst_lines(const std::vector<ReportRow>& rows);

// Returns the whole page.
std::string report_html(const ReportData& data);

}  // namespace tribo::report
