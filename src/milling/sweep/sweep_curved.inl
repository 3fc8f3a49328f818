// SPDX-License-Identifier: MIT
// Travels along quadratics (sweep_distance.inl says how this file is included). One point evaluates the
// quadratics themselves. The eight nodes of a lattice row evaluate polynomials of the tool's frame, which are
// as accurate as single precision: they are linear in the point and therefore nearly free along a row.

inline Vec3 tip_at(const CurvedLine& c, double t) {
    return t * (c.tip1 + t * c.tip2);
}
inline Vec3 axis_at(const CurvedLine& c, double t) {
    return normalized(c.axis0 + t * (c.axis1 + t * c.axis2));
}

// Bounds for a point relative to the tip at the start. In a frame that follows the axis without spin the
// point runs along q with q' = -v - w x d and q'' = -a + 2 w x v - w' x d + w x (w x d). d is the point
// relative to the tip, v and a are speed and acceleration of the tip, w is the rate of turn of the axis.
template <class T>
TRIBO_LANES PointBounds<T> bounds_of(const Profile<T>& p, const TravelBounds& b, T x, T y, T z) {
    const T dx = x - broadcast<T>(b.middle.x), dy = y - broadcast<T>(b.middle.y),
            dz = z - broadcast<T>(b.middle.z);
    const T reach = sqrt(dx * dx + dy * dy + dz * dz) + broadcast<T>(b.spread);
    return {
        broadcast<T>(b.tip_bend + 2 * b.turn * b.speed) + broadcast<T>(b.turn_rate + b.turn * b.turn) * reach,
        broadcast<T>(b.speed) + broadcast<T>(b.turn) * reach, broadcast<T>(0), p.R, reach};
}

// The tool at the eight instants as seen from one point; the names are those of instant().
struct Views {
    F8 rho_squared, half_rate, z, dz, way_squared;

    TRIBO_LANES Views(const CurvedInstants& c, const float (&point)[3]) {
        const F8 zero = splat(0.0f);
        F8 d[3], axis[3], turned = zero, along = zero, squared = zero;
        rho_squared = half_rate = z = zero;
        for (int k = 0; k < 3; ++k) {
            d[k] = splat(point[k]) - load(c.tip[k]);
            axis[k] = load(c.axis[k]);
            z += d[k] * axis[k];
            turned += d[k] * load(c.axis_rate[k]);
            along += axis[k] * load(c.tip_rate[k]);
        }
        for (int k = 0; k < 3; ++k) {
            const F8 radial = d[k] - z * axis[k], way = load(c.tip_rate[k]) + z * load(c.axis_rate[k]);
            rho_squared += radial * radial;
            half_rate -= radial * way;
            squared += way * way;
        }
        dz = turned - along;
        way_squared = squared - along * along;
    }
    template <CutterKind kind>
    TRIBO_LANES Instant<F8> instants(const Profile<F8>& p) const {
        return instant<kind>(p, rho_squared, half_rate, z, dz, way_squared);
    }
};

// Rounding error of a distance in single precision, per mm from the tip.
constexpr float kRounding = 1e-6f;

// Returns lower bounds of the distances to eight travels, each from its middle alone.
template <CutterKind kind>
TRIBO_LANES F8 bounds_from_middles(const Profile<F8>& p, const TravelMiddles& m, const float (&point)[3]) {
    F8 away = splat(0.0f);
    for (int k = 0; k < 3; ++k) {
        const F8 d = splat(point[k]) - load(m.middle[k]);
        away += d * d;
    }
    const F8 reach = sqrt(away) + load(m.spread), speed = load(m.speed) + load(m.turn) * reach;
    const F8 bend = load(m.bend) + load(m.bend_per_mm) * reach;
    const Instant<F8> middle = Views(m.at, point).instants<kind>(p);
    const F8 rounding = splat(kRounding) * reach * (splat(1.0f) + speed / p.R);
    return bound_from_middle(middle, bend) - rounding;
}

