// SPDX-License-Identifier: MIT
#include "readers/apt/frames.hpp"

#include <cmath>
#include <vector>

#include "readers/text/length_unit.hpp"

namespace tribo::readers::apt {
namespace {

// Directions are written with about six digits. A larger deviation from a right angle is not a rotation.
constexpr double kSquareTolerance = 1e-3;

// Reads all items as numbers. There must be exactly `count`.
Result<std::vector<double>> numbers(const Statement& statement, std::size_t count, Report& report) {
    if (statement.items.size() != count) {
        return report.refuse(
            statement.word,
            quoted(statement.word.text) + " has " + std::to_string(statement.items.size()) + " numbers",
            "write " + std::to_string(count) + " of them");
    }
    std::vector<double> out;
    for (const Item& item : statement.items) {
        const auto value = report.number(item, kLimits.coordinate);
        if (!value) return std::unexpected(value.error());
        out.push_back(*value);
    }
    return out;
}

// For two directions that should be perpendicular.
Result<Frame> frame_of(Vec3 x, Vec3 y, Vec3 origin_mm, const Statement& statement, Report& report) {
    if (std::abs(length(x) - 1) > kSquareTolerance || std::abs(length(y) - 1) > kSquareTolerance ||
        std::abs(dot(x, y)) > kSquareTolerance) {
        return report.refuse(statement.word, quoted(statement.word.text) + " is not a turn without stretch",
                             "give axes of length 1 that are square to each other");
    }
    Frame frame;
    frame.x = normalized(x);
    frame.z = normalized(cross(frame.x, y));
    frame.y = cross(frame.z, frame.x);
    frame.origin_mm = origin_mm;
    return frame;
}

bool is_identity(const Frame& f) {
    return f.x == Vec3{1, 0, 0} && f.y == Vec3{0, 1, 0} && f.origin_mm == Vec3{};
}

}  // namespace

Frame Frame::inverse() const {
    Frame out{{x.x, y.x, z.x}, {x.y, y.y, z.y}, {x.z, y.z, z.z}, {}};
    out.origin_mm = -out.turn(origin_mm);
    return out;
}

void Frames::update() {
    to_program_ = machine_;
    if (type_ == Type::local) to_program_ = machine_ * local_;
    to_program_.origin_mm += translation_mm_;
}

Result<void> Frames::set_machine_frame(const Statement& statement, double unit_mm, bool any_points,
                                       Report& report) {
    const auto n = numbers(statement, 9, report);
    if (!n) return std::unexpected(n.error());
    const std::vector<double>& v = *n;
    const auto frame =
        frame_of({v[3], v[4], v[5]}, {v[6], v[7], v[8]}, unit_mm * Vec3{v[0], v[1], v[2]}, statement, report);
    if (!frame) return std::unexpected(frame.error());
    if (!first_) first_ = any_points ? Frame{} : *frame;
    const bool same = frame->x == first_->x && frame->y == first_->y && frame->origin_mm == first_->origin_mm;
    machine_ = same ? Frame{} : first_->inverse() * *frame;
    if (!same && report.first(Note::second_frame)) {
        report.warn(statement.word.line, "a second MSYS: its points are led to the frame of the first");
    }
    update();
    return {};
}

Result<void> Frames::set_frame(const Statement& statement, double unit_mm, Report& report) {
    const auto n = numbers(statement, 12, report);
    if (!n) return std::unexpected(n.error());
    const std::vector<double>& v = *n;
    const auto frame = frame_of({v[0], v[4], v[8]}, {v[1], v[5], v[9]}, unit_mm * Vec3{v[3], v[7], v[11]},
                                statement, report);
    if (!frame) return std::unexpected(frame.error());
    const Vec3 z{v[2], v[6], v[10]};
    if (distance(z, frame->z) > 2 * kSquareTolerance) {
        return report.refuse(statement.word, "the third axis of CSYS is not the cross product of the others",
                             "write the rows of a right-handed 3 x 4 matrix");
    }
    if (type_ == Type::unsaid && !is_identity(*frame)) {
        return report.refuse(statement.word,
                             "CSYS does not say whether points are written in it or in the world",
                             "write TRNTYP/WORLD or TRNTYP/LOCAL before it");
    }
    local_ = *frame;
    update();
    return {};
}

Result<void> Frames::set_frame_type(const Statement& statement, Report& report) {
    const std::size_t count = statement.items.size();
    const bool world = count > 0 && matches(statement.items[0].text, "WORLD");
    if (!world && (count == 0 || !matches(statement.items[0].text, "LOCAL"))) {
        return report.refuse(count > 0 ? statement.items[0] : statement.word,
                             "TRNTYP is neither WORLD nor LOCAL", "write one of the two");
    }
    for (std::size_t i = 1; i < count; ++i) {
        const auto value = report.number(statement.items[i], kLimits.coordinate);
        if (!value) return std::unexpected(value.error());
        if (*value != 0)
            return report.refuse(statement.items[i], "TRNTYP with an offset is not read", "use TRANS");
    }
    type_ = world ? Type::world : Type::local;
    if (!world && report.first(Note::local_frame)) {
        report.warn(statement.word.line, "TRNTYP/LOCAL: points are taken as written in the frame of CSYS");
    }
    update();
    return {};
}

Result<void> Frames::set_translation(const Statement& statement, double unit_mm, Report& report) {
    const auto n = numbers(statement, 3, report);
    if (!n) return std::unexpected(n.error());
    translation_mm_ = unit_mm * Vec3{(*n)[0], (*n)[1], (*n)[2]};
    if (translation_mm_ != Vec3{} && report.first(Note::translation)) {
        report.warn(statement.word.line, "TRANS is added to all points that follow");
    }
    update();
    return {};
}

Result<void> Frames::set_origin(const Statement& statement, Report& report) {
    const auto n = numbers(statement, 3, report);
    if (!n) return std::unexpected(n.error());
    const bool is_zero = (*n)[0] == 0 && (*n)[1] == 0 && (*n)[2] == 0;
    if (!is_zero && report.first(Note::origin)) {
        report.warn(statement.word.line,
                    "ORIGIN says where the part lies in the machine: points are taken in the part's frame");
    }
    return {};
}

}  // namespace tribo::readers::apt
