// SPDX-License-Identifier: MIT
// Converts a row of a cut to a contact::ContactSample. This is the only place that does.
#pragma once

#include "contact/contact_sample.hpp"
#include "milling/engagement/cut_row.hpp"
#include "milling/force/row_force.hpp"

namespace tribo::session {

// The contact of the row at `t_s`, with the mean force of the row. `edges`: number of cutting edges. The
// sample refers to the spectrum of `force`, which must outlive it.
contact::ContactSample contact_of_cut(const milling::CutRow& row, const milling::RowForce& force, int edges,
                                      double t_s);

// The spindle turns in air at the start of the row, at `t_s`: no force, no removed material.
contact::ContactSample contact_in_air(const milling::CutRow& row, double t_s);

}  // namespace tribo::session
