// SPDX-License-Identifier: MIT
// What the tests of Siemens programs share.
#pragma once

#include <gtest/gtest.h>
#include <string>
#include <string_view>

#include "readers/program_checks.hpp"
#include "readers/siemens/reader.hpp"

namespace tribo::readers {

// Three lines: a known place above the zero, with spindle and tool.
inline constexpr std::string_view kSiemensStart =
    "N10 G71 G90 G17 G54 G64\nN20 T1 D1 M6\nN30 G0 X0 Y0 Z10 S3000 M3\n";

// The program of `text` behind kSiemensStart.
inline motion::Program siemens(std::string_view text, const GcodeOptions& options = {}) {
    const auto program = read_siemens(std::string(kSiemensStart) + std::string(text), options);
    if (!program) {
        ADD_FAILURE() << program.error().text() << "\nin:\n" << text;
        return {};
    }
    return *program;
}

// The end of its last move.
inline Vec3 end_of(const motion::Program& program) {
    return program.moves.empty() ? Vec3{} : program.moves.back().end.tip_mm;
}

}  // namespace tribo::readers
