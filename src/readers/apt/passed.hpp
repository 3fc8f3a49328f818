// SPDX-License-Identifier: MIT
// The words that are passed over: each machine has words for its post-processor, and they move no tool.
#pragma once

#include <optional>
#include <vector>

#include "readers/apt/report.hpp"

namespace tribo::readers::apt {

class PassedWords {
  public:
    // Refuses what has not the shape of such a word, and words that begin like GOTO.
    Result<void> add(const Item& word, const Report& report);
    // For a file in which nothing else is known: refuses its first word, if there is one.
    Result<void> refuse_first(const Report& report) const;
    // Warns of each word once, in its first line.
    void warn(Report& report) const;

  private:
    std::vector<Item> words_;
    std::size_t more_ = 0;
};

}  // namespace tribo::readers::apt
