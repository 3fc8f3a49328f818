// SPDX-License-Identifier: MIT
// The distance formulas of sweeps, for T = double (one exact answer) and T = F8 (eight nodes of a lattice).
// Included inside an unnamed namespace of each file that uses it, so that every file has code of its own
// (base/simd.hpp says why).
//
// Legend: (x, y, z) the point relative to the tip at the start, x along the part of the travel across the
// axis, z along the axis to the shank; (across, 0, rise) the travel of the tip; t in 0..1 the fraction of it;
// rho the distance to the tool axis; R radius, r corner radius, L length.

// Profile of the tool: distance in the half plane (rho, z). Flat: mitred at the edge.
template <class T>
struct Profile {
    T R, r, core, L;
    explicit Profile(const ToolProfile& p)
        : R(broadcast<T>(p.radius_mm)),
          r(broadcast<T>(p.corner_mm)),
          core(broadcast<T>(p.radius_mm - p.corner_mm)),
          L(broadcast<T>(p.length_mm)) {}
};

template <class T>
TRIBO_LANES T flat_distance(const Profile<T>& p, T rho, T z) {
    return max(rho - p.R, -z);
}

template <class T>
TRIBO_LANES T ball_distance(const Profile<T>& p, T rho_squared, T z) {
    const T below = min(z - p.R, broadcast<T>(0));
    return sqrt(rho_squared + below * below) - p.R;
}

template <class T>
TRIBO_LANES T bull_distance(const Profile<T>& p, T rho, T z) {
    const T zero = broadcast<T>(0);
    const T side = rho - p.core, under = p.r - z;
    const T out_side = max(side, zero), out_under = max(under, zero);
    return sqrt(out_side * out_side + out_under * out_under) + min(max(side, under), zero) - p.r;
}

template <CutterKind kind, class T>
TRIBO_LANES T profile_distance(const Profile<T>& p, T rho_squared, T z) {
    if constexpr (kind == CutterKind::flat) return flat_distance(p, sqrt(rho_squared), z);
    if constexpr (kind == CutterKind::ball) return ball_distance(p, rho_squared, z);
    return bull_distance(p, sqrt(rho_squared), z);
}

// Straight travel with one axis.
template <class T>
struct Line {
    T across, rise, per_across, per_length_squared, length_squared;
    explicit Line(const StraightLine& s)
        : across(broadcast<T>(s.across)),
          rise(broadcast<T>(s.rise)),
          per_across(broadcast<T>(s.across > 0 ? 1 / s.across : 0)),
          per_length_squared(
              broadcast<T>(s.across > 0 || s.rise != 0 ? 1 / (s.across * s.across + s.rise * s.rise) : 0)),
          length_squared(broadcast<T>(s.across * s.across + s.rise * s.rise)) {}
};

template <class T>
TRIBO_LANES T unit_clamp(T t) {
    return min(max(t, broadcast<T>(0)), broadcast<T>(1));
}

// Across the axis: the nearest instant is the same at all heights.
template <CutterKind kind, class T>
TRIBO_LANES T level_distance(const Profile<T>& p, const Line<T>& l, T x, T y, T z) {
    const T dx = x - unit_clamp(x * l.per_across) * l.across;
    return max(profile_distance<kind>(p, dx * dx + y * y, z), z - p.L);
}

// Above the cap at its highest instant there is nothing.
template <class T>
TRIBO_LANES T capped(const Profile<T>& p, const Line<T>& l, T distance, T z) {
    return max(distance, z - max(l.rise, broadcast<T>(0)) - p.L);
}

// min over t of max(A, B), A = rho(t) - R convex, B = t rise - z linear. Either A is the larger at its own
// minimum, or the minimum lies where B, falling, meets A: a t^2 - 2 b t + c = 0, rho^2 = (R + t rise - z)^2.
template <class T>
TRIBO_LANES T ramp_flat(const Profile<T>& p, const Line<T>& l, T x, T y, T z) {
    const T zero = broadcast<T>(0), one = broadcast<T>(1);
    const auto at = [&](T t) {
        const T dx = x - t * l.across;
        return max(sqrt(dx * dx + y * y) - p.R, t * l.rise - z);
    };
    const T nearest = unit_clamp(x * l.per_across);
    const T w = p.R - z;
    const T a = l.across * l.across - l.rise * l.rise;
    const T b = x * l.across + w * l.rise;
    const T c = x * x + y * y - w * w;
    const T down = select(l.rise < zero, one, -one);  // the direction of t in which B falls
    const T root = sqrt(max(b * b - a * c, zero));
    const T stable = b + down * root, other = b - down * root;
    const T quotient_low = select(a == zero, one, a), quotient_high = select(other == zero, one, other);
    const T meet =
        select(down * b >= zero, select(a == zero, down, stable / quotient_low), c / quotient_high);
    const T end = select(l.rise < zero, one, zero);
    const T between = min(max(meet, min(nearest, end)), max(nearest, end));
    return capped(p, l, min(at(nearest), min(at(between), at(end))), z);
}

