// SPDX-License-Identifier: MIT
// Detects from the text of a program for which control it is written.
#pragma once

#include <optional>
#include <string_view>

namespace tribo::readers {

enum class Dialect { linuxcnc, fanuc, siemens, heidenhain };

// "LinuxCNC", "Fanuc", "Siemens", "Heidenhain".
std::string_view name_of(Dialect dialect);

// Detects the control from clear signs in the first lines. Heidenhain: BEGIN PGM. Siemens: TRAORI, CYCLE800,
// MSG(, words with '='. Fanuc: an O word alone at the start, GOTO, WHILE DO, G65, G43.4, G68.2. LinuxCNC:
// o<name>, M428, named parameters. Returns none without a sign; callers then assume LinuxCNC.
std::optional<Dialect> detect_dialect(std::string_view bytes);

}  // namespace tribo::readers
