// SPDX-License-Identifier: MIT
#include "app/audit/speed_advice.hpp"

#include <limits>

#include "base/math.hpp"
#include "base/text/decimal.hpp"
#include "milling/tool/surface_speed.hpp"

namespace tribo::app {
namespace {

struct Bound {
    double rpm = std::numeric_limits<double>::infinity();
    std::string from;
};

Bound bound_of(const milling::Cutter& cutter, const PreparedJob& loaded) {
    Bound bound;
    const std::vector<job::SpindlePoint>& curve = loaded.job.limits.spindle;
    if (!curve.empty()) bound = {curve.back().rpm, "end of 'spindle' in [limits] of the job"};
    const auto usual = milling::usual_surface_speed_m_per_min(loaded.material.name, cutter.body);
    if (!usual) return bound;
    const double rpm = 1000 * *usual / (math::kPi * cutter.diameter_mm);
    if (rpm < bound.rpm)
        bound = {rpm, format_decimal(*usual) + " m/min, " + std::string(milling::kSurfaceSpeedSource)};
    return bound;
}

}  // namespace

Result<void> check_bends(const job::Job& job) {
    if (job.can_vibrate()) return {};
    return fail_at(job.file, 0, 0, "--stable needs to know what bends, and the job has no modes",
                   "write [[mode]] or [[frf]] into the job, or [dynamics] estimate = true");
}

SpeedAdvice advise_speeds(const session::StableSpeedSearch& search, const PreparedJob& loaded,
                          const session::MillSetup& setup, const ParallelFor& parallel) {
    std::vector<Bound> bounds;
    std::vector<double> most_rpm;
    for (const milling::Cutter& cutter : setup.cutters)
        most_rpm.push_back(bounds.emplace_back(bound_of(cutter, loaded)).rpm);
    SpeedAdvice advice;
    advice.speeds = search.find(most_rpm, parallel);
    for (const session::StableSpeed& speed : advice.speeds) {
        advice.tools.push_back(setup.cutters[speed.cutter].number);
        advice.bounds.push_back(bounds[speed.cutter].from);
    }
    return advice;
}

std::vector<std::string> in_words(const SpeedAdvice& advice) {
    std::vector<std::string> all;
    for (std::size_t n = 0; n < advice.speeds.size(); ++n) {
        const session::StableSpeed& s = advice.speeds[n];
        const auto risk = [](double multiplier, const std::optional<double>& probability) {
            std::string text = "multiplier " + format_digits(multiplier, 3);
            if (probability) text += ", probability of chatter " + format_digits(*probability, 2);
            return text;
        };
        std::string text = advice.tools[n] > 0 ? "T" + std::to_string(advice.tools[n]) : "the tool";
        text += ", line " + std::to_string(s.line) + ": ";
        const std::string old =
            format_digits(s.old_rpm, 5) + " rpm (" + risk(s.old_multiplier, s.old_probability) + ")";
        if (s.is_stable() && s.new_rpm == s.old_rpm) {
            text += old + " is stable, and stays";
        } else if (s.is_better()) {
            text += format_digits(s.new_rpm, 5) + " rpm (" + risk(s.new_multiplier, s.new_probability) +
                    ") for " + old + ", feeds times " + format_digits(s.factor(), 4);
        } else {
            text += "no speed without chatter is known; " + old + " stays: cut less deep";
        }
        if (!advice.bounds[n].empty())
            text += "; at most " + format_digits(s.most_rpm, 5) + " rpm (" + advice.bounds[n] + ")";
        all.push_back(std::move(text));
    }
    return all;
}

files::Json speeds_json(const SpeedAdvice& advice) {
    files::Json all = files::Json::array();
    for (std::size_t n = 0; n < advice.speeds.size(); ++n) {
        const session::StableSpeed& s = advice.speeds[n];
        files::Json speed{{"tool", advice.tools[n]},
                          {"line", s.line},
                          {"old_rpm", s.old_rpm},
                          {"new_rpm", s.is_better() ? s.new_rpm : s.old_rpm},
                          {"stable", s.is_stable()},
                          {"old_multiplier", s.old_multiplier},
                          {"new_multiplier", s.is_better() ? s.new_multiplier : s.old_multiplier}};
        files::set(speed, "old_probability", s.old_probability);
        files::set(speed, "new_probability", s.is_better() ? s.new_probability : s.old_probability);
        if (!advice.bounds[n].empty()) {
            speed["most_rpm"] = s.most_rpm;
            speed["most_rpm_from"] = advice.bounds[n];
        }
        all.push_back(std::move(speed));
    }
    return all;
}

}  // namespace tribo::app
