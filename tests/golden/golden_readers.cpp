// SPDX-License-Identifier: MIT
#include <string>
#include <string_view>

#include "base/hash.hpp"
#include "base/noise_hash.hpp"
#include "base/text/decimal.hpp"
#include "golden/golden.hpp"
#include "readers/gcode/reader.hpp"
#include "readers/mesh/model.hpp"

namespace tribo::golden {

// A G-code program with arcs of every kind and its lengths; a model in text with numbers of many digits.
std::uint64_t readers() {
    Hash hash;
    const CounterNoise noise(4);
    std::string program = "G21 G90 G17 S6000 M3 F900\nG0 X0 Y0 Z5\nG1 Z-1.25\n";
    for (std::uint64_t i = 0; i < 50; ++i) {
        const auto word = [&](char letter, std::uint64_t n) {
            return letter + format_decimal(noise.gaussian(8 * i + n)) + " ";
        };
        program += "G91 G1 " + word('X', 0) + word('Y', 1) + word('Z', 2) + "\n";
        program += "G2 X1.5 Y-.5 R" + format_decimal(1 + noise.uniform(8 * i + 3)) + "\n";
        program += "G3 X0 Y0 " + word('I', 4) + word('J', 5) + word('Z', 6) + "\n";
    }
    const auto read = readers::read_gcode(program);
    if (!read) return 0;
    for (const motion::Move& move : read->moves) {
        hash.add(move.end.tip_mm);
        hash.add(motion::path_length_mm(move));
        hash.add(motion::pose_at(move, 0.3).tip_mm);
    }

    std::string model;
    for (std::uint64_t i = 0; i < 300; ++i) {
        model += "v";
        for (std::uint64_t n = 0; n < 3; ++n)
            model += ' ' + format_decimal(10 * noise.gaussian(1000 + 3 * i + n));
        model += '\n';
        if (i >= 2) model += "f -1 -2 -3\n";
    }
    readers::ModelOptions options;
    options.source_name = "golden.obj";
    const auto obj = readers::read_model(model, options);
    if (!obj) return 0;
    for (const Point3f& p : obj->mesh.positions) hash.add(p);
    hash.add(obj->mesh.triangles.size());
    hash.add(area_mm2(obj->mesh));
    return hash.value();
}

}  // namespace tribo::golden
