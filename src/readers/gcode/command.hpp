// SPDX-License-Identifier: MIT
// One block of words, sorted: codes by modal group, other words by letter.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/result.hpp"
#include "readers/gcode/codes.hpp"
#include "readers/gcode/text/lexer.hpp"

namespace tribo::readers::gcode {

// A G or M code in tenths, with its column.
struct Code {
    int tenths = 0;
    int column = 0;
};

// Holds pointers into its block, which must outlive it.
class Command {
  public:
    // Refuses G codes that are not read, two codes of one group, and a repeated letter. With `last_holds` the
    // last of two modes holds, as on Fanuc controls (B-63944, section 3). The error has line and column but
    // no file.
    static Result<Command> of(const Block& block, bool last_holds);

    int line() const { return line_; }
    const Block& block() const { return *block_; }
    std::optional<Code> g(GGroup group) const { return g_[static_cast<std::size_t>(group)]; }
    std::optional<Code> m(MGroup group) const { return m_[static_cast<std::size_t>(group)]; }
    bool has_g(GGroup group, int tenths) const { return g(group) && g(group)->tenths == tenths; }
    bool has_any_m() const;
    // M codes without a group, in order: the machine has them, the path does not.
    const std::vector<Code>& unknown_m() const { return unknown_m_; }

    // A mode that a later code of its block has replaced, and that code.
    std::optional<Code> overruled() const { return overruled_; }
    Code overruling() const { return overruling_; }

    // G41 or G42 beside G150, in tenths: the side of its contour.
    std::optional<int> side_of_pocket() const { return pocket_side_; }
    bool names_next_tool() const { return next_tool_ != nullptr; }
    // True when the block has the word; does not count as use of the word.
    bool has(char letter) const { return words_[index(letter)] != nullptr; }
    bool has_any(std::string_view letters) const;
    // Returns the word and marks it as used; null if the block has none.
    const Word* use(char letter);
    // Removes the word from the command.
    void hide(char letter) { words_[index(letter)] = nullptr; }
    void hide_axes() {
        for (const char letter : {'X', 'Y', 'Z'}) hide(letter);
    }
    // Marks all words but the axes as used.
    void use_rest() { used_ |= ~axis_bits(); }
    // Returns the first word of the block that is not used; null if there is none.
    const Word* first_unused() const;

  private:
    static std::size_t index(char letter) { return static_cast<std::size_t>(letter - 'A'); }
    static std::uint32_t axis_bits() {
        std::uint32_t bits = 0;
        for (const char letter : {'A', 'B', 'C', 'U', 'V', 'W', 'X', 'Y', 'Z'}) {
            bits |= std::uint32_t{1} << index(letter);
        }
        return bits;
    }
    Result<void> add_g(const Word& word);
    Result<void> settle();
    Result<void> add_m(const Word& word);

    int line_ = 0;
    const Block* block_ = nullptr;
    std::array<const Word*, 26> words_{};
    const Word* next_tool_ = nullptr;  // a second T
    std::optional<int> pocket_side_;
    std::uint32_t used_ = 0;  // bit per letter
    std::array<std::optional<Code>, static_cast<std::size_t>(GGroup::count)> g_;
    std::array<std::optional<Code>, static_cast<std::size_t>(MGroup::count)> m_;
    std::vector<Code> unknown_m_;
    bool last_holds_ = false;
    std::optional<Code> overruled_;
    Code overruling_;
};

// For 901: "G90.1".
std::string code_text(char letter, int tenths);

}  // namespace tribo::readers::gcode
