// SPDX-License-Identifier: MIT
#include "noise/model/voice_map.hpp"

#include <algorithm>
#include <cassert>

#include "base/math.hpp"

namespace tribo::noise {
namespace {

// Below the recorded range the level falls at least with the square root of speed or force.
constexpr double kLeastSlopeDb = 10;

// Forces with a smaller difference form one row.
constexpr double kSameForce = 1e-9;

double power_of_db(double db) {
    return math::pow(10, 0.1 * db);
}

// Returns the level in dB: a slope over a logarithm, with other slopes beyond the recorded range [low, high].
double bent(double slope_db, double x, double low, double high) {
    const double inside = slope_db * std::clamp(x, low, high);
    if (x < low) return inside + std::max(slope_db, kLeastSlopeDb) * (x - low);
    if (x > high) return inside + std::min(std::max(slope_db, 0.0) * (x - high), kMostAboveDb);
    return inside;
}

}  // namespace

LevelLaw fit_level_law(const std::vector<VoiceModel>& models) {
    LevelLaw law;
    if (models.empty()) return law;
    const auto n = static_cast<double>(models.size());
    double v_mean = 0, f_mean = 0, y_mean = 0;
    const auto speed_of = [](const VoiceModel& m) { return math::log10(m.speed_mm_per_s / kLawSpeedMmPerS); };
    const auto force_of = [](const VoiceModel& m) { return math::log10(m.force_n / kLawForceN); };
    for (const VoiceModel& m : models) {
        v_mean += speed_of(m) / n;
        f_mean += force_of(m) / n;
        y_mean += m.level_db / n;
    }
    double vv = 0, ff = 0, vf = 0, vy = 0, fy = 0;
    for (const VoiceModel& m : models) {
        const double v = speed_of(m) - v_mean, f = force_of(m) - f_mean, y = m.level_db - y_mean;
        vv += v * v;
        ff += f * f;
        vf += v * f;
        vy += v * y;
        fy += f * y;
    }
    // A spread below a hundredth of a decade gives no slope; nor do speed and force that change together.
    constexpr double kSpread = 1e-4;
    const double determinant = vv * ff - vf * vf;
    if (vv > kSpread && ff > kSpread && determinant > 1e-3 * vv * ff) {
        law.db_per_decade_speed = (vy * ff - fy * vf) / determinant;
        law.db_per_decade_force = (fy * vv - vy * vf) / determinant;
    } else if (vv > kSpread) {
        law.db_per_decade_speed = (vy - law.db_per_decade_force * vf) / vv;
    } else if (ff > kSpread) {
        law.db_per_decade_force = (fy - law.db_per_decade_speed * vf) / ff;
    }
    for (double* slope : {&law.db_per_decade_speed, &law.db_per_decade_force}) {
        *slope = std::clamp(*slope, -kSteepestLawDb, kSteepestLawDb);
    }
    law.level_db = y_mean - law.db_per_decade_speed * v_mean - law.db_per_decade_force * f_mean;
    law.level_db = std::clamp(law.level_db, kLeastLawDb, kMostLawDb);
    return law;
}

VoiceMap::VoiceMap(const MaterialVoices& voices) : law_(voices.law) {
    assert(!voices.models.empty());
    for (const VoiceModel& m : voices.models) {
        const double log_speed = math::log10(m.speed_mm_per_s / kLawSpeedMmPerS);
        const double log_force = math::log10(m.force_n / kLawForceN);
        if (rows_.empty() || log_force - rows_.back().log_force > kSameForce) {
            rows_.push_back({log_force, static_cast<int>(knots_.size()), 0});
        }
        ++rows_.back().count;
        knots_.push_back({log_speed, m.speed_mm_per_s, power_of_db(m.level_db),
                          m.level_db - law_.level_db - law_.db_per_decade_speed * log_speed -
                              law_.db_per_decade_force * log_force});
    }
    slowest_ = fastest_ = knots_[0].log_speed;
    for (const Knot& knot : knots_) {
        slowest_ = std::min(slowest_, knot.log_speed);
        fastest_ = std::max(fastest_, knot.log_speed);
    }
}

void VoiceMap::add_row(const Row& row, double log_speed, double share, VoicePlace& place,
                       double& offset_db) const {
    const auto add = [&](int model, double part) {
        offset_db += part * knots_[static_cast<std::size_t>(model)].offset_db;
        if (part <= 0) return;
        place.model[static_cast<std::size_t>(place.count)] = model;
        place.share[static_cast<std::size_t>(place.count)] = part;
        ++place.count;
    };
    int upper = 0;
    while (upper < row.count && knots_[static_cast<std::size_t>(row.first + upper)].log_speed <= log_speed) {
        ++upper;
    }
    if (upper == 0) return add(row.first, share);
    if (upper == row.count) return add(row.first + row.count - 1, share);
    const Knot& a = knots_[static_cast<std::size_t>(row.first + upper - 1)];
    const Knot& b = knots_[static_cast<std::size_t>(row.first + upper)];
    const double t = (log_speed - a.log_speed) / (b.log_speed - a.log_speed);
    add(row.first + upper - 1, share * (1 - t));
    add(row.first + upper, share * t);
}

VoicePlace VoiceMap::at(double speed_mm_per_s, double force_n) const {
    VoicePlace place;
    if (!(speed_mm_per_s > 0) || !(force_n > 0)) return place;
    const double log_speed = math::log10(speed_mm_per_s / kLawSpeedMmPerS);
    const double log_force = math::log10(force_n / kLawForceN);
    double offset_db = 0;
    std::size_t upper = 0;
    while (upper < rows_.size() && rows_[upper].log_force <= log_force) ++upper;
    if (upper == 0 || upper == rows_.size()) {
        add_row(rows_[upper == 0 ? 0 : upper - 1], log_speed, 1, place, offset_db);
    } else {
        const Row &a = rows_[upper - 1], &b = rows_[upper];
        const double t = (log_force - a.log_force) / (b.log_force - a.log_force);
        add_row(a, log_speed, 1 - t, place, offset_db);
        add_row(b, log_speed, t, place, offset_db);
    }
    const double level_db =
        law_.level_db + offset_db + bent(law_.db_per_decade_speed, log_speed, slowest_, fastest_) +
        bent(law_.db_per_decade_force, log_force, rows_.front().log_force, rows_.back().log_force);
    place.gain = math::pow(10, 0.05 * level_db);
    return place;
}

VoicePlace VoiceMap::as_published(double speed_mm_per_s) const {
    // With several forces, use the middle one.
    const Row& row = rows_[(rows_.size() - 1) / 2];
    const auto knot = [&](int n) -> const Knot& { return knots_[static_cast<std::size_t>(row.first + n)]; };
    int upper = 0;
    while (upper < row.count && knot(upper).speed <= speed_mm_per_s) ++upper;
    VoicePlace place;
    const int a = std::max(upper - 1, 0), b = std::min(upper, row.count - 1);
    const double t = a == b ? 0 : (speed_mm_per_s - knot(a).speed) / (knot(b).speed - knot(a).speed);
    place.gain = (1 - t) * knot(a).power + t * knot(b).power;
    place.count = 1;
    place.model[0] = row.first + a;
    place.share[0] = 1 - t;
    if (t > 0) {
        place.count = 2;
        place.model[1] = row.first + b;
        place.share[1] = t;
    }
    return place;
}

}  // namespace tribo::noise
