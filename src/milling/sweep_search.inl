// SPDX-License-Identifier: MIT
// The least distance over the instants t in 0..1 of a travel, for T = double or F8 (sweep_distance.inl says
// how this file is included). Every lane is searched as if it were alone: its result does not depend on its
// neighbours.

// The distance to the tool at one instant; `slope`, `drho` and `dz` are derivatives by t: of the distance, of
// the point's distance to the axis and of its height above the tip. A flat cutter has an edge, where `gap` =
// distance to the side less distance to the bottom passes zero; a rounded bottom is smooth (gap 1).
template <class T>
struct Instant {
    T distance, slope, drho, dz, gap;
};
template <bool kEdge, class T>
TRIBO_LANES Instant<T> blend(Mask<T> m, const Instant<T>& a, const Instant<T>& b) {
    return {select(m, a.distance, b.distance), select(m, a.slope, b.slope), select(m, a.drho, b.drho),
            select(m, a.dz, b.dz), kEdge ? select(m, a.gap, b.gap) : a.gap};
}

// Above every distance, mm.
constexpr double kNever = 1e30;

template <class T>
struct Least {
    T distance, t;
};

// A stretch of t over which the distance first falls, then rises.
template <class T>
struct Valley {
    T lo, hi;
    Instant<T> a, b;  // at lo and hi
};

template <class T>
TRIBO_LANES Mask<T> is_valley(const Instant<T>& a, const Instant<T>& b) {
    return both(a.slope<broadcast<T>(0), b.slope> broadcast<T>(0));
}

// What the valley may go down to. Without the edge between its ends: where the tangents meet, or the bottom
// of the parabola with the mean curvature, whichever is lower, less what a bottom that the point leaves ever
// faster lies below its tangent. With the edge between them: as far as the part that is not nearest has come
// at an end, if from there it only gets farther towards the other end.
template <bool kEdge, class T>
TRIBO_LANES T floor_of(const Valley<T>& v, Mask<T> valley) {
    const T zero = broadcast<T>(0), half = broadcast<T>(0.5);
    const Instant<T>&a = v.a, &b = v.b;
    const T width = v.hi - v.lo, steepness = select(valley, b.slope - a.slope, broadcast<T>(1));
    const T meet = (a.distance - b.distance + b.slope * width) / steepness;
    const T gentle = min(-a.slope, b.slope);
    const T parabola = min(a.distance, b.distance) - half * gentle * gentle * width / steepness;
    const T smooth = min(parabola, a.distance + a.slope * meet) - half * max(b.dz - a.dz, zero) * width;
    if constexpr (!kEdge) return smooth;
    const T deep = broadcast<T>(-1e30);
    const T rate_a = select(a.gap < zero, a.drho, -a.dz), rate_b = select(b.gap < zero, b.drho, -b.dz);
    const T from_a = select(rate_a < zero, deep, a.distance - abs(a.gap));
    const T from_b = select(rate_b > zero, deep, b.distance - abs(b.gap));
    return select(a.gap * b.gap < zero, max(from_a, from_b), smooth);
}

// From lo to the least of the cubic with the distances and slopes of both ends.
template <class T>
TRIBO_LANES T to_bottom(const Valley<T>& v, T width, T steepness) {
    const T chord = v.a.slope + v.b.slope + broadcast<T>(3) * (v.a.distance - v.b.distance) / width;
    const T root = sqrt(max(chord * chord - v.a.slope * v.b.slope, broadcast<T>(0)));
    return width - width * (v.b.slope + root - chord) / (steepness + root + root);
}

// From lo to where the cubic with the gaps and gap rates of both ends is zero: two steps of Newton from the
// chord's zero.
template <class T>
TRIBO_LANES T to_edge(const Valley<T>& v, T width, Mask<T> crosses) {
    const T zero = broadcast<T>(0), one = broadcast<T>(1), two = broadcast<T>(2), three = broadcast<T>(3);
    const T change = v.b.gap - v.a.gap, p = width * (v.a.drho + v.a.dz), q = width * (v.b.drho + v.b.dz);
    const T c2 = three * change - two * p - q, c3 = p + q - two * change;
    T u = -v.a.gap / select(crosses, change, one);
    for (int n = 0; n < 2; ++n) {
        const T value = v.a.gap + u * (p + u * (c2 + u * c3)), rate = p + u * (two * c2 + u * three * c3);
        const auto steep = both(crosses, rate * change > zero);
        u = select(steep, min(max(u - value / select(steep, rate, one), zero), one), u);
    }
    return u * width;
}

// Where to look next in a valley: its bottom after the cubic, the edge where it crosses one. A cubic that
// follows the distance badly leaves one end where it is, so every third step is a tangents' meeting.
template <bool kEdge, class T>
TRIBO_LANES T next_look(const Valley<T>& v, Mask<T> active, int step) {
    const T one = broadcast<T>(1), width = select(active, v.hi - v.lo, one);
    const T steepness = select(active, v.b.slope - v.a.slope, one);
    T wanted = step % 3 == 2 ? (v.a.distance - v.b.distance + v.b.slope * width) / steepness
                             : to_bottom(v, width, steepness);
    if constexpr (kEdge) {
        const auto crosses = both(active, v.a.gap * v.b.gap < broadcast<T>(0));
        if (any(crosses)) wanted = select(crosses, to_edge(v, width, crosses), wanted);
    }
    return v.lo + min(max(wanted, broadcast<T>(0.02) * width), broadcast<T>(0.98) * width);
}

