// SPDX-License-Identifier: MIT
// The distance formulas of sweeps, for T = double (one exact answer) and T = F8 (eight nodes of a lattice).
// Each file that uses them includes this file inside an unnamed namespace, so that it has its own code
// (base/simd.hpp says why).
//
// Legend: (x, y, z) is the point relative to the tip at the start, x along the part of the travel across the
// axis, z along the axis to the shank. (across, 0, rise) is the travel of the tip, t in 0..1 its fraction.
// rho is the distance to the tool axis; R radius, r corner radius, L length.

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
    T across, rise, per_across, per_length_squared;
    Line() = default;
    explicit Line(const StraightLine& s)
        : across(broadcast<T>(s.across)),
          rise(broadcast<T>(s.rise)),
          per_across(broadcast<T>(s.per_across)),
          per_length_squared(broadcast<T>(s.per_length_squared)) {}
};

template <class T>
TRIBO_LANES T unit_clamp(T t) {
    return min(max(t, broadcast<T>(0)), broadcast<T>(1));
}

// Travel across the axis: the nearest instant is the same at all heights.
template <CutterKind kind, class T>
TRIBO_LANES T level_distance(const Profile<T>& p, const Line<T>& l, T x, T y, T z) {
    const T dx = x - unit_clamp(x * l.per_across) * l.across;
    return max(profile_distance<kind>(p, dx * dx + y * y, z), z - p.L);
}

// Applies the cap: the solid ends at the cap at its highest instant.
template <class T>
TRIBO_LANES T capped(const Profile<T>& p, const Line<T>& l, T distance, T z) {
    return max(distance, z - max(l.rise, broadcast<T>(0)) - p.L);
}

// min over t of max(A, B), A = rho(t) - R convex, B = t rise - z linear. Either A is the larger one at its
// own minimum, or B at its own, or the minimum lies where the falling B meets A: a t^2 - 2 b t + c = 0,
// rho^2 = (R + t rise - z)^2. The root is worked out only where some lane needs it.
template <class T>
TRIBO_LANES Least<T> ramp_flat(const Profile<T>& p, const Line<T>& l, T x, T y, T z) {
    const T zero = broadcast<T>(0), one = broadcast<T>(1);
    const auto side = [&](T t) {
        const T dx = x - t * l.across;
        return sqrt(dx * dx + y * y) - p.R;
    };
    const auto bottom = [&](T t) { return t * l.rise - z; };
    const T nearest = unit_clamp(x * l.per_across), end = select(l.rise < zero, one, zero);
    const T side_alone = side(nearest), bottom_alone = bottom(end);
    const auto by_side = side_alone >= bottom(nearest), by_bottom = bottom_alone >= side(end);
    Least<T> least{select(by_side, side_alone, bottom_alone), select(by_side, nearest, end)};
    const auto known = either(by_side, by_bottom);
    if (every(known)) return least;
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
    const T between = min(max(meet, min(nearest, end)), max(nearest, end));
    Least<T> edge{max(side_alone, bottom(nearest)), nearest};
    take(edge, max(side(between), bottom(between)), between);
    take(edge, max(side(end), bottom_alone), end);
    return {select(known, least.distance, edge.distance), select(known, least.t, edge.t)};
}

// The square of the distance to the path of the centre. It is smooth and convex in t. Its minimum is the
// minimum of the sphere below the height of the centre, the minimum of the cylinder above it, or the instant
// at which the point passes that height. Above or below all heights of the centre one of them is known to
// count.
template <class T>
TRIBO_LANES Least<T> ramp_ball_squared(const Profile<T>& p, const Line<T>& l, T x, T y, T z) {
    const T zero = broadcast<T>(0), one = broadcast<T>(1);
    const T height = z - p.R, aside = y * y;
    const auto squared = [&](T t) {
        const T dx = x - t * l.across, dz = min(height - t * l.rise, zero);
        return dx * dx + dz * dz + aside;
    };
    const auto above = height >= max(l.rise, zero), under = height <= min(l.rise, zero);
    const T cylinder = unit_clamp(x * l.per_across);
    const T of_cylinder = squared(cylinder);
    if (every(above)) return {of_cylinder, cylinder};
    const T sphere = unit_clamp((x * l.across + height * l.rise) * l.per_length_squared);
    const T of_sphere = squared(sphere);
    if (every(under)) return {of_sphere, sphere};
    const T level = unit_clamp(height / select(l.rise == zero, one, l.rise));
    Least<T> least{of_sphere, sphere};
    take(least, of_cylinder, cylinder);
    take(least, squared(level), level);
    return {select(above, of_cylinder, select(under, of_sphere, least.distance)),
            select(above, cylinder, select(under, sphere, least.t))};
}
template <class T>
TRIBO_LANES Least<T> ramp_ball(const Profile<T>& p, const Line<T>& l, T x, T y, T z) {
    const Least<T> least = ramp_ball_squared(p, l, x, y, z);
    return {sqrt(least.distance) - p.R, least.t};
}

