// SPDX-License-Identifier: MIT
// The key "stock_record" of summary.json of a render: it identifies the stock in the folder for later jobs.
#pragma once

#include <string>

#include "files/files.hpp"
#include "job/stock_record.hpp"

namespace tribo::files {

// Reads summary.json of a folder. Refuses a folder that Tribo did not render, and a folder of an older
// version without a record.
FileResult<job::StockRecord> read_stock_record(const std::string& folder);

}  // namespace tribo::files
