// SPDX-License-Identifier: MIT
// The least distance over the instants t in 0..1 of a travel, for T = double or F8 (sweep_distance.inl says
// how this file is included). Every lane is searched as if it were alone: its result does not depend on the
// other lanes.
//
// The search is branch and bound with a true bound. As seen from the tool, the point runs along a curve q(t),
// and the distance F(q) to the tool is convex with slope at most 1 (the tool is a convex solid). So F lies
// above its tangent planes, and with |q''| <= bend
//     g(s) >= g(t) + g'(t) (s - t) - bend (s - t)^2 / 2,   g(t) = F(q(t)).
// Two such parabolas, from the ends of a stretch, bound g between them. Beside a round side g is even convex:
// g'' >= (way^2 - g'^2) / rho - bend. way is the speed of the point across the axis, rho its distance from
// the axis (for a ball: from its centre).

// The distance to the tool at one instant. `slope`, `drho` and `dz` are derivatives by t: of the distance, of
// the point's distance to the axis and of its height above the tip. `way_squared` is the square of its speed
// across the axis. `gap` is more than 0 where the point is beside the side of the tool. For a flat cutter it
// is distance to the side minus distance to the bottom; both meet in an edge.
template <class T>
struct Instant {
    T distance, slope, drho, dz, gap, way_squared;
};
template <bool kEdge, class T>
TRIBO_LANES Instant<T> blend(Mask<T> m, const Instant<T>& a, const Instant<T>& b) {
    return {select(m, a.distance, b.distance),
            select(m, a.slope, b.slope),
            kEdge ? select(m, a.drho, b.drho) : a.drho,
            kEdge ? select(m, a.dz, b.dz) : a.dz,
            select(m, a.gap, b.gap),
            select(m, a.way_squared, b.way_squared)};
}

// A lower bound of the distance over the whole travel, from its middle alone. `bend`: bound of |q''|.
template <class T>
TRIBO_LANES T bound_from_middle(const Instant<T>& middle, T bend) {
    return middle.distance - broadcast<T>(0.5) * abs(middle.slope) - broadcast<T>(0.125) * bend;
}

// Bounds for one point over the whole travel: of |q''|, of |q'|, and of the error of way_squared by a frame
// that spins. `radius` converts a distance to the side into a distance to the axis. `reach` is the distance
// from the tip.
template <class T>
struct PointBounds {
    T bend, speed, way_error, radius, reach;
};

// Larger than every distance, mm.
constexpr double kNever = 1e30;

template <class T>
struct Least {
    T distance, t;
};

// A stretch of t.
template <class T>
struct Stretch {
    T lo, hi;
    Instant<T> a, b;  // at lo and hi
};
template <bool kEdge, class T>
TRIBO_LANES Stretch<T> blend(Mask<T> m, const Stretch<T>& u, const Stretch<T>& v) {
    return {select(m, u.lo, v.lo), select(m, u.hi, v.hi), blend<kEdge>(m, u.a, v.a),
            blend<kEdge>(m, u.b, v.b)};
}

// kSettled: largest height of the least distance found in a valley above its bottom, mm. kProven: any
// distance is at most this much below the least that was found, mm.
template <class T>
constexpr double kSettled = std::is_same_v<T, double> ? 1e-6 : 1e-5;
template <class T>
constexpr double kProven = std::is_same_v<T, double> ? 1e-5 : 4e-5;

// Returns the largest fall of g' per t over the stretch: 0 where g is convex.
template <class T>
TRIBO_LANES T bend_of(const Stretch<T>& s, T width, const PointBounds<T>& p) {
    const T bow = p.bend * width, steep = max(abs(s.a.slope), abs(s.b.slope)) + bow;
    const T rho = max(s.a.distance, s.b.distance) + broadcast<T>(0.125) * bow * width + p.radius;
    const T way = min(s.a.way_squared, s.b.way_squared) - p.speed * bow - p.way_error;
    const auto convex = both(min(s.a.gap, s.b.gap) > broadcast<T>(0.75) * p.speed * width,
                             way - steep * steep >= p.bend * rho);
    return select(convex, broadcast<T>(0), p.bend);
}

// How many edges of the tool may be seen over a stretch. The gap tells of one; with more, no bottom is
// predicted.
constexpr int kNoEdge = 0, kOneEdge = 1, kManyEdges = 2;

