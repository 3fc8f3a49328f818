// SPDX-License-Identifier: MIT
#include "milling/engagement/chip.hpp"

#include <algorithm>

#include "base/math.hpp"
#include "milling/tool/cutter_profile.hpp"

namespace tribo::milling {
namespace {

// Returns the largest value of the law between two rotations.
double largest(const TurnLaw& law, double entry_rad, double exit_rad) {
    const auto at = [&](double phi) {
        return law.sine * math::sin(phi) + law.cosine * math::cos(phi) + law.constant;
    };
    double most = std::max(at(entry_rad), at(exit_rad));
    double crest = math::atan2(law.sine, law.cosine);
    if (crest < 0) crest += math::kTwoPi;
    if (crest > entry_rad && crest < exit_rad) most = std::max(most, at(crest));
    return most;
}

}  // namespace

double thickest_chip_mm(const Engagement& engagement, const ToolTravel& feed_per_tooth,
                        const Cutter& cutter) {
    const CutterProfile profile(cutter);
    double most = 0;
    for (const EngagementBand& b : engagement.bands) {
        const ProfilePoint middle = profile.at(profile.at_height(0.5 * (b.z0_mm + b.z1_mm)));
        most = std::max(most, largest(normal_travel(feed_per_tooth, middle), b.entry_rad, b.exit_rad));
    }
    for (const BottomBand& b : engagement.bottom) {
        const ProfilePoint middle = point_of(b, 0.5 * (b.r0_mm + b.r1_mm));
        most = std::max(most, largest(normal_travel(feed_per_tooth, middle), b.entry_rad, b.exit_rad));
    }
    return most;
}

ChipVerdict chip_verdict(double thickest_mm, const Cutter& cutter) {
    if (thickest_mm < kRubbingChipMm) return ChipVerdict::rubs;
    return thickest_mm > kOverloadShare * cutter.diameter_mm ? ChipVerdict::overloads : ChipVerdict::cuts;
}

void ChipFindings::add(const CutRow& row, double thickest_mm, const Cutter& cutter) {
    const ChipVerdict verdict = chip_verdict(thickest_mm, cutter);
    const double seconds = row.duration_s();
    if (verdict != ChipVerdict::rubs || row.line != open_line_) open_s_ = 0;
    if (verdict == ChipVerdict::rubs) {
        rubbing_s += seconds;
        open_line_ = row.line;
        open_s_ += seconds;
        if (open_s_ > longest_s_) {
            longest_s_ = open_s_;
            rubbing_line = row.line;
        }
    }
    const double share = thickest_mm / (kOverloadShare * cutter.diameter_mm);
    if (share > overload) {
        overload = share;
        overload_mm = thickest_mm;
        overload_line = row.line;
    }
    if (verdict == ChipVerdict::overloads && row.line != last_overloaded_) {
        last_overloaded_ = row.line;
        ++overloaded_lines;
    }
}

}  // namespace tribo::milling