// The tool at one instant as seen from a point. Parameters: rho^2, half its derivative by t, z, its
// derivative by t, and the square of the speed of the point across the axis.
template <CutterKind kind, class T>
TRIBO_LANES Instant<T> instant(const Profile<T>& p, T rho_squared, T half_rate, T z, T dz, T way_squared) {
    const T zero = broadcast<T>(0), tiny = broadcast<T>(1e-30);
    if constexpr (kind == CutterKind::ball) {
        const T below = min(z - p.R, zero), out = sqrt(rho_squared + below * below);
        return {out - p.R,  (half_rate + below * dz) / max(out, tiny), zero, zero, broadcast<T>(kNever),
                way_squared};
    }
    const T rho = sqrt(rho_squared), drho = half_rate / max(rho, tiny);
    if constexpr (kind == CutterKind::flat) {
        const T side = rho - p.R, gap = side + z;
        const auto on_side = gap >= zero;
        return {select(on_side, side, -z), select(on_side, drho, -dz), drho, dz, gap, way_squared};
    }
    const T side = rho - p.core, under = p.r - z;
    const T out_side = max(side, zero), out_under = max(under, zero);
    const T out = sqrt(out_side * out_side + out_under * out_under);
    const T inner = select(side >= under, drho, -dz);
    return {out + min(max(side, under), zero) - p.r,
            select(out > zero, (out_side * drho - out_under * dz) / max(out, tiny), inner),
            zero,
            zero,
            min(side, -under),
            way_squared};
}

template <class T>
TRIBO_LANES Least<T> ramp_bull(const Profile<T>& p, const Line<T>& l, T x, T y, T z, T near) {
    const T zero = broadcast<T>(0);
    const auto at = [&](T t) {
        const T dx = x - t * l.across;
        return instant<CutterKind::bull>(p, dx * dx + y * y, -dx * l.across, z - t * l.rise, -l.rise,
                                         l.across * l.across);
    };
    const auto node = [&](int k) { return at(broadcast<T>(k)); };
    return least_over<false, T>(1, 0, 1, PointBounds<T>{zero, zero, zero, p.R, zero}, Needed<T>(near), node,
                                at);
}

// Travel along and across the axis at once: returns the nearest instant, without the flat top. For a
// bull-nose cutter it is exact only within `near` of the surface.
template <CutterKind kind, class T>
TRIBO_LANES Least<T> ramp_nearest(const Profile<T>& p, const Line<T>& l, T x, T y, T z, T near) {
    if constexpr (kind == CutterKind::flat) return ramp_flat(p, l, x, y, z);
    if constexpr (kind == CutterKind::ball) return ramp_ball(p, l, x, y, z);
    return ramp_bull(p, l, x, y, z, near);
}
template <CutterKind kind, class T>
TRIBO_LANES T ramp_distance(const Profile<T>& p, const Line<T>& l, T x, T y, T z, T near) {
    return capped(p, l, ramp_nearest<kind>(p, l, x, y, z, near).distance, z);
}

// One of several travels. `view` turns a point of their common frame into the coordinates of this one.
template <class T>
struct PartOf {
    Line<T> line;
    T start_x, start_y, start_z, along_x, along_y;
    PartOf() = default;
    explicit PartOf(const StraightPart& part)
        : line(part.line),
          start_x(broadcast<T>(part.start.x)),
          start_y(broadcast<T>(part.start.y)),
          start_z(broadcast<T>(part.start.z)),
          along_x(broadcast<T>(part.along_x)),
          along_y(broadcast<T>(part.along_y)) {}
    struct View {
        T x, y, z;
    };
    TRIBO_LANES View view(T x, T y, T z) const {
        const T dx = x - start_x, dy = y - start_y;
        return {dx * along_x + dy * along_y, dy * along_x - dx * along_y, z - start_z};
    }
};

// Distance to the swept path in the plane of an arc about the origin. The arc starts on the x axis and turns
// to the left by at most half a turn; end = (cos, sin) of the turn.
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
