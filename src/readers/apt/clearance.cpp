// SPDX-License-Identifier: MIT
#include "readers/apt/clearance.hpp"

namespace tribo::readers::apt {

Result<void> Clearance::set(const Statement& statement, const Path& path, Report& report) {
    const auto& items = statement.items;
    if (!items.empty() && matches(items[0].text, "OFF")) {
        plane_.reset();
        return {};
    }
    constexpr std::string_view planes[] = {"YZPLAN", "ZXPLAN", "XYPLAN"};
    Plane plane;
    std::size_t height = 0;
    if (items.size() == 4) {
        const auto normal = path.read_direction(statement, 0);
        if (!normal) return std::unexpected(normal.error());
        plane.normal = *normal;
        height = 3;
    } else if (items.size() == 2) {
        int k = 0;
        while (k < 3 && !matches(items[0].text, planes[k])) ++k;
        if (k == 3) return report.refuse(items[0], quoted(items[0].text) + " is no plane", "write XYPLAN");
        plane.normal = {};
        plane.normal[k] = 1;
        height = 1;
    } else if (items.size() != 1) {
        return report.refuse(statement.word, "CLEARP without a plane", "write CLEARP/XYPLAN,z");
    }
    const auto value = report.number(items[height], kLimits.coordinate, path.settings.unit_mm);
    if (!value) return std::unexpected(value.error());
    const Frame& frame = path.frames.to_program();
    plane.distance_mm = *value * path.settings.unit_mm;
    plane.normal = frame.turn(plane.normal);
    plane.distance_mm += dot(plane.normal, frame.origin_mm);
    plane_ = plane;
    return {};
}

Result<void> Clearance::retract(const Statement& statement, Path& path, Report& report) const {
    if (!statement.items.empty() && !matches(statement.items[0].text, "ON")) {
        return report.refuse(statement.items[0], "RETRCT with conditions is not read",
                             "let the CAM system write it as GOTO with tool axes");
    }
    if (!path.place()) return {};
    // Without a plane the post retracts to the height of the machine's own.
    if (!plane_) {
        path.leave_to_home(statement);
        return {};
    }
    motion::ToolPose end = *path.place();
    const double rise = dot(end.axis, plane_->normal);
    const double gap = plane_->distance_mm - dot(end.tip_mm, plane_->normal);
    if (rise < 1e-3) {
        return report.refuse(statement.word, "the tool axis does not lead to the clearance plane",
                             "correct CLEARP");
    }
    if (gap <= 0) return {};
    end.tip_mm += gap / rise * end.axis;
    return path.go(end, motion::MoveKind::rapid, statement.word);
}

}  // namespace tribo::readers::apt
