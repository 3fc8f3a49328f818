// SPDX-License-Identifier: MIT
#include "surface/textured_triangles.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <vector>

#include "surface/height.hpp"
#include "surface/roughness.hpp"

namespace tribo::surface {
namespace {

constexpr int kProfilePoints = 256;
// A shift is a pitch if the autocorrelation of the profile there is at least this.
constexpr double kAlike = 0.5;
// Grooves lower than this are rounding of the field, mm.
constexpr double kLeastHeight = 1e-6;
// Patches of surfaces without grooves also need a size, mm.
constexpr double kPlainPatch = 0.5;
constexpr double kHeightLimit = 5;

// Subtracts a least-squares parabola from the profile: it is form, not texture.
void remove_form(std::vector<double>& h) {
    const auto n = static_cast<double>(h.size());
    double s0 = 0, s1 = 0, s2 = 0, x2 = 0, x4 = 0;
    const auto x_of = [&](std::size_t i) { return (2 * static_cast<double>(i) + 1) / n - 1; };
    for (std::size_t i = 0; i < h.size(); ++i) {
        const double x = x_of(i), q = x * x;
        s0 += h[i];
        s1 += x * h[i];
        s2 += q * h[i];
        x2 += q;
        x4 += q * q;
    }
    const double determinant = n * x4 - x2 * x2;
    const double a = (s0 * x4 - s2 * x2) / determinant, b = s1 / x2, c = (n * s2 - s0 * x2) / determinant;
    for (std::size_t i = 0; i < h.size(); ++i) {
        const double x = x_of(i);
        h[i] -= a + b * x + c * x * x;
    }
}

// Returns the shift of the first peak of the autocorrelation after its first fall below zero, in samples with
// fraction; 0: no sufficient peak.
double pitch_in_samples(const std::vector<double>& h) {
    const std::size_t most = h.size() / 2;
    std::vector<double> alike(most + 1);
    for (std::size_t shift = 0; shift <= most; ++shift) {
        double product = 0, first = 0, second = 0;
        for (std::size_t i = 0; i + shift < h.size(); ++i) {
            product += h[i] * h[i + shift];
            first += h[i] * h[i];
            second += h[i + shift] * h[i + shift];
        }
        alike[shift] = first > 0 && second > 0 ? product / std::sqrt(first * second) : 0;
    }
    std::size_t shift = 1;
    while (shift < most && alike[shift] > 0) ++shift;
    for (; shift < most; ++shift) {
        if (alike[shift] > kAlike && alike[shift] >= alike[shift - 1] && alike[shift] >= alike[shift + 1]) {
            const double bend = alike[shift - 1] - 2 * alike[shift] + alike[shift + 1];
            const double off = bend < 0 ? 0.5 * (alike[shift - 1] - alike[shift + 1]) / bend : 0;
            return static_cast<double>(shift) + off;
        }
    }
    return 0;
}

// Returns the mean over whole pitches of highest to lowest.
double height_in_pitches(const std::vector<double>& h, double pitch) {
    const auto whole = static_cast<std::size_t>(static_cast<double>(h.size()) / pitch);
    if (whole == 0) return 0;
    double sum = 0;
    for (std::size_t n = 0; n < whole; ++n) {
        const auto from = h.begin() + static_cast<std::ptrdiff_t>(static_cast<double>(n) * pitch);
        const auto to = h.begin() + static_cast<std::ptrdiff_t>(static_cast<double>(n + 1) * pitch);
        const auto [low, high] = std::minmax_element(from, to);
        sum += *high - *low;
    }
    return sum / static_cast<double>(whole);
}

struct Wave {
    double pitch_mm = 0, height_mm = 0;
};

Wave measure(const contact::DistanceField& field, Vec3 place, Vec3 up, Vec3 way, double given_mm,
             double reach_mm) {
    // A known pitch is measured over a few of its lengths, so that it is well sampled.
    const double reach = given_mm > 0 ? std::min(reach_mm, 4 * given_mm) : reach_mm;
    const auto profile = height_profile(field, place - reach * way, place + reach * way, up, kProfilePoints);
    if (!profile) return {given_mm, 0};
    std::vector<double> h = *profile;
    remove_form(h);
    const double step = 2 * reach / kProfilePoints;
    const double pitch = given_mm > 0 ? given_mm / step : pitch_in_samples(h);
    if (pitch < 2) return {given_mm, 0};
    const double height = height_in_pitches(h, pitch);
    if (height < kLeastHeight) return {given_mm, 0};
    return {pitch * step, height};
}

struct SurfaceFrame {
    Vec3 place, up, along, across;
};

// Empty if there is no surface.
std::optional<SurfaceFrame> frame_at(const contact::DistanceField& field, const CutterPlace& p) {
    SurfaceFrame f;
    f.up = normalized(p.normal);
    f.along = normalized(p.feed - dot(p.feed, f.up) * f.up, any_perpendicular(f.up));
    f.across = cross(f.up, f.along);
    const auto height = height_over(field, p.tip_mm, f.up, kHeightLimit);
    if (!height) return std::nullopt;
    f.place = p.tip_mm + *height * f.up;
    return f;
}

contact::GrooveGeometry grooves_at(const contact::DistanceField& field, const SurfaceFrame& f,
                                   const TextureOptions& o) {
    const Wave across = measure(field, f.place, f.up, f.across, o.pitch_across_mm, o.reach_mm);
    const Wave along = measure(field, f.place, f.up, f.along, o.pitch_along_mm, o.reach_mm);
    return {across.pitch_mm, across.height_mm, along.pitch_mm, along.height_mm};
}

}  // namespace

std::optional<contact::TextureRecord> textured_triangles(const contact::DistanceField& machined,
                                                         const CutterPlace& place,
                                                         const TextureOptions& options) {
    assert(options.reach_mm > 0);
    const auto frame = frame_at(machined, place);
    if (!frame) return std::nullopt;
    contact::TextureRecord record;
    record.grooves = grooves_at(machined, *frame, options);
    record.place_mm = frame->place;
    record.normal = frame->up;
    record.along = frame->along;
    const auto half = [](double pitch) { return 0.5 * (pitch > 0 ? pitch : kPlainPatch); };
    record.half_along_mm = half(record.grooves.pitch_along_mm);
    record.half_across_mm = half(record.grooves.pitch_across_mm);
    // The mean plane of the patch is subtracted: it is form.
    double mean = 0, slope_along = 0, slope_across = 0;
    for (int j = 0; j < 3; ++j) {
        for (int i = 0; i < 3; ++i) {
            const Vec3 foot = record.place_mm + (i - 1) * record.half_along_mm * record.along +
                              (j - 1) * record.half_across_mm * frame->across;
            const auto height = height_over(machined, foot, record.normal, kHeightLimit);
            if (!height) return std::nullopt;
            record.height_mm[static_cast<std::size_t>(j)][static_cast<std::size_t>(i)] = *height;
            mean += *height / 9;
            slope_along += (i - 1) * *height / 6;
            slope_across += (j - 1) * *height / 6;
        }
    }
    for (int j = 0; j < 3; ++j) {
        for (int i = 0; i < 3; ++i) {
            record.height_mm[static_cast<std::size_t>(j)][static_cast<std::size_t>(i)] -=
                mean + slope_along * (i - 1) + slope_across * (j - 1);
        }
    }
    record.place_mm += mean * record.normal;
    return record;
}

}  // namespace tribo::surface
