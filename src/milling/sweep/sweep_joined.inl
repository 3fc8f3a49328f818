// SPDX-License-Identifier: MIT
// Sweeps of several moves, one after the other. sweep.cpp includes this file behind the sweeps of one move.

// Several straight travels with one axis, each from the end of the one before it.
class JoinedStraightSweep final : public field::Shape {
  public:
    JoinedStraightSweep(const ToolProfile& tool, std::span<const motion::Move* const> moves)
        : tool_(tool),
          whole_(moves.front()->start.tip_mm, moves.back()->end.tip_mm - moves.front()->start.tip_mm,
                 moves.front()->start.axis) {
        std::vector<Vec3> tips{{}};
        parts_.reserve(moves.size());
        for (const motion::Move* move : moves) {
            const StraightFrame own(move->start.tip_mm, move->end.tip_mm - move->start.tip_mm,
                                    whole_.frame.z);
            box_.include(own.box({tool_.radius_mm, tool_.length_mm}));
            const double along_x = dot(own.frame.x, whole_.frame.x),
                         along_y = dot(own.frame.x, whole_.frame.y);
            parts_.push_back({whole_.frame.into(own.start - whole_.start), along_x, along_y, own.line});
            tips.push_back(whole_.frame.into(move->end.tip_mm - whole_.start));
            lowest_mm_ = std::min(lowest_mm_, tips.back().z);
            highest_mm_ = std::max(highest_mm_, tips.back().z);
        }
        direct_ = Chord(tips);
        for (Vec3& tip : tips) tip.z = 0;
        level_ = Chord(tips);
    }

    Box3 bounds_mm() const override { return box_; }
    double distance_mm(Vec3 point) const override { return distance_below(point, kNever); }
    double distance_below(Vec3 point, double bound) const override {
        return least(whole_.frame.into(point - whole_.start), bound).distance;
    }

    // At each instant the tool holds a piece of a line along its axis. If the path does not rise by more than
    // the cylinder is long, all these pieces have a point in common.
    bool is_whole_along(Vec3 direction) const override {
        return highest_mm_ - lowest_mm_ <= tool_.length_mm - tool_.corner_mm &&
               are_parallel(direction, whole_.frame.z);
    }

    Vec3 gradient(Vec3 point) const override { return slope(point).gradient; }

    Slope slope(Vec3 point) const override {
        const Vec3 q = whole_.frame.into(point - whole_.start);
        const StraightPart& part = parts_[least(q, kNever).part];
        const Frame& f = whole_.frame;
        const Frame own{part.along_x * f.x + part.along_y * f.y, part.along_x * f.y - part.along_y * f.x,
                        f.z};
        return straight_slope(tool_, part.line, own, seen(part, q));
    }

    void sample(const field::Lattice& lattice, float* out) const override {
        sample_near(lattice, kNever, out);
    }

    void sample_near(const field::Lattice& lattice, double near_mm, float* out) const override {
        sweep_kernels().joined_straight(tool_, parts_, whole_.frame, whole_.start, lattice, near_mm, out);
        if (lowest_mm_ == highest_mm_) return;
        sample_tops(*this, lattice, near_mm, nullptr, out, [this](Vec3 point, double around) {
            return dot(point - whole_.start, whole_.frame.z) + around - lowest_mm_ - tool_.length_mm;
        });
    }

  private:
    // A path of tips beside the straight line from its start to its end.
    struct Chord {
        Vec3 along;              // unit; zero if the path does not advance all along the line
        std::vector<double> at;  // of each tip, along the line
        double off_mm = 0;       // largest distance of the path from the line
        double parts_per_mm = 0;

        Chord() = default;
        explicit Chord(const std::vector<Vec3>& tips) : along(normalized(tips.back(), {0, 0, 0})) {
            for (std::size_t n = 1; n < tips.size(); ++n)
                if (!(dot(tips[n] - tips[n - 1], along) > 0)) along = {};
            at.reserve(tips.size());
            for (const Vec3 tip : tips) {
                at.push_back(dot(tip, along));
                off_mm = std::max(off_mm, length(tip - at.back() * along));
            }
            if (at.back() > 0) parts_per_mm = static_cast<double>(tips.size() - 1) / at.back();
        }
    };
    struct Nearest {
        double distance;
        std::size_t part;
    };

    static Vec3 seen(const StraightPart& part, Vec3 q) {
        const auto v = PartOf<double>(part).view(q.x, q.y, q.z);
        return {v.x, v.y, v.z};
    }

