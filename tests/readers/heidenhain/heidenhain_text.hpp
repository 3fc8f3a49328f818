// SPDX-License-Identifier: MIT
// Conversational programs for tests.
#pragma once

#include <gtest/gtest.h>
#include <span>
#include <string>
#include <vector>

#include "readers/heidenhain/reader.hpp"
#include "readers/program_checks.hpp"
#include "readers/refusals.hpp"

namespace tribo::readers {

inline motion::Program conversational(std::string_view text, const GcodeOptions& options = {}) {
    const auto program = read_heidenhain(text, options);
    if (!program) {
        ADD_FAILURE() << program.error().text() << "\nin:\n" << text;
        return {};
    }
    return *program;
}

inline motion::Program on(const char* name, std::string_view text) {
    const motion::Machine machine = *motion::named_machine(name);
    GcodeOptions options;
    options.machine = &machine;
    return conversational(text, options);
}

inline std::string fault(std::string_view text) {
    GcodeOptions options;
    options.source_name = "p.h";
    options.max_steps = 10'000;
    const auto program = read_heidenhain(text, options);
    return program ? "" : program.error().text();
}

inline void expect_refused_conversational(std::span<const Refusal> refusals) {
    expect_refused(refusals, [](const std::string& text, const std::string& name) {
        GcodeOptions options;
        options.source_name = name;
        return read_heidenhain(text, options);
    });
}

inline constexpr std::string_view kHeidenhainStart =
    "0 BEGIN PGM P MM\n1 TOOL CALL 1 Z S2000 F500\n2 L X+0 Y+0 Z+10 R0 FMAX M3\n";

inline std::string after_start(std::string_view text) {
    return std::string(kHeidenhainStart) + std::string(text) + "99 END PGM P MM\n";
}

inline double length_of(const motion::Program& program, std::size_t move) {
    return motion::path_length_mm(program.moves.at(move));
}

inline std::vector<double> heights(const motion::Program& program) {
    std::vector<double> z;
    for (const motion::Move& move : program.moves) {
        if (move.kind != motion::MoveKind::dwell) z.push_back(move.end.tip_mm.z);
    }
    return z;
}

}  // namespace tribo::readers
