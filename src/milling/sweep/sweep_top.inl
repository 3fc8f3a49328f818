// SPDX-License-Identifier: MIT
// The flat top of the tool; sweep.cpp includes this file behind sweep_curved.inl.
//
// The other formulas leave the top out where a move leads along the axis: they find the instant at which the
// tool comes nearest as if it went on upwards, some of them up to the highest place of its top. Where the
// point is below the top at that instant, or farther from the tool than above its top, that is the distance.
// Elsewhere, as above a disc that was there and has sunk, it is searched anew, for the tool with its top.

// True if the top does not count at the instant of the least distance. `height`: of the point above the tip.
inline bool is_below_top(const ToolProfile& tool, const Least<double>& least, double height) {
    return height - tool.length_mm <= least.distance;
}

// Of the tool with its top. The gap to the top stands in for the gap to the bottom where it is the smaller
// one.
template <CutterKind kind>
Instant<double> closed_instant(const Profile<double>& p, const CurvedLine& c, Vec3 point, double t) {
    const Seen s = seen_at(c, point, t);
    const Instant<double> i = instant<kind>(p, s.rho_squared, s.half_rate, s.z, s.dz, s.way_squared);
    if (kind == CutterKind::flat && s.z <= 0.5 * p.L) return i;
    const double top = s.z - p.L, gap = i.distance - top;
    return {max(i.distance, top), gap >= 0 ? i.slope : s.dz, i.slope, -s.dz, min(i.gap, gap), i.way_squared};
}

// Returns the instant at which the tool with its top comes nearest, if that distance is below `bound`. The
// point is relative to the tip at the start.
template <CutterKind kind>
Least<double> closed_nearest(const Profile<double>& p, const CurvedLine& c, Vec3 point, double bound) {
    const PointBounds<double> bounds = bounds_of<double>(p, c.bounds, point.x, point.y, point.z);
    const auto at = [&](double t) { return closed_instant<kind>(p, c, point, t); };
    Least<double> least{bound, 0};
    Instant<double> end = at(0);
    take(least, end.distance, 0.0);
    for (int n = 0; n < c.stretches; ++n) {
        Stretch<double> s{
            static_cast<double>(n) / c.stretches, static_cast<double>(n + 1) / c.stretches, end, {}};
        s.b = end = at(s.hi);
        take(least, end.distance, s.hi);
        search<kManyEdges>(s, floor_of<kManyEdges>(s, bounds), bounds, Needed<double>(kNever), least, at);
    }
    return least;
}

// Corrects the sampled nodes for which the top may count. `highest_mm` of a point and a distance: no point
// within that distance is higher above the top, at any instant.
template <class F>
void sample_tops(const field::Shape& shape, const field::Lattice& lattice, double near_mm, const float* known,
                 float* out, const F& highest_mm) {
    constexpr double kHalf = 0.5 * (kLatticeEdge - 1);
    const Vec3 middle = lattice.node(0, 0, 0) + (kHalf * lattice.cell_mm) * Vec3{1, 1, 1};
    if (highest_mm(middle, std::sqrt(3.0) * kHalf * lattice.cell_mm) < -near_mm) return;
    for (int n = 0; n < field::kLatticeNodes; ++n) {
        const double bound = known ? std::min(near_mm, static_cast<double>(known[n])) : near_mm;
        if (static_cast<double>(out[n]) >= bound) continue;
        const Vec3 node = lattice.node(n % kLatticeEdge, n / kLatticeEdge % kLatticeEdge,
                                       n / (kLatticeEdge * kLatticeEdge));
        if (highest_mm(node, 0.0) < -near_mm) continue;
        out[n] = static_cast<float>(shape.distance_below(node, bound));
    }
}