// Returns the value that the search must reach over the stretch before it may stop. It is the lower one of
// two values: the true bound, raised by the tolerance of `kProven`, and in a valley the bottom that the
// slopes at its ends predict.
template <int kEdges, class T>
TRIBO_LANES T floor_of(const Stretch<T>& s, const PointBounds<T>& p) {
    const T zero = broadcast<T>(0), half = broadcast<T>(0.5), tiny = broadcast<T>(1e-30);
    const Instant<T>&a = s.a, &b = s.b;
    const T width = s.hi - s.lo, bend = bend_of(s, width, p), ends = min(a.distance, b.distance);
    const T bow = half * bend * width;
    const T steepness = max(b.slope - a.slope + bow + bow, tiny);
    const T meet = min(max((a.distance - b.distance + (b.slope + bow) * width) / steepness, zero), width);
    const T bound = min(ends, a.distance + meet * (a.slope - half * bend * meet));
    const auto valley = both(a.slope<zero, b.slope> zero);
    const T gentle = min(-a.slope, b.slope);
    T bottom = min(a.distance, b.distance) - half * gentle * gentle * width / steepness;
    if constexpr (kEdges == kOneEdge) bottom = select(a.gap * b.gap < zero, bound, bottom);
    if constexpr (kEdges == kManyEdges) bottom = bound;
    return min(bound + broadcast<T>(kProven<T> - kSettled<T>), select(valley, bottom, ends));
}

// Returns the step from lo to the minimum of the cubic with the distances and slopes of both ends.
template <class T>
TRIBO_LANES T to_bottom(const Stretch<T>& v, T width, T steepness) {
    const T chord = v.a.slope + v.b.slope + broadcast<T>(3) * (v.a.distance - v.b.distance) / width;
    const T root = sqrt(max(chord * chord - v.a.slope * v.b.slope, broadcast<T>(0)));
    return width - width * (v.b.slope + root - chord) / (steepness + root + root);
}

