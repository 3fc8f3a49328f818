// SPDX-License-Identifier: MIT
// The data of a Mill. Not installed.
#pragma once

#include <memory>
#include <string>

#include "base/parallel.hpp"
#include "job/job.hpp"
#include "session/cut/mill_session.hpp"
#include "tribo/mill.hpp"

namespace tribo {

struct Mill::State {
    std::string file;
    job::Job job;
    Box3 blank_mm;
    Warnings warnings;
    ParallelFor parallel;
    std::unique_ptr<session::MillSession> session;
    bool done = false;
};

}  // namespace tribo
