// SPDX-License-Identifier: MIT
#include "session/cut/stock_at_time.hpp"

namespace tribo::session {

StockAtTime::StockAtTime(MillSetup setup, ParallelFor parallel, double start_s)
    : session_(std::move(setup), std::move(parallel)) {
    advance(start_s);
    reader_ = session_.read_stock();
}

void StockAtTime::advance(double program_s) {
    if (program_s > session_.milled_s()) (void)session_.run_to(program_s, {});
}

}  // namespace tribo::session