// The distance is smooth and convex in t: its minimum is that of the sphere below the centre's height, of the
// cylinder above it, or where the point passes that height.
template <class T>
TRIBO_LANES T ramp_ball(const Profile<T>& p, const Line<T>& l, T x, T y, T z) {
    const T zero = broadcast<T>(0), one = broadcast<T>(1);
    const T height = z - p.R;
    const auto squared = [&](T t) {
        const T dx = x - t * l.across, dz = min(height - t * l.rise, zero);
        return dx * dx + dz * dz;
    };
    const T sphere = unit_clamp((x * l.across + height * l.rise) * l.per_length_squared);
    const T cylinder = unit_clamp(x * l.per_across);
    const T level = unit_clamp(height / select(l.rise == zero, one, l.rise));
    const T least = min(squared(sphere), min(squared(cylinder), squared(level)));
    return capped(p, l, sqrt(least + y * y) - p.R, z);
}

// One evaluation of a distance along t: its derivative, and for a flat cutter the side's distance less the bottom's, whose
// root is the instant at which the edge stands nearest (for round bottoms 1: there is no edge).
template <class T>
struct Instant {
    T distance, slope, gap;
};

template <class T>
struct Least {
    T distance, t;
};

// Minimum over t in 0..1 of a distance that falls and then rises (if it does neither, the lower end). One bisection, then
// regula falsi steps in the Illinois form: on the gap where the edge lies in the bracket, on the slope where the minimum
// is smooth. Gives the least value seen, and where.
template <class T, class F>
TRIBO_LANES Least<T> least_over_unit(const F& at) {
    const T zero = broadcast<T>(0), one = broadcast<T>(1), half = broadcast<T>(0.5);
    T lo = zero, hi = one;
    Instant<T> a = at(lo), b = at(hi);
    Least<T> least{min(a.distance, b.distance), select(b.distance < a.distance, one, zero)};
    T last_side = zero;  // -1: the lower end moved last, 1: the upper
    const auto take = [&](T t, const Instant<T>& c) {
        const auto better = c.distance < least.distance;
        least.distance = select(better, c.distance, least.distance);
        least.t = select(better, t, least.t);
        const auto falling = c.slope < zero;
        const T side = select(falling, -one, one);
        // An end that stays twice counts half, so that it cannot hold the steps back.
        const T stale = select(side == last_side, half, one);
        lo = select(falling, t, lo);
        hi = select(falling, hi, t);
        a.slope = select(falling, c.slope, a.slope * stale);
        a.gap = select(falling, c.gap, a.gap * stale);
        b.slope = select(falling, b.slope * stale, c.slope);
        b.gap = select(falling, b.gap * stale, c.gap);
        last_side = side;
    };
    take(half, at(half));
    // Nothing to search where the slope does not change from falling to rising: the bracket closes on one end.
    const auto rises = a.slope >= zero, falls = b.slope <= zero;
    hi = select(rises, lo, hi);
    lo = select(falls, hi, lo);
    // Eight lanes go through the same steps, enough for single precision. One double stops when it is settled.
    constexpr bool kScalar = std::is_same_v<T, double>;
    constexpr int kSteps = kScalar ? 40 : 6;
    for (int step = 0; step < kSteps; ++step) {
        const T width = hi - lo;
        const auto edge = a.gap * b.gap < zero;
        const T from = select(edge, a.gap, a.slope), to = select(edge, b.gap, b.slope);
        const T spread_of = to - from;
        const T share = -from / select(spread_of == zero, one, spread_of);
        const T t = lo + width * min(max(share, zero), one);
        const Instant<T> c = at(t);
        take(t, c);
        if constexpr (kScalar) {
            constexpr double kSettled = 1e-8;  // mm
            if (width * abs(c.slope) < kSettled || abs(c.gap) < kSettled) break;
        }
    }
    return least;
}

// Distance and its gradient (by rho, by z) in the profile plane.
template <CutterKind kind, class T>
TRIBO_LANES void profile_gradient(const Profile<T>& p, T rho, T z, T& distance, T& by_rho, T& by_z) {
    const T zero = broadcast<T>(0), one = broadcast<T>(1);
    if constexpr (kind == CutterKind::flat) {
        const T side = rho - p.R;
        const auto on_side = side >= -z;
        distance = select(on_side, side, -z);
        by_rho = select(on_side, one, zero);
        by_z = select(on_side, zero, -one);
        return;
    }
    const T side = rho - p.core, under = p.r - z;
    const T out_side = max(side, zero), out_under = max(under, zero);
    const T out = sqrt(out_side * out_side + out_under * out_under);
    const auto inside = out <= zero;
    distance = out + min(max(side, under), zero) - p.r;
    const T per = one / select(inside, one, out);
    by_rho = select(inside, select(side >= under, one, zero), out_side * per);
    by_z = select(inside, select(side >= under, zero, -one), -out_under * per);
}

