// SPDX-License-Identifier: MIT
// Noise of chips in the air. Number and size of the chips set the level, the material sets the spectrum.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

#include "contact/contact_sample.hpp"
#include "noise/model/ar_model.hpp"
#include "noise/play/bass_noise.hpp"
#include "noise/play/model_noise.hpp"
#include "sound/cut/voice.hpp"

namespace tribo::sound {

// Kind of chips: hard and short, soft and long, or segmented. `none`: no chip noise.
enum class ChipMaterial : std::uint8_t { none, steel, aluminium, titanium, nickel };

// By a name of the materials library. An unknown name gives steel.
ChipMaterial chip_material(std::string_view material);

struct ChipOptions {
    ChipMaterial material = ChipMaterial::none;
    double level = 1;  // of the pressure
    // Spectrum of a recorded cut in place of the material. The model must have poles. Bass without a share is
    // off.
    std::optional<noise::ArModel> learned{};
    noise::BassModel learned_bass{};

    bool sounds() const { return material != ChipMaterial::none || learned; }
};

// Number of chips per second, and volume of one chip. If the number of edges is unknown, one chip per turn.
struct Chips {
    double per_second = 0, mm3 = 0;
};
Chips chips_of(const contact::ContactSample& cut);

// RMS pressure at 1 m: kChipPascal sqrt(per_second / 1000) mm3^(2/3). Independent chips add their powers. The
// pressure of one chip is proportional to its breaking force, so to its cross-section.
double chip_pressure_pa(const Chips& chips);

// Coarseness of chips of this volume, from fine (0) to coarse (1).
double coarseness(double chip_mm3);

// Noise with a mean square of 1. Real-time safe after construction. 3 ns per sample for fine or coarse chips,
// 6 ns between. One thread at a time.
class ChipNoise {
  public:
    ChipNoise(const ChipOptions& options, double sample_rate_hz, std::uint64_t seed);

    // Renders block `index` of the stream. `coarse` (0 ... 1) is the coarseness at its end.
    void render(std::uint64_t index, double coarse, Quantum& out);

  private:
    std::optional<noise::DetailedNoise> learned_;  // alone
    std::optional<noise::ModelNoise> fine_, coarse_;
    double share_ = -1;  // share of the coarse noise; negative: not set yet
};

}  // namespace tribo::sound
