// SPDX-License-Identifier: MIT
#include "readers/control/run_limit.hpp"

#include "base/text/decimal.hpp"

namespace tribo::readers {
namespace {

// Characters of blocks that may run without a move, about a second.
constexpr std::size_t kMostIdle = 50'000'000;
// Characters of blocks that may run for each step of GcodeOptions::max_steps. A usual block has 20.
constexpr std::size_t kCharactersPerStep = 25;
// The clock is asked once in so many blocks.
constexpr std::size_t kBlocksPerLook = 1024;

}  // namespace

std::optional<std::string> RunLimit::count(std::size_t characters) {
    ++steps_;
    characters_ += characters + 1;  // with the line end
    if (moves_ != moves_seen_) {
        moves_seen_ = moves_;
        idle_from_ = characters_;
    }
    if (characters_ <= bytes_ + 1) return std::nullopt;
    if (steps_ > options_.max_steps && steps_ > bytes_)
        return describe("more than " + std::to_string(options_.max_steps) + " blocks have run");
    if (characters_ - bytes_ > kCharactersPerStep * options_.max_steps)
        return describe("blocks with more than " + std::to_string(kCharactersPerStep * options_.max_steps) +
                        " characters have run again");
    if (characters_ - idle_from_ > kMostIdle)
        return describe("blocks with more than " + std::to_string(kMostIdle) +
                        " characters have run without a move");
    if (!options_.clock_s || steps_ % kBlocksPerLook != 0) return std::nullopt;
    const double now_s = options_.clock_s();
    if (!start_s_) start_s_ = now_s;
    if (now_s - *start_s_ <= options_.max_loop_s) return std::nullopt;
    return describe("loops and calls have run for " + format_decimal(options_.max_loop_s) + " s");
}

std::string RunLimit::describe(const std::string& what) const {
    return what + ": a loop around this line does not seem to end";
}

}  // namespace tribo::readers
