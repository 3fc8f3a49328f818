// SPDX-License-Identifier: MIT
// A short way for the G-code tests to read a text.
#pragma once

#include <gtest/gtest.h>
#include <string_view>

#include "readers/gcode/reader.hpp"
#include "readers/program_checks.hpp"

namespace tribo::readers {

// A program that is known to be readable.
inline motion::Program program_of(std::string_view text, const GcodeOptions& options = {}) {
    const auto program = read_gcode(text, options);
    if (!program) {
        ADD_FAILURE() << program.error().text() << "\nin:\n" << text;
        return {};
    }
    return *program;
}

}  // namespace tribo::readers
