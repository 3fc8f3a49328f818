// SPDX-License-Identifier: MIT
#include "haptics/texture/haptic_texture.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>

#include "base/math.hpp"

namespace tribo::haptics {
namespace {

constexpr double kAllBelow = 0.25, kNoneFrom = 0.4;  // of the loop's rate

}  // namespace

double groove_gain(double speed_mm_per_s, double wavelength_mm, double rate_hz) {
    if (!(wavelength_mm > 0)) return 1;
    const double share = std::abs(speed_mm_per_s) / (wavelength_mm * rate_hz);
    if (share <= kAllBelow) return 1;
    if (share >= kNoneFrom) return 0;
    return 0.5 + 0.5 * math::cos(std::numbers::pi * (share - kAllBelow) / (kNoneFrom - kAllBelow));
}

TextureMap::TextureMap(std::vector<contact::TextureRecord> records, double reach_mm)
    : records_(std::move(records)), reach_(reach_mm) {
    assert(reach_mm > 0);
    std::vector<Vec3> places;
    places.reserve(records_.size());
    for (const contact::TextureRecord& r : records_) places.push_back(r.place_mm);
    cells_ = CellIndex(places, reach_mm);
}

const contact::TextureRecord* TextureMap::nearest(Vec3 place_mm) const {
    const contact::TextureRecord* best = nullptr;
    if (!is_finite(place_mm)) return best;
    double least = reach_ * reach_;
    cells_.for_each_near(place_mm, kMostLooked, [&](std::uint32_t n) {
        const contact::TextureRecord& r = records_[n];
        const double d = squared_length(r.place_mm - place_mm);
        if (d <= least) {
            least = d;
            best = &r;
        }
    });
    return best;
}

Vec3 texture_force(const contact::TextureRecord& record, const TextureTouch& touch, double stiffness_n_per_mm,
                   double rate_hz) {
    const contact::GrooveGeometry& g = record.grooves;
    const contact::TextureBand band{
        groove_gain(dot(touch.velocity_mm_per_s, record.along), g.pitch_along_mm, rate_hz),
        groove_gain(dot(touch.velocity_mm_per_s, record.across()), g.pitch_across_mm, rate_hz)};
    return stiffness_n_per_mm * contact::texture_normal(record, touch.place_mm, touch.press_mm, band);
}

}  // namespace tribo::haptics
