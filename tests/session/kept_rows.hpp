// SPDX-License-Identifier: MIT
// The rows of a session, kept with their forces.
#pragma once

#include <vector>

#include "session/cut/mill_session.hpp"

namespace tribo::session {

struct KeptRow {
    milling::CutRow row;
    milling::RowForce force;
};

inline MillSinks keep_rows(std::vector<KeptRow>& rows) {
    MillSinks sinks;
    sinks.row = [&rows](const milling::CutRow& row, const milling::RowForce& force) {
        rows.push_back({row, force});
    };
    return sinks;
}

}  // namespace tribo::session
