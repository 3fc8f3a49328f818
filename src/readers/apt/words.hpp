// SPDX-License-Identifier: MIT
// Which APT statements this reader knows, and what it says of those that it knows by name only.
#pragma once

#include <string_view>

namespace tribo::readers::apt {

enum class Action {
    go_to,          // GOTO
    go_by,          // GODLTA
    go_home,        // GOHOME
    rapid,          // RAPID
    feed,           // FEDRAT
    from,           // FROM
    circle,         // CIRCLE, MOVARC
    direction,      // INDIRV
    circle_catia,   // TLON,GOFWD
    cycle,          // CYCLE
    clearance,      // CLEARP
    retract,        // RETRCT
    spindle,        // SPINDL
    load,           // LOADTL, LOAD
    cutter,         // CUTTER
    tool_data,      // TLDATA
    multi_axis,     // MULTAX
    tool_axis,      // TLAXIS
    units,          // UNITS, UNIT
    machine_frame,  // MSYS
    frame,          // CSYS
    frame_type,     // TRNTYP
    translation,    // TRANS
    origin,         // ORIGIN
    delay,          // DELAY
    compensation,   // CUTCOM
    machine_code,   // PREFUN, AUXFUN
    end,            // FINI
    nothing,        // moves no tool: MACHIN, COOLNT, ...
    unread,
};

struct Meaning {
    Action action = Action::unread;
    std::string_view
        what;  // of an unread statement: what it asks for; empty for one that is not known at all
};

// In either case.
Meaning meaning_of(std::string_view word);

}  // namespace tribo::readers::apt
