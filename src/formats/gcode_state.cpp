// SPDX-License-Identifier: MIT
#include "formats/gcode_state.hpp"

#include <utility>

namespace tribo::formats::gcode {

bool Output::first(Note note) {
    return !std::exchange(noted_[static_cast<std::size_t>(note)], true);
}

void Output::warn(int line, std::string text) {
    program.warnings.push_back({options.source_name, line, std::move(text)});
}

std::unexpected<Error> Output::refuse(int line, int column, std::string cause, std::string remedy) const {
    return fail_at(options.source_name, line, column, std::move(cause), std::move(remedy));
}

}  // namespace tribo::formats::gcode