// Returns the step from lo to the zero of the cubic with the gaps and gap rates of both ends: two Newton
// steps from the zero of the chord.
template <class T>
TRIBO_LANES T to_edge(const Stretch<T>& v, T width, Mask<T> crosses) {
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

// Returns the next instant to evaluate. In a valley: at the bottom of the cubic, or at the edge if the
// stretch crosses one. A cubic that fits the distance badly moves only one end; therefore every third step
// halves. Elsewhere only the bound is too low: close to the nearer end, so that the bounds of both parts rise
// above it.
template <bool kEdge, class T>
TRIBO_LANES T next_look(const Stretch<T>& v, const PointBounds<T>& p, Mask<T> active, T looks) {
    const T zero = broadcast<T>(0), one = broadcast<T>(1), half = broadcast<T>(0.5);
    const T width = select(active, v.hi - v.lo, one);
    const auto valley = both(active, both(v.a.slope<zero, v.b.slope> zero));
    const T change = abs(v.b.slope - v.a.slope);
    T wanted = to_bottom(v, width, select(valley, change, one));
    if constexpr (kEdge) {
        const auto crosses = both(valley, v.a.gap * v.b.gap < zero);
        if (any(crosses)) wanted = select(crosses, to_edge(v, width, crosses), wanted);
    }
    const T bent = broadcast<T>(0.375) * p.bend * width / max(change, broadcast<T>(1e-30));
    const T near = min(max(bent, broadcast<T>(0.1)), half);
    const T one_sided = select(v.a.distance < v.b.distance, near, one - near);
    const T share = select(looks == broadcast<T>(2), half, select(valley, wanted / width, one_sided));
    return v.lo + width * min(max(share, broadcast<T>(0.02)), broadcast<T>(0.98));
}

template <class T>
TRIBO_LANES void take(Least<T>& least, T distance, T t) {
    const auto better = distance < least.distance;
    least.distance = select(better, distance, least.distance);
    least.t = select(better, t, least.t);
}

// Which distances are needed: those between -deep and limit. Above and below only the side is.
template <class T>
struct Needed {
    T deep, limit;
    explicit Needed(T near) : deep(near), limit(near) {}
    Needed(T d, T l) : deep(d), limit(l) {}
};

// Returns the value below which a floor is worth an evaluation.
template <class T>
TRIBO_LANES T goal_of(const Least<T>& least, const Needed<T>& needed) {
    return select(least.distance > -needed.deep,
                  min(least.distance - broadcast<T>(kSettled<T>), needed.limit), broadcast<T>(-kNever));
}

// Searches a stretch with known ends until nothing in it can lie below the least: depth first, each lane with
// its own stack of pending stretches.
template <int kEdges, class T, class F>
TRIBO_LANES void search(Stretch<T> s, T floor, const PointBounds<T>& p, const Needed<T>& needed,
                        Least<T>& least, const F& at) {
    constexpr bool kEdge = kEdges != kNoEdge;
    const T zero = broadcast<T>(0), one = broadcast<T>(1), never = broadcast<T>(kNever);
    constexpr int kDepth = std::is_same_v<T, double> ? 32 : 12;
    constexpr double kMostLooks = std::is_same_v<T, double> ? 200 : 50;
    Stretch<T> aside[kDepth];
    T floors[kDepth], depth = zero, looks = zero, since_halving = zero;
    int used = 0;  // the greatest depth of any lane
    while (true) {
        T goal = goal_of(least, needed);
        for (auto idle = both(floor >= goal, depth > zero); any(idle);
             idle = both(floor >= goal, depth > zero)) {
            for (int n = 0; n < used; ++n) {
                const auto top = both(idle, depth == broadcast<T>(n + 1));
                s = blend<kEdge>(top, aside[n], s);
                floor = select(top, floors[n], floor);
            }
            depth = select(idle, depth - one, depth);
            if (!any(depth >= broadcast<T>(used))) --used;
        }
        const auto active = both(floor < goal, looks < broadcast<T>(kMostLooks));
        if (!any(active)) return;
        const T t = next_look<kEdge>(s, p, active, since_halving);
        looks = looks + one;
        since_halving = select(since_halving == broadcast<T>(2), zero, since_halving + one);
        const Instant<T> c = at(t);
        take(least, select(active, c.distance, never), t);
        const Stretch<T> left{s.lo, t, s.a, c}, right{t, s.hi, c, s.b};
        const T below_left = floor_of<kEdges>(left, p), below_right = floor_of<kEdges>(right, p);
        const auto left_first = below_left < below_right;
        const T second = max(below_left, below_right);
        goal = goal_of(least, needed);
        const auto two = both(both(active, second < goal), depth < broadcast<T>(kDepth));
        if (any(two)) {
            const Stretch<T> other = blend<kEdge>(left_first, right, left);
            for (int n = 0; n <= used && n < kDepth; ++n) {
                const auto here = both(two, depth == broadcast<T>(n));
                // Nothing lies in a new place yet.
                aside[n] = n < used ? blend<kEdge>(here, other, aside[n]) : other;
                floors[n] = n < used ? select(here, second, floors[n]) : second;
            }
            depth = select(two, depth + one, depth);
            if (any(depth > broadcast<T>(used))) ++used;
        }
        floor = select(active, min(below_left, below_right), never);
        s = blend<kEdge>(left_first, left, right);
    }
}

// Returns the least over the travel from first / count to last / count. The stretches of 1 / count are
// searched in turn, the deepest first. node(k) equals at(k / count), perhaps at less cost. Farther than
// `near` from the tool the result is a bound of the distance on that side.
template <bool kEdge, class T, class N, class F>
TRIBO_LANES Least<T> least_over(int count, int first, int last, const PointBounds<T>& p,
                                const Needed<T>& needed, const N& node, const F& at) {
    const T never = broadcast<T>(kNever);
    const auto time = [&](int k) { return broadcast<T>(static_cast<double>(k) / count); };
    Least<T> least{never, time(first)};
    Stretch<T> s{}, deepest{};
    T floor = never, second = never;  // of the deepest stretch, of the next one
    const auto begin = [&] {
        s.lo = time(first);
        s.a = node(first);
    };
    const auto reach = [&](int k) {
        s.hi = time(k);
        s.b = node(k);
    };
    const auto go_on = [&] {
        s.lo = s.hi;
        s.a = s.b;
    };
    begin();
    take(least, s.a.distance, s.lo);
    for (int k = first + 1; k <= last; ++k, go_on()) {
        reach(k);
        take(least, s.b.distance, s.hi);
        const T under = floor_of<kEdge>(s, p);
        const auto deeper = under < floor;
        second = min(second, select(deeper, floor, under));
        floor = select(deeper, under, floor);
        deepest = blend<kEdge>(deeper, s, deepest);
    }
    const T bound = max(needed.limit, floor - broadcast<T>(kProven<T> - kSettled<T>));
    const T searched = deepest.lo;
    s = deepest;
    for (int k = first; k <= last; ++k) {
        if (k > first) {
            reach(k);
            floor = select(s.lo != searched, floor_of<kEdge>(s, p), never);
        }
        if (any(floor < goal_of(least, needed))) search<kEdge>(s, floor, p, needed, least, at);
        if (k == first) {
            if (!any(second < goal_of(least, needed))) break;
            begin();
        } else {
            go_on();
        }
    }
    return {select(least.distance > needed.limit, bound, least.distance), least.t};
}
