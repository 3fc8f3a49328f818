// SPDX-License-Identifier: MIT
// Modes out of measured frequency responses.
#pragma once

#include <cstdint>

#include "job/file_source.hpp"
#include "job/frf.hpp"
#include "job/job.hpp"

namespace tribo::job {

inline constexpr std::uint64_t kLargestResponseBytes = std::uint64_t{128} << 20;

// Fits the modes of a response as the section wants it. `file` is its name in messages; adds those of the
// response, and warns of other signs and of a large residual.
Result<dynamics::ModeFit> fit_response(const readers::FrequencyResponse& response, const JobFrf& wanted,
                                       Warnings& warnings);

// Reads the file of each [[frf]] of the job and adds the fitted modes to those of the job. `memory_bytes` as
// in LoadOptions.
FileResult<void> add_fitted_modes(const FileSource& files, Job& job, std::uint64_t memory_bytes,
                                  Warnings& warnings);

}  // namespace tribo::job
