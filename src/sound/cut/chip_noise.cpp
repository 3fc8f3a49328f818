// SPDX-License-Identifier: MIT
#include "sound/cut/chip_noise.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "base/math.hpp"
#include "noise/play/colour.hpp"
#include "sound/play/calibration.hpp"

namespace tribo::sound {
namespace {

constexpr int kPoints = 7, kOrder = 40;
using Colour = std::array<noise::ColourPoint, kPoints>;

// Of chips half way between fine and coarse. Drawn by ear and by what is known of chip forms (ISO 3685: long
// and tangled from soft metals, short and broken from steel; segmented at a high rate in titanium), not
// measured.
constexpr Colour kSteel{
    {{315, -36}, {800, -16}, {1600, -5}, {3150, 0}, {6300, -1}, {10000, -5}, {16000, -16}}};
constexpr Colour kAluminium{
    {{315, -26}, {800, -8}, {1600, 0}, {3150, -2}, {6300, -8}, {10000, -16}, {16000, -30}}};
constexpr Colour kTitanium{
    {{315, -40}, {800, -24}, {1600, -12}, {3150, -4}, {6300, 0}, {10000, -1}, {16000, -10}}};
constexpr Colour kNickel{
    {{315, -34}, {800, -14}, {1600, -6}, {3150, -1}, {6300, 0}, {10000, -8}, {16000, -22}}};

const Colour& colour_of(ChipMaterial material) {
    switch (material) {
        case ChipMaterial::aluminium:
            return kAluminium;
        case ChipMaterial::titanium:
            return kTitanium;
        case ChipMaterial::nickel:
            return kNickel;
        case ChipMaterial::none:
        case ChipMaterial::steel:
            break;
    }
    return kSteel;
}

// Chips eight times as large are twice as wide, and sound an octave lower.
constexpr double kFinestMm3 = 0.125, kCoarsestMm3 = 8;
constexpr double kHalfRange = 1.4142135623730951;  // fine and coarse stand an octave apart

noise::ModelNoise noise_of(const Colour& colour, double factor, double rate, std::uint64_t seed) {
    std::vector<noise::ColourPoint> moved(colour.begin(), colour.end());
    for (noise::ColourPoint& p : moved) p.hz *= factor;
    return {noise::model_of(moved, rate, kOrder), seed};
}

}  // namespace

ChipMaterial chip_material(std::string_view material) {
    const struct {
        std::string_view begins;
        ChipMaterial material;
    } known[] = {
        {"al", ChipMaterial::aluminium}, {"ti", ChipMaterial::titanium}, {"gh", ChipMaterial::nickel}};
    for (const auto& k : known) {
        if (material.starts_with(k.begins)) return k.material;
    }
    return ChipMaterial::steel;
}

Chips chips_of(const contact::ContactSample& cut) {
    const double per_second = std::abs(cut.phase_rate_rad_per_s) / math::kTwoPi * std::max(cut.edges, 1);
    if (!(per_second > 0 && cut.removed_mm3_per_s > 0)) return {};
    return {per_second, cut.removed_mm3_per_s / per_second};
}

double chip_pressure_pa(const Chips& chips) {
    constexpr double kPerSecond = 1000;
    if (chips.mm3 <= 0) return 0;
    return kChipPascal * std::sqrt(chips.per_second / kPerSecond) * math::pow(chips.mm3, 2.0 / 3);
}

double coarseness(double chip_mm3) {
    if (chip_mm3 <= kFinestMm3) return 0;
    return std::min(math::log(chip_mm3 / kFinestMm3) / math::log(kCoarsestMm3 / kFinestMm3), 1.0);
}

ChipNoise::ChipNoise(const ChipOptions& options, double sample_rate_hz, std::uint64_t seed) {
    if (options.learned && options.learned_bass.share > 0) {
        learned_.emplace(*options.learned, options.learned_bass, sample_rate_hz, seed);
    } else if (options.learned) {
        fine_.emplace(noise::at_rate(*options.learned, sample_rate_hz), seed);
    } else if (options.material != ChipMaterial::none) {
        const Colour& colour = colour_of(options.material);
        fine_.emplace(noise_of(colour, kHalfRange, sample_rate_hz, seed));
        coarse_.emplace(noise_of(colour, 1 / kHalfRange, sample_rate_hz, ~seed));
    }
}

void ChipNoise::render(std::uint64_t index, double coarse, Quantum& out) {
    if (learned_) {
        std::ranges::copy(learned_->block(index), out.begin());
        return;
    }
    const double to = coarse_ ? coarse : 0, from = share_ < 0 ? to : share_;
    share_ = to;
    out.fill(0);
    // The two know nothing of each other: their powers add up to one.
    const auto add = [&](noise::ModelNoise& noise, double a, double b) {
        if (a <= 0 && b <= 0) return;
        const double first = std::sqrt(a), last = std::sqrt(b);
        const auto block = noise.block(index);
        for (std::size_t n = 0; n < out.size(); ++n) {
            const double t = static_cast<double>(n) * (1.0 / kQuantumFrames);
            out[n] += (first + t * (last - first)) * static_cast<double>(block[n]);
        }
    };
    if (fine_) add(*fine_, 1 - from, 1 - to);
    if (coarse_) add(*coarse_, from, to);
}

}  // namespace tribo::sound
