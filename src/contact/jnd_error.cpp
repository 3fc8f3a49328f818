// SPDX-License-Identifier: MIT
#include "contact/jnd_error.hpp"

#include <cmath>

#include "base/math.hpp"

namespace tribo::contact {

ErrorInJnd level_error(const JndProfile& profile) {
    return [jnd_db = profile.sound_level_db](std::span<const double> truth, std::span<const double> shown) {
        return std::abs(20 * math::log10(shown[0] / truth[0])) / jnd_db;
    };
}

ErrorInJnd pitch_error(const JndProfile& profile) {
    return [jnd = profile.pitch](std::span<const double> truth, std::span<const double> shown) {
        return std::abs(shown[0] / truth[0] - 1) / jnd;
    };
}

}  // namespace tribo::contact
