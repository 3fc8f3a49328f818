// SPDX-License-Identifier: MIT
// Travels along a quadratic with one axis and an even rise, of eight points at once (sweep_distance.inl says
// how this file is included). Where the square of the distance to the axis is convex, Newton's method finds
// the nearest instant in two or three steps.

// Returns the distances. They hold in the lanes of `sure` only; the others must be searched.
template <CutterKind kind>
TRIBO_LANES F8 upright_distance(const Profile<F8>& p, const UprightLine& line, F8 x, F8 y, F8 z, I8& sure) {
    constexpr int kMostSteps = 12;
    constexpr double kStill = 1e-4;  // the last step moves the tool by less than this share of R
    const F8 zero = splat(0.0f), two = splat(2.0f), tiny = broadcast<F8>(1e-30);
    const F8 across = broadcast<F8>(line.across), rise = broadcast<F8>(line.rise);
    const F8 bend_x = broadcast<F8>(line.bend_x), bend_y = broadcast<F8>(line.bend_y);
    const F8 height = z - p.R, way_x = across + bend_x;
    struct Across {
        F8 x, y, rho_squared;
    };
    const auto off = [&](F8 t) {
        const F8 dx = x - t * (across + t * bend_x), dy = y - t * t * bend_y;
        return Across{dx, dy, dx * dx + dy * dy};
    };
    // Half of the rate of rho^2, and its rate.
    struct Rate {
        F8 value, growth;
    };
    const auto rate_of = [&](const Across& d, F8 t) {
        const F8 speed_x = across + two * t * bend_x, speed_y = two * t * bend_y;
        return Rate{-(d.x * speed_x + d.y * speed_y),
                    speed_x * speed_x + speed_y * speed_y - two * (d.x * bend_x + d.y * bend_y)};
    };
    const auto lowest = [&](F8 t) { return min(height - t * rise, zero); };

    F8 along = x * way_x + y * bend_y, squared = way_x * way_x + bend_y * bend_y;
    if constexpr (kind == CutterKind::ball) {
        along += height * rise;
        squared += rise * rise;
    }
    F8 t = unit_clamp(along / max(squared, tiny));
    sure = x * bend_x + y * bend_y < broadcast<F8>(line.convex_below);
    I8 moving = sure;
    const F8 still = broadcast<F8>(kStill * kStill) * p.R * p.R;
    for (int n = 0; n < kMostSteps && any(moving); ++n) {
        Rate rate = rate_of(off(t), t);
        if constexpr (kind == CutterKind::ball) {
            const F8 below = lowest(t);
            rate.value -= below * rise;
            rate.growth += select(below < zero, rise * rise, zero);
        }
        const F8 next = unit_clamp(t - rate.value / rate.growth), step = next - t;
        I8 goes_on = step * step * rate.growth > still;
        // Where the ball's centre passes the height of the point, another growth begins.
        if constexpr (kind == CutterKind::ball) goes_on |= (lowest(t) < zero) ^ (lowest(next) < zero);
        t = select(moving, next, t);
        moving = both(moving, goes_on);
    }
    sure &= ~moving;
    const F8 cap = z - max(rise, zero) - p.L;
    if constexpr (kind == CutterKind::ball) {
        const F8 below = lowest(t);
        return max(sqrt(off(t).rho_squared + below * below) - p.R, cap);
    }
    const auto side = [&](F8 at) { return sqrt(off(at).rho_squared) - p.R; };
    const auto bottom = [&](F8 at) { return at * rise - z; };
    const F8 beside = side(t), under = bottom(t);
    F8 distance = max(beside, under);
    if (line.rise == 0) return max(distance, cap);
    // Below the bottom the tool comes nearer where it is lower, as far as its edge.
    const F8 end = splat(line.rise > 0 ? 0.0f : 1.0f), at_end = bottom(end);
    const I8 by_bottom = both(sure, beside < under);
    const I8 by_edge = both(by_bottom, side(end) > at_end);
    distance = select(by_bottom, at_end, distance);
    moving = by_edge;
    F8 edge = end;
    for (int n = 0; n < kMostSteps && any(moving); ++n) {
        const Across d = off(edge);
        const F8 rho = sqrt(d.rho_squared), gap = rho - p.R - bottom(edge);
        const F8 slope = rate_of(d, edge).value / max(rho, tiny) - rise;
        moving = both(moving, abs(gap) > broadcast<F8>(0.5 * kSettled<F8>));
        edge = select(moving, min(max(edge - gap / slope, min(t, end)), max(t, end)), edge);
    }
    sure &= ~moving;
    return max(select(by_edge, max(side(edge), bottom(edge)), distance), cap);
}