// Fills Floors for one point: eight instants at once.
template <CutterKind kind>
TRIBO_LANES void curved_floors(const Profile<F8>& p, const CurvedInstants& c, const TravelBounds& travel,
                               const float (&point)[3], Floors& out) {
    constexpr bool kEdge = kind == CutterKind::flat;
    const F8 width = splat(1.0f / (CurvedInstants::kCount - 1));
    const Views v(c, point);
    const PointBounds<F8> bounds =
        bounds_of<F8>(p, travel, splat(point[0]), splat(point[1]), splat(point[2]));
    const F8 reach = bounds.reach;
    const F8 rounding = splat(kRounding) * reach * (splat(1.0f) + width * bounds.speed / p.R);
    Stretch<F8> s;
    s.a = v.instants<kind>(p);
    s.b = {next(s.a.distance), next(s.a.slope), next(s.a.drho),
           next(s.a.dz),       next(s.a.gap),   next(s.a.way_squared)};
    s.lo = splat(0.0f);
    s.hi = width;
    store(out.floor, floor_of<kEdge>(s, bounds) - rounding);
    store(out.distance, s.a.distance - rounding);
    store(out.slope, s.a.slope);
    store(out.drho, s.a.drho);
    store(out.dz, s.a.dz);
    store(out.gap, s.a.gap);
    store(out.way_squared, s.a.way_squared);
    out.lowest = v.z[0];
    for (int k = 1; k < CurvedInstants::kCount; ++k) out.lowest = v.z[k] < out.lowest ? v.z[k] : out.lowest;
}

// Lower and upper bounds, at the eight instants, of the rate of change of the distance for all points within
// `radius` of one point.
struct SlopeBounds {
    F8 least, most;
};

// Two points see the tool in directions that differ by at most 2 radius / (rho + rho'), and move past it at
// velocities that differ by at most turn * radius. Where side and bottom of a tool may both count, the slope
// is the slope of one of them or, on a corner, a mix whose shares add up to at least 1.
template <CutterKind kind>
TRIBO_LANES SlopeBounds slopes_around(const Profile<F8>& p, const Views& v, F8 radius, F8 turn) {
    const F8 two = splat(2.0f), never = broadcast<F8>(kNever), tiny = broadcast<F8>(1e-30);
    const auto turned = [&](F8 rho) {
        return min(two * radius / max(rho + max(rho - radius, splat(0.0f)), tiny), two);
    };
    const F8 spread = turn * radius;
    if constexpr (kind == CutterKind::ball) {
        const Instant<F8> i = v.instants<kind>(p);
        const F8 off = turned(i.distance + p.R) * sqrt(v.way_squared + v.dz * v.dz) + spread;
        return {i.slope - off, i.slope + off};
    }
    const F8 rho = sqrt(v.rho_squared), drho = v.half_rate / max(rho, tiny), gap = rho - p.R + v.z;
    const F8 off = turned(rho) * sqrt(max(v.way_squared, splat(0.0f))) + spread;
    // The gap changes by at most sqrt(2) per mm.
    const F8 sure = splat(1.4143f) * radius;
    auto side = gap > -sure, bottom = gap < sure;
    if constexpr (kind == CutterKind::bull) {  // in front of the corner both count
        side = either(side, rho > p.core - radius);
        bottom = either(bottom, v.z < p.r + radius);
    }
    const F8 fall = -v.dz;
    return {min(select(side, drho - off, never), select(bottom, fall - spread, never)),
            max(select(side, drho + off, -never), select(bottom, fall + spread, -never))};
}

// A part of the travel, in t.
struct Part {
    float from = 0, to = 1;
};

