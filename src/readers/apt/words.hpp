// SPDX-License-Identifier: MIT
// The APT statements known to this reader, and messages for those it knows but does not read.
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
    direction,      // INDIRV, INDIRP
    surface,        // PSIS
    circle_catia,   // TLON,GOFWD
    arc_slope,      // ARCSLP
    cycle,          // CYCLE
    clearance,      // CLEARP
    retract,        // RETRCT
    spindle,        // SPINDL
    load,           // LOADTL, LOAD
    tool_kind,      // TOOLNO
    cutter,         // CUTTER
    tool_data,      // TLDATA
    multi_axis,     // MULTAX
    tool_axis,      // TLAXIS
    units,          // UNITS, UNIT
    machine_frame,  // MSYS
    work_frame,     // MCSYS
    transform,      // TRACUT
    turn,           // ROTATE, ROTABL, ROTHED
    mode,           // MODE
    frame,          // CSYS
    frame_type,     // TRNTYP
    translation,    // TRANS
    origin,         // ORIGIN
    delay,          // DELAY
    compensation,   // CUTCOM
    machine_code,   // PREFUN, AUXFUN
    end,            // FINI
    nothing,        // no effect on the tool path: MACHIN, COOLNT, ...
    unread,         // known, and refused
    unknown,
};

struct Meaning {
    Action action = Action::unknown;
    std::string_view what;  // of an unread statement: its purpose
};

// Case is ignored, and blanks after a comma.
Meaning meaning_of(std::string_view word);

// True for a word of the shape that post-processors use: two letters or more, then letters, digits, '_' and
// '-'. What follows a comma does not count.
bool is_post_word(std::string_view word);

}  // namespace tribo::readers::apt
