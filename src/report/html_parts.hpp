// SPDX-License-Identifier: MIT
// What pages are made of: text that cannot break out, bytes inside the page.
#pragma once

#include <span>
#include <string>
#include <string_view>

namespace tribo::report {

// Text for HTML, outside and inside of quoted attributes.
std::string escaped(std::string_view text);

std::string base64(std::string_view bytes);

// A WAV file of 16 bits (RIFF, PCM): samples of `channels` channels in turn, full scale 1.
std::string wav_bytes_16(std::span<const float> interleaved, int channels, double rate_hz);

}  // namespace tribo::report
