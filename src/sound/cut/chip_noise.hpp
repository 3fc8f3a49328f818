// SPDX-License-Identifier: MIT
// The noise that chips make in the air: how loud by their number and size, of which colour by their material.
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

// What breaks off: hard and short, soft and long, or segmented. `none`: nothing is heard of chips.
enum class ChipMaterial : std::uint8_t { none, steel, aluminium, titanium, nickel };

// By a name of the materials' library; a material without a known name sounds as steel.
ChipMaterial chip_material(std::string_view material);

struct ChipOptions {
    ChipMaterial material = ChipMaterial::none;
    double level = 1;  // of the pressure
    // The colour of a recorded cut, whatever the material. It has poles; bass without a share is none.
    std::optional<noise::ArModel> learned{};
    noise::BassModel learned_bass{};

    bool sounds() const { return material != ChipMaterial::none || learned; }
};

// What the chips of a moment are: how many come off per second, and the volume of one. Where the number of
// edges is not told they are taken as one per turn.
struct Chips {
    double per_second = 0, mm3 = 0;
};
Chips chips_of(const contact::ContactSample& cut);

// RMS pressure at 1 m. Chips that do not know of each other add their powers, and each is as loud as the
// force that breaks it, which grows with its section: kChipPascal sqrt(per_second / 1000) mm3^(2/3).
double chip_pressure_pa(const Chips& chips);

// Where chips of this volume stand between fine (0) and coarse (1).
double coarseness(double chip_mm3);

// Noise with a mean square of 1. Real-time safe after construction, 3 ns a sample where chips are fine or
// coarse, 6 between; one thread at a time.
class ChipNoise {
  public:
    ChipNoise(const ChipOptions& options, double sample_rate_hz, std::uint64_t seed);

    // Block `index` of the stream, of chips that are `coarse` (0 ... 1) by its end.
    void render(std::uint64_t index, double coarse, Quantum& out);

  private:
    std::optional<noise::DetailedNoise> learned_;  // alone
    std::optional<noise::ModelNoise> fine_, coarse_;
    double share_ = -1;  // of the coarse; below 0: not yet told
};

}  // namespace tribo::sound
