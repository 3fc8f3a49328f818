// SPDX-License-Identifier: MIT
// Any bytes give a material that survives being written and read and can be played, or an error with a
// remedy.
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "material/material_json.hpp"
#include "noise/play/friction_voice.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace tribo;
    constexpr std::size_t largest = 1 << 17;
    if (size > largest) return 0;
    const auto material = material::parse_material({reinterpret_cast<const char*>(data), size}, "fuzz.json");
    if (!material) {
        if (material.error().cause.empty() || material.error().remedy.empty()) std::abort();
        return 0;
    }
    const auto again = material::parse_material(material::material_json(*material), "again.json");
    if (!again || again->voices.models.size() != material->voices.models.size()) std::abort();
    if (material->voices.models.empty()) return 0;
    noise::FrictionVoice voice(material->voices);
    std::array<float, 256> out;
    for (const double speed : {1.0, 100.0, 1e4}) {
        voice.set_target(speed, 1);
        voice.render(out);
        for (const float x : out) {
            if (!(x >= -1 && x <= 1)) std::abort();
        }
    }
    return 0;
}
