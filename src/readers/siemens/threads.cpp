// SPDX-License-Identifier: MIT
// Threads that are milled: CYCLE70 and CYCLE90.
#include <algorithm>
#include <cmath>

#include "base/math.hpp"
#include "readers/siemens/interpreter.hpp"

namespace tribo::readers::siemens {
namespace {

constexpr double kMostTurns = 10'000;
constexpr double kSameMm = 1e-6;

}  // namespace

// The centre of a cycle that may state it, in the plane.
Vec3 Interpreter::centre_of(const Call& call, std::size_t at_u, std::size_t at_v) const {
    const auto [u, v, w] = axes();
    Vec3 centre = path_.tip();
    if (call.has(at_u)) centre[u] = scale_[u] * call.at(at_u) * unit_mm_;
    if (call.has(at_v)) centre[v] = scale_[v] * call.at(at_v) * unit_mm_;
    return to_plane(centre);
}

Result<void> Interpreter::mill_helix(const Helix& helix) {
    const auto end = control::mill_helix(helix, to_plane(path_.tip()), mover());
    return end ? Result<void>{} : std::unexpected(end.error());
}

// CYCLE90(RTP, RFP, SDIS, DP, DPR, DIATH, KDIAM, PIT, FFR, CDIR, TYPTH, CPA, CPO): a thread, milled from
// RFP + SDIS down.
Result<void> Interpreter::mill_thread(const Call& call) {
    const Place where{call.line, call.column};
    const auto depths = depths_of(call, 4, kNoParameter);
    if (!depths) return std::unexpected(depths.error());
    const auto feed = cycle_feed(call, 8);
    if (!feed) return std::unexpected(feed.error());
    const double scale = std::abs(scale_[axes()[0]]) * unit_mm_;
    Helix helix;
    helix.is_outside = call.at(10) == 1;
    const double hole = std::abs(call.at(5)) * scale / 2;
    const double tool =
        path_.clearing_radius_mm(unit_mm_, where.line, helix.is_outside ? control::kOpenMm : hole);
    helix.radius = helix.is_outside ? std::abs(call.at(6)) * scale / 2 + tool : hole - tool;
    helix.lead = helix.is_outside ? std::max(tool, helix.radius / 2) : helix.radius / 2;
    const double pitch = std::abs(call.at(7)) * scale;
    helix.turns = (depths->near - depths->bottom) / pitch;
    if (!(helix.radius > kSameMm) || !(pitch > 0) || !(helix.turns <= kMostTurns)) {
        return path_.refuse(where, "CYCLE90: the tool does not fit, or the pitch is none",
                            "correct DIATH, KDIAM and PIT, or take a smaller tool");
    }
    helix.way = call.at(9) == 3 ? 1 : -1;
    helix.centre = centre_of(call, 11, 12);
    helix.from_z = depths->near;
    helix.to_z = depths->bottom;
    helix.feed = *feed;
    const Vec3 now = to_plane(path_.tip());
    if (auto done = mill_to({now.x, now.y, depths->back}, {}, {}); !done) return done;
    if (auto done = mill_helix(helix); !done) return done;
    const Vec3 end = to_plane(path_.tip());
    return mill_to({end.x, end.y, depths->back}, {}, {});
}

// CYCLE70(RTP, RFP, SDIS, DP, DIATH, H1, FAL, PIT, NT, MID, FFR, TYPTH, PA, PO, NSP, VARI, ...): a thread by
// a plate of one tooth, between RFP and DP. VARI: 2 in the units finishes in one cut; 2 in the tens mills
// from the bottom up; 1 in the hundreds is a left-hand thread.
Result<void> Interpreter::mill_thread_of_plate(const Call& call) {
    const Place where{call.line, call.column};
    const auto depths = depths_of(call, kNoParameter, 22);
    if (!depths) return std::unexpected(depths.error());
    const auto feed = cycle_feed(call, 10);
    if (!feed) return std::unexpected(feed.error());
    if (call.at(8) > 1) {
        return path_.refuse(where, "CYCLE70 with a plate of more than one tooth is not read",
                            "let the CAM system write the path with G0 to G3");
    }
    const double scale = std::abs(scale_[axes()[0]]) * unit_mm_;
    const double diameter = std::abs(call.at(4)) * scale, depth = std::abs(call.at(5)) * scale;
    const double pitch = std::abs(call.at(7)) * scale;
    const int kind = static_cast<int>(std::clamp(call.at(15), 0.0, 9999.0));
    const bool finishes = kind % 10 == 2, goes_up = kind / 10 % 10 == 2, is_left = kind / 100 % 10 == 1;
    Helix helix;
    helix.is_outside = call.at(11) == 1;
    const double tool = path_.clearing_radius_mm(unit_mm_, where.line,
                                                 helix.is_outside ? control::kOpenMm : diameter / 2 - depth);
    const double cut = finishes ? depth : std::max(depth - std::abs(call.at(6)) * scale, 0.0);
    const double infeed = std::abs(call.at(9)) * scale;
    const double cuts = !finishes && infeed > 0 ? std::max(1.0, std::ceil(cut / infeed - 1e-9)) : 1;
    helix.turns = (depths->top - depths->bottom) / pitch;
    const double final_radius =
        helix.is_outside ? diameter / 2 - cut + tool : diameter / 2 - depth + cut - tool;
    const double first_radius = helix.is_outside ? final_radius : diameter / 2 - depth + cut / cuts - tool;
    if (!(first_radius > kSameMm) || !(pitch > 0) || !(helix.turns * cuts <= kMostTurns)) {
        return path_.refuse(where, "CYCLE70: the tool does not fit, or the pitch is none",
                            "correct DIATH, H1 and PIT, or take a smaller tool");
    }
    helix.way = is_left == goes_up ? -1 : 1;  // a right-hand helix turns to the left on its way up
    helix.centre = centre_of(call, 12, 13);
    helix.from_z = goes_up ? depths->bottom : depths->top;
    helix.to_z = goes_up ? depths->top : depths->bottom;
    helix.feed = *feed;
    const Vec3 now = to_plane(path_.tip());
    if (auto done = mill_to({now.x, now.y, depths->back}, {}, {}); !done) return done;
    for (double k = 1; k <= cuts; ++k) {
        const double now_cut = cut * k / cuts;
        helix.radius =
            helix.is_outside ? diameter / 2 - now_cut + tool : diameter / 2 - depth + now_cut - tool;
        helix.lead = helix.is_outside ? std::max(tool, helix.radius / 2) : helix.radius / 2;
        if (auto done = mill_helix(helix); !done) return done;
        const Vec3 end = to_plane(path_.tip());
        if (auto done = mill_to({end.x, end.y, depths->back}, {}, {}); !done) return done;
    }
    return {};
}

}  // namespace tribo::readers::siemens
