// SPDX-License-Identifier: MIT
// Parts of HTML pages: escaped text, and embedded bytes.
#pragma once

#include <span>
#include <string>
#include <string_view>

namespace tribo::report {

// Escapes text for HTML, also for quoted attributes.
std::string escaped(std::string_view text);

std::string base64(std::string_view bytes);

// A WAV file of 16 bits (RIFF, PCM): interleaved samples of `channels` channels, full scale 1.
std::string wav_bytes_16(std::span<const float> interleaved, int channels, double rate_hz);

}  // namespace tribo::report