// Returns the part of the travel, from one of the eight instants to another, that holds the nearest instant
// of every point within `radius` of `point`. Returns the whole travel if the flat top of the tool may count.
template <CutterKind kind>
TRIBO_LANES Part nearest_part(const Profile<F8>& p, const CurvedInstants& c, const TravelBounds& travel,
                              const float (&point)[3], float radius) {
    constexpr int kLast = CurvedInstants::kCount - 1;
    const F8 when = F8{0, 1, 2, 3, 4, 5, 6, 7} / broadcast<F8>(kLast);
    const Views v(c, point);
    const PointBounds<F8> bounds =
        bounds_of<F8>(p, travel, splat(point[0]), splat(point[1]), splat(point[2]));
    const F8 turn = broadcast<F8>(travel.turn), around = splat(radius);
    const F8 bend = bounds.bend + broadcast<F8>(travel.turn_rate + travel.turn * travel.turn) * around;
    const F8 speed = bounds.speed + turn * around;
    // The distance is never less than -R.
    if (any(v.z + around + splat(0.5f / kLast) * speed > p.L - p.R)) return {};
    // g' falls by at most bend per t. Where g' is below -bend t, g falls all the way from 0 to there, and
    // more steeply than the bound of a search between two of these instants; likewise from 1. The margin is
    // far above the rounding in that search, so that the search finds the same result to the last bit.
    const F8 margin = splat(5e-3f) + splat(1e-3f) * speed;
    const SlopeBounds slope = slopes_around<kind>(p, v, around, turn);
    const auto falls = slope.most + bend * when < -margin;
    const auto rises = slope.least - bend * (splat(1.0f) - when) > margin;
    Part part;
    for (int k = 0; k <= kLast; ++k) {
        if (falls[k] != 0) part.from = when[k];
        if (rises[kLast - k] != 0) part.to = when[kLast - k];
    }
    return part;
}

// The tool at one instant as seen from a point; the names are those of instant().
struct Seen {
    double rho_squared, half_rate, z, dz, way_squared;
};
inline Seen seen_at(const CurvedLine& c, Vec3 point, double t) {
    const Vec3 d = point - tip_at(c, t), velocity = c.tip1 + 2 * t * c.tip2;
    const Vec3 n = c.axis0 + t * (c.axis1 + t * c.axis2), turning = c.axis1 + 2 * t * c.axis2;
    const double per_squared = 1 / dot(n, n), per = std::sqrt(per_squared), z = dot(d, n) * per;
    const double growth = dot(n, turning) * per_squared, along = dot(velocity, n) * per;
    const double dz = (dot(d, turning) * per - z * growth) - along;
    const Vec3 way = velocity + (z * per) * (turning - growth * n);
    return {max(dot(d, d) - z * z, 0.0), -dot(d, velocity) - z * dz, z, dz, dot(way, way) - along * along};
}

template <CutterKind kind>
TRIBO_LANES Instant<double> curved_instant(const Profile<double>& p, const CurvedLine& c, Vec3 point,
                                           double t) {
    const Seen s = seen_at(c, point, t);
    return instant<kind>(p, s.rho_squared, s.half_rate, s.z, s.dz, s.way_squared);
}

// Returns a lower bound of the distance from the middle instant alone. It is cheap, and useful for short
// travels.
template <CutterKind kind>
double curved_bound(const Profile<double>& p, const CurvedLine& c, Vec3 point) {
    const Instant<double> middle = curved_instant<kind>(p, c, point, 0.5);
    const double bend = bounds_of<double>(p, c.bounds, point.x, point.y, point.z).bend;
    return middle.distance - 0.5 * std::abs(middle.slope) - 0.125 * bend;
}

