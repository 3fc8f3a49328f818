// SPDX-License-Identifier: MIT
#include "dynamics/vibration.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>

#include "base/math.hpp"
#include "milling/engagement/engaged_edges.hpp"

namespace tribo::dynamics {
namespace {

// Lag of an edge, and angle of its profile, over a slice: which tooth left the surface is asked once in it.
constexpr double kSliceRad = 0.25, kProfileRad = 0.4;
// Samples that are kept at most, unless one passage needs more.
constexpr double kMostKept = 262'144;
// Samples after which sine and cosine are computed anew.
constexpr std::size_t kFreshEvery = 256;
// Points and weights of Gauss and Legendre on [-1, 1].
constexpr std::array<double, 4> kPoints{-0.86113631159405258, -0.33998104358485626, 0.33998104358485626,
                                        0.86113631159405258};
constexpr std::array<double, 4> kWeights{0.34785484513745386, 0.65214515486254614, 0.65214515486254614,
                                         0.34785484513745386};

// Weights of four values at -1, 0, 1, 2 for the cubic through them at t.
std::array<double, 4> cubic(double t) {
    return {-t * (t - 1) * (t - 2) / 6, (t + 1) * (t - 1) * (t - 2) / 2, -(t + 1) * t * (t - 2) / 2,
            (t + 1) * t * (t - 1) / 6};
}

double in_turn(double angle_rad) {
    return angle_rad - math::kTwoPi * std::floor(angle_rad / math::kTwoPi);
}

double chip_at(const milling::TurnLaw& law, double sine, double cosine) {
    return law.sine * sine + law.cosine * cosine + law.constant;
}

}  // namespace

Vibration::Vibration(std::span<const Mode> modes, const milling::Cutter& cutter,
                     const milling::CuttingCoefficients& coefficients, double rate_hz, double rotation_rad)
    : cutter_(cutter),
      coefficients_(milling::EngagedEdges(cutter, coefficients).coefficients()),
      rate_hz_(rate_hz),
      lag_per_mm_(cutter.lag_rad(1)),
      straight_(lag_per_mm_ == 0 && cutter.corner_radius_mm() == 0),
      first_rad_(rotation_rad),
      rotation_rad_(rotation_rad),
      turn_rad_(in_turn(rotation_rad)) {
    math::sincos(turn_rad_, turn_sine_, turn_cosine_);
    const double half_s = 0.5 / rate_hz;
    for (const Mode& mode : modes) {
        const double w = math::kTwoPi * mode.frequency_hz, zeta = mode.damping_ratio;
        const double damped = w * std::sqrt(1 - zeta * zeta), decay = math::exp(-zeta * w * half_s);
        double sine, cosine;
        math::sincos(damped * half_s, sine, cosine);
        const double qq = decay * (cosine + zeta * w / damped * sine), qv = decay * sine / damped;
        const double vq = -decay * w * w / damped * sine;
        const double vv = decay * (cosine - zeta * w / damped * sine);
        Oscillator o{};
        o.direction = normalized(mode.direction);
        o.q_push = (1 - qq) / mode.stiffness_n_per_mm;
        o.v_push = -vq / mode.stiffness_n_per_mm;
        o.q_by_q = qq * qq + qv * vq;
        o.q_by_v = qq * qv + qv * vv;
        o.q_by_force = qq * o.q_push + qv * o.v_push;
        o.v_by_q = vq * qq + vv * vq;
        o.v_by_v = vq * qv + vv * vv;
        o.v_by_force = vq * o.q_push + vv * o.v_push;
        oscillators_.push_back(o);
    }
    const auto teeth = static_cast<std::size_t>(cutter.flutes);
    std::vector<double> pitch(teeth, math::kTwoPi / static_cast<double>(teeth));
    for (std::size_t n = 0; n < cutter.pitch_deg.size(); ++n)
        pitch[n] = cutter.pitch_deg[n] * math::kRadPerDeg;
    double phase = 0;
    for (const double p : pitch) {
        double sine, cosine;
        math::sincos(phase, sine, cosine);
        phase_rad_.push_back(phase);
        phase_sine_.push_back(sine);
        phase_cosine_.push_back(cosine);
        runout_mm_.push_back(cutter.runout_mm * math::cos(cutter.runout_deg * math::kRadPerDeg - phase));
        phase += p;
    }
    alike_ = cutter.pitch_deg.empty();
    for (std::size_t tooth = 0; tooth < (alike_ ? 1 : teeth); ++tooth) {
        double back = 0;
        for (std::size_t k = 0; k < kMostPassages; ++k) {
            back += pitch[(tooth + k) % teeth];
            before_.push_back({.back_rad = back});
        }
    }
}

double enough_rate_hz(std::span<const Mode> modes, const milling::Cutter& cutter, double spindle_rpm) {
    constexpr double kPerCycle = 20, kPerTooth = 8;
    double fastest_hz = 0;
    for (const Mode& mode : modes) fastest_hz = std::max(fastest_hz, mode.frequency_hz);
    // With unequal pitch some teeth follow sooner.
    double least_pitch_deg = 360.0 / cutter.flutes;
    for (const double pitch : cutter.pitch_deg) least_pitch_deg = std::min(least_pitch_deg, pitch);
    const double tooth_hz = spindle_rpm / 60 * 360 / least_pitch_deg;
    return std::max(kPerCycle * fastest_hz, kPerTooth * tooth_hz);
}

void Vibration::scale_modes(double factor) {
    for (Oscillator& o : oscillators_) {
        o.q_mm *= factor;
        o.v_mm_per_s *= factor;
    }
}

void Vibration::turn_modes(std::span<const Mode> modes) {
    for (std::size_t n = 0; n < oscillators_.size(); ++n)
        oscillators_[n].direction = normalized(modes[n].direction);
}

void Vibration::engage(std::span<const milling::EngagementBand> bands, const milling::ToolTravel& per_tooth,
                       double spindle_rpm, double feed_rad) {
    slices_.clear();
    for (milling::EngagementBand band : bands) {
        // Rotations run clockwise.
        band.entry_rad -= feed_rad;
        band.exit_rad -= feed_rad;
        const double corner = std::clamp(cutter_.corner_radius_mm(), band.z0_mm, band.z1_mm);
        const double top = band.z1_mm;
        band.z1_mm = corner;
        add_slices(band, true);
        band.z0_mm = corner;
        band.z1_mm = top;
        add_slices(band, false);
    }
    double sine, cosine;
    math::sincos(feed_rad, sine, cosine);
    const milling::ToolTravel feed = (cutter_.flutes / math::kTwoPi) * per_tooth;
    feed_per_rad_ = {{cosine * feed.across_mm, sine * feed.across_mm, -feed.down_mm},
                     cosine * feed.turn_x_rad - sine * feed.turn_y_rad,
                     sine * feed.turn_x_rad + cosine * feed.turn_y_rad};
    turns_ = turns_ || feed.turns();
    const double step_rad = spindle_rpm * math::kTwoPi / 60 / rate_hz_;
    if (step_rad == step_rad_) return;
    step_rad_ = step_rad;
    even_from_ = samples_;
    math::sincos(step_rad_, step_sine_, step_cosine_);
    double longest_pitch = 0;
    for (std::size_t first = 0; first < before_.size(); first += kMostPassages)
        longest_pitch = std::max(longest_pitch, before_[first].back_rad);
    passages_ = static_cast<std::size_t>(
        std::clamp(kMostKept * step_rad_ / longest_pitch, 1.0, static_cast<double>(kMostPassages)));
    double longest = 0;
    for (std::size_t n = 0; n < before_.size(); ++n) {
        Passage& p = before_[n];
        p.back_samples = p.back_rad / step_rad_;
        const double t = std::ceil(p.back_samples) - p.back_samples;
        p.weights = cubic(t);
        if (n % kMostPassages < passages_) longest = std::max(longest, p.back_samples);
    }
    keep(std::bit_ceil(static_cast<std::size_t>(std::ceil(longest)) + 8));
}

void Vibration::keep(std::size_t samples) {
    if (samples <= past_.size()) return;
    std::vector<Sample> longer(samples);
    for (std::size_t back = 1; back <= std::min(samples_, past_.size()); ++back)
        longer[(samples_ - back) & (samples - 1)] = sample(samples_ - back);
    past_ = std::move(longer);
}

void Vibration::add_slices(const milling::EngagementBand& band, bool round) {
    const double height = band.z1_mm - band.z0_mm;
    if (!(height > 0)) return;
    double count = std::ceil(std::abs(lag_per_mm_) * height / kSliceRad);
    if (round) {
        const double corner = cutter_.corner_radius_mm();
        const auto kappa = [&](double z) { return math::acos(std::clamp(1 - z / corner, -1.0, 1.0)); };
        count = std::max(count, std::ceil((kappa(band.z1_mm) - kappa(band.z0_mm)) / kProfileRad));
    }
    count = std::max(count, 1.0);
    for (int n = 0; n < static_cast<int>(count); ++n) {
        Slice slice;
        slice.band = band;
        slice.round = round;
        slice.entry_rad = in_turn(band.entry_rad);
        slice.span_rad = std::abs(lag_per_mm_) * height / count;
        slice.band.z0_mm = band.z0_mm + height * n / count;
        slice.band.z1_mm = band.z0_mm + height * (n + 1) / count;
        const EngagedZone all{slice.band.z0_mm, slice.band.z1_mm};
        slice.low_rad = in_turn(band.entry_rad + lag_per_mm_ * (lag_per_mm_ > 0 ? all.z1_mm : all.z0_mm));
        if (round) {
            slice.nodes = nodes_of(all);
        } else {
            slice.piece = piece_of(all);
        }
        slices_.push_back(slice);
    }
}

VibrationSample Vibration::step() {
    displacement_mm_ = {};
    for (const Oscillator& o : oscillators_)
        displacement_mm_ += (o.q_mm + o.q_push * dot(force_n_, o.direction)) * o.direction;
    force_n_ = cutting_force();
    VibrationSample now{{}, force_n_};
    for (Oscillator& o : oscillators_) {
        const double along = dot(force_n_, o.direction);
        const double q = o.q_mm + o.q_push * along, v = o.v_mm_per_s + o.v_push * along;
        now.displacement_mm += q * o.direction;
        o.q_mm = o.q_by_q * q + o.q_by_v * v + o.q_by_force * along;
        o.v_mm_per_s = o.v_by_q * q + o.v_by_v * v + o.v_by_force * along;
    }
    past_[samples_ & (past_.size() - 1)] = {
        rotation_rad_, {fed_.tip_mm + now.displacement_mm, fed_.turn_x_rad, fed_.turn_y_rad}, cut_};
    ++samples_;
    add(fed_, step_rad_, feed_per_rad_);
    rotation_rad_ += step_rad_;
    turn_rad_ += step_rad_;
    if (turn_rad_ >= math::kTwoPi) turn_rad_ -= math::kTwoPi;
    if (samples_ % kFreshEvery == 0) {
        math::sincos(turn_rad_, turn_sine_, turn_cosine_);
    } else {
        const double sine = turn_sine_ * step_cosine_ + turn_cosine_ * step_sine_;
        turn_cosine_ = turn_cosine_ * step_cosine_ - turn_sine_ * step_sine_;
        turn_sine_ = sine;
    }
    return now;
}

const Vibration::Passage& Vibration::passage(std::size_t tooth, std::size_t k) {
    Passage& p = before_[(alike_ ? 0 : tooth * kMostPassages) + k];
    if (p.known_at != samples_ + 1) look_back(p);
    return p;
}

// By a cubic through the four samples around it. Before the first sample the feed was the same and nothing
// was displaced.
void Vibration::look_back(Passage& p) const {
    p.known_at = samples_ + 1;
    p.beyond = {displacement_mm_};
    p.cut = ~Teeth{0};
    const double at_rad = rotation_rad_ - p.back_rad;
    if (samples_ < 4 || !(at_rad > first_rad_)) {
        add(p.beyond, p.back_rad, feed_per_rad_);
        return;
    }
    add(p.beyond, 1, fed_);
    const auto back = static_cast<std::size_t>(std::ceil(p.back_samples));
    std::size_t n = back < samples_ ? samples_ - back : 0;
    std::array<double, 4> weights = p.weights;
    if (n < even_from_ + 1) {
        n = std::min(n, samples_ - 3);
        while (n > 0 && sample(n).rotation_rad > at_rad) --n;
        while (n + 3 < samples_ && sample(n + 1).rotation_rad <= at_rad) ++n;
        const double from = sample(n).rotation_rad, to = sample(n + 1).rotation_rad;
        weights = cubic((at_rad - from) / (to - from));
    }
    // The sample before the first one stood a step of the feed before it.
    if (n > 0) {
        add(p.beyond, -weights[0], sample(n - 1).place);
    } else {
        add(p.beyond, -weights[0], sample(0).place);
        add(p.beyond, weights[0] * step_rad_, feed_per_rad_);
    }
    for (std::size_t k = 1; k < 4; ++k) add(p.beyond, -weights[k], sample(n + k - 1).place);
    p.cut = sample(n).cut & sample(n + 1).cut;
}

void Vibration::add(Place& sum, double times, const Place& place) const {
    sum.tip_mm += times * place.tip_mm;
    if (!turns_) return;
    sum.turn_x_rad += times * place.turn_x_rad;
    sum.turn_y_rad += times * place.turn_y_rad;
}

Vec3 Vibration::cutting_force() {
    cut_ = ~Teeth{0};
    Vec3 sum{};
    for (std::size_t tooth = 0; tooth < phase_rad_.size(); ++tooth) {
        if (straight_ && !turns_) {
            sum += straight_force(tooth);
            continue;
        }
        for (const Slice& slice : slices_) sum += slice_force(tooth, slice);
    }
    return sum;
}

milling::TurnLaw Vibration::chip(std::size_t tooth, double sine, double cosine, double lag_rad,
                                 const milling::ProfilePoint& at) {
    const std::size_t teeth = phase_rad_.size();
    const auto radius = [&](std::size_t of_tooth) {
        return lag_rad == 0 ? runout_mm_[of_tooth]
                            : cutter_.runout_mm * math::cos(cutter_.runout_deg * math::kRadPerDeg -
                                                            phase_rad_[of_tooth] + lag_rad);
    };
    const double own = cutter_.runout_mm == 0 ? 0 : radius(tooth);
    const double arm = at.height_mm * at.sin_kappa + at.radius_mm * at.cos_kappa;
    milling::TurnLaw thinnest;
    double least = 0;
    for (std::size_t k = 0; k < passages_; ++k) {
        const Passage& p = passage(tooth, k);
        const std::size_t other = (tooth + k + 1) % teeth;
        const double offset = cutter_.runout_mm == 0 ? 0 : own - radius(other);
        const Vec3 tip = p.beyond.tip_mm;
        const milling::TurnLaw law{tip.x * at.sin_kappa + p.beyond.turn_x_rad * arm,
                                   tip.y * at.sin_kappa + p.beyond.turn_y_rad * arm,
                                   offset * at.sin_kappa - tip.z * at.cos_kappa};
        const double thickness = chip_at(law, sine, cosine);
        if (k == 0 || thickness < least) {
            thinnest = law;
            least = thickness;
        }
        // What it cut, nothing older stands beyond.
        if ((p.cut & bit(other)) != 0) break;
    }
    if (!(least > 0)) stands_clear(tooth);
    return thinnest;
}

// The bands of a straight edge, all at one angle.
Vec3 Vibration::straight_force(std::size_t tooth) {
    double angle = turn_rad_ + phase_rad_[tooth];
    if (angle >= math::kTwoPi) angle -= math::kTwoPi;
    double height = 0;
    for (const Slice& slice : slices_) {
        double from_entry = angle - slice.entry_rad;
        if (from_entry < 0) from_entry += math::kTwoPi;
        if (from_entry < slice.band.exit_rad - slice.band.entry_rad)
            height += slice.band.z1_mm - slice.band.z0_mm;
    }
    if (height == 0) return {};
    const double sine = tip_sine(tooth), cosine = tip_cosine(tooth);
    const Passage& last = passage(tooth, 0);
    const std::size_t other = tooth + 1 == phase_rad_.size() ? 0 : tooth + 1;
    double thickness =
        last.beyond.tip_mm.x * sine + last.beyond.tip_mm.y * cosine + runout_mm_[tooth] - runout_mm_[other];
    if ((last.cut & bit(other)) == 0 || !(thickness > 0))
        thickness = chip_at(chip(tooth, sine, cosine, 0, {.radius_mm = cutter_.radius_mm()}), sine, cosine);
    if (!(thickness > 0)) return {};
    const milling::CuttingCoefficients& k = coefficients_;
    const double tangential = height * (k.ktc * thickness + k.kte);
    const double radial = height * (k.krc * thickness + k.kre);
    const double axial = height * (k.kac * thickness + k.kae);
    return {-tangential * cosine - radial * sine, tangential * sine - radial * cosine, -axial};
}

Vibration::Piece Vibration::piece_of(EngagedZone zone) const {
    Piece piece;
    piece.height_mm = zone.z1_mm - zone.z0_mm;
    piece.middle_mm = 0.5 * (zone.z0_mm + zone.z1_mm);
    math::sincos(lag_per_mm_ * piece.middle_mm, piece.lag_sine, piece.lag_cosine);
    piece.half = milling::half_span(0.5 * std::abs(lag_per_mm_) * piece.height_mm);
    return piece;
}

Vibration::Nodes Vibration::nodes_of(EngagedZone zone) const {
    const double corner = cutter_.corner_radius_mm();
    const double from = math::acos(std::clamp(1 - zone.z0_mm / corner, -1.0, 1.0)),
                 to = math::acos(std::clamp(1 - zone.z1_mm / corner, -1.0, 1.0));
    Nodes nodes;
    for (std::size_t n = 0; n < nodes.size(); ++n) {
        Node& node = nodes[n];
        const double kappa = 0.5 * (from + to) + 0.5 * (to - from) * kPoints[n];
        math::sincos(kappa, node.at.sin_kappa, node.at.cos_kappa);
        node.at.radius_mm = cutter_.radius_mm() - corner * (1 - node.at.sin_kappa);
        node.at.height_mm = corner * (1 - node.at.cos_kappa);
        node.lag_rad = lag_per_mm_ * node.at.height_mm;
        math::sincos(node.lag_rad, node.lag_sine, node.lag_cosine);
        node.length_mm = 0.5 * (to - from) * kWeights[n] * corner;
    }
    return nodes;
}

// At most instants all of a slice is in the cut, or nothing of it.
Vec3 Vibration::slice_force(std::size_t tooth, const Slice& slice) {
    double from_entry = turn_rad_ + phase_rad_[tooth] - slice.low_rad;  // of the last end
    if (from_entry < 0) from_entry += math::kTwoPi;
    if (from_entry >= math::kTwoPi) from_entry -= math::kTwoPi;
    const double width = slice.band.exit_rad - slice.band.entry_rad, to = from_entry + slice.span_rad;
    if (from_entry >= width && to < math::kTwoPi) return {};
    if (to <= width)
        return slice.round ? round_force(tooth, slice.nodes) : cylinder_force(tooth, slice.piece);
    Vec3 sum{};
    for_each_zone(slice.band, tip_rad(tooth), lag_per_mm_, [&](EngagedZone zone) {
        sum += slice.round ? round_force(tooth, nodes_of(zone)) : cylinder_force(tooth, piece_of(zone));
    });
    return sum;
}

Vec3 Vibration::cylinder_force(std::size_t tooth, const Piece& piece) {
    const milling::ProfilePoint at{.radius_mm = cutter_.radius_mm(), .height_mm = piece.middle_mm};
    const double tip_sin = tip_sine(tooth), tip_cos = tip_cosine(tooth);
    const double sine = tip_sin * piece.lag_cosine - tip_cos * piece.lag_sine;
    const double cosine = tip_cos * piece.lag_cosine + tip_sin * piece.lag_sine;
    const milling::TurnLaw law = chip(tooth, sine, cosine, lag_per_mm_ * piece.middle_mm, at);
    // At both ends.
    const milling::HalfSpan& half = piece.half;
    const double low =
        chip_at(law, sine * half.cosine - cosine * half.sine, cosine * half.cosine + sine * half.sine);
    const double high =
        chip_at(law, sine * half.cosine + cosine * half.sine, cosine * half.cosine - sine * half.sine);
    const milling::EdgeLoad load = milling::edge_load(coefficients_, law, at);
    if (low > 0 && high > 0) return milling::segment_force(load, sine, cosine, half, piece.height_mm).force_n;
    stands_clear(tooth);
    if (low <= 0 && high <= 0) return {};
    // The chip ends within the piece: almost on a straight line, for it is short. `share`: of the piece that
    // cuts.
    const double share = std::max(low, high) / std::abs(high - low);
    const double half_rad = math::atan2(half.sine, half.cosine),
                 shift = (low > 0 ? -1 : 1) * (1 - share) * half_rad;
    double shift_sine, shift_cosine;
    math::sincos(shift, shift_sine, shift_cosine);
    return milling::segment_force(load, sine * shift_cosine + cosine * shift_sine,
                                  cosine * shift_cosine - sine * shift_sine,
                                  milling::half_span(share * half_rad), share * piece.height_mm)
        .force_n;
}

Vec3 Vibration::round_force(std::size_t tooth, const Nodes& nodes) {
    const double tip_sin = tip_sine(tooth), tip_cos = tip_cosine(tooth);
    Vec3 sum{};
    for (const Node& node : nodes) {
        const double sine = tip_sin * node.lag_cosine - tip_cos * node.lag_sine;
        const double cosine = tip_cos * node.lag_cosine + tip_sin * node.lag_sine;
        const milling::TurnLaw law = chip(tooth, sine, cosine, node.lag_rad, node.at);
        if (chip_at(law, sine, cosine) <= 0) continue;
        const milling::EdgeLoad load = milling::edge_load(coefficients_, law, node.at);
        sum += node.length_mm * milling::force_at_rotation(load, sine, cosine).force_n;
    }
    return sum;
}

}  // namespace tribo::dynamics