    // Returns the part with the least distance if that is below `bound`. `q` is in the common frame. The
    // cylinder about the axis is as far as its path seen along the axis; the sphere of a ball is as far as
    // the path of its centre. Both paths are near a line. Parts that are too far away along it are left out.
    Nearest least(Vec3 q, double bound) const {
        Nearest least{bound, 0};
        if (lowest_mm_ - q.z >= bound) return least;
        const bool by_sphere = tool_.kind == CutterKind::ball && q.z - tool_.radius_mm <= lowest_mm_;
        const Chord& chord = by_sphere ? direct_ : level_;
        const Vec3 from_path{q.x, q.y, by_sphere ? q.z - tool_.radius_mm : 0};
        const double at = dot(from_path, chord.along), aside_squared = squared_length(from_path) - at * at;
        // True if nothing that is at least `way` away along the line can come below the least.
        const auto too_far = [&](double way) {
            const double reach = tool_.radius_mm + least.distance, far = reach + chord.off_mm;
            const double ahead = std::max(way, 0.0);
            return reach <= 0 || ahead * ahead + aside_squared >= far * far;
        };
        if (too_far(std::max(-at, at - chord.at.back()))) return least;
        const auto look = [&](std::size_t n) {
            const double d = straight_distance(tool_, parts_[n].line, seen(parts_[n], q), least.distance);
            if (d < least.distance) least = {d, n};
        };
        const auto first = static_cast<std::size_t>(
            std::clamp(at * chord.parts_per_mm, 0.0, static_cast<double>(parts_.size() - 1)));
        for (std::size_t n = first; n < parts_.size() && !too_far(chord.at[n] - at); ++n) look(n);
        for (std::size_t n = first; n > 0 && !too_far(at - chord.at[n]); --n) look(n - 1);
        return least;
    }

    ToolProfile tool_;
    StraightFrame whole_;  // from the start to the end
    std::vector<StraightPart> parts_;
    Chord direct_, level_;                   // of the path itself, and of the path seen along the axis
    double lowest_mm_ = 0, highest_mm_ = 0;  // of the tip, in the common frame
    Box3 box_;
};

// Curved sweeps one after the other.
class JoinedCurvedSweep final : public JoinedSweep {
  public:
    JoinedCurvedSweep(const ToolProfile& tool, std::span<const motion::Move* const> moves,
                      std::vector<std::unique_ptr<const field::Shape>> sweeps)
        : JoinedSweep(std::move(sweeps)), tool_(tool), start_(moves.front()->start.tip_mm) {
        groups_.resize((moves.size() + TravelMiddles::kCount - 1) / TravelMiddles::kCount);
        for (std::size_t n = 0; n < TravelMiddles::kCount * groups_.size(); ++n) {
            TravelMiddles& group = groups_[n / TravelMiddles::kCount];
            const auto k = static_cast<int>(n % TravelMiddles::kCount);
            const motion::Move& move = *moves[std::min(n, moves.size() - 1)];
            group.put(k, curved_line(move), move.start.tip_mm - start_);
        }
    }

  private:
    std::array<float, kMostParts> lower_bounds(Vec3 point) const {
        std::array<float, kMostParts> bounds;
        for (std::size_t n = 0; n < groups_.size(); ++n)
            sweep_kernels().lower_bounds(tool_, groups_[n], point - start_,
                                         bounds.data() + n * TravelMiddles::kCount);
        return bounds;
    }
    std::size_t likely_part(Vec3 point) const override {
        const std::array<float, kMostParts> bounds = lower_bounds(point);
        const auto end = bounds.begin() + static_cast<std::ptrdiff_t>(parts().size());
        return static_cast<std::size_t>(std::min_element(bounds.begin(), end) - bounds.begin());
    }

    // The parts in the order of their lower bounds: most need no search.
    Least nearest_part(Vec3 point, Least least) const override {
        std::array<float, kMostParts> bounds = lower_bounds(point);
        const auto end = bounds.begin() + static_cast<std::ptrdiff_t>(parts().size());
        while (true) {
            const auto lowest = std::min_element(bounds.begin(), end);
            if (static_cast<double>(*lowest) >= least.distance) return least;
            const auto n = static_cast<std::size_t>(lowest - bounds.begin());
            const double d =
                static_cast<const CurvedSweep&>(*parts()[n]).searched_below(point, least.distance);
            if (d < least.distance) least = {d, n};
            *lowest = std::numeric_limits<float>::infinity();
        }
    }

    ToolProfile tool_;
    Vec3 start_;
    std::vector<TravelMiddles> groups_;
};
