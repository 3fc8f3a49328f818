// SPDX-License-Identifier: MIT
#include "session/cut/mill_warnings.hpp"

#include <cmath>

#include "base/text/decimal.hpp"

namespace tribo::session {
namespace {

// A larger deviation of the balance gives a warning.
constexpr double kBalanced = 0.01;
// A cause is named where it explains this share of the deviation.
constexpr double kMostOfIt = 0.8;
// Every cut begins and ends with thin chips. Rubbing gives a warning from this share of the cutting time on.
constexpr double kRubbingShare = 0.1;
// Less of what is removed is not worth a warning.
constexpr double kLittle = 1e-4;
// Less is the rounding of a tool that just touches.
constexpr double kStoodInMm3 = 0.1;

// Rounds to 1 / `parts`.
std::string rounded(double value, double parts) {
    return format_decimal(std::round(value * parts) / parts);
}

}  // namespace

Warnings warnings_of(const MillTotals& totals, const std::string& job, const std::string& program) {
    Warnings warnings;
    if (totals.removed_mm3 == 0 && totals.rows > 0) {
        warnings.push_back({job, 0,
                            "the tool cuts, but the grid is too coarse to measure what it removes; try a "
                            "finer --resolution"});
    } else if (totals.removed_mm3 == 0) {
        warnings.push_back({job, 0,
                            "nothing was cut: the tool never meets the stock; check the path's units and "
                            "zero, and the stock's place"});
    }
    if (totals.is_stock_gone) {
        warnings.push_back({job, 0,
                            "nothing is left of the stock: the program mills all of it away; check the "
                            "stock's size and place, and the units of program and cutter"});
    }
    if (totals.stood_in_mm3 > kStoodInMm3) {
        warnings.push_back({program, totals.stood_in_line,
                            "the path begins inside the stock: the " + rounded(totals.stood_in_mm3, 10) +
                                " mm3 that the tool stands in are taken as gone, without a force; add an "
                                "approach, or give a stock that leaves room for the tool"});
    }
    const bool is_unbalanced = totals.energy_balance && std::abs(*totals.energy_balance - 1) > kBalanced;
    if (is_unbalanced) {
        const std::string share = "the spindle's work is " + rounded(*totals.energy_balance, 1000) +
                                  " of what the metal removed asks for: ";
        const double missing_mm3 = (1 - *totals.energy_balance) * totals.fed_mm3;
        if (totals.edgeless_mm3 > kMostOfIt * missing_mm3 && missing_mm3 > 0) {
            warnings.push_back({program, totals.edgeless_line,
                                share + "no edge cuts " + rounded(totals.edgeless_mm3, 1) +
                                    " mm3 of it, first here, as when a tool is pulled back with its shank "
                                    "in the stock; give the true length of its edges. Or the contact is "
                                    "narrower than a cell of the grid, as at a thin rib; try a finer "
                                    "--resolution"});
        } else if (totals.core_mm3 > kMostOfIt * missing_mm3 && missing_mm3 > 0) {
            warnings.push_back(
                {program, totals.core_line,
                 share + "the tool has no edges in its middle (core_mm), and " +
                     rounded(totals.core_mm3, 10) +
                     " mm3 that it goes down into are removed without a force, most of it here; "
                     "leave core_mm out of a tool that cuts over centre"});
        } else {
            warnings.push_back(
                {job, 0, share + "the force is off by about as much; try a finer --resolution"});
        }
    }
    const bool is_told = totals.edgeless_mm3 > kMostOfIt * totals.unseen_mm3 && is_unbalanced;
    if (totals.unseen_mm3 > kLittle * totals.fed_mm3 && !is_told) {
        warnings.push_back({program, totals.unseen_line,
                            rounded(totals.unseen_mm3, 10) +
                                " mm3 are removed without the force of it, most of it here: the contact is "
                                "narrower than a cell of the grid, as at a thin rib, or no edge cuts, as "
                                "where a shank is pulled through the stock; try a finer --resolution, and "
                                "give the true length of the edges"});
    }
    const milling::ChipFindings& chips = totals.chips;
    if (chips.rubbing_s > kRubbingShare * totals.cutting_s) {
        warnings.push_back(
            {program, chips.rubbing_line,
             "the teeth rub rather than cut in " + rounded(100 * chips.rubbing_s / totals.cutting_s, 1) +
                 " % of the cutting time, longest here: the chip is thinner than " +
                 format_decimal(milling::kRubbingChipMm) + " mm (a rule of thumb); try more feed per tooth"});
    }
    if (chips.overload > 1) {
        const std::size_t others = chips.overloaded_lines - 1;
        warnings.push_back(
            {program, chips.overload_line,
             "a tooth takes a chip of " + rounded(chips.overload_mm, 1000) + " mm, " +
                 rounded(chips.overload, 10) + " times " + format_decimal(100 * milling::kOverloadShare) +
                 " % of the cutter's diameter (a rule of thumb)" +
                 (others > 0 ? ", and " + std::to_string(others) + " more lines overload" : "") +
                 "; try less feed per tooth"});
    }
    return warnings;
}

}  // namespace tribo::session
