// SPDX-License-Identifier: MIT
#include "contact/force_table.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/math.hpp"

namespace tribo::contact {
namespace {

constexpr std::size_t kMean = 3, kPerHarmonic = 6;
constexpr double kFullShare = 0.35, kNoShare = 0.45;  // share of the servo's rate
// A longer gap between two stretches is a pause, s.
constexpr double kTouchingS = 1e-9;

// Converts three channels from the tool's frame to the stock's.
void put(const ForceStretch& s, double x, double y, double z, double* out) {
    const Vec3 v = x * s.x + y * s.y + z * s.z;
    out[0] = v.x;
    out[1] = v.y;
    out[2] = v.z;
}

std::vector<double> channels_of(const ForceStretch& s, std::size_t harmonics) {
    std::vector<double> row(kMean + kPerHarmonic * harmonics);
    const auto& h = s.spectrum.harmonics;
    if (!h.empty()) put(s, h[0].x.real(), h[0].y.real(), h[0].z.real(), row.data());
    for (std::size_t n = 1; n < h.size() && n <= harmonics; ++n) {
        double* out = row.data() + kMean + kPerHarmonic * (n - 1);
        put(s, h[n].x.real(), h[n].y.real(), h[n].z.real(), out);
        put(s, h[n].x.imag(), h[n].y.imag(), h[n].z.imag(), out + 3);
    }
    return row;
}

double amplitude(std::span<const double> harmonic) {
    double sum = 0;
    for (const double v : harmonic) sum += v * v;
    return 2 * std::sqrt(sum);
}

// Returns the highest harmonic that a servo can carry and a hand can feel, at most kMostHarmonics.
std::size_t harmonics_worth_keeping(std::span<const ForceStretch> stretches, const ForceTableOptions& o) {
    std::size_t keep = 0;
    for (const ForceStretch& s : stretches) {
        const double base_hz = s.rate_rad_per_s / math::kTwoPi * s.spectrum.order_step;
        const std::size_t most = std::min(s.spectrum.harmonics.size(), ForceTable::kMostHarmonics + 1);
        for (std::size_t n = most; n-- > keep + 1;) {
            if (vibration_gain(base_hz * static_cast<double>(n), o.fastest_hz) <= 0) continue;
            const ForceHarmonic& h = s.spectrum.harmonics[n];
            const double size = 2 * std::sqrt(std::norm(h.x) + std::norm(h.y) + std::norm(h.z));
            if (size * o.hand_per_tool < o.profile.vibration_floor_n) continue;
            keep = n;
            break;
        }
    }
    return keep;
}

}  // namespace

double vibration_gain(double frequency_hz, double rate_hz) {
    return std::clamp((kNoShare - frequency_hz / rate_hz) / (kNoShare - kFullShare), 0.0, 1.0);
}

bool ForceTable::force_at(double t_s, double rate_hz, Cursor& cursor, Vec3& force_n) const noexcept {
    const std::size_t piece = table_.piece_at(t_s, cursor);
    if (piece >= pieces_.size()) return false;
    const ForcePiece& p = pieces_[piece];
    const double base_hz = p.rate_rad_per_s * p.order_step / math::kTwoPi;
    std::size_t count = 0;
    while (count < harmonics() && vibration_gain(base_hz * static_cast<double>(count + 1), rate_hz) > 0)
        ++count;
    std::array<double, kMean + kPerHarmonic * kMostHarmonics> row;
    if (!table_.look_up(t_s, std::span(row).first(kMean + kPerHarmonic * count), cursor)) return false;
    Vec3 sum{row[0], row[1], row[2]};
    if (count > 0) {
        const double start_s = table_.pieces()[piece].from;
        double turn_re, turn_im, re = 1, im = 0;
        math::sincos(p.order_step * (p.phase_rad + p.rate_rad_per_s * (t_s - start_s)), turn_im, turn_re);
        for (std::size_t n = 0; n < count; ++n) {
            const double turned = re * turn_re - im * turn_im;
            im = re * turn_im + im * turn_re;
            re = turned;
            const double share = 2 * vibration_gain(base_hz * static_cast<double>(n + 1), rate_hz);
            const double* c = row.data() + kMean + kPerHarmonic * n;
            sum += share * Vec3{c[0] * re - c[3] * im, c[1] * re - c[4] * im, c[2] * re - c[5] * im};
        }
    }
    force_n = sum;
    return true;
}

ErrorInJnd force_error(const ForceTableOptions& o) {
    const double floor = o.profile.force_floor_n / o.hand_per_tool;
    const double shake = o.profile.vibration_floor_n / o.hand_per_tool;
    return [p = o.profile, floor, shake](std::span<const double> truth, std::span<const double> shown) {
        const Vec3 a{truth[0], truth[1], truth[2]}, b{shown[0], shown[1], shown[2]};
        const double size_a = length(a), size_b = length(b);
        double worst = std::abs(size_a - size_b) / (p.force_magnitude * std::max(size_a, floor));
        if (size_a > 0 && size_b > 0) {
            const double angle = math::atan2(length(cross(a, b)), dot(a, b));
            worst = std::max(worst, angle / p.force_direction_rad * std::min(1.0, size_a / floor));
        }
        for (std::size_t c = kMean; c + kPerHarmonic <= truth.size(); c += kPerHarmonic) {
            const double t = amplitude(truth.subspan(c, kPerHarmonic)),
                         s = amplitude(shown.subspan(c, kPerHarmonic));
            worst = std::max(worst, std::abs(t - s) / (p.vibration_amplitude * std::max(t, shake)));
        }
        return worst;
    };
}

ForceFunction force_function(std::span<const ForceStretch> stretches, const ForceTableOptions& options) {
    ForceFunction f;
    const std::size_t harmonics = harmonics_worth_keeping(stretches, options);
    f.dense.channels = kMean + kPerHarmonic * harmonics;
    const ErrorInJnd error = force_error(options);
    const auto add = [&](double at, const std::vector<double>& row) {
        f.dense.at.push_back(at);
        f.dense.values.insert(f.dense.values.end(), row.begin(), row.end());
    };
    std::vector<double> last;
    for (std::size_t n = 0; n < stretches.size(); ++n) {
        const ForceStretch& s = stretches[n];
        if (!(s.end_s > s.start_s)) continue;
        const std::vector<double> row = channels_of(s, harmonics);
        const bool joined = !last.empty() && n > 0 && s.start_s - stretches[n - 1].end_s <= kTouchingS &&
                            s.rate_rad_per_s == stretches[n - 1].rate_rad_per_s &&
                            s.spectrum.order_step == stretches[n - 1].spectrum.order_step &&
                            error(last, row) <= kJumpJnd;
        if (!joined) {
            if (!last.empty())
                add(std::max(f.dense.at.back(), std::min(stretches[n - 1].end_s, s.start_s)), last);
            f.dense.piece_starts.push_back(f.dense.size());
            f.pieces.push_back({s.phase_rad, s.rate_rad_per_s, static_cast<double>(s.spectrum.order_step)});
            add(s.start_s, row);
        }
        add(0.5 * (s.start_s + s.end_s), row);
        last = row;
    }
    if (!last.empty()) add(stretches.back().end_s, last);
    return f;
}

ForceTable build_force_table(const ForceFunction& function, const ForceTableOptions& options) {
    if (function.dense.size() == 0) return {};
    auto pieces = std::make_shared<std::vector<ForcePiece>>(function.pieces);
    const std::span<const ForcePiece> view = *pieces;
    return {build_perceptual_table(function.dense, force_error(options), options.most_jnd), view,
            std::move(pieces)};
}

}  // namespace tribo::contact
