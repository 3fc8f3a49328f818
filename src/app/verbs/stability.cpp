// SPDX-License-Identifier: MIT
// `tribo stability JOB`: will it chatter, and at which depth does it begin.
#include <charconv>
#include <cstdio>
#include <memory>
#include <string>
#include <vector>

#include "app/exit.hpp"
#include "app/interrupt.hpp"
#include "app/options.hpp"
#include "app/verbs/verbs.hpp"
#include "base/math.hpp"
#include "base/text/printable.hpp"
#include "files/disk_source.hpp"
#include "files/json/json.hpp"
#include "files/machine_limits.hpp"
#include "job/loader.hpp"
#include "job/toml/job_toml.hpp"
#include "session/chatter/steady_cut.hpp"

namespace tribo::app {
namespace {

struct Call {
    std::string job;
    std::vector<std::string> at;
    std::vector<double> limit;
    bool json = false;
};

struct Point {
    double spindle_rpm = 0, axial_depth_mm = 0;
    dynamics::Stability stability;
};

struct Border {
    double spindle_rpm = 0;
    dynamics::DepthLimit limit;
};

struct Answer {
    session::SteadyCut cut;
    Warnings warnings;
    std::vector<Point> points;
    std::vector<Border> limits;
};

bool read_number(std::string_view text, const Limit& limit, double& value) {
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    return error == std::errc() && end == text.data() + text.size() && limit.range.contains(value);
}

// RPM:MM. Returns false if it is none, or a number is out of its range.
bool read_point(const std::string& text, Point& point) {
    const std::size_t colon = text.find(':');
    return colon != text.npos &&
           read_number({text.data(), colon}, kLimits.spindle_speed, point.spindle_rpm) &&
           read_number(std::string_view(text).substr(colon + 1), kLimits.axial_depth, point.axial_depth_mm);
}

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

FileResult<Answer> compute(const Call& call) {
    const files::DiskSource disk;
    auto job = job::read_job(disk, call.job);
    if (!job) return std::unexpected(job.error());
    auto program = job::read_and_complete(disk, *job, files::machine_limits());
    if (!program) return std::unexpected(program.error());
    Answer answer;
    answer.warnings = program->warnings;
    auto cut = session::steady_cut(*job, *program, answer.warnings);
    if (!cut) return std::unexpected(FileFailure(cut.error()));
    answer.cut = *std::move(cut);
    std::vector<double> speeds = call.limit;
    for (const std::string& text : call.at) {
        Point& point = answer.points.emplace_back();
        read_point(text, point);  // checked as a flag
    }
    if (call.at.empty() && call.limit.empty()) {
        answer.points.push_back({answer.cut.spindle_rpm, answer.cut.axial_depth_mm, {}});
        speeds.push_back(answer.cut.spindle_rpm);
    }
    for (Point& point : answer.points)
        point.stability = answer.cut.at(point.spindle_rpm, point.axial_depth_mm);
    for (const double rpm : speeds) {
        if (interrupted()) break;
        answer.limits.push_back({rpm, answer.cut.limit(rpm)});
    }
    return answer;
}

// Nine significant digits.
double nine(double value) {
    char text[40];
    std::snprintf(text, sizeof text, "%.9g", value);
    double rounded = value;
    std::from_chars(text, text + sizeof text, rounded);
    return rounded;
}

std::string json_of(const Answer& answer) {
    files::Json json;
    json["schema"] = "tribo.stability/1";
    json["points"] = files::Json::array();
    for (const Point& p : answer.points) {
        const dynamics::Stability& s = p.stability;
        json["points"].push_back({{"spindle_rpm", nine(p.spindle_rpm)},
                                  {"axial_depth_mm", nine(p.axial_depth_mm)},
                                  {"multiplier", nine(s.multiplier)},
                                  {"period_s", nine(s.period_s)},
                                  {"angle_rad", nine(s.angle_rad)},
                                  {"chatter_hz", nine(s.chatter_hz)},
                                  {"kind", name_of(s.kind)}});
    }
    json["limits"] = files::Json::array();
    for (const Border& b : answer.limits) {
        files::Json limit;
        limit["spindle_rpm"] = nine(b.spindle_rpm);
        limit["limit_mm"] = b.limit.depth_mm ? files::Json(nine(*b.limit.depth_mm)) : files::Json();
        limit["chatter_hz"] = nine(b.limit.there.chatter_hz);
        limit["kind"] = name_of(b.limit.there.kind);
        json["limits"].push_back(std::move(limit));
    }
    json["modes"] = files::Json::array();
    for (const dynamics::Mode& m : answer.cut.modes) {
        json["modes"].push_back({{"direction", files::triple(m.direction)},
                                 {"on", m.on == dynamics::ModeOn::part ? "part" : "tool"},
                                 {"frequency_hz", nine(m.frequency_hz)},
                                 {"damping_ratio", nine(m.damping_ratio)},
                                 {"stiffness_n_per_mm", nine(m.stiffness_n_per_mm)}});
    }
    return files::pretty(json);
}

void print(const Answer& answer) {
    for (const Point& p : answer.points) {
        const dynamics::Stability& s = p.stability;
        std::printf("%g rpm, %g mm: ", p.spindle_rpm, p.axial_depth_mm);
        if (s.kind == dynamics::ChatterKind::stable) {
            std::printf("stable; a vibration keeps %.4g of its size in each %.4g ms\n", s.multiplier,
                        1e3 * s.period_s);
        } else {
            std::printf("chatter at %.1f Hz (%s); a vibration grows by %.4g in each %.4g ms\n", s.chatter_hz,
                        name_of(s.kind), s.multiplier, 1e3 * s.period_s);
        }
    }
    for (const Border& b : answer.limits) {
        if (b.limit.depth_mm) {
            std::printf("%g rpm: stable up to %.4g mm deep, then %.1f Hz (%s)\n", b.spindle_rpm,
                        *b.limit.depth_mm, b.limit.there.chatter_hz, name_of(b.limit.there.kind));
        } else {
            std::printf("%g rpm: stable along the whole edge of %g mm\n", b.spindle_rpm,
                        answer.cut.cutter.length_mm);
        }
    }
}

int stability(const Call& call) {
    const FileResult<Answer> answer = compute(call);
    if (!answer) return report(answer.error());
    if (interrupted()) return interrupted_exit_code();
    report(answer->warnings);
    if (call.json) {
        std::fputs(json_of(*answer).c_str(), stdout);
    } else {
        print(*answer);
    }
    return std::fflush(stdout) == 0
               ? kDone
               : report(files::system_failure("standard output", "write", errno).error());
}

}  // namespace

void add_stability(CLI::App& program, int& exit_code) {
    const auto call = std::make_shared<Call>();
    CLI::App* verb =
        program.add_subcommand("stability", "Say whether a cut chatters, and from which depth on");
    verb->add_option("JOB", call->job, "Job file (TOML) with modes")->required();
    verb->add_option("--at", call->at, "Ask for this speed and axial depth; may be given often")
        ->check(CLI::Validator(
            [](const std::string& text) {
                Point point;
                return read_point(text, point)
                           ? std::string()
                           : "'" + text +
                                 "' is no speed and depth; write RPM:MM, as 8000:1.5, within the "
                                 "ranges of docs/limits.md";
            },
            ""))
        ->type_name("RPM:MM");
    verb->add_option("--limit", call->limit, "Ask for the stable depth at this speed; may be given often")
        ->check(within(kLimits.spindle_speed))
        ->type_name("RPM");
    verb->add_flag("--json", call->json, "Print one JSON object");
    verb->callback([call, &exit_code] { exit_code = stability(*call); });
}

}  // namespace tribo::app
