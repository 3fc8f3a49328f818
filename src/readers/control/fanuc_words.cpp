// SPDX-License-Identifier: MIT
#include "readers/control/fanuc_words.hpp"

#include "readers/control/fadal_words.hpp"
#include "readers/control/num_words.hpp"
#include "readers/control/word_translator.hpp"
#include "readers/text/text_lines.hpp"

namespace tribo::readers {

std::string in_fanuc_words(std::string_view bytes, OtherControl control) {
    if (control == OtherControl::num) return num_in_fanuc_words(bytes);
    if (control == OtherControl::fadal) return fadal_in_fanuc_words(bytes);
    WordTranslator translator(control, bytes);
    std::string text;
    TextLines lines(bytes);
    while (const auto line = lines.next()) {
        text += translator.line(*line);
        text += '\n';
    }
    return text;
}

}  // namespace tribo::readers
