// SPDX-License-Identifier: MIT
#include "session/feel/surface_waves.hpp"

#include <algorithm>
#include <cmath>

#include "haptics/texture/haptic_texture.hpp"

namespace tribo::session {
namespace {

constexpr double kMeanS = 0.1;

}  // namespace

Vec3 SurfaceWaves::force(const haptics::ProbeContact& contact, double tick_s) noexcept {
    const auto wave = contact.in_contact ? error_.wave_at(contact.proxy_mm) : std::nullopt;
    if (!wave) {
        touching_ = false;
        return {};
    }
    if (!touching_) mean_mm_ = wave->left_mm;
    touching_ = true;
    mean_mm_ += std::min(tick_s / kMeanS, 1.0) * (wave->left_mm - mean_mm_);
    const double gain =
        haptics::groove_gain(dot(contact.slip_mm_per_s, wave->along), wave->shortest_mm, 1 / tick_s);
    const double out = mean_mm_ + gain * (wave->left_mm - mean_mm_);
    if (out == 0) return {};
    const double share = std::clamp(contact.penetration_mm / std::abs(out), 0.0, 1.0);
    return stiffness_n_per_mm_ * share * out * contact.normal;
}

}  // namespace tribo::session
