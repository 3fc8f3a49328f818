// SPDX-License-Identifier: MIT
// The page of `tribo learn --report`: original and voice side by side, as plots and sound. One file that
// opens offline.
#pragma once

#include <string>
#include <vector>

#include "material/material.hpp"
#include "noise/learn/learning.hpp"
#include "noise/learn/voice_quality.hpp"

namespace tribo::report {

struct ReportedVoice {
    std::string recording;  // file
    noise::VoiceModel model;
    noise::VoiceQuality quality;
};

std::string learning_report(const material::Material& material, const noise::Learned& learned,
                            const std::vector<ReportedVoice>& voices);

}  // namespace tribo::report
