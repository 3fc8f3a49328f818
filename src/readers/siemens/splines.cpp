// SPDX-License-Identifier: MIT
// BSPLINE, ASPLINE, CSPLINE and POLY.
#include <algorithm>
#include <cmath>

#include "base/math.hpp"
#include "readers/siemens/interpreter.hpp"

namespace tribo::readers::siemens {
namespace {

constexpr std::size_t kMostControlPoints = 100'000;
constexpr double kHighestDegree = 3;
constexpr Range kWeight{0.01, 100};
constexpr Range kParameter{1e-6, 1e6};

using Curve = motion::BSpline<motion::HomogeneousPoint>;

// Derivatives at the points by Akima (1970): between the slopes beside a point, nearer to that one which
// differs less from the next one on its side. Beyond the ends the slopes go on evenly.
std::vector<Vec3> akima_tangents(const std::vector<Vec3>& slope) {
    const std::size_t count = slope.size();
    if (count == 1) return {slope[0], slope[0]};
    std::vector<Vec3> m;  // with two slopes more at each end
    m.push_back(3 * slope[0] - 2 * slope[1]);
    m.push_back(2 * slope[0] - slope[1]);
    m.insert(m.end(), slope.begin(), slope.end());
    m.push_back(2 * slope[count - 1] - slope[count - 2]);
    m.push_back(3 * slope[count - 1] - 2 * slope[count - 2]);
    std::vector<Vec3> tangents;
    for (std::size_t i = 0; i <= count; ++i) {
        const double before = length(m[i + 1] - m[i]), behind = length(m[i + 3] - m[i + 2]);
        const double sum = before + behind;
        const double share = sum > 0 ? before / sum : 0.5;  // of the slope behind the point
        tangents.push_back((1 - share) * m[i + 1] + share * m[i + 2]);
    }
    return tangents;
}

// The same of the cubic spline with steady bend, and none at its ends (Thomas's elimination).
std::vector<Vec3> natural_tangents(const std::vector<Vec3>& slope, const std::vector<double>& chord) {
    const std::size_t count = slope.size();
    std::vector<double> upper(count + 1);
    std::vector<Vec3> tangents(count + 1);
    upper[0] = 0.5;
    tangents[0] = 1.5 * slope[0];
    for (std::size_t i = 1; i <= count; ++i) {
        const bool is_last = i == count;
        const double low = is_last ? 1 : 1 / chord[i - 1], high = is_last ? 0 : 1 / chord[i];
        const double own = is_last ? 2 : 2 * (low + high);
        const Vec3 right = is_last ? 3 * slope[i - 1] : 3 * (low * slope[i - 1] + high * slope[i]);
        const double pivot = own - low * upper[i - 1];
        upper[i] = high / pivot;
        tangents[i] = (right - low * tangents[i - 1]) / pivot;
    }
    for (std::size_t i = count; i > 0; --i) tangents[i - 1] = tangents[i - 1] - upper[i - 1] * tangents[i];
    return tangents;
}

// The curve through the points, in cubic pieces; the parameter is the length of the chords.
Curve through(const std::vector<motion::HomogeneousPoint>& points, bool by_akima) {
    std::vector<Vec3> slope;
    std::vector<double> chord;
    for (std::size_t i = 1; i < points.size(); ++i) {
        const Vec3 way = points[i].xyz - points[i - 1].xyz;
        chord.push_back(length(way));
        slope.push_back(way / chord.back());
    }
    const std::vector<Vec3> tangents = by_akima ? akima_tangents(slope) : natural_tangents(slope, chord);
    Curve curve;
    curve.degree = 3;
    curve.control.push_back({points[0].xyz, 1});
    curve.knots.assign(4, 0);
    for (std::size_t i = 0; i < chord.size(); ++i) {
        const Vec3 from = points[i].xyz, to = points[i + 1].xyz;
        curve.control.push_back({from + chord[i] / 3 * tangents[i], 1});
        curve.control.push_back({to - chord[i] / 3 * tangents[i + 1], 1});
        curve.control.push_back({to, 1});
        curve.knots.insert(curve.knots.end(), 3, curve.knots.back() + chord[i]);
    }
    curve.knots.push_back(curve.knots.back());
    return curve;
}

double choose(std::size_t n, std::size_t k) {
    double value = 1;
    for (std::size_t i = 0; i < k; ++i)
        value = value * static_cast<double>(n - i) / static_cast<double>(i + 1);
    return value;
}

}  // namespace

// BSPLINE: the blocks give control points with weights PW; the first one is where the tool stands. Knots are
// one apart, as without PL.
Result<void> Interpreter::add_to_spline(const Words& words, Vec3 to) {
    const Place where = place(words.first_column);
    const bool through_points = motion_ == Motion::akima || motion_ == Motion::cubic;
    if (through_points && path_.first(kCurveThroughPoints)) {
        path_.warn(line_number(),
                   "ASPLINE and CSPLINE lead through their points: between them the curve of Akima, or the "
                   "natural cubic spline, over the lengths of the chords is taken");
    }
    if (side_ != 0 || turns_) {
        return path_.refuse(where, "a spline with radius compensation or a turning tool is not read",
                            "write G40 before it, or let the CAM system write lines");
    }
    if (!spline_) {
        if (auto done = close_contour(); !done) return done;
        contour_.leave();
        check_start(false);
        spline_.emplace();
        spline_->control.push_back({path_.tip(), 1});
        spline_->place = where;
        spline_->kind = motion_;
    }
    if (words.degree) {
        if (!(*words.degree >= 2 && *words.degree <= kHighestDegree)) {
            return path_.refuse(where, "SD is neither 2 nor 3", "correct the degree");
        }
        spline_->degree = static_cast<std::size_t>(*words.degree);
    }
    const double weight = words.weight.value_or(1);
    if (!kWeight.contains(weight)) {
        return path_.refuse(where, "PW is out of range", "write a weight of 0.01 to 100");
    }
    if (words.knot_step && !through_points) {
        if (*words.knot_step != spline_->knot_step.value_or(*words.knot_step) || !(*words.knot_step > 0)) {
            return path_.refuse(where, "a BSPLINE with different PL is not read",
                                "let the CAM system write equal ones, or G1 to G3");
        }
        spline_->knot_step = words.knot_step;
    }
    if (spline_->control.size() >= kMostControlPoints) {
        return path_.refuse(where, "the spline has too many points", "write it in parts");
    }
    if (through_points && to == spline_->control.back().xyz) return {};
    spline_->control.push_back({to, weight});
    return {};
}

Result<void> Interpreter::close_spline() {
    if (!spline_) return {};
    const Spline spline = *std::move(spline_);
    spline_.reset();
    if (spline.control.size() < 2) return {};
    if (spline.kind != Motion::bspline) {
        const Curve curve = through(spline.control, spline.kind == Motion::akima);
        tangent_ = normalized(curve.control.back().xyz - curve.control[curve.control.size() - 2].xyz,
                              spline.control.back().xyz - spline.control[spline.control.size() - 2].xyz);
        return path_.follow(curve, spline.place);
    }
    Curve curve;
    const std::size_t count = spline.control.size();
    curve.degree = std::min(spline.degree, count - 1);
    for (const motion::HomogeneousPoint& p : spline.control) curve.control.push_back({p.w * p.xyz, p.w});
    const double spans = static_cast<double>(count - curve.degree);
    for (std::size_t i = 0; i < count + curve.degree + 1; ++i) {
        const double knot = static_cast<double>(i) - static_cast<double>(curve.degree);
        curve.knots.push_back(std::clamp(knot, 0.0, spans));
    }
    const Vec3 end = spline.control.back().xyz, before = spline.control[count - 2].xyz;
    if (distance(before, end) > 0) tangent_ = normalized(end - before);
    return path_.follow(curve, spline.place);
}

// POLY: PO[X]=(end,a2,a3,a4,a5) over 0 to PL.
Result<void> Interpreter::run_polynomial(const Words& words, Vec3 to) {
    const Place where = place(words.first_column);
    std::size_t degree = 1;
    for (const auto& coefficients : words.polynomial) degree = std::max(degree, coefficients.size() + 1);
    if (degree == 1) return travel(words, to, {});
    if (side_ != 0 || turns_) {
        return path_.refuse(where, "a polynomial with radius compensation or a turning tool is not read",
                            "write G40 before it, or let the CAM system write lines");
    }
    const double length = words.knot_step.value_or(1);
    if (!kParameter.contains(length)) {
        return path_.refuse(where, "PL is out of range", "write the length of the parameter, for example 1");
    }
    if (auto done = close_contour(); !done) return done;
    contour_.leave();
    check_start(false);
    const Vec3 from = path_.tip();
    std::vector<Vec3> power(degree + 1);  // of the parameter over 0 to 1
    power[0] = from;
    power[1] = to - from;
    for (int k = 0; k < 3; ++k) {
        double factor = length;
        const auto& coefficients = words.polynomial[static_cast<std::size_t>(k)];
        for (std::size_t i = 0; i < coefficients.size(); ++i) {
            factor *= length;
            const double mm = scale_[k] * coefficients[i] * unit_mm_ * factor;
            if (auto good = path_.in_range(kLimits.coordinate, mm, where); !good) return good;
            power[i + 2][k] = mm;
            power[1][k] -= mm;
        }
    }
    Curve curve;
    curve.degree = degree;
    for (std::size_t j = 0; j <= degree; ++j) {
        Vec3 point;
        for (std::size_t i = 0; i <= j; ++i) point = point + choose(j, i) / choose(degree, i) * power[i];
        curve.control.push_back({point, 1});
    }
    curve.knots.assign(degree + 1, 0);
    curve.knots.insert(curve.knots.end(), degree + 1, 1);
    const Vec3 last = curve.control[degree].xyz - curve.control[degree - 1].xyz;
    if (tribo::length(last) > 0) tangent_ = normalized(last);
    return path_.follow(curve, where);
}

}  // namespace tribo::readers::siemens
