// SPDX-License-Identifier: MIT
// Any bytes give a profile of finite thresholds, which survives being written and read, or an error with a
// remedy.
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string>
#include <string_view>
#include <utility>

#include "base/math.hpp"
#include "base/text/decimal.hpp"
#include "job/toml/jnd_profile_toml.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace tribo;
    constexpr std::size_t largest = 1 << 16;
    if (size > largest) return 0;
    const auto profile = job::parse_jnd_profile({reinterpret_cast<const char*>(data), size}, "fuzz.toml");
    if (!profile) {
        if (profile.error().cause.empty() || profile.error().remedy.empty()) std::abort();
        return 0;
    }
    const auto values = [](const contact::JndProfile& p) {
        return std::array{std::pair{"force_magnitude", p.force_magnitude},
                          std::pair{"force_direction_deg", p.force_direction_rad / math::kRadPerDeg},
                          std::pair{"vibration_amplitude", p.vibration_amplitude},
                          std::pair{"vibration_frequency", p.vibration_frequency},
                          std::pair{"sound_level_db", p.sound_level_db},
                          std::pair{"pitch", p.pitch},
                          std::pair{"force_floor_n", p.force_floor_n},
                          std::pair{"vibration_floor_n", p.vibration_floor_n}};
    };
    std::string text;
    for (const auto& [key, value] : values(*profile)) {
        if (!(value > 0 && value <= 90.001)) std::abort();
        text += std::string(key) + " = " + format_decimal(value) + '\n';
    }
    const auto again = job::parse_jnd_profile(text, "again.toml");
    if (!again) {
        // The angle may round to just above its limit on its way to radians and back.
        if (again.error().cause.find("force_direction_deg") == std::string::npos) std::abort();
        return 0;
    }
    for (std::size_t n = 0; n < values(*again).size(); ++n) {
        const double is = values(*again)[n].second, was = values(*profile)[n].second;
        if (!(std::abs(is - was) <= 1e-15 * was)) std::abort();
    }
    return 0;
}
