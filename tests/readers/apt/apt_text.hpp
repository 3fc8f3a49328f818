// SPDX-License-Identifier: MIT
// APT programs for tests.
#pragma once

#include <gtest/gtest.h>
#include <span>
#include <string>
#include <string_view>

#include "readers/apt/reader.hpp"
#include "readers/program_checks.hpp"
#include "readers/refusals.hpp"

namespace tribo::readers {

inline motion::Program apt(std::string_view text, const AptOptions& options = {}) {
    const auto program = read_apt(text, options);
    if (!program) {
        ADD_FAILURE() << program.error().text() << "\nin:\n" << text;
        return {};
    }
    return *program;
}

// `text` after the settings that most programs share: millimetres and a feed of 100 mm/min.
inline motion::Program apt_in_mm(const std::string& text) {
    return apt("UNITS/MM\nFEDRAT/100\n" + text);
}

inline void expect_refused_apt(std::span<const Refusal> refusals) {
    expect_refused(refusals, [](const std::string& text, const char* name) {
        AptOptions options;
        options.source_name = name;
        return read_apt(text, options);
    });
}

}  // namespace tribo::readers
