// SPDX-License-Identifier: MIT
// Surface speeds that catalogues of tool makers give as usual: rules of thumb, no model of tool life.
#pragma once

#include <optional>
#include <string_view>

#include "milling/tool/cutter.hpp"

namespace tribo::milling {

// How a rule of thumb of surface speeds is named beside its number.
inline constexpr std::string_view kSurfaceSpeedSource =
    "usual surface speed of catalogues for dry cuts with uncoated tools, a rule of thumb";

// The highest usual surface speed, m/min, of a material of the library (materials.hpp). Absent for others.
std::optional<double> usual_surface_speed_m_per_min(std::string_view material, CutterBody body);

}  // namespace tribo::milling
