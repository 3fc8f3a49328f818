// SPDX-License-Identifier: MIT
// Parts of HTML pages: escaped text, and embedded bytes.
#pragma once

#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace tribo::report {

// Escapes text for HTML, also for quoted attributes.
std::string escaped(std::string_view text);

std::string base64(std::string_view bytes);

// Replaces every {{mark}} of a page in one pass, so that inserted text is never replaced again.
std::string filled(std::string_view page, const std::function<std::string(std::string_view)>& value);

// JSON that may stand in a script element: only "</" could end it, and '<' occurs only in strings.
std::string json_for_script(std::string_view json);

// A table with a title and a hint, which may be empty. Rows are as long as the header.
struct HtmlTable {
    std::string title, hint;
    std::vector<std::string> header;
    std::vector<std::vector<std::string>> rows;
};
std::string html_of(const HtmlTable& table);

// A box with a list; empty without items. `style`: "bad", or empty for a warning.
std::string notice_list(const std::vector<std::string>& items, const std::string& title,
                        std::string_view style = "");

// A WAV file of 16 bits (RIFF, PCM): interleaved samples of `channels` channels, full scale 1.
std::string wav_bytes_16(std::span<const float> interleaved, int channels, double rate_hz);

}  // namespace tribo::report
