// SPDX-License-Identifier: MIT
// Which APT statements this reader knows, and what it says of those that it knows by name only.
#pragma once

#include <string_view>

namespace tribo::formats::apt {

enum class Action {
    go_to,         // GOTO
    rapid,         // RAPID
    feed,          // FEDRAT
    from,          // FROM
    spindle,       // SPINDL
    load,          // LOADTL, LOAD
    cutter,        // CUTTER
    multi_axis,    // MULTAX
    units,         // UNITS, UNIT
    delay,         // DELAY
    compensation,  // CUTCOM
    end,           // FINI
    nothing,       // moves no tool: MACHIN, COOLNT, ...
    unread,
};

struct Meaning {
    Action action = Action::unread;
    std::string_view
        what;  // of an unread statement: what it asks for; empty for one that is not known at all
};

// In either case.
Meaning meaning_of(std::string_view word);

}  // namespace tribo::formats::apt
