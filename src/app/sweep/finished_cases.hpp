// SPDX-License-Identifier: MIT
// Which cases of a sweep are finished, and where their results stand. 32 bytes a case.
#pragma once

#include <array>
#include <cstdint>
#include <fstream>
#include <optional>
#include <string>
#include <vector>

#include "app/sweep/case_store.hpp"

namespace tribo::app {

class FinishedCases {
  public:
    // Reads all files of results in the folder.
    static FileResult<FinishedCases> read(const std::string& folder);

    std::size_t count() const { return places_.size(); }
    // Results beyond one for each case: of cases that ran twice, as on a node that seemed dead.
    std::size_t repeated() const { return repeated_; }
    // True where the case has results or a reason; a case whose process died counts only with `and_died`.
    bool has(const CaseId& id, bool and_died = false) const;
    // No value where the case is not finished. Of several results of one case the first is taken. One thread.
    FileResult<std::optional<CaseResult>> result(const CaseId& id) const;

  private:
    using Key = std::array<std::uint64_t, 2>;
    struct Entry {
        Key key;
        std::uint64_t offset;
        std::uint32_t file;
        bool died;
    };
    static Key key_of(const CaseId& id);
    const Entry* find(const CaseId& id) const;

    // A file that stays open: cases of neighbouring numbers stand in the files of all tasks in turn.
    struct OpenFile {
        std::uint32_t file = 0;
        std::ifstream in;
    };
    std::ifstream& opened(std::uint32_t file) const;

    std::vector<std::string> files_;
    mutable std::vector<OpenFile> open_;
    std::vector<Entry> places_;  // sorted by key
    std::size_t repeated_ = 0;
};

}  // namespace tribo::app
