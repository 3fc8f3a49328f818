// SPDX-License-Identifier: MIT
#include <vector>

#include "job/toml/sections.hpp"

namespace tribo::job {
namespace {

using namespace std::string_view_literals;

constexpr std::array kKeys{"file"sv, "direction"sv, "on"sv, "band_hz"sv, "modes"sv, "unit"sv};

}  // namespace

JobFrf read_frf(TomlFile& file, const toml::table& table) {
    TomlSection section(file, table, "[[frf]]", kKeys);
    JobFrf frf;
    frf.file = section.required_path("file");
    if (!section.has("direction")) section.missing("direction");
    frf.direction = read_direction(section, "direction", frf.direction);
    if (section.word("on", kModeOnWords).value_or(0) == 1) frf.on = dynamics::ModeOn::part;
    if (const auto band = section.numbers("band_hz", kLimits.mode_frequency)) {
        if (band->size() == 2 && (*band)[0] < (*band)[1]) {
            frf.from_hz = (*band)[0];
            frf.to_hz = (*band)[1];
        } else {
            section.fail("band_hz", "'band_hz' is no band",
                         "write two rising frequencies, as in [200, 3000]");
        }
    }
    frf.modes = section.integer("modes", kLimits.fitted_modes);
    std::vector<std::string_view> units;
    units.reserve(readers::kResponseUnits.size());
    for (const readers::ResponseUnit& unit : readers::kResponseUnits) units.push_back(unit.name);
    if (const auto unit = section.word("unit", units)) frf.unit = &readers::kResponseUnits[*unit];
    return frf;
}

}  // namespace tribo::job
