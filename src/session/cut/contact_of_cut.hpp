// SPDX-License-Identifier: MIT
// What every sense needs to know of a cut, out of the record of the cut: the one place where a cut becomes a
// contact::ContactSample.
#pragma once

#include "contact/contact_sample.hpp"
#include "milling/engagement/cut_row.hpp"
#include "milling/force/row_force.hpp"

namespace tribo::session {

// The contact of the row at `t_s`, with the row's mean force. `edges`: of the cutter. The sample borrows the
// spectrum of `force`.
contact::ContactSample contact_of_cut(const milling::CutRow& row, const milling::RowForce& force, int edges,
                                      double t_s);

// The spindle turns in the air where the row begins, at `t_s`: no force, nothing removed.
contact::ContactSample contact_in_air(const milling::CutRow& row, double t_s);

}  // namespace tribo::session
