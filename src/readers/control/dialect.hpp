// SPDX-License-Identifier: MIT
// Which control a program is written for, told from its text.
#pragma once

#include <optional>
#include <string_view>

namespace tribo::readers {

enum class Dialect { linuxcnc, fanuc, siemens, heidenhain };

// "LinuxCNC", "Fanuc", "Siemens", "Heidenhain".
std::string_view name_of(Dialect dialect);

// What the first lines say plainly: BEGIN PGM is Heidenhain's; TRAORI, CYCLE800, MSG(, words with '=' are
// Siemens'; an O word alone at the start, GOTO, G43.4 and G68.2 are Fanuc's; o<name>, M428 and named
// parameters LinuxCNC's. None where nothing of the kind stands there: then LinuxCNC's meaning is taken.
std::optional<Dialect> detect_dialect(std::string_view bytes);

}  // namespace tribo::readers
