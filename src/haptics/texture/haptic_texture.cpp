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
constexpr int kCellBits = 21;

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
    Box3 box;
    for (const contact::TextureRecord& r : records_) box.include(r.place_mm);
    if (records_.empty()) return;
    origin_ = box.min - Vec3{2 * reach_, 2 * reach_, 2 * reach_};
    entries_.reserve(records_.size());
    for (std::size_t n = 0; n < records_.size(); ++n)
        entries_.push_back({cell_of(records_[n].place_mm, 0, 0, 0), static_cast<std::uint32_t>(n)});
    std::sort(entries_.begin(), entries_.end(), [](const Entry& a, const Entry& b) {
        return a.cell != b.cell ? a.cell < b.cell : a.record < b.record;
    });
}

std::uint64_t TextureMap::cell_of(Vec3 p, int dx, int dy, int dz) const {
    const auto along = [&](double v, int d) {
        const double most = (1 << kCellBits) - 2;
        return static_cast<std::uint64_t>(std::clamp(std::floor(v / reach_) + d, 0.0, most));
    };
    return along(p.x - origin_.x, dx) | along(p.y - origin_.y, dy) << kCellBits |
           along(p.z - origin_.z, dz) << 2 * kCellBits;
}

const contact::TextureRecord* TextureMap::nearest(Vec3 place_mm) const {
    const contact::TextureRecord* best = nullptr;
    if (!is_finite(place_mm)) return best;
    double least = reach_ * reach_;
    for (int dz = -1; dz <= 1; ++dz) {
        for (int dy = -1; dy <= 1; ++dy) {
            for (int dx = -1; dx <= 1; ++dx) {
                const std::uint64_t cell = cell_of(place_mm, dx, dy, dz);
                auto at = std::lower_bound(entries_.begin(), entries_.end(), cell,
                                           [](const Entry& e, std::uint64_t c) { return e.cell < c; });
                for (int n = 0; n < kMostLooked && at != entries_.end() && at->cell == cell; ++n, ++at) {
                    const contact::TextureRecord& r = records_[at->record];
                    const double d = squared_length(r.place_mm - place_mm);
                    if (d <= least) {
                        least = d;
                        best = &r;
                    }
                }
            }
        }
    }
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
