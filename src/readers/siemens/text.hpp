// SPDX-License-Identifier: MIT
// The lines of a program file with what its flow needs: programs, labels, and where structures end.
#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace tribo::readers::siemens {

// What stands before the words of a block.
struct Head {
    bool is_deletable = false;  // '/'
    std::string number;         // N10, :10; empty: none
    std::string label;          // in upper case; empty: none
    std::size_t at = 0;         // of the first word
};
Head head_of(std::string_view line);

// The line up to its ';' comment.
std::string_view code_of(std::string_view line);

// A program of the file.
struct Unit {
    std::size_t begin = 0, end = 0;
    std::optional<std::size_t> proc;  // line of its PROC
    bool is_subprogram = false;       // its header says _SPF
};

class Text {
  public:
    explicit Text(std::string_view bytes);

    std::size_t size() const { return lines_.size(); }
    std::string_view line(std::size_t i) const { return lines_[i]; }
    const std::vector<Unit>& units() const { return units_; }
    // The program that runs first.
    const Unit& main() const { return units_[main_]; }
    // By its name in upper case (%_N_NAME_SPF, PROC NAME); null: it is not in the file.
    const Unit* unit_named(const std::string& name) const;

    // IF: its ELSE or ENDIF. ELSE: its ENDIF. WHILE, FOR, LOOP, REPEAT: their end. An end: its beginning.
    // None where the partner is missing.
    std::optional<std::size_t> partner(std::size_t line) const;

    enum class Way { forward, backward, both };
    // The line of a label or block number, first in the direction of the jump.
    std::optional<std::size_t> place_of(const std::string& label, std::size_t from, Way way,
                                        const Unit& unit) const;

  private:
    void find_structure(std::size_t i, std::string_view code, const std::string& word,
                        std::vector<std::size_t>& open);

    std::vector<std::string_view> lines_;
    std::vector<Unit> units_;
    std::map<std::string, std::size_t> unit_names_;  // indices of units_
    std::size_t main_ = 0;
    std::map<std::string, std::vector<std::size_t>> places_;
    std::map<std::size_t, std::size_t> partners_;
};

}  // namespace tribo::readers::siemens