// Returns the instant at which the tool comes nearest, without its flat top, if that distance is below
// `bound`.
template <CutterKind kind>
Least<double> curved_nearest(const Profile<double>& p, const CurvedLine& c, const Floors& floors, Vec3 point,
                             double bound) {
    constexpr bool kEdge = kind == CutterKind::flat;
    const PointBounds<double> bounds = bounds_of<double>(p, c.bounds, point.x, point.y, point.z);
    const auto at = [&](double t) { return curved_instant<kind>(p, c, point, t); };
    constexpr int kStretches = CurvedInstants::kCount - 1;
    Least<double> least{bound, 0};
    const auto exact = [&](double t) {
        const Instant<double> i = at(t);
        take(least, i.distance, t);
        return i;
    };
    const auto is_open = [&](double floor) { return floor < least.distance - kSettled<double>; };
    // Single precision is accurate enough for the distance at an end that cannot be the nearest instant.
    const auto look_through = [&](Stretch<double> s, bool lo_is_exact,
                                  bool hi_is_exact) __attribute__((noinline)) {
        if (!is_open(floor_of<kEdge>(s, bounds))) return;
        if (!lo_is_exact && is_open(s.a.distance)) s.a = exact(s.lo);
        if (!hi_is_exact && is_open(s.b.distance)) s.b = exact(s.hi);
        search<kEdge>(s, floor_of<kEdge>(s, bounds), bounds, Needed<double>(kNever), least, at);
    };
    unsigned open = (1u << kStretches) - 1;  // one bit per stretch that was not searched yet
    while (true) {
        int k = -1;
        auto deepest = static_cast<float>(least.distance - kSettled<double>);
        for (int n = 0; n < kStretches; ++n) {
            if ((open >> n & 1) != 0 && floors.floor[n] < deepest) {
                deepest = floors.floor[n];
                k = n;
            }
        }
        if (k < 0) return least;
        open &= ~(1u << k);
        const auto seen = [&](int n) {
            return Instant<double>{floors.distance[n], floors.slope[n], floors.drho[n],
                                   floors.dz[n],       floors.gap[n],   floors.way_squared[n]};
        };
        Stretch<double> s{static_cast<double>(k) / kStretches, static_cast<double>(k + 1) / kStretches,
                          seen(k), seen(k + 1)};
        if (s.a.slope < 0 && s.b.slope > 0) {
            const double t = next_look<kEdge>(s, bounds, true, 0.0);
            const Instant<double> middle = exact(t);
            look_through({s.lo, t, s.a, middle}, false, true);
            look_through({t, s.hi, middle, s.b}, true, false);
        } else if (s.a.distance < s.b.distance) {
            s.a = exact(s.lo);
            look_through(s, true, false);
        } else {
            s.b = exact(s.hi);
            look_through(s, false, true);
        }
    }
}

// Returns the instant of the least distance from the one that a search has found. Near its bottom the
// distance hardly tells instants apart, so that the search may end some um of the way beside it, where the
// normal is off by a thousandth. The slope tells: one step towards where it is zero, and one of the secant.
// `at` gives the instants of a tool of this kind and radius.
template <CutterKind kind, class F>
double sharpened(double radius_mm, const F& at, double t) {
    const Instant<double> found = at(t);
    const bool is_end = (t <= 0 && found.slope >= 0) || (t >= 1 && found.slope <= 0);
    if (is_end || found.slope == 0) return t;
    // The slope ends after a fall of no more than kSettled.
    const double most = 2 * kSettled<double> / std::abs(found.slope);
    if constexpr (kind == CutterKind::flat) {
        // At the edge, where the side comes nearer as the bottom leaves, or the bottom as the side does.
        constexpr double kOnEdge = 1e-6;  // mm
        const bool has_edge = found.drho * found.dz > 0;
        if (has_edge && std::abs(found.gap) < kOnEdge) return t;
        const double to_edge = -found.gap / (found.drho + found.dz);
        if (has_edge && std::abs(to_edge) < most && to_edge * found.slope < 0) {
            const Instant<double> near = at(t + to_edge);
            const double edge = std::clamp(t + to_edge - near.gap / (near.drho + near.dz), 0.0, 1.0);
            if (at(edge).distance <= found.distance) return edge;
        }
    }
    // Of the slope beside a round side, on a path without bend.
    const double growth = found.gap > 0 ? found.way_squared / (found.distance + radius_mm) : 0;
    const double size = growth > 0 ? std::min(std::abs(found.slope) / growth, most) : most;
    const double next = std::clamp(found.slope < 0 ? t + size : t - size, 0.0, 1.0);
    const Instant<double> there = at(next);
    const double change = there.slope - found.slope;
    if (!(found.gap * there.gap > 0) || !(change * (next - t) > 0)) return t;
    const double sharp = std::clamp(next - there.slope * (next - t) / change, 0.0, 1.0);
    if (kind == CutterKind::ball && std::abs(there.slope) < 0.5 * std::abs(found.slope)) return sharp;
    const Instant<double> last = at(sharp);
    const bool is_lower = found.gap * last.gap > 0 && last.distance <= found.distance;
    return is_lower && std::abs(last.slope) < std::abs(found.slope) ? sharp : t;
}

// The coordinates of points in the tool's frame at one instant, x and y across the axis: their gradient by
// the point's coordinates, and their values for the point (0, 0, 0).
struct SeenAxes {
    struct Row {
        Vec3 axis;
        double constant;
    };
    Row rows[3];

