// SPDX-License-Identifier: MIT
#include "readers/apt/frames.hpp"

#include <cmath>
#include <utility>
#include <vector>

#include "base/math.hpp"
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

// Reads the rows of a 3 x 4 matrix.
Result<Frame> matrix_of(const Statement& statement, double unit_mm, Report& report) {
    const auto n = numbers(statement, 12, report);
    if (!n) return std::unexpected(n.error());
    const std::vector<double>& v = *n;
    const auto frame = frame_of({v[0], v[4], v[8]}, {v[1], v[5], v[9]}, unit_mm * Vec3{v[3], v[7], v[11]},
                                statement, report);
    if (!frame) return std::unexpected(frame.error());
    const Vec3 z{v[2], v[6], v[10]};
    if (distance(z, frame->z) > 2 * kSquareTolerance) {
        return report.refuse(statement.word,
                             "the third axis of " + std::string(statement.word.text) +
                                 " is not the cross product of the others",
                             "write the rows of a right-handed 3 x 4 matrix");
    }
    return frame;
}

constexpr const char* kSecondFrame = "a second coordinate system: its points are led to that of the first";

// Equal to the digits of a file.
bool is_near(const Frame& a, const Frame& b) {
    return distance(a.x, b.x) < 1e-6 && distance(a.y, b.y) < 1e-6 &&
           distance(a.origin_mm, b.origin_mm) < 1e-6;
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
    to_program_ = header_ * machine_;
    if (type_ == Type::local) to_program_ = to_program_ * local_;
    to_program_ = to_program_ * transform_;
    to_program_.origin_mm += translation_mm_;
    to_program_ = copy_ * to_program_;
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
        report.warn(statement.word.line, "a second " + std::string(statement.word.text) +
                                             ": its points are led to the frame of the first");
    }
    update();
    return {};
}

Result<void> Frames::set_work_frame(const Statement& statement, double unit_mm, bool any_points,
                                    Report& report) {
    Statement plain;
    plain.word = statement.word;
    const auto& items = statement.items;
    for (std::size_t i = 0; i < items.size(); ++i) {
        if (!matches(items[i].text, "POINT") && !matches(items[i].text, "VECTOR")) continue;
        for (std::size_t k = 0; k < 3 && i + 1 < items.size(); ++k) plain.items.push_back(items[++i]);
    }
    return set_machine_frame(plain, unit_mm, any_points, report);
}

Result<void> Frames::set_frame(const Statement& statement, double unit_mm, Report& report) {
    const auto frame = matrix_of(statement, unit_mm, report);
    if (!frame) return std::unexpected(frame.error());
    if (type_ == Type::unsaid && !is_identity(*frame)) {
        return report.refuse(statement.word,
                             "CSYS does not say whether points are written in it or in the world",
                             "write TRNTYP/WORLD or TRNTYP/LOCAL before it");
    }
    local_ = *frame;
    update();
    return {};
}

Result<void> Frames::set_header_frame(const Statement& statement, double unit_mm, bool any_points,
                                      Report& report) {
    const auto frame = matrix_of(statement, unit_mm, report);
    if (!frame) return std::unexpected(frame.error());
    if (!first_header_) first_header_ = any_points ? Frame{} : *frame;
    unsettled_.reset();
    header_ = Frame{};
    const Frame& first = *first_header_;
    if (is_near(*frame, first)) {
        update();
        return {};
    }
    const Frame to_first = first.inverse() * *frame;
    if (matches(statement.word.text, "CATIA0")) {
        header_ = to_first;
        if (report.first(Note::second_frame)) report.warn(statement.word.line, kSecondFrame);
    } else if (distance(to_first.z, {0, 0, 1}) < kSquareTolerance) {
        return report.refuse(statement.word,
                             "another coordinate system than at the start, and the file does not say whether "
                             "its points are written in it",
                             "let Creo write one file for each of the two systems");
    } else {
        unsettled_ = to_first;
        unsettled_line_ = statement.word.line;
    }
    update();
    return {};
}

void Frames::settle(bool point_has_axis, Report& report) {
    if (!unsettled_) return;
    const Frame frame = *std::exchange(unsettled_, std::nullopt);
    if (!point_has_axis) header_ = frame;
    report.warn(unsettled_line_,
                point_has_axis
                    ? "a turned coordinate system: its points state their axis, so they are taken as "
                      "written in the first system"
                    : "a turned coordinate system: its points state no axis, so they are led from it "
                      "to the first system");
    update();
}

Result<void> Frames::set_transform(const Statement& statement, double unit_mm, Report& report) {
    const auto& items = statement.items;
    const std::string_view head = items.empty() ? "" : items[0].text;
    transform_ = Frame{};
    if (matches(head, "NOMORE")) {
        update();
        return {};
    }
    if (items.size() == 12) {
        const auto frame = matrix_of(statement, unit_mm, report);
        if (!frame) return std::unexpected(frame.error());
        transform_ = *frame;
        update();
        return {};
    }
    // (MATRIX/ kind, numbers )
    const std::size_t slash = head.find('/');
    const bool is_matrix =
        slash != std::string_view::npos && matches(trimmed(head.substr(0, slash)), "(MATRIX");
    const std::string_view kind = is_matrix ? trimmed(head.substr(slash + 1)) : "";
    const bool shift = matches(kind, "TRANSL");
    if ((!shift && !matches(kind, "XYROT")) || items.size() != (shift ? 4U : 2U) ||
        !items.back().text.ends_with(')')) {
        return report.refuse(
            statement.word, "TRACUT with a matrix in a form that is not read",
            "write the rows of the 3 x 4 matrix, or let the CAM system write the moved path");
    }
    Statement plain;
    plain.word = statement.word;
    plain.items.assign(items.begin() + 1, items.end());
    plain.items.back().text = trimmed(plain.items.back().text.substr(0, plain.items.back().text.size() - 1));
    const auto n = numbers(plain, plain.items.size(), report);
    if (!n) return std::unexpected(n.error());
    if (shift) {
        transform_.origin_mm = unit_mm * Vec3{(*n)[0], (*n)[1], (*n)[2]};
    } else {
        const double turn = (*n)[0] * math::kRadPerDeg;
        transform_.x = {math::cos(turn), math::sin(turn), 0};
        transform_.y = cross(transform_.z, transform_.x);
    }
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
    // CATIA adds the directions of x and z.
    const auto n = numbers(statement, statement.items.size() == 9 ? 9 : 3, report);
    if (!n) return std::unexpected(n.error());
    const bool is_zero = (*n)[0] == 0 && (*n)[1] == 0 && (*n)[2] == 0;
    if (!is_zero && report.first(Note::origin)) {
        report.warn(statement.word.line,
                    "ORIGIN says where the part lies in the machine: points are taken in the part's frame");
    }
    return {};
}

}  // namespace tribo::readers::apt
