// SPDX-License-Identifier: MIT
#include "job/job_files.hpp"

#include <algorithm>

namespace tribo::job {

FileFailure at_key(const Job& job, FileFailure failure) {
    if (failure.fault != FileFault::missing || failure.line != 0) return failure;
    const auto named = std::ranges::find(job.files, failure.file, &JobFile::path);
    if (named == job.files.end()) return failure;
    return FileFailure({job.file, named->line, named->column,
                        "'" + named->key + "' names " + failure.file + ", which is not there",
                        "correct the name: it is taken from the folder of the job file"},
                       failure.fault);
}

}  // namespace tribo::job
