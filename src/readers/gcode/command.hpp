// SPDX-License-Identifier: MIT
// One block of words, sorted by what they are for: its codes by modal group, its other words by letter.
#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "base/result.hpp"
#include "readers/gcode/codes.hpp"
#include "readers/gcode/text/lexer.hpp"

namespace tribo::readers::gcode {

// A G or M code in tenths, and where it stands.
struct Code {
    int tenths = 0;
    int column = 0;
};

// Points into the block that it was made of.
class Command {
  public:
    // Refuses codes that are not read, two codes of one group, and a letter given twice; the error has line
    // and column but no file.
    static Result<Command> of(const Block& block);

    int line() const { return line_; }
    std::optional<Code> g(GGroup group) const { return g_[static_cast<std::size_t>(group)]; }
    std::optional<Code> m(MGroup group) const { return m_[static_cast<std::size_t>(group)]; }
    bool has_g(GGroup group, int tenths) const { return g(group) && g(group)->tenths == tenths; }

    // Whether the block has the word; says nothing about its use.
    bool has(char letter) const { return words_[index(letter)] != nullptr; }
    bool has_any(std::string_view letters) const;
    // The word, which from now on counts as used; null where the block has none.
    const Word* use(char letter);
    // Leaves the word out of the block from now on.
    void hide(char letter) { words_[index(letter)] = nullptr; }
    void hide_axes() {
        for (const char letter : {'X', 'Y', 'Z'}) hide(letter);
    }
    // The first word in the block that nothing has used; null where none is left.
    const Word* first_unused() const;

  private:
    static std::size_t index(char letter) { return static_cast<std::size_t>(letter - 'A'); }
    Result<void> add_g(const Word& word);
    Result<void> add_m(const Word& word);

    int line_ = 0;
    const Block* block_ = nullptr;
    std::array<const Word*, 26> words_{};
    std::uint32_t used_ = 0;  // bit per letter
    std::array<std::optional<Code>, static_cast<std::size_t>(GGroup::count)> g_;
    std::array<std::optional<Code>, static_cast<std::size_t>(MGroup::count)> m_;
};

// G90.1 for 901.
std::string code_text(char letter, int tenths);

}  // namespace tribo::readers::gcode