// How far the least distance found may stand above the true one before the search goes on, mm.
template <class T>
constexpr double kSettled = std::is_same_v<T, double> ? 1e-7 : 1e-5;

// Goes down one valley. Lanes that are settled stay as they are.
template <bool kEdge, class T, class F>
TRIBO_LANES void descend(Valley<T> v, T floor, Mask<T> valley, Least<T>& least, const F& at) {
    const T zero = broadcast<T>(0), settled = broadcast<T>(kSettled<T>);
    auto active = both(valley, floor < least.distance - settled);
    constexpr int kMostSteps = std::is_same_v<T, double> ? 40 : 12;
    for (int step = 0; step < kMostSteps && any(active); ++step) {
        const T t = next_look<kEdge>(v, active, step);
        const Instant<T> c = at(t);
        const auto better = both(active, c.distance < least.distance);
        least.distance = select(better, c.distance, least.distance);
        least.t = select(better, t, least.t);
        const auto falling = both(active, c.slope < zero), rising = both(active, c.slope >= zero);
        v.lo = select(falling, t, v.lo);
        v.a = blend<kEdge>(falling, c, v.a);
        v.hi = select(rising, t, v.hi);
        v.b = blend<kEdge>(rising, c, v.b);
        active = both(active, floor_of<kEdge>(v, active) < least.distance - settled);
    }
}

// Where within a stretch the point comes closest to the tip's plane from above, or farthest from the axis:
// there one of the tool's parts first nears the point, then leaves it again, and both sides may hold a
// valley.
template <class T>
TRIBO_LANES Mask<T> is_parted(const Instant<T>& a, const Instant<T>& b) {
    const T zero = broadcast<T>(0);
    return either(both(a.dz<zero, b.dz> zero), both(a.drho > zero, b.drho < zero));
}

// Calls visit(valley) for the stretch, or for its two sides where it is parted, over each of which the
// distance is taken to fall at first or rise at last.
template <bool kEdge, class T, class F, class V>
TRIBO_LANES void over_sides(Valley<T> v, const F& at, const V& visit) {
    const T zero = broadcast<T>(0), one = broadcast<T>(1);
    const auto parted = is_parted(v.a, v.b);
    if (any(parted)) {
        const auto lowest = both(v.a.dz<zero, v.b.dz> zero);
        const T rate_a = select(lowest, v.a.dz, v.a.drho), rate_b = select(lowest, v.b.dz, v.b.drho);
        const T share = rate_a / select(parted, rate_a - rate_b, one);
        const T middle = select(parted, v.lo + share * (v.hi - v.lo), v.hi);
        Instant<T> m = blend<kEdge>(parted, at(middle), v.b);
        // Where that part is the nearest the distance is level: one way down each side.
        const T level = broadcast<T>(0.05) * abs(rate_b - rate_a), slope = m.slope;
        const auto is_level = both(parted, abs(slope) < level);
        m.slope = select(is_level, level, slope);
        visit(Valley<T>{v.lo, middle, v.a, m});
        m.slope = select(is_level, -level, slope);
        v.lo = middle;
        v.a = m;
    }
    visit(v);
}

// The sides of `count` equal stretches that make up 0..1.
template <bool kEdge, class T, class N, class F, class V>
TRIBO_LANES void over_stretches(int count, const N& node, const F& at, const V& visit) {
    Valley<T> v;
    v.lo = broadcast<T>(0);
    v.a = node(0);
    for (int k = 1; k <= count; ++k) {
        v.hi = broadcast<T>(static_cast<double>(k) / count);
        v.b = node(k);
        over_sides<kEdge>(v, at, visit);
        v.lo = v.hi;
        v.a = v.b;
    }
}

template <class T>
TRIBO_LANES void take(Least<T>& least, T distance, T t) {
    const auto better = distance < least.distance;
    least.distance = select(better, distance, least.distance);
    least.t = select(better, t, least.t);
}

// The least over the whole travel. node(k) is at(k / count), perhaps at less cost.
template <bool kEdge, class T, class N, class F>
TRIBO_LANES Least<T> least_over_unit(int count, const N& node, const F& at) {
    const T zero = broadcast<T>(0), never = broadcast<T>(kNever);
    Least<T> least{never, zero};
    Valley<T> deepest{};
    T floor = never, second = never;  // of the deepest valley, of the next
    over_stretches<kEdge, T>(count, node, at, [&](const Valley<T>& v) {
        take(least, v.a.distance, v.lo);
        take(least, v.b.distance, v.hi);
        const auto valley = is_valley(v.a, v.b);
        const T under = select(valley, floor_of<kEdge>(v, valley), never);
        const auto deeper = under < floor;
        second = min(second, select(deeper, floor, under));
        floor = select(deeper, under, floor);
        deepest.lo = select(deeper, v.lo, deepest.lo);
        deepest.hi = select(deeper, v.hi, deepest.hi);
        deepest.a = blend<kEdge>(deeper, v.a, deepest.a);
        deepest.b = blend<kEdge>(deeper, v.b, deepest.b);
    });
    descend<kEdge>(deepest, floor, floor < never, least, at);
    if (!any(second < least.distance - broadcast<T>(kSettled<T>))) return least;
    // Another valley may be deeper still.
    over_stretches<kEdge, T>(count, node, at, [&](const Valley<T>& v) {
        const auto valley = both(is_valley(v.a, v.b), v.lo != deepest.lo);
        descend<kEdge>(v, floor_of<kEdge>(v, valley), valley, least, at);
    });
    return least;
}
