// SPDX-License-Identifier: MIT
// Sets keys of a parsed job. Private to job/: it brings in the TOML library.
#pragma once

#include <span>
#include <string>

#include "base/result.hpp"
#include "job/sweep/job_change.hpp"
#include "job/toml/toml_section.hpp"

namespace tribo::job {

// Sets the keys in this order. A missing table or key is added. Refuses a key that names one of several
// tables without its number, or an element that is not there; `file` stands in the error.
Result<void> apply(std::span<const JobChange> changes, toml::table& job, const std::string& file);

}  // namespace tribo::job
