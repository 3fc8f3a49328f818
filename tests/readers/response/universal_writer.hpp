// SPDX-License-Identifier: MIT
// Writes datasets of Universal Files as their writers do.
#pragma once

#include <array>
#include <bit>
#include <cstdint>
#include <cstdio>
#include <string>
#include <utility>
#include <vector>

namespace tribo::readers {

enum class Bytes { text, little, big };

struct Dataset58 {
    int kind = 4;
    std::string response_name = "NONE";
    int response_node = 1, response_direction = 1;
    std::string reference_name = "NONE";
    int reference_node = 1, reference_direction = 1;
    int type = 5;  // of the numbers
    bool even = true;
    double first = 0, step = 0;
    int abscissa = 18, numerator = 8, denominator = 13;
    std::string numerator_label = "NONE", numerator_unit = "NONE", denominator_unit = "NONE";
    std::vector<std::vector<double>> rows;  // of each point: abscissa where uneven, value, imaginary part
    const char* line_end = "\n";
    Bytes bytes = Bytes::text;
    bool single_abscissa = false;  // binary
    int points = -1;               // if not those of the rows
};

inline std::string print(const char* format, auto... values) {
    char text[200];
    std::snprintf(text, sizeof text, format, values...);
    return text;
}

inline void append_binary(std::string& to, double value, bool is_double, Bytes order) {
    const std::uint64_t bits = is_double ? std::bit_cast<std::uint64_t>(value)
                                         : std::bit_cast<std::uint32_t>(static_cast<float>(value));
    const int size = is_double ? 8 : 4;
    for (int n = 0; n < size; ++n)
        to += static_cast<char>(bits >> 8 * (order == Bytes::little ? n : size - 1 - n) & 0xFF);
}

inline std::string numbers_of(const Dataset58& d) {
    std::string text;
    const bool is_double = d.type == 4 || d.type == 6;
    if (d.bytes != Bytes::text) {
        for (const auto& row : d.rows)
            for (std::size_t n = 0; n < row.size(); ++n)
                append_binary(text, row[n], is_double && !(d.single_abscissa && !d.even && n == 0), d.bytes);
        return text;
    }
    // 6E13.5, 4E20.12, E13.5 with E20.12 twice.
    std::size_t width = 0;
    for (const auto& row : d.rows) {
        for (std::size_t n = 0; n < row.size(); ++n) {
            const bool is_wide = is_double && (d.even || n > 0);
            text += is_wide ? print("%20.12E", row[n]) : print("%13.5E", row[n]);
            width += is_wide ? 20 : 13;
            if (width > 80 - (is_double ? 20 : 13) || (is_double && !d.even && n + 1 == row.size())) {
                text += d.line_end;
                width = 0;
            }
        }
    }
    if (width > 0) text += d.line_end;
    return text;
}

inline std::string written(const Dataset58& d) {
    const std::string end = d.line_end, numbers = numbers_of(d);
    const int points = d.points >= 0 ? d.points : static_cast<int>(d.rows.size());
    std::string text = "    -1" + end;
    if (d.bytes == Bytes::text) {
        text += "    58" + end;
    } else {
        text += print("    58b%6d%6d%12d%12d%6d%6d%12d%12d", d.bytes == Bytes::little ? 1 : 2, 2, 11,
                      static_cast<int>(numbers.size()), 0, 0, 0, 0) +
                end;
    }
    text += "Tip of the tool" + end + "NONE" + end + "18-Apr-24 13:49:58" + end + "NONE" + end + "NONE" + end;
    text += print("%5d%10d%5d%10d %-10s%10d%4d %-10s%10d%4d", d.kind, 0, 0, 0, d.response_name.c_str(),
                  d.response_node, d.response_direction, d.reference_name.c_str(), d.reference_node,
                  d.reference_direction) +
            end;
    text +=
        print("%10d%10d%10d%13.5E%13.5E%13.5E", d.type, points, d.even ? 1 : 0, d.first, d.step, 0.0) + end;
    const auto axis = [&](int type, const std::string& label, const std::string& unit) {
        text += print("%10d%5d%5d%5d %-20s %-20s", type, 0, 0, 0, label.c_str(), unit.c_str()) + end;
    };
    axis(d.abscissa, "Frequency", "Hz");
    axis(d.numerator, d.numerator_label, d.numerator_unit);
    axis(d.denominator, "NONE", d.denominator_unit);
    axis(0, "NONE", "NONE");
    return text + numbers + "    -1" + end;
}

inline const std::string kHeader151 =
    "    -1\n   151\nModel\nNONE\nprogram\n18-Apr-24  13:49:58\nNONE\nNONE\n18-Apr-24  13:50:00\n    -1\n";
inline const std::string kNodes15 =
    "    -1\n    15\n         1         0         0        11  0.00000E+00  0.00000E+00  1.00000E+00\n    "
    "-1\n";
// Lengths in mm, forces in N.
inline const std::string kMillimetres164 =
    "    -1\n   164\n        10mm (newton)                 2\n  1.00000000000000000D+03  "
    "1.00000000000000000D+00  "
    "1.00000000000000000D+00\n  2.73149999999999980D+02\n    -1\n";

}  // namespace tribo::readers
