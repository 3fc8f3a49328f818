// SPDX-License-Identifier: MIT
// What bends with each cutter of a job.
#pragma once

#include "base/result.hpp"
#include "job/job.hpp"
#include "session/cut/mill_session.hpp"

namespace tribo::session {

// Gives the setup the modes of its job for each cutter: those that the job states, and those that it asks to
// estimate, with a warning that says so for each cutter. Refuses an estimate of a cutter without a stick-out,
// which a program or a tool table may bring.
Result<void> add_modes(const job::Job& job, MillSetup& setup, Warnings& warnings);

}  // namespace tribo::session
