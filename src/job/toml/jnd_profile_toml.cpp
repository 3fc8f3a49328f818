// SPDX-License-Identifier: MIT
#include "job/toml/jnd_profile_toml.hpp"

#include <array>

#include "base/math.hpp"
#include "job/toml/toml_section.hpp"

namespace tribo::job {

using namespace std::string_view_literals;

Result<contact::JndProfile> parse_jnd_profile(std::string_view text, const std::string& name) {
    static constexpr std::array keys{"force_magnitude"sv,     "force_direction_deg"sv,
                                     "vibration_amplitude"sv, "vibration_frequency"sv,
                                     "sound_level_db"sv,      "pitch"sv,
                                     "force_floor_n"sv,       "vibration_floor_n"sv};
    const Result<toml::table> parsed = parse_toml(text, name);
    if (!parsed) return std::unexpected(parsed.error());
    TomlFile file(name);
    TomlSection section(file, *parsed, "", keys);
    contact::JndProfile p;
    const auto read = [&](std::string_view key, const Limit& limit, double& value) {
        value = section.number(key, limit).value_or(value);
    };
    double direction_deg = p.force_direction_rad / math::kRadPerDeg;
    read("force_magnitude", kLimits.noticeable_share, p.force_magnitude);
    read("force_direction_deg", kLimits.noticeable_angle, direction_deg);
    read("vibration_amplitude", kLimits.noticeable_share, p.vibration_amplitude);
    read("vibration_frequency", kLimits.noticeable_share, p.vibration_frequency);
    read("sound_level_db", kLimits.noticeable_level, p.sound_level_db);
    read("pitch", kLimits.noticeable_share, p.pitch);
    read("force_floor_n", kLimits.force_floor, p.force_floor_n);
    read("vibration_floor_n", kLimits.force_floor, p.vibration_floor_n);
    p.force_direction_rad = direction_deg * math::kRadPerDeg;
    if (!file.ok()) return std::unexpected(file.error());
    return p;
}

FileResult<contact::JndProfile> read_jnd_profile(const FileSource& files, const std::string& path) {
    const FileResult<std::string> text = files.read(path, kLargestJobBytes);
    if (!text) return std::unexpected(text.error());
    const auto profile = parse_jnd_profile(*text, path);
    if (!profile) return std::unexpected(FileFailure(profile.error()));
    return *profile;
}

}  // namespace tribo::job