    SeenAxes(const CurvedLine& line, double t) {
        const Vec3 across = any_perpendicular(line.axis0), tip = tip_at(line, t), z = axis_at(line, t);
        const Vec3 x = normalized(across - dot(across, z) * z);
        const Vec3 axes[3] = {x, cross(z, x), z};
        for (int k = 0; k < 3; ++k) rows[k] = {axes[k], -dot(tip, axes[k])};
    }
};

// The same as polynomials of t in Newton's form through the Chebyshev points. With w the turn of the axis, v
// the length of the tip path and d the distance of a point, all over one piece, their error is about 7e-7 w^5
// (6 v + w d): 0.01 um at 30 degrees, 40 mm from the tip, 20 mm of path.
struct SeenFrame {
    static constexpr int kDegree = 5, kCoefficients = 3 * (kDegree + 1), kMostStretches = 8;
    // First the coefficients. From kNodes on: x, y, z and their derivatives at every node from the first to
    // the last; if there is one stretch, also at its middle.
    static constexpr int kNodes = 24, kEntries = 80;
    static_assert(kNodes >= kCoefficients && kEntries >= kNodes + 6 * (kMostStretches + 1));
    static_assert(kNodes % kLatticeEdge == 0 && kEntries % kLatticeEdge == 0);
    // (1 - cos((2 i + 1) pi / 12)) / 2
    static constexpr double kPoints[kDegree + 1] = {0.017037086855465844, 0.14644660940672624,
                                                    0.3705904774487396,   0.6294095225512604,
                                                    0.8535533905932737,   0.9829629131445341};

    // Value of each entry for the point (0, 0, 0), and its gradient by the coordinates of the point.
    float constant[kEntries] = {}, by_x[kEntries] = {}, by_y[kEntries] = {}, by_z[kEntries] = {};
    int stretches, first, last;  // nodes are at n / stretches
    // Upper bound of twice the speed at which the frame spins about the axis, radians per t. The frame is
    // free of spin only at t = 0.
    float spin;

    SeenFrame(const CurvedLine& line, const Part& part)
        : stretches(line.stretches),
          first(static_cast<int>(std::floor(part.from * static_cast<float>(stretches)))),
          last(static_cast<int>(std::ceil(part.to * static_cast<float>(stretches)))),
          spin(static_cast<float>(2.5 * line.bounds.turn * std::min(line.bounds.turn, 1.0))) {
        using Row = SeenAxes::Row;
        Row table[kDegree + 1][3];
        for (int i = 0; i <= kDegree; ++i) {
            const SeenAxes axes(line, kPoints[i]);
            std::copy_n(axes.rows, 3, table[i]);
        }
        // Divided differences.
        for (int order = 1; order <= kDegree; ++order) {
            for (int i = kDegree; i >= order; --i) {
                const double per = 1 / (kPoints[i] - kPoints[i - order]);
                for (int k = 0; k < 3; ++k) {
                    Row& r = table[i][k];
                    const Row& before = table[i - 1][k];
                    r = {per * (r.axis - before.axis), per * (r.constant - before.constant)};
                }
            }
        }
        const auto put = [&](int entry, const Row& r) {
            constant[entry] = static_cast<float>(r.constant);
            by_x[entry] = static_cast<float>(r.axis.x);
            by_y[entry] = static_cast<float>(r.axis.y);
            by_z[entry] = static_cast<float>(r.axis.z);
        };
        for (int k = 0; k < 3; ++k) {
            for (int i = 0; i <= kDegree; ++i) put(3 * i + k, table[i][k]);
        }
        const auto put_instant = [&](int entry, double t) {
            const SeenAxes axes(line, t);
            for (int k = 0; k < 3; ++k) {
                Row value = table[kDegree][k], rate{{}, 0};
                for (int i = kDegree - 1; i >= 0; --i) {
                    const double h = t - kPoints[i];
                    rate = {h * rate.axis + value.axis, h * rate.constant + value.constant};
                    value = {h * value.axis + table[i][k].axis, h * value.constant + table[i][k].constant};
                }
                put(entry + k, axes.rows[k]);
                put(entry + 3 + k, rate);
            }
        };
        for (int n = first; n <= last; ++n) put_instant(node(n), static_cast<double>(n) / stretches);
        if (stretches == 1) put_instant(node(last + 1), 0.5);
    }
    int node(int n) const { return kNodes + 6 * (n - first); }
};

