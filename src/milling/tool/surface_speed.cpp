// SPDX-License-Identifier: MIT
#include "milling/tool/surface_speed.hpp"

namespace tribo::milling {
namespace {

struct UsualSpeed {
    std::string_view begin;  // of the names of the materials
    double carbide, high_speed_steel;
};
constexpr UsualSpeed kUsualSpeeds[] = {
    {"al", 600, 150},     // wrought aluminium
    {"ti6al4v", 60, 15},  // titanium
    {"gh909", 40, 8},     // a nickel and iron superalloy
    {"steel", 150, 30},   // unalloyed
};

}  // namespace

std::optional<double> usual_surface_speed_m_per_min(std::string_view material, CutterBody body) {
    for (const UsualSpeed& usual : kUsualSpeeds)
        if (material.starts_with(usual.begin))
            return body == CutterBody::carbide ? usual.carbide : usual.high_speed_steel;
    return std::nullopt;
}

}  // namespace tribo::milling