template <class T>
TRIBO_LANES T ramp_bull(const Profile<T>& p, const Line<T>& l, T x, T y, T z) {
    const T tiny = broadcast<T>(1e-30);
    const auto at = [&](T t) {
        const T dx = x - t * l.across, rho = sqrt(dx * dx + y * y);
        T by_rho, by_z;
        Instant<T> i;
        profile_gradient<CutterKind::bull>(p, rho, z - t * l.rise, i.distance, by_rho, by_z);
        i.gap = broadcast<T>(1);
        i.slope = -by_rho * dx * l.across / max(rho, tiny) - by_z * l.rise;
        return i;
    };
    return capped(p, l, least_over_unit<T>(at).distance, z);
}

// Distance to the swept path in the plane of an arc about the origin that starts on the x axis and turns to
// the left by at most half a turn, end = (cos, sin) of the turn.
template <class T>
struct Round {
    T radius, end_x, end_y;
    explicit Round(const ArcLine& a)
        : radius(broadcast<T>(a.radius)), end_x(broadcast<T>(a.end_x)), end_y(broadcast<T>(a.end_y)) {}
};

template <CutterKind kind, class T>
TRIBO_LANES T arc_distance(const Profile<T>& p, const Round<T>& a, T x, T y, T z) {
    const T zero = broadcast<T>(0);
    const T from_start = x - a.radius;
    const T from_end_x = x - a.radius * a.end_x, from_end_y = y - a.radius * a.end_y;
    const T ends = min(from_start * from_start + y * y, from_end_x * from_end_x + from_end_y * from_end_y);
    const T off = sqrt(x * x + y * y) - a.radius;
    const T before_end = x * a.end_y - y * a.end_x;
    const T rho_squared = select(min(y, before_end) >= zero, off * off, ends);
    return max(profile_distance<kind>(p, rho_squared, z), z - p.L);
}

template <class T>
struct Vector {
    T x, y, z;
};
template <class T>
TRIBO_LANES Vector<T> spread(Vec3 v) {
    return {broadcast<T>(v.x), broadcast<T>(v.y), broadcast<T>(v.z)};
}
template <class T>
TRIBO_LANES T dot(const Vector<T>& a, const Vector<T>& b) {
    return a.x * b.x + a.y * b.y + a.z * b.z;
}
template <class T>
TRIBO_LANES Vector<T> along(const Vector<T>& a, T t, const Vector<T>& b) {
    return {a.x + t * b.x, a.y + t * b.y, a.z + t * b.z};
}

// Tip and axis as quadratics in the power basis, tip relative to its start.
template <class T>
struct Curve {
    Vector<T> tip1, tip2, axis0, axis1, axis2;
    explicit Curve(const CurvedLine& c)
        : tip1(spread<T>(c.tip1)),
          tip2(spread<T>(c.tip2)),
          axis0(spread<T>(c.axis0)),
          axis1(spread<T>(c.axis1)),
          axis2(spread<T>(c.axis2)) {}
};

// The tool's frame at one instant as the point sees it: where it is, and how that changes with t.
template <class T>
struct Seen {
    Vector<T> axis, radial;  // radial: from the axis to the point, not unit
    T rho, z, drho, dz;
};

template <class T>
TRIBO_LANES Seen<T> seen_from(const Curve<T>& c, const Vector<T>& point, T t) {
    const T one = broadcast<T>(1), two = broadcast<T>(2), tiny = broadcast<T>(1e-30);
    const Vector<T> d = along(along(point, -t, c.tip1), -t * t, c.tip2);
    const Vector<T> velocity = along(c.tip1, two * t, c.tip2);
    const Vector<T> n = along(along(c.axis0, t, c.axis1), t * t, c.axis2);
    const Vector<T> turning = along(c.axis1, two * t, c.axis2);
    const T per = one / sqrt(dot(n, n));
    Seen<T> s;
    s.axis = {n.x * per, n.y * per, n.z * per};
    // Derivative of the unit axis: the part of n' across it, over |n|.
    const Vector<T> across = along(turning, -dot(s.axis, turning), s.axis);
    s.z = dot(d, s.axis);
    s.radial = along(d, -s.z, s.axis);
    s.rho = sqrt(dot(s.radial, s.radial));
    s.dz = dot(d, across) * per - dot(velocity, s.axis);
    // The radial vector is across the axis: only the velocity and the axis' own turn change its length.
    s.drho = (-dot(s.radial, velocity) - s.z * per * dot(s.radial, across)) / max(s.rho, tiny);
    return s;
}

template <CutterKind kind, class T>
TRIBO_LANES Least<T> curved_least(const Profile<T>& p, const Curve<T>& c, const Vector<T>& point) {
    return least_over_unit<T>([&](T t) {
        const Seen<T> s = seen_from(c, point, t);
        T by_rho, by_z;
        Instant<T> i;
        profile_gradient<kind>(p, s.rho, s.z, i.distance, by_rho, by_z);
        i.distance = max(i.distance, s.z - p.L);
        i.slope = by_rho * s.drho + by_z * s.dz;
        i.gap = kind == CutterKind::flat ? s.rho - p.R + s.z : broadcast<T>(1);
        return i;
    });
}
