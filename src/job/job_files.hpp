// SPDX-License-Identifier: MIT
// The files that a job names, with the places of their keys.
#pragma once

#include "base/file_result.hpp"
#include "job/job.hpp"

namespace tribo::job {

// Returns the failure at the key of the job that names the file, if that is not there; else as it is.
FileFailure at_key(const Job& job, FileFailure failure);

}  // namespace tribo::job