// One row of nodes: the entries at y and z, still linear in x. Few rows need the coefficients.
struct SeenRow {
    const SeenFrame& frame;
    F8 x, y, z;
    float at_zero[SeenFrame::kEntries];

    TRIBO_LANES SeenRow(const SeenFrame& f, F8 px, float py, float pz)
        : frame(f), x(px), y(splat(py)), z(splat(pz)) {}
    TRIBO_LANES void fill(int first, int end) {
        for (int i = first; i < end; i += kLatticeEdge) {
            store(at_zero + i,
                  load(frame.constant + i) + z * load(frame.by_z + i) + y * load(frame.by_y + i));
        }
    }
    TRIBO_LANES F8 entry(int i) const { return splat(at_zero[i]) + x * splat(frame.by_x[i]); }
};

// Returns lower bounds of the distances of a row from the middle of the travel alone.
template <CutterKind kind>
TRIBO_LANES F8 row_bound(const Profile<F8>& p, const SeenFrame& frame, F8 x, float y, float z,
                         const PointBounds<F8>& bounds) {
    const int first = frame.node(frame.last + 1);
    F8 seen[6];
    for (int k = 0; k < 6; ++k) {
        const int i = first + k;
        seen[k] = splat(frame.constant[i] + z * frame.by_z[i] + y * frame.by_y[i]) + x * splat(frame.by_x[i]);
    }
    const Instant<F8> middle =
        instant<kind>(p, seen[0] * seen[0] + seen[1] * seen[1], seen[0] * seen[3] + seen[1] * seen[4],
                      seen[2], seen[5], seen[3] * seen[3] + seen[4] * seen[4]);
    return bound_from_middle(middle, bounds.bend) - broadcast<F8>(kProven<F8>);
}

template <CutterKind kind>
TRIBO_LANES F8 curved_row(const Profile<F8>& p, SeenRow& row, const PointBounds<F8>& bounds,
                          const Needed<F8>& needed) {
    row.fill(SeenFrame::kNodes, row.frame.node(row.frame.last + 1));
    const auto seen = [&](const F8(&value)[3], const F8(&rate)[3]) {
        return instant<kind>(p, value[0] * value[0] + value[1] * value[1],
                             value[0] * rate[0] + value[1] * rate[1], value[2], rate[2],
                             rate[0] * rate[0] + rate[1] * rate[1]);
    };
    F8 coefficients[SeenFrame::kCoefficients];
    bool has_coefficients = false;
    const auto at = [&](F8 t) {
        if (!has_coefficients) {
            has_coefficients = true;
            row.fill(0, SeenFrame::kCoefficients);
            for (int i = 0; i < SeenFrame::kCoefficients; ++i) coefficients[i] = row.entry(i);
        }
        F8 value[3], rate[3];
        for (int k = 0; k < 3; ++k) {
            value[k] = coefficients[3 * SeenFrame::kDegree + k];
            rate[k] = broadcast<F8>(0);
        }
        for (int i = SeenFrame::kDegree - 1; i >= 0; --i) {
            const F8 h = t - broadcast<F8>(SeenFrame::kPoints[i]);
            for (int k = 0; k < 3; ++k) {
                rate[k] = h * rate[k] + value[k];
                value[k] = h * value[k] + coefficients[3 * i + k];
            }
        }
        return seen(value, rate);
    };
    const auto node = [&](int n) {
        const int first = row.frame.node(n);
        const F8 value[3] = {row.entry(first), row.entry(first + 1), row.entry(first + 2)};
        const F8 rate[3] = {row.entry(first + 3), row.entry(first + 4), row.entry(first + 5)};
        return seen(value, rate);
    };
    return least_over < kind ==
           CutterKind::flat >
               (row.frame.stretches, row.frame.first, row.frame.last, bounds, needed, node, at).distance;
}
