// SPDX-License-Identifier: MIT
// The files of a job on the disk, for session::read_stock().
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "files/files.hpp"
#include "job/job.hpp"
#include "session/cut/job_stock.hpp"

namespace tribo::app {

FileResult<job::Solid> read_solid(const job::JobSolid& solid);

struct StockOnDisk {
    session::JobStock stock;
    std::vector<std::string> folders;  // of renders that the stock comes from; absolute, links resolved
};

// session::read_stock() from the disk; a FileFailure says whose fault it is.
FileResult<StockOnDisk> read_stock(const job::Job& job, Warnings& warnings);

// `file` as it is called from within `folder`.
std::string relative_to(const std::string& folder, const std::string& file);

}  // namespace tribo::app
