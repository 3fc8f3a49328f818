// SPDX-License-Identifier: MIT
// report.html: one file that opens offline and shows a render: the part in 3D, figures, warnings, force along
// the program and along the path, one turn of the spindle with its spectrum, the sound and its waveforms, and
// what it all rests on. The page's own text, style and script stand in page/ and are built in; the scripts
// are made of web/report/.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "base/vec3.hpp"
#include "report/report_part.hpp"
#include "report/summary_json.hpp"

namespace tribo::report {

// One stretch of the cut.
struct ReportRow {
    double t_s = 0, duration_s = 0;
    int line = 0;
    Vec3 tip_mm;
    double mean_n = 0, peak_n = 0;  // |mean force| over a turn, largest |F| in a turn
    double entry_deg = 0, exit_deg = 0, depth_mm = 0;
    double rpm = 0, feed_mm_per_min = 0;
};

// The turn with the largest force.
struct ReportTurn {
    double t_s = 0, rpm = 0;
    int line = 0;
    std::vector<Vec3> force_n;                        // at equal steps over 360 degrees, without the end
    std::vector<std::pair<double, double>> spectrum;  // Hz and N, rising
};

// A stretch of sound pressure, short enough to see its form.
struct ReportWave {
    std::string label;
    double rate_hz = 48000;
    std::vector<float> pascal;
};

struct ReportSound {
    double seconds = 0;                                    // of the whole sound
    std::vector<std::pair<float, float>> envelope_pascal;  // least and largest in equal steps over the whole
    std::vector<ReportWave> waves;                         // as the paper's figure 8: two
    // What the page plays: the stretch from heard_from_s, stereo samples in turn, full scale 1, at most
    // kReportSoundS of it (the rest is left out).
    double heard_from_s = 0, rate_hz = 48000;
    std::vector<float> stereo;
};
inline constexpr double kReportSoundS = 10;  // 2.6 MB of the 5 that the page may weigh

struct ReportData {
    std::string title, subtitle;
    Summary summary;
    std::string picture_png;         // bytes of a PNG; empty: no picture
    std::optional<ReportPart> part;  // shown in 3D in the picture's place, where the browser can
    std::vector<ReportRow> rows;     // in the order of time
    std::optional<ReportTurn> turn;
    std::optional<ReportSound> sound;
    std::vector<std::pair<std::string, std::string>> facts;  // what it rests on: name, text
};

// At most `most` rows: neighbours without a gap between them are joined; the joined row keeps the place of
// the largest force and means the mean over time.
std::vector<ReportRow> thin_rows(const std::vector<ReportRow>& rows, std::size_t most);

// The whole page.
std::string report_html(const ReportData& data);

}  // namespace tribo::report
