// SPDX-License-Identifier: MIT
// Errors in just-noticeable differences for tables of sound: how loud (rolloff over distance) and how high
// (Doppler factor over time). That of forces is force_error() in force_table.hpp.
#pragma once

#include "contact/jnd_profile.hpp"
#include "contact/perceptual_table.hpp"

namespace tribo::contact {

// One channel, an amplitude > 0: the difference of levels.
ErrorInJnd level_error(const JndProfile& profile);
// One channel, a factor of frequency > 0.
ErrorInJnd pitch_error(const JndProfile& profile);

}  // namespace tribo::contact
