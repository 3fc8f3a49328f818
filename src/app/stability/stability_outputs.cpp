// SPDX-License-Identifier: MIT
#include "app/stability/stability_outputs.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdio>

#include "app/exit.hpp"
#include "app/interrupt.hpp"
#include "app/progress.hpp"
#include "app/stability/stability_words.hpp"
#include "base/math.hpp"
#include "base/text/printable.hpp"
#include "files/image/png.hpp"
#include "files/json/json.hpp"
#include "report/stability_picture.hpp"

namespace tribo::app {
namespace {

const char* name_of(dynamics::ChatterKind kind) {
    switch (kind) {
        case dynamics::ChatterKind::stable:
            return "stable";
        case dynamics::ChatterKind::quasi_periodic:
            return "quasi-periodic";
        case dynamics::ChatterKind::period_doubling:
            return "period-doubling";
    }
    return "";
}

// Nine significant digits.
double nine(double value) {
    char text[40];
    std::snprintf(text, sizeof text, "%.9g", value);
    double rounded = value;
    std::from_chars(text, text + sizeof text, rounded);
    return rounded;
}

files::Json json_of(const StabilityPoint& p) {
    const dynamics::Stability& s = p.stability;
    files::Json json = {{"spindle_rpm", nine(p.spindle_rpm)},
                        {"axial_depth_mm", nine(p.axial_depth_mm)},
                        {"multiplier", nine(s.multiplier)},
                        {"period_s", nine(s.period_s)},
                        {"angle_rad", nine(s.angle_rad)},
                        {"chatter_hz", nine(s.chatter_hz)},
                        {"kind", name_of(s.kind)}};
    files::set(json, "probability", p.probability);
    return json;
}

files::Json json_of(double spindle_rpm, const dynamics::DepthLimit& limit) {
    files::Json json;
    json["spindle_rpm"] = nine(spindle_rpm);
    json["limit_mm"] = limit.depth_mm ? files::Json(nine(*limit.depth_mm)) : files::Json();
    json["chatter_hz"] = nine(limit.there.chatter_hz);
    json["kind"] = name_of(limit.there.kind);
    return json;
}

files::Json modes_json(const session::SteadyCut& cut) {
    files::Json modes = files::Json::array();
    for (const dynamics::Mode& m : cut.modes) {
        files::Json mode = {{"direction", files::triple(m.direction)},
                            {"on", m.on == dynamics::ModeOn::part ? "part" : "tool"},
                            {"frequency_hz", nine(m.frequency_hz)},
                            {"damping_ratio", nine(m.damping_ratio)},
                            {"stiffness_n_per_mm", nine(m.stiffness_n_per_mm)}};
        if (m.estimated) mode["from"] = "estimate";
        const auto set_spread = [&](const char* key, double spread) {
            if (spread > 0) mode[key] = nine(spread);
        };
        set_spread("frequency_spread", m.spread.frequency);
        set_spread("damping_spread", m.spread.damping);
        set_spread("stiffness_spread", m.spread.stiffness);
        modes.push_back(std::move(mode));
    }
    return modes;
}

files::Json frfs_json(const StabilityAnswer& answer) {
    files::Json frfs = files::Json::array();
    for (const job::JobFrf& frf : answer.frfs) {
        frfs.push_back({{"file", frf.file},
                        {"direction", files::triple(frf.direction)},
                        {"on", frf.on == dynamics::ModeOn::part ? "part" : "tool"},
                        {"band_hz", {nine(frf.fit->from_hz), nine(frf.fit->to_hz)}},
                        {"points", frf.fit->points},
                        {"modes", frf.fit->modes.size()},
                        {"residual", nine(frf.fit->residual)}});
    }
    return frfs;
}

files::Json engagement_json(const session::SteadyCut& cut) {
    files::Json json;
    json["from"] = cut.t_s ? "program" : "[engagement]";
    if (cut.line > 0) json["line"] = cut.line;
    if (cut.t_s) json["t_s"] = nine(*cut.t_s);
    if (cut.rows > 0) json["rows"] = cut.rows;
    json["entry_deg"] = nine(cut.entry_rad() * math::kDegPerRad);
    json["exit_deg"] = nine(cut.exit_rad() * math::kDegPerRad);
    json["axial_depth_mm"] = nine(cut.axial_depth_mm);
    json["bands"] = cut.bands.size();
    if (cut.force_low_factor != cut.force_high_factor)
        json["force_band"] = {nine(cut.force_low_factor), nine(cut.force_high_factor)};
    return json;
}

// Where the engagement is from: for people.
std::string source_of(const StabilityCall& call, const session::SteadyCut& cut) {
    if (!cut.t_s) return "[engagement] of the job";
    char text[120];
    std::snprintf(text, sizeof text, "line %d of the program at %.6g s", cut.line, *cut.t_s);
    std::string all = text;
    if (cut.rows > 1)
        all += ", the most critical of " + std::to_string(cut.rows) + " rows" +
               (call.place.line ? " of that line" : "");
    return all;
}

void add_chart(const session::SteadyCut& cut, const ComputedChart& computed, files::Json& json) {
    const dynamics::ChartRange& r = computed.range;
    json["advice"] = in_words(cut, computed.chart, computed.advice);
    files::set(json, "nearest_stable_rpm", computed.advice.nearest_rpm);
    files::set(json, "safe_mm", computed.advice.safe_mm);
    json["chart"] = {{"from_rpm", nine(r.from_rpm)},
                     {"to_rpm", nine(r.to_rpm)},
                     {"step_rpm", nine(r.step_rpm)},
                     {"most_mm", nine(r.most_mm)},
                     {"step_mm", nine(r.step_mm)}};
    json["pockets"] = files::Json::array();
    for (const dynamics::SafePocket& p : computed.advice.pockets) {
        json["pockets"].push_back(
            {{"spindle_rpm", nine(p.spindle_rpm)}, {"depth_mm", nine(p.depth_mm)}, {"deeper", p.deeper}});
    }
}

std::string points_csv(const dynamics::StabilityChart& chart) {
    const bool has_spread = !chart.probability.empty();
    std::string text = "spindle_rpm,axial_depth_mm,multiplier,chatter_hz,kind";
    text += has_spread ? ",probability\n" : "\n";
    char line[160];
    for (std::size_t s = 0; s < chart.speeds_rpm.size(); ++s) {
        for (std::size_t d = 0; d < chart.depths_mm.size(); ++d) {
            const dynamics::Stability& p = chart.at(s, d);
            std::snprintf(line, sizeof line, "%.9g,%.9g,%.9g,%.9g,%s", chart.speeds_rpm[s],
                          chart.depths_mm[d], p.multiplier, p.chatter_hz, name_of(p.kind));
            text += line;
            if (has_spread) {
                std::snprintf(line, sizeof line, ",%.9g", chart.probability[s * chart.depths_mm.size() + d]);
                text += line;
            }
            text += '\n';
        }
    }
    return text;
}

// Without a limit down to the last depth of the chart the field is empty.
std::string limits_csv(const dynamics::StabilityChart& chart) {
    std::string text = "spindle_rpm,limit_mm,chatter_hz,kind\n";
    char line[160], depth[40];
    for (std::size_t s = 0; s < chart.speeds_rpm.size(); ++s) {
        const dynamics::DepthLimit& limit = chart.limits[s];
        depth[0] = 0;
        if (limit.depth_mm) std::snprintf(depth, sizeof depth, "%.9g", *limit.depth_mm);
        std::snprintf(line, sizeof line, "%.9g,%s,%.9g,%s\n", chart.speeds_rpm[s], depth,
                      limit.there.chatter_hz, name_of(limit.there.kind));
        text += line;
    }
    return text;
}

files::Json simulation_json(const session::Simulation& simulation, const StabilityAnswer& answer) {
    files::Json json = {{"spindle_rpm", nine(simulation.spindle_rpm)},
                        {"axial_depth_mm", nine(simulation.axial_depth_mm)},
                        {"turns", simulation.turns},
                        {"feed_per_tooth_mm", nine(answer.cut.feed_per_tooth_mm)},
                        {"rate_hz", session::kVibrationHz},
                        {"largest_displacement_mm", nine(answer.simulated->displacement_mm)},
                        {"largest_force_n", nine(answer.simulated->force_n)}};
    files::set(json, "ended_s", answer.simulated->ended_s);
    return json;
}

std::string summary_json(const StabilityCall& call, const StabilityAnswer& answer) {
    const session::SteadyCut& cut = answer.cut;
    files::Json json;
    json["schema"] = "tribo.stability-summary/1";
    json["version"] = TRIBO_VERSION;
    json["job"] = call.job;
    json["engagement"] = engagement_json(cut);
    if (answer.chart) {
        const session::Advice& advice = answer.chart->advice;
        json["point"] =
            json_of(StabilityPoint{cut.spindle_rpm, cut.axial_depth_mm, advice.here, advice.probability});
        json["limit"] = json_of(cut.spindle_rpm, advice.limit);
        add_chart(answer.cut, *answer.chart, json);
    }
    if (answer.simulated) json["simulation"] = simulation_json(*call.simulation, answer);
    json["modes"] = modes_json(cut);
    if (!answer.frfs.empty()) json["frf"] = frfs_json(answer);
    json["warnings"] = files::Json::array();
    for (const Warning& w : answer.warnings) json["warnings"].push_back(w.message());
    return files::pretty(json);
}

constexpr std::array<const char*, 4> kChartFiles{"stability.csv", "limits.csv", "stability.svg",
                                                 "stability.png"};
constexpr const char *kVibration = "vibration.csv", *kSummary = "summary.json";

// Nine significant digits, and a comma or a line end.
void append(std::string& line, double value, char end) {
    char text[40];
    const auto done = std::to_chars(text, text + sizeof text, value, std::chars_format::general, 9);
    line.append(text, done.ptr);
    line += end;
}

}  // namespace

std::string stability_json(const StabilityCall& call, const StabilityAnswer& answer) {
    files::Json json;
    json["schema"] = "tribo.stability/1";
    json["points"] = files::Json::array();
    for (const StabilityPoint& p : answer.points) json["points"].push_back(json_of(p));
    json["limits"] = files::Json::array();
    for (const StabilityLimit& l : answer.limits) {
        json["limits"].push_back(json_of(l.spindle_rpm, l.limit));
        if (l.band_mm) json["limits"].back()["limit_mm_band"] = {nine(l.band_mm->low), nine(l.band_mm->high)};
    }
    if (call.uncertain) json["uncertain_cases"] = *call.uncertain;
    json["engagement"] = engagement_json(answer.cut);
    if (answer.chart) add_chart(answer.cut, *answer.chart, json);
    if (answer.simulated) json["simulation"] = simulation_json(*call.simulation, answer);
    json["modes"] = modes_json(answer.cut);
    if (!answer.frfs.empty()) json["frf"] = frfs_json(answer);
    return files::pretty(json);
}

void print(const StabilityCall& call, const StabilityAnswer& answer) {
    const session::SteadyCut& cut = answer.cut;
    std::printf("cut: %s; %.4g mm deep, engaged from %.4g to %.4g deg, %g rpm\n",
                source_of(call, cut).c_str(), cut.axial_depth_mm, cut.entry_rad() * math::kDegPerRad,
                cut.exit_rad() * math::kDegPerRad, cut.spindle_rpm);
    if (is_estimated(cut))
        std::printf("modes of the tool: estimated, not measured (see the warning for their band)\n");
    for (const job::JobFrf& frf : answer.frfs) {
        const std::size_t count = frf.fit->modes.size();
        std::printf("frf: %s, %.6g to %.6g Hz: %zu %s, residual %.2g %%\n", printable(frf.file).c_str(),
                    frf.fit->from_hz, frf.fit->to_hz, count, count == 1 ? "mode" : "modes",
                    100 * frf.fit->residual);
    }
    for (const StabilityPoint& p : answer.points) {
        const dynamics::Stability& s = p.stability;
        std::printf("%g rpm, %g mm: ", p.spindle_rpm, p.axial_depth_mm);
        if (s.kind == dynamics::ChatterKind::stable) {
            std::printf("stable; a vibration keeps %.4g of its size in each %.4g ms\n", s.multiplier,
                        1e3 * s.period_s);
        } else {
            std::printf("chatter at %.1f Hz (%s); a vibration grows by %.4g in each %.4g ms\n", s.chatter_hz,
                        name_of(s.kind), s.multiplier, 1e3 * s.period_s);
        }
        if (p.probability)
            std::printf("  within the band it chatters in %s\n", cases_in_words(*p.probability).c_str());
    }
    for (const StabilityLimit& l : answer.limits) {
        if (l.limit.depth_mm) {
            std::printf("%g rpm: stable up to %.4g mm deep, then %.1f Hz (%s)\n", l.spindle_rpm,
                        *l.limit.depth_mm, l.limit.there.chatter_hz, name_of(l.limit.there.kind));
        } else {
            std::printf("%g rpm: stable along the whole edge of %g mm\n", l.spindle_rpm,
                        answer.cut.cutter.length_mm);
        }
        if (l.band_mm)
            std::printf("  in 9 of 10 of %d cases up to %.4g to %.4g mm\n", *call.uncertain, l.band_mm->low,
                        l.band_mm->high);
    }
    if (answer.simulated) {
        std::printf(
            "simulated: %d turns at %g rpm and %g mm, %.4g mm per tooth: displaced by at most %.4g mm, "
            "force at most %.4g N\n",
            call.simulation->turns, call.simulation->spindle_rpm, call.simulation->axial_depth_mm,
            cut.feed_per_tooth_mm, answer.simulated->displacement_mm, answer.simulated->force_n);
    }
    if (!answer.chart) return;
    const dynamics::ChartRange& r = answer.chart->range;
    std::printf("chart: %g to %g rpm in steps of %g rpm%s, to %g mm in steps of %g mm%s\n", r.from_rpm,
                r.to_rpm, r.step_rpm, call.speeds ? "" : " (--rpm asks for others)", r.most_mm, r.step_mm,
                call.depths ? "" : " (--depth asks for others)");
    std::printf("advice: %s\n", in_words(cut, answer.chart->chart, answer.chart->advice).c_str());
}

bool is_stability_file(const std::string& name) {
    return name == kVibration || name == kSummary ||
           std::find(kChartFiles.begin(), kChartFiles.end(), name) != kChartFiles.end();
}

FileResult<void> write_vibration(const StabilityCall& call, StabilityAnswer& answer,
                                 const files::OutputFolder& folder) {
    const session::Simulation& simulation = *call.simulation;
    auto file = files::FileWriter::create(folder.file(kVibration));
    if (!file) return std::unexpected(file.error());
    file->write("t_s,x_mm,y_mm,z_mm,fx_n,fy_n,fz_n\n");
    Progress progress;
    std::string line;
    answer.simulated = session::simulate(
        answer.cut, simulation, [&](std::size_t n, const dynamics::VibrationSample& sample) {
            const double t_s = static_cast<double>(n) / session::kVibrationHz;
            const Vec3 r = sample.displacement_mm, f = sample.force_n;
            line.clear();
            for (const double value : {t_s, r.x, r.y, r.z, f.x, f.y}) append(line, value, ',');
            append(line, f.z, '\n');
            file->write(line);
            progress.update("vibration", t_s / simulation.lasts_s());
            return !interrupted();
        });
    if (answer.simulated->ended_s) {
        char cause[160];
        std::snprintf(
            cause, sizeof cause,
            "the simulation ends at %.4g s: the tool moves by more than a tenth of its diameter, and "
            "there the equations no longer hold",
            *answer.simulated->ended_s);
        answer.warnings.push_back({call.job, 0, cause});
        report(Warnings{answer.warnings.back()});
    }
    return file->finish();
}

FileResult<void> write_files(const StabilityCall& call, const StabilityAnswer& answer,
                             const files::OutputFolder& folder) {
    if (answer.chart) {
        const session::SteadyCut& cut = answer.cut;
        const report::Drawing drawing = report::draw_stability(
            answer.chart->chart,
            {chart_title(cut), cut.spindle_rpm, cut.axial_depth_mm, answer.chart->advice.here.multiplier <= 1,
             answer.chart->advice.probability});
        const std::array<std::string, kChartFiles.size()> texts{
            points_csv(answer.chart->chart), limits_csv(answer.chart->chart), report::svg_of(drawing),
            files::png_bytes(report::image_of(drawing))};
        for (std::size_t n = 0; n < kChartFiles.size(); ++n)
            if (auto done = files::write_file(folder.file(kChartFiles[n]), texts[n]); !done) return done;
    }
    return files::write_file(folder.file(kSummary), summary_json(call, answer));
}

}  // namespace tribo::app
