// SPDX-License-Identifier: MIT
#include "report/picture/studio.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/math.hpp"

namespace tribo::report {
namespace {

constexpr double kPanelDistance = 3;
// Brightness of the floor straight below and far away, and of the sky.
constexpr double kFloor = 0.2, kFar = 0.95, kHorizon = 0.62, kZenith = 0.24;
constexpr float kSun = 1.9F;
constexpr Rgb kSunColour{1, 0.97F, 0.92F};

// Narrow panels with dark gaps make shallow grooves visible.
struct Panel {
    Vec3 towards;
    double width, height, brightness;
};
constexpr Panel kPanels[] = {
    {{-0.75, 0.5, 0.9}, 1.6, 0.9, 6}, {{0.15, 1, 0.95}, 3, 0.28, 2.6}, {{0.1, 1, 0.42}, 3.6, 0.3, 2.6},
    {{0.95, 0.3, 0.6}, 0.5, 2.2, 4},  {{-1, -0.4, 0.3}, 0.6, 1.6, 3},  {{0.7, -1, 0.5}, 0.8, 0.8, 3},
};

class Room {
  public:
    Room() {
        for (std::size_t n = 0; n < std::size(kPanels); ++n) {
            Wall& w = walls_[n];
            w.out = normalized(kPanels[n].towards);
            w.right = normalized(cross(Vec3{0, 0, 1}, w.out));
            w.up = cross(w.out, w.right);
        }
    }
    double brightness(Vec3 d) const {
        for (std::size_t n = 0; n < std::size(kPanels); ++n) {
            const Wall& w = walls_[n];
            const double forward = dot(d, w.out);
            if (forward <= 0) continue;
            const double scale = kPanelDistance / forward;
            if (std::abs(dot(d, w.right)) * scale <= 0.5 * kPanels[n].width &&
                std::abs(dot(d, w.up)) * scale <= 0.5 * kPanels[n].height)
                return kPanels[n].brightness;
        }
        return d.z < 0 ? kFar + d.z * (kFar - kFloor) : kHorizon + d.z * (kZenith - kHorizon);
    }

