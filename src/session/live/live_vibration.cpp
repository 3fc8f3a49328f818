// SPDX-License-Identifier: MIT
#include "session/live/live_vibration.hpp"

#include <algorithm>
#include <cmath>

#include "base/limits.hpp"
#include "base/math.hpp"
#include "dynamics/step/edge_slices.hpp"
#include "session/chatter/row_stability.hpp"
#include "session/chatter/simulated_cut.hpp"

namespace tribo::session {
namespace {

// Angles and heights may be beyond their limits by this share: they come in single precision.
constexpr double kRounding = 1e-6;
// Steps in a sample, at most: for modes up to 19 kHz.
constexpr int kMostSteps = 8;
// Pieces of edge (dynamics::Vibration) times steps in a sample, at most: a third of a second for each second
// of sound.
constexpr double kMostWork = 96;
// How many pieces on the cylinder one on the rounded part costs.
constexpr double kRoundCost = 3;

bool is_good(const dynamics::Mode& mode) {
    return is_finite(mode.direction) && length(mode.direction) > 0 &&
           kLimits.mode_frequency.range.contains(mode.frequency_hz) &&
           kLimits.mode_damping.range.contains(mode.damping_ratio) &&
           kLimits.mode_stiffness.range.contains(mode.stiffness_n_per_mm) &&
           (mode.on == dynamics::ModeOn::tool || mode.on == dynamics::ModeOn::part);
}

bool is_good(const protocol::LiveBendingCutter& of) {
    return of.cutter.kind <= milling::CutterKind::bull && check(of.cutter) && of.fastest_rpm > 0 &&
           std::isfinite(of.fastest_rpm) &&
           std::ranges::all_of(of.modes, [](const dynamics::Mode& mode) { return is_good(mode); });
}

int steps_of(const protocol::LiveBendingCutter& of, double rate_hz) {
    const double wanted = dynamics::enough_rate_hz(of.modes, of.cutter, of.fastest_rpm) / rate_hz;
    return static_cast<int>(std::ceil(std::clamp(wanted, 1.0, 1.0 + kMostSteps)));
}

std::optional<Vec3> direction(const Point3f& p) {
    const Vec3 v{p[0], p[1], p[2]};
    if (!is_finite(v) || !(length(v) > 0.5)) return std::nullopt;
    return normalized(v);
}

// In the range of milling::EngagementBand.
bool read(const protocol::LiveBand& told, double length_mm, milling::EngagementBand& band) {
    band = {double{told.z0_mm}, std::min(double{told.z1_mm}, length_mm), double{told.entry_rad},
            std::min(double{told.exit_rad}, math::kTwoPi)};
    return band.z0_mm >= 0 && band.z1_mm > band.z0_mm && band.entry_rad >= 0 &&
           band.exit_rad > band.entry_rad && double{told.z1_mm} <= length_mm * (1 + kRounding) &&
           double{told.exit_rad} <= math::kTwoPi * (1 + kRounding);
}

}  // namespace

std::unique_ptr<LiveVibration> LiveVibration::make(const protocol::LiveBending& bending, int sample_rate_hz) {
    const auto good = [](const protocol::LiveBendingCutter& of) { return is_good(of); };
    if (!std::ranges::all_of(bending.cutters, good) || !check(bending.coefficients)) return nullptr;
    return std::unique_ptr<LiveVibration>(new LiveVibration(bending, sample_rate_hz));
}

LiveVibration::LiveVibration(const protocol::LiveBending& bending, int sample_rate_hz)
    : rate_hz_(sample_rate_hz) {
    for (const protocol::LiveBendingCutter& of : bending.cutters) {
        const int steps = steps_of(of, rate_hz_);
        tools_.push_back(
            {of.cutter, of.modes, ring_s(of.modes) * rate_hz_, steps,
             BendingTool(of.modes, of.cutter, bending.coefficients, rate_hz_, steps, 0, 1, true)});
        last_.modes.reserve(of.modes.size());
    }
}

bool LiveVibration::teeth_can_be_followed(std::size_t cutter, double spindle_rpm) const {
    const Tool& tool = tools_[cutter];
    double least_deg = 360.0 / tool.cutter.flutes, most_deg = least_deg;
    for (const double pitch : tool.cutter.pitch_deg) {
        least_deg = std::min(least_deg, pitch);
        most_deg = std::max(most_deg, pitch);
    }
    constexpr double kLeastSamples = 4;
    const double deg_per_s = 6 * spindle_rpm;
    return most_deg <= kLongestPitchS * deg_per_s &&
           least_deg * tool.steps * rate_hz_ >= kLeastSamples * deg_per_s;
}

double LiveVibration::work(std::size_t cutter, std::span<const milling::EngagementBand> bands) const {
    const Tool& tool = tools_[cutter];
    const double corner = tool.cutter.corner_radius_mm(), lag = std::abs(tool.cutter.lag_rad(1));
    const auto kappa = [&](double z_mm) { return math::acos(std::clamp(1 - z_mm / corner, -1.0, 1.0)); };
    double pieces = 0;
    for (const milling::EngagementBand& band : bands) {
        const double middle = std::clamp(corner, band.z0_mm, band.z1_mm);
        pieces += std::ceil(lag * (band.z1_mm - middle) / dynamics::kSliceRad);
        if (middle > band.z0_mm)
            pieces +=
                kRoundCost * std::ceil(std::max(lag * (middle - band.z0_mm) / dynamics::kSliceRad,
                                                (kappa(middle) - kappa(band.z0_mm)) / dynamics::kProfileRad));
    }
    return pieces * tool.cutter.flutes * tool.steps;
}

bool LiveVibration::read(const protocol::LiveSoundPiece& piece, Cut& cut) {
    const protocol::LiveTeeth& teeth = piece.teeth;
    const auto axis = direction(teeth.axis), feed = direction(teeth.feed), head = direction(teeth.head);
    cut.cutter = teeth.cutter;
    cut.spindle_rpm = double{piece.spindle_rad_per_s} * 60 / math::kTwoPi;
    if (teeth.bands.empty() || teeth.bands.size() > kMostBands || cut.cutter >= tools_.size() || !axis ||
        !feed || !head || !(cut.spindle_rpm > 0) || !teeth_can_be_followed(cut.cutter, cut.spindle_rpm))
        return false;
    Tool& tool = tools_[cut.cutter];
    if (tool.modes.empty()) return false;
    cut.bands.resize(teeth.bands.size());
    for (std::size_t n = 0; n < cut.bands.size(); ++n)
        if (!session::read(teeth.bands[n], tool.cutter.length_mm, cut.bands[n])) return false;
    if (tool.steps > kMostSteps || work(cut.cutter, cut.bands) > kMostWork) return false;
    cut.per_tooth = {double{teeth.across_mm}, double{teeth.down_mm}, double{teeth.turn_x_rad},
                     double{teeth.turn_y_rad}};
    const milling::ToolTravel& way = cut.per_tooth;
    const double turn_mm = tool.cutter.length_mm * (std::abs(way.turn_x_rad) + std::abs(way.turn_y_rad));
    if (!(way.across_mm >= 0 && way.across_mm + std::abs(way.down_mm) + turn_mm <= tool.cutter.diameter_mm))
        return false;
    const Vec3 across = cross(*axis, *head);
    if (!(length(across) > 0.5)) return false;
    milling::ToolFrame frame;
    frame.z = *axis;
    frame.y = normalized(across);
    frame.x = cross(frame.y, frame.z);
    const std::complex<double> along(dot(*feed, frame.x), dot(*feed, frame.y));
    if (!(std::abs(along) > 0.5)) return false;
    cut.feed = along / std::abs(along);
    cut.modes = modes_in(frame, frame, tool.modes);
    // Makes room; run() engages it.
    tool.bends.engage(cut.modes, cut.bands, cut.per_tooth, cut.spindle_rpm, cut.feed);
    engaged_.reset();
    in_air_ = false;
    return true;
}

std::span<const std::array<float, 2>> LiveVibration::run(const Cut& cut, std::size_t number,
                                                         std::size_t samples) {
    BendingTool& tool = tools_[cut.cutter].bends;
    if (awake_ != cut.cutter) tool.calm();
    if (engaged_ != number || awake_ != cut.cutter)
        tool.engage(cut.modes, cut.bands, cut.per_tooth, cut.spindle_rpm, cut.feed);
    awake_ = cut.cutter;
    engaged_ = number;
    in_air_ = false;
    air_samples_ = 0;
    // Within the memory that it has.
    last_.modes.assign(cut.modes.begin(), cut.modes.end());
    last_.per_tooth = cut.per_tooth;
    last_.spindle_rpm = cut.spindle_rpm;
    last_.feed = cut.feed;
    samples = std::min(samples, kMostSamples);
    for (std::size_t n = 0; n < samples; ++n) {
        tool.next();
        added_n_[n] = tool.added_n();
    }
    return std::span(added_n_).first(samples);
}

void LiveVibration::rest(std::size_t samples) {
    if (!awake_) return;
    BendingTool& tool = tools_[*awake_].bends;
    const double rings = tools_[*awake_].ring_samples;
    if (!in_air_) tool.engage(last_.modes, {}, last_.per_tooth, last_.spindle_rpm, last_.feed);
    in_air_ = true;
    engaged_.reset();
    for (std::size_t n = 0; n < samples; ++n) tool.next();
    air_samples_ += static_cast<double>(samples);
    // For a turn at least: then all teeth have left the surface of a still tool.
    if (air_samples_ < std::max(rings, 60 / last_.spindle_rpm * rate_hz_)) return;
    tool.calm();
    awake_.reset();
}

double LiveVibration::phase_rad(const Cut& cut) const {
    return tools_[cut.cutter].bends.rotation_rad() + math::atan2(cut.feed.imag(), cut.feed.real());
}

}  // namespace tribo::session
