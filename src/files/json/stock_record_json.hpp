// SPDX-License-Identifier: MIT
// The key "stock_record" of a render's summary.json: how a later job finds out which stock the folder shows.
#pragma once

#include <string>

#include "files/files.hpp"
#include "job/stock_record.hpp"

namespace tribo::files {

// Out of the summary.json of a folder. Refuses a folder that Tribo did not render, and one of an older
// version, which left no record.
FileResult<job::StockRecord> read_stock_record(const std::string& folder);

}  // namespace tribo::files