  private:
    struct Wall {
        Vec3 out, right, up;
    };
    std::array<Wall, std::size(kPanels)> walls_;
};

constexpr int kSide = 96;  // of the table of a sky
constexpr int kRays = 96;  // of one lobe

// Van der Corput's sequence in base 2.
double radical_inverse(unsigned n) {
    double share = 0;
    for (double digit = 0.5; n != 0; n >>= 1, digit *= 0.5) {
        if (n & 1) share += digit;
    }
    return share;
}

// Folds the corners of the square to its middle, or back: the lower half of the octahedron (Engelhardt and
// Dachsbacher 2008).
struct Square {
    double x, y;  // -1 to 1
    Square folded() const {
        return {(1 - std::abs(y)) * (x < 0 ? -1 : 1), (1 - std::abs(x)) * (y < 0 ? -1 : 1)};
    }
};
Vec3 direction_of(Square s) {
    const double z = 1 - std::abs(s.x) - std::abs(s.y);
    if (z < 0) s = s.folded();
    return normalized(Vec3{s.x, s.y, z});
}

// A Phong lobe of 2 / roughness^4 - 2 about the normal has a quarter of that exponent about the mirrored
// direction.
double lobe_of(double roughness) {
    const double alpha = roughness * roughness;
    return 0.25 * (2 / (alpha * alpha) - 2);
}

}  // namespace

Studio::Sky::Sky(double exponent)
    : table_(static_cast<std::size_t>(kSide) * static_cast<std::size_t>(kSide)) {
    const Room room;
    // Rays of a lobe about z, all of one weight.
    std::array<Vec3, kRays> rays;
    for (unsigned n = 0; n < kRays; ++n) {
        const double cosine = math::pow((n + 0.5) / kRays, 1 / (exponent + 1)),
                     sine = std::sqrt(1 - cosine * cosine), angle = math::kTwoPi * radical_inverse(n);
        rays[n] = {sine * math::cos(angle), sine * math::sin(angle), cosine};
    }
    for (int row = 0; row < kSide; ++row) {
        for (int k = 0; k < kSide; ++k) {
            const Vec3 axis = direction_of({2.0 * k / (kSide - 1) - 1, 2.0 * row / (kSide - 1) - 1}),
                       right = normalized(cross(Vec3{0, 0, 1}, axis), {1, 0, 0}), up = cross(axis, right);
            double sum = 0;
            for (const Vec3 ray : rays) sum += room.brightness(ray.x * right + ray.y * up + ray.z * axis);
            table_[static_cast<std::size_t>(row * kSide + k)] = static_cast<float>(sum / kRays);
        }
    }
}

float Studio::Sky::at(Vec3 d) const {
    const double scale = 1 / (std::abs(d.x) + std::abs(d.y) + std::abs(d.z));
    Square s{d.x * scale, d.y * scale};
    if (d.z < 0) s = s.folded();
    const double across = 0.5 * (s.x + 1) * (kSide - 1), along = 0.5 * (s.y + 1) * (kSide - 1);
    const int k = std::clamp(static_cast<int>(across), 0, kSide - 2),
              row = std::clamp(static_cast<int>(along), 0, kSide - 2);
    const auto u = static_cast<float>(across - k), v = static_cast<float>(along - row);
    const float* at = &table_[static_cast<std::size_t>(row * kSide + k)];
    const float low = at[0] + u * (at[1] - at[0]), high = at[kSide] + u * (at[kSide + 1] - at[kSide]);
    return low + v * (high - low);
}

// The polynomial of Karis 2014, "Physically based shading on mobile".
Studio::Gloss::Gloss(float rough, float metal)
    : roughness(rough), metalness(metal), sky(lobe_of(static_cast<double>(rough))) {
    const float r0 = 1 - rough, r1 = 0.0425F - 0.0275F * rough, r2 = 1.04F - 0.572F * rough,
                r3 = 0.022F * rough - 0.04F;
    for (int n = 0; n <= kCosines; ++n) {
        const auto fall = static_cast<float>(math::pow(2, -9.28 * n / kCosines));
        const float a = std::min(r0 * r0, fall) * r0 + r1;
        mirrored[static_cast<std::size_t>(n)] = {-1.04F * a + r2, 1.04F * a + r3};
    }
}

// As in web/ui/src/studio.ts.
Studio::Studio() : glosses_{Gloss(0.3F, 1), Gloss(0.62F, 0.4F), Gloss(0.55F, 0)}, matte_(1) {}

Vec3 Studio::to_sun() {
    return normalized(Vec3{-0.75, -0.2, 1});
}

Rgb Studio::on(Finish finish, Rgb colour, Vec3 normal, Vec3 to_viewer, float sun) const {
    const Gloss& gloss = glosses_[static_cast<std::size_t>(finish)];
    const float metalness = gloss.metalness;
    const auto facing = static_cast<float>(std::clamp(dot(normal, to_viewer), 1e-3, 1.0));
    const float seen = gloss.sky.at(2 * dot(normal, to_viewer) * normal - to_viewer);
    const Mirrored share = gloss.mirrored[static_cast<std::size_t>(facing * kCosines + 0.5F)];
    float soft = metalness < 1 ? matte_.at(normal) : 0;

    // The sun: GGX with Smith's visibility, Fresnel after Schlick 1994.
    const auto towards = static_cast<float>(dot(normal, to_sun()));
    float spark = 0, edge = 0;
    if (towards > 0 && sun > 0) {
        constexpr auto kPi = static_cast<float>(math::kPi);
        const Vec3 half = normalized(to_viewer + to_sun());
        const auto h = static_cast<float>(dot(normal, half)),
                   miss = 1 - static_cast<float>(dot(to_viewer, half));
        const float alpha = gloss.roughness * gloss.roughness, a2 = alpha * alpha;
        const float lobe = h * h * (a2 - 1) + 1;
        const float visible = 0.5F / (towards * std::sqrt(facing * facing * (1 - a2) + a2) +
                                      facing * std::sqrt(towards * towards * (1 - a2) + a2));
        spark = kSun * sun * towards * visible * a2 / (kPi * lobe * lobe);
        soft += kSun * sun * towards / kPi;
        edge = miss * miss * miss * miss * miss;
    }
    soft *= 1 - metalness;
    const auto channel = [&](float own, float tint) {
        const float head_on = 0.04F + metalness * (own - 0.04F);
        return seen * (head_on * share.scale + share.offset) + own * soft +
               tint * spark * (head_on + edge * (1 - head_on));
    };
    return {channel(colour.r, kSunColour.r), channel(colour.g, kSunColour.g),
            channel(colour.b, kSunColour.b)};
}

Rgb toned(Rgb c) {
    constexpr float kStart = 0.8F - 0.04F, kDesaturation = 0.15F;
    const float least = std::min({c.r, c.g, c.b});
    const float offset = least < 0.08F ? least - 6.25F * least * least : 0.04F;
    c = {c.r - offset, c.g - offset, c.b - offset};
    const float peak = std::max({c.r, c.g, c.b});
    if (peak < kStart) return c;
    constexpr float kRoom = 1 - kStart;
    const float lower = 1 - kRoom * kRoom / (peak + kRoom - kStart), scale = lower / peak;
    const float white = 1 - 1 / (kDesaturation * (peak - lower) + 1);
    const auto mixed = [&](float v) { return v * scale + white * (lower - v * scale); };
    return {mixed(c.r), mixed(c.g), mixed(c.b)};
}

}  // namespace tribo::report
