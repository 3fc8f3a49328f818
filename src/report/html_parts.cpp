// SPDX-License-Identifier: MIT
#include "report/html_parts.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace tribo::report {
namespace {

void append_little_endian(std::string& bytes, std::uint32_t value, int count) {
    for (int i = 0; i < count; ++i) bytes += static_cast<char>(value >> (8 * i) & 0xFF);
}

}  // namespace

std::string escaped(std::string_view text) {
    std::string out;
    for (const char c : text) {
        switch (c) {
            case '&':
                out += "&amp;";
                break;
            case '<':
                out += "&lt;";
                break;
            case '>':
                out += "&gt;";
                break;
            case '"':
                out += "&quot;";
                break;
            default:
                out += c;
        }
    }
    return out;
}

std::string base64(std::string_view bytes) {
    constexpr std::string_view kLetters = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string out;
    out.reserve((bytes.size() + 2) / 3 * 4);
    for (std::size_t i = 0; i < bytes.size(); i += 3) {
        const auto byte = [&](std::size_t k) {
            return i + k < bytes.size() ? static_cast<std::uint32_t>(static_cast<unsigned char>(bytes[i + k]))
                                        : 0U;
        };
        const std::uint32_t bits = byte(0) << 16 | byte(1) << 8 | byte(2);
        for (std::size_t k = 0; k < 4; ++k) {
            out += i + k > bytes.size() ? '=' : kLetters[bits >> (18 - 6 * k) & 63];
        }
    }
    return out;
}

std::string filled(std::string_view page, const std::function<std::string(std::string_view)>& value) {
    std::string out;
    while (true) {
        const std::size_t open = page.find("{{");
        const std::size_t close = open == page.npos ? page.npos : page.find("}}", open);
        if (close == page.npos) return out.append(page);
        out.append(page.substr(0, open));
        out += value(page.substr(open + 2, close - open - 2));
        page.remove_prefix(close + 2);
    }
}

std::string json_for_script(std::string_view json) {
    std::string safe;
    for (const char c : json) {
        if (c == '<') {
            safe += "\\u003c";
        } else {
            safe += c;
        }
    }
    return safe;
}

std::string html_of(const HtmlTable& table) {
    std::string html = "<section><h2>" + escaped(table.title) + "</h2>\n";
    if (!table.hint.empty()) html += "<p class=\"hint\">" + escaped(table.hint) + "</p>\n";
    html += "<div class=\"wide\"><table><tr>";
    for (const std::string& name : table.header) html += "<th scope=\"col\">" + escaped(name) + "</th>";
    html += "</tr>\n";
    for (const std::vector<std::string>& row : table.rows) {
        html += "<tr>";
        for (const std::string& cell : row) html += "<td>" + escaped(cell) + "</td>";
        html += "</tr>\n";
    }
    return html + "</table></div></section>\n";
}

std::string notice_list(const std::vector<std::string>& items, const std::string& title,
                        std::string_view style) {
    if (items.empty()) return "";
    std::string html = "<div class=\"notice " + std::string(style) + "\"><b>" + title + "</b>\n<ul>\n";
    for (const std::string& item : items) html += "<li>" + escaped(item) + "</li>\n";
    return html + "</ul></div>\n";
}

std::string wav_bytes_16(std::span<const float> interleaved, int channels, double rate_hz) {
    const auto rate = static_cast<std::uint32_t>(std::lround(rate_hz));
    const auto frame = static_cast<std::uint32_t>(2 * channels);
    const auto length = static_cast<std::uint32_t>(2 * interleaved.size());
    std::string wav = "RIFF";
    append_little_endian(wav, 36 + length, 4);
    wav += "WAVEfmt ";
    append_little_endian(wav, 16, 4);
    append_little_endian(wav, 1, 2);  // PCM
    append_little_endian(wav, frame / 2, 2);
    append_little_endian(wav, rate, 4);
    append_little_endian(wav, frame * rate, 4);
    append_little_endian(wav, frame, 2);
    append_little_endian(wav, 16, 2);
    wav += "data";
    append_little_endian(wav, length, 4);
    for (const float sample : interleaved) {
        const float full = std::clamp(sample, -1.0F, 1.0F);
        append_little_endian(wav, static_cast<std::uint32_t>(std::lround(full * 32767.0F)) & 0xFFFF, 2);
    }
    return wav;
}

}  // namespace tribo::report
