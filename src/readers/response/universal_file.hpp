// SPDX-License-Identifier: MIT
// The datasets of a Universal File. Private to readers/response/.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/result.hpp"

namespace tribo::readers {

// Dataset 164: lengths and forces of the file over those in m and N.
struct UniversalUnits {
    double length = 1, force = 1;
};

// A place and a direction.
struct UniversalPoint {
    std::string_view name;
    long long node = 0;
    int direction = 0;  // 1 to 3: x, y, z; 4 to 6: turns; negative: against it; 0: not said

    bool operator==(const UniversalPoint&) const = default;
};

struct UniversalAxis {
    int type =
        0;  // 0 unknown, 1 general, 8 displacement, 11 velocity, 12 acceleration, 13 force, 18 frequency
    std::string_view label, unit;
};

// Dataset 58: a function of one variable. The numbers are not read yet.
struct UniversalFunction {
    int line = 0;    // of its first line
    int number = 0;  // of all functions of the file, from 1
    int kind = 0;    // 1 time response, 4 frequency response
    UniversalPoint response, reference;
    bool is_complex = false, is_double = false, is_even = false;
    std::size_t points = 0;
    double first = 0, step = 0;  // of the abscissa, where it is even
    UniversalAxis abscissa, numerator, denominator;
    std::optional<UniversalUnits> units;  // the dataset 164 before it, else the first one after it
    // Its numbers: text from this line on, or binary.
    std::string_view data;
    int data_line = 0;
    bool is_binary = false, is_big_endian = false;
    bool has_single_abscissa = false;  // binary: beside double numbers
};

// Whether the text begins with a dataset, after a byte order mark and empty lines.
bool is_universal_file(std::string_view bytes);

// The functions of a file; other datasets are passed over. Refuses damaged datasets 58 and 164. Linear in the
// bytes. The views look into them.
Result<std::vector<UniversalFunction>> read_functions(std::string_view bytes, const std::string& source_name);

// The numbers of a function as they stand: abscissa where it is uneven, value, imaginary part where it is
// complex. All finite.
Result<std::vector<double>> read_numbers(const UniversalFunction& function, const std::string& source_name);

}  // namespace tribo::readers
