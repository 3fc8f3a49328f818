// SPDX-License-Identifier: MIT
// WAV files as their definition reads and writes them, apart from the library that does so for the program.
#pragma once

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace tribo::test {

// RIFF read by its definition (Microsoft and IBM 1991): four letters, little-endian length, bytes, even.
struct Riff {
    std::map<std::string, std::string> chunks;
    bool well_formed = false;

    explicit Riff(const std::string& file) {
        if (file.size() < 12 || file.substr(0, 4) != "RIFF" || file.substr(8, 4) != "WAVE") return;
        if (number(file, 4, 4) != file.size() - 8) return;
        std::size_t at = 12;
        while (at + 8 <= file.size()) {
            const std::size_t length = number(file, at + 4, 4);
            chunks[file.substr(at, 4)] = file.substr(at + 8, length);
            at += 8 + length + length % 2;
        }
        well_formed = at == file.size();
    }
    static std::size_t number(const std::string& bytes, std::size_t at, int count) {
        std::size_t value = 0;
        for (int i = count - 1; i >= 0; --i) {
            value = value << 8 | static_cast<unsigned char>(bytes.at(at + static_cast<std::size_t>(i)));
        }
        return value;
    }
    std::size_t format(std::size_t at, int count) const { return number(chunks.at("fmt "), at, count); }
    std::vector<double> samples(int bits) const {
        const std::string& data = chunks.at("data");
        std::vector<double> values;
        const int bytes = bits / 8;
        for (std::size_t at = 0; at + static_cast<std::size_t>(bytes) <= data.size();
             at += static_cast<std::size_t>(bytes)) {
            const auto raw = static_cast<std::uint32_t>(number(data, at, bytes));
            if (bits == 32) {
                values.push_back(static_cast<double>(std::bit_cast<float>(raw)));
            } else {
                const auto high = static_cast<std::int32_t>(raw << (32 - bits));
                values.push_back(static_cast<double>(high) * 0x1p-31);
            }
        }
        return values;
    }
};

inline std::string little_endian(std::uint32_t value, int bytes) {
    std::string s;
    for (int n = 0; n < bytes; ++n) s += static_cast<char>(value >> 8 * n & 255);
    return s;
}

// A WAV file of 16 bits, mono, by the format's definition.
inline std::string wav(int rate_hz, const std::vector<double>& x) {
    const auto rate = static_cast<std::uint32_t>(rate_hz);
    std::string data;
    for (const double v : x) {
        const long n = std::lround(std::clamp(v, -1.0, 1.0) * 32767);
        data += little_endian(static_cast<std::uint32_t>(n), 2);
    }
    const auto size = static_cast<std::uint32_t>(data.size());
    return "RIFF" + little_endian(36 + size, 4) + "WAVEfmt " + little_endian(16, 4) + little_endian(1, 2) +
           little_endian(1, 2) + little_endian(rate, 4) + little_endian(2 * rate, 4) + little_endian(2, 2) +
           little_endian(16, 2) + "data" + little_endian(size, 4) + data;
}

}  // namespace tribo::test
