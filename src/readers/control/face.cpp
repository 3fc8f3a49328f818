// SPDX-License-Identifier: MIT
#include "readers/control/face.hpp"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "base/math.hpp"

namespace tribo::readers::control {
namespace {

struct Pass {
    double z = 0, feed = 0;
};

double rough_passes(const Face& face) {
    const double height = face.depths.top - face.depths.bottom - face.left;
    if (!(height > 1e-9)) return 0;
    return face.infeed > 0 ? std::max(1.0, std::ceil(height / face.infeed - 1e-9)) : 1;
}

std::vector<Pass> passes_of(const Face& face) {
    std::vector<Pass> passes;
    const double rough = rough_passes(face), height = face.depths.top - face.depths.bottom - face.left;
    for (double i = 1; i <= rough; ++i) passes.push_back({face.depths.top - height * i / rough, face.feed});
    if (face.left > 0) passes.push_back({face.depths.bottom, face.finish_feed});
    return passes;
}

double across(const Face& face) {
    return face.along_width ? face.length : face.width;
}

double lines_of_pass(const Face& face) {
    if (face.lines) return *face.lines;
    if (!(face.step > 0)) return 1;
    const double whole = face.way == FaceWay::spiral
                             ? std::min(std::abs(face.length), std::abs(face.width)) / 2
                             : std::abs(across(face));
    return std::max(1.0, std::ceil(whole / face.step - 1e-9));
}

class FaceMill {
  public:
    FaceMill(const Face& face, Vec3 from, const PocketMove& go)
        : face_(face),
          go_(go),
          now_(from),
          cosine_(math::cos(face.angle_rad)),
          sine_(math::sin(face.angle_rad)) {}

    // A place from the corner, along length and width.
    Vec3 at(double x, double y, double z) const {
        return {face_.corner.x + cosine_ * x - sine_ * y, face_.corner.y + sine_ * x + cosine_ * y, z};
    }
    Result<void> to(Vec3 place, std::optional<double> feed) {
        now_ = place;
        return go_(place, feed, {});
    }
    // To the start of a pass, high above it, and down beside the face.
    Result<void> enter(Vec3 start) {
        if (auto done = to({start.x, start.y, now_.z}, {}); !done) return done;
        return to(start, {});
    }
    Result<void> leave() { return to({now_.x, now_.y, face_.depths.back}, {}); }

    Result<void> lines(const Pass& pass) {
        const double count = lines_of_pass(face_), length = face_.along_width ? face_.width : face_.length;
        const double sign = length < 0 ? -1 : 1;
        double from = -sign * face_.start_over, end = length + sign * face_.over;
        const double other = -sign * face_.over;
        const auto place = [&](double along, double aside) {
            return face_.along_width ? at(aside, along, pass.z) : at(along, aside, pass.z);
        };
        for (double line = 0; line < count; ++line) {
            const double aside = across(face_) * (line + 0.5) / count;
            auto done = line == 0 ? enter(place(from, aside)) : step_to(place(from, aside));
            if (done) done = to(place(end, aside), pass.feed);
            if (!done) return done;
            if (line == 0) from = other;
            if (face_.way == FaceWay::back_and_forth) std::swap(from, end);
        }
        return {};
    }

    // Rings whose first side begins outside of the face.
    Result<void> spiral(const Pass& pass) {
        const double count = lines_of_pass(face_);
        const double step = std::min(std::abs(face_.length), std::abs(face_.width)) / (2 * count);
        const double x = face_.length < 0 ? -1 : 1, y = face_.width < 0 ? -1 : 1;
        const double length = std::abs(face_.length), width = std::abs(face_.width);
        const auto place = [&](double u, double v) { return at(x * u, y * v, pass.z); };
        for (double ring = 0; ring < count; ++ring) {
            const double inset = (ring + 0.5) * step, next = inset + step;
            auto done = ring == 0 ? enter(place(-face_.start_over, inset)) : Result<void>{};
            if (done) done = to(place(length - inset, inset), pass.feed);
            if (done) done = to(place(length - inset, width - inset), pass.feed);
            if (done) done = to(place(inset, width - inset), pass.feed);
            if (done) done = to(place(inset, ring + 1 < count ? next : inset), pass.feed);
            if (!done) return done;
        }
        return {};
    }

  private:
    Result<void> step_to(Vec3 start) {
        if (face_.way == FaceWay::back_and_forth) return to(start, face_.between);
        const double above = start.z + face_.lift;
        if (auto done = to({now_.x, now_.y, above}, {}); !done) return done;
        if (auto done = to({start.x, start.y, above}, face_.between); !done) return done;
        return to(start, face_.between);
    }

    const Face& face_;
    const PocketMove& go_;
    Vec3 now_;
    double cosine_, sine_;
};

}  // namespace

double line_count(const Face& face) {
    return (rough_passes(face) + (face.left > 0 ? 1 : 0)) * lines_of_pass(face);
}

Result<void> mill_face(const Face& face, Vec3 from, const PocketMove& go) {
    FaceMill mill(face, from, go);
    if (auto done = mill.leave(); !done) return done;
    for (const Pass& pass : passes_of(face)) {
        if (auto done = face.way == FaceWay::spiral ? mill.spiral(pass) : mill.lines(pass); !done)
            return done;
        if (auto done = mill.leave(); !done) return done;
    }
    return {};
}

}  // namespace tribo::readers::control
