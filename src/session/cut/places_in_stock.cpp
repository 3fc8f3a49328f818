// SPDX-License-Identifier: MIT
#include "session/cut/places_in_stock.hpp"

#include <memory>
#include <type_traits>
#include <utility>
#include <vector>

#include "milling/sweep/sweep.hpp"

namespace tribo::session {
namespace {

constexpr double kSamePlaceMm = 1e-6;

motion::Move place_of(const motion::Move& next) {
    motion::Move place;
    place.kind = motion::MoveKind::rapid;
    place.start = place.end = next.start;
    place.tool = next.tool;
    place.line = next.line;
    return place;
}

}  // namespace

void add_places_in_stock(MillSetup& setup, const Box3& blank_mm) {
    const auto is_known = [&](std::size_t n) {
        if (n == 0 || setup.cutter_of_move[n - 1] != setup.cutter_of_move[n]) return false;
        const motion::ToolPose &before = setup.moves[n - 1].end, &now = setup.moves[n].start;
        return distance(before.tip_mm, now.tip_mm) < kSamePlaceMm &&
               distance(before.axis, now.axis) < kSamePlaceMm;
    };
    std::vector<std::size_t> begin;  // moves that a place is put before
    for (std::size_t n = 0; n < setup.moves.size(); ++n) {
        if (setup.moves[n].kind != motion::MoveKind::feed || is_known(n)) continue;
        const auto stands =
            milling::make_sweep(setup.cutters[setup.cutter_of_move[n]], place_of(setup.moves[n]));
        if (stands->bounds_mm().overlaps(blank_mm)) begin.push_back(n);
    }
    if (begin.empty()) return;
    auto schedule = *setup.schedule;
    const auto widen = [&](auto& list, const auto& added) {
        std::remove_reference_t<decltype(list)> wide;
        wide.reserve(list.size() + begin.size());
        auto next = begin.begin();
        for (std::size_t n = 0; n < list.size(); ++n) {
            if (next != begin.end() && *next == n) {
                wide.push_back(added(list[n]));
                ++next;
            }
            wide.push_back(list[n]);
        }
        list = std::move(wide);
    };
    const auto same = [](const auto& entry) { return entry; };
    widen(setup.moves, place_of);
    widen(setup.cutter_of_move, same);
    widen(setup.rpm_of_move, same);
    widen(schedule.moves, [](const motion::MoveTiming& next) {
        motion::MoveTiming timing;
        timing.start_s = timing.end_s = next.start_s;
        return timing;
    });
    setup.schedule = std::make_shared<const motion::Schedule>(std::move(schedule));
}

}  // namespace tribo::session
