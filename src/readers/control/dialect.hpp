// SPDX-License-Identifier: MIT
// Detects from the text of a program for which control it is written.
#pragma once

#include <array>
#include <optional>
#include <string_view>

namespace tribo::readers {

enum class Dialect { linuxcnc, fanuc, siemens, heidenhain, num };

// Their words in job files and flags, in their order.
inline constexpr std::array<std::string_view, 5> kDialectWords{"linuxcnc", "fanuc", "siemens", "heidenhain",
                                                               "num"};

// None for another word.
std::optional<Dialect> dialect_of(std::string_view word);

// "LinuxCNC", "Fanuc", "Siemens", "Heidenhain", "NUM".
std::string_view name_of(Dialect dialect);

// Detects the control from clear signs in the first lines. Heidenhain: BEGIN PGM. Siemens: TRAORI, CYCLE800,
// MSG(, GOTOF, DEF, words with '='. Fanuc: an O word alone at the start, GOTO, WHILE DO, G65, G43.4, G68.2.
// LinuxCNC: o<name>, M428, named parameters. Returns none without a sign; callers then assume LinuxCNC.
std::optional<Dialect> detect_dialect(std::string_view bytes);

// Returns the line that tells a program of the ISG kernel (Beckhoff TwinCAT CNC and others), whose words are
// not read: #VAR, #CS, #RTCP, V.L.NAME, L CYCLE.
std::optional<int> line_of_isg_kernel(std::string_view bytes);

}  // namespace tribo::readers
