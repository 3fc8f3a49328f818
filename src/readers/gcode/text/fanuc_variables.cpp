// SPDX-License-Identifier: MIT
#include "readers/gcode/text/fanuc_variables.hpp"

#include <cmath>

#include "base/text/limit_text.hpp"
#include "readers/gcode/state.hpp"

namespace tribo::readers::gcode {
namespace {

// Origins of G54 to G59: 20 numbers each, the first three for X, Y and Z.
constexpr int kFirstWork = 5221, kWorkStep = 20, kWorkCount = 6;
// The same of G54.1 P1 to P48.
constexpr int kFirstMoreWork = 7001, kMoreWorkCount = 48;

struct WorkPlace {
    std::size_t system;
    int axis;
};
std::optional<WorkPlace> work_place(int number) {
    const auto within = [&](int first, int count, std::size_t base) -> std::optional<WorkPlace> {
        if (number < first || number >= first + count * kWorkStep) return std::nullopt;
        const int axis = (number - first) % kWorkStep;
        if (axis >= 3) return std::nullopt;
        return WorkPlace{base + static_cast<std::size_t>((number - first) / kWorkStep), axis};
    };
    if (const auto place = within(kFirstWork, kWorkCount, 0)) return place;
    return within(kFirstMoreWork, kMoreWorkCount, kWorkSystems);
}

double motion_code(const State& state) {
    switch (state.plain_motion) {
        case MotionMode::line:
            return 1;
        case MotionMode::arc_clockwise:
            return 2;
        case MotionMode::arc_counter_clockwise:
            return 3;
        default:
            return 0;
    }
}

}  // namespace

std::optional<double> fanuc_system_variable(int number, const State& state) {
    if (number >= kFirstHeading && number < kFirstHeading + 3) {
        if (!state.heading) return std::nullopt;
        const Vec3 at = state.tip_mm - state.origin_mm();
        return normalized(state.frame.written(at + *state.heading) -
                          state.frame.written(at))[number - kFirstHeading];
    }
    if (const auto place = work_place(number)) {
        return state.work[place->system].origin_mm[place->axis] / state.unit_mm;
    }
    switch (number) {
        case 4001:
            return motion_code(state);
        case 4002:
            return state.plane == Plane::xy ? 17 : state.plane == Plane::zx ? 18 : 19;
        case 4003:
            return state.incremental ? 91 : 90;
        case 4005:
            return state.feed_mode == FeedMode::inverse_time ? 93
                   : state.feed_mode == FeedMode::per_minute ? 94
                                                             : 95;
        case 4006:
            return state.unit_mm == 1 ? 21 : 20;
        case 4007:
            return state.compensation.is_on ? state.compensation.code / 10 : 40;
        case 4009:
            return state.motion == MotionMode::cycle ? state.cycle.tenths / 10 : 80;
        case 4010:
            return state.retract_to_r ? 99 : 98;
        case 4014:
            return state.active_work < 6 ? 54 + state.active_work : 54.1;
        case 4109:
            return state.feed.value_or(0) / (state.feed_mode == FeedMode::inverse_time ? 1 : state.unit_mm);
        case 3027:  // Haas
        case 4119:
            return state.spindle_rpm;
        case 3026:  // Haas
        case 4120:
            return state.tool();
        default:
            return std::nullopt;
    }
}

Result<bool> set_fanuc_system_variable(int number, double value, State& state) {
    if (number == kClearingDepth) {
        state.clearing_depth_mm = std::abs(value) * state.unit_mm;
        return true;
    }
    const auto place = work_place(number);
    if (!place) return false;
    const double origin_mm = value * state.unit_mm;
    if (!kLimits.coordinate.range.contains(origin_mm))
        return fail(out_of_range(kLimits.coordinate, origin_mm), range_remedy(kLimits.coordinate));
    WorkSystem& work = state.work[place->system];
    work.origin_mm[place->axis] = origin_mm;
    work.set = true;
    return true;
}

}  // namespace tribo::readers::gcode
