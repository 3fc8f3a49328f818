// SPDX-License-Identifier: MIT
#include "session/live/live_compare.hpp"

#include <algorithm>

#include "session/audit/row_loads.hpp"

namespace tribo::session {
namespace {

// Rows whose forces are computed together.
constexpr std::size_t kJoinsAtOnce = 1024;

}  // namespace

std::vector<ComparedRow> compared_rows(const LiveMill& mill, const ParallelFor& parallel) {
    const MillSetup& setup = mill.session().setup();
    const CutChange& change = mill.change();
    std::optional<LoadModel> loads;
    if (mill.extras().limits) loads.emplace(setup, *mill.extras().limits);
    const std::span<const milling::CutRow> rows = mill.record().rows();
    std::vector<ComparedRow> compared;
    compared.reserve(rows.size());
    for (std::size_t first = 0; first < rows.size(); first += kJoinsAtOnce) {
        const auto some = rows.subspan(first, std::min(kJoinsAtOnce, rows.size() - first));
        const auto forces = changed_forces(some, setup, change, some.size(), parallel);
        for (std::size_t n = 0; n < some.size(); ++n) {
            const milling::CutRow row = changed_row(some[n], change);
            const std::optional<double> multiplier = mill.multiplier(first + n);
            std::optional<double> load_ratio;
            if (loads) {
                RowLoads load = loads->loads(row, forces[n].peaks, forces[n].chip_mm);
                if (multiplier) loads->add_multiplier(row.cutter, *multiplier, load);
                load_ratio = *std::ranges::max_element(load.ratio);
            }
            compared.push_back(compared_row(row, forces[n], multiplier, load_ratio));
            compared.back().feed_mm_per_min *= change.feed_factor;
        }
    }
    return compared;
}

}  // namespace tribo::session
