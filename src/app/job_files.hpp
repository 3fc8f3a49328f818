// SPDX-License-Identifier: MIT
// The files of a job on the disk, for session::read_stock().
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "formats/job.hpp"
#include "io/files.hpp"
#include "session/job_stock.hpp"

namespace tribo::app {

io::FileResult<session::Solid> read_solid(const formats::JobSolid& solid);

struct StockOnDisk {
    session::JobStock stock;
    std::vector<std::string> folders;  // of renders that the stock comes from; absolute, links resolved
};

// session::read_stock() from the disk; a Failure says whose fault it is.
io::FileResult<StockOnDisk> read_stock(const formats::Job& job, Warnings& warnings);

// `file` as it is called from within `folder`.
std::string relative_to(const std::string& folder, const std::string& file);

}  // namespace tribo::app
