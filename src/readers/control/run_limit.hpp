// SPDX-License-Identifier: MIT
// Ends programs whose loops and calls would run for ever.
#pragma once

#include <cstddef>
#include <optional>
#include <string>

#include "readers/gcode/reader.hpp"

namespace tribo::readers {

// A program that runs each of its lines at most once never reaches a limit: they count from the moment when
// more characters have run than the program has.
class RunLimit {
  public:
    static constexpr const char* kRemedy =
        "correct the loop's condition, or write the path out without loops";

    // `moves`: the number of moves so far. The arguments must outlive the object.
    RunLimit(const GcodeOptions& options, std::size_t bytes, const std::size_t& moves)
        : options_(options), bytes_(bytes), moves_(moves) {}

    // Counts a block of so many characters. Returns why the program may not go on; none if it may.
    std::optional<std::string> count(std::size_t characters);

  private:
    std::string describe(const std::string& what) const;

    const GcodeOptions& options_;
    std::size_t bytes_;
    const std::size_t& moves_;
    std::size_t steps_ = 0, characters_ = 0;
    std::size_t moves_seen_ = 0, idle_from_ = 0;  // characters_ at the last move
    std::optional<double> start_s_;
};

}  // namespace tribo::readers
