// SPDX-License-Identifier: MIT
#include "session/cut/memory_estimate.hpp"

#include <algorithm>
#include <array>
#include <bitset>
#include <cmath>
#include <span>
#include <vector>

#include "field/carved/carved_field.hpp"
#include "milling/engagement/joined_moves.hpp"
#include "milling/tool/convex_zones.hpp"
#include "motion/path/path.hpp"
#include "session/cut/kept_states.hpp"
#include "session/cut/mill_session.hpp"

namespace tribo::session {
namespace {

// A brick has its own nodes if the distance of the surface is less than Brick::kNearCells; in brick edges.
constexpr double kNearEdges = static_cast<double>(field::Brick::kNearCells) / field::kBrickCells;
// A brick is air if no node is nearer to the material; in brick edges.
constexpr double kClearEdges = field::FieldQuery::kClearCells / field::kBrickCells;
// Margin of the grid beyond the blank, in brick edges.
constexpr double kMarginEdges = field::CarvedField::kMarginCells / field::kBrickCells;
// Distance from the centre of a brick to its corners, in edges.
constexpr double kToCorner = 0.8661;
// Largest number of cells of the coarse grid. Its table has eight bytes for each 512 cells.
constexpr double kMostCells = 5e8;
// Bytes of a move with its timing and other data, and of its sweep, with the overhead of the heap.
constexpr double kMoveBytes = sizeof(motion::Move) + 2 * sizeof(motion::MoveTiming) + 64;
// A straight move that joins another is a part of its sweep.
constexpr double kSweepBytes = 320, kCurvedSweepBytes = 1400, kPartBytes = 130;
// Typical number of vertices of a brick that was cut. A brick on a flat face has one.
constexpr double kCutBrickVertices = 25;
// Bytes of meshing, measured: per vertex with its two triangles, including growth of the arrays; for the
// bricks being processed; per brick of two layers.
constexpr double kVertexBytes = 50, kInHandBytes = 1e7, kLayerBrickBytes = 16;

// The surface of the tool, seen from a point: distance (negative inside) and direction.
struct FromTool {
    double mm;
    Vec3 normal;
};

FromTool from_tool(const milling::Cutter& c, const motion::ToolPose& pose, Vec3 point_mm) {
    const Vec3 from_tip = point_mm - pose.tip_mm;
    const double along = dot(from_tip, pose.axis);
    const double off = std::sqrt(std::max(0.0, squared_length(from_tip) - along * along));
    const Vec3 outward = off > 0 ? (from_tip - along * pose.axis) / off : Vec3{};
    if (c.zones) {
        const milling::ConvexZones::Seen seen = c.zones->look(milling::PlanePoint{off, along});
        return {seen.distance_mm,
                normalized(seen.normal.r * outward + seen.normal.z * pose.axis, -pose.axis)};
    }
    const double corner = c.corner_radius_mm();
    const double below = corner - along, beyond = off - (c.radius_mm() - corner);
    FromTool side{off - c.radius_mm(), outward};
    if (below > 0 && beyond > 0) {
        const double far = std::sqrt(below * below + beyond * beyond);
        side = {far - corner, far > 0 ? (beyond * outward - below * pose.axis) / far : -pose.axis};
    } else if (-along > side.mm) {
        side = {-along, -pose.axis};
    }
    return along - c.length_mm > side.mm ? FromTool{along - c.length_mm, pose.axis} : side;
}

// The cells of the coarse grid, stored as in field::BrickIndex.
class CoarseStock {
  public:
    // clear_mm: nodes so far from the material do not count.
    CoarseStock(const field::Shape& blank, double edge, double clear_mm)
        : blank_(blank),
          box_(blank.bounds_mm().inflated(kMarginEdges * edge)),
          edge_(edge),
          clear_mm_(clear_mm),
          index_(size()) {}

    void sweep(const milling::Cutter& cutter, const motion::ToolPose& pose) {
        Box3 box;
        box.include(pose.tip_mm);
        box.include(pose.tip_mm + cutter.length_mm * pose.axis);
        box = box.inflated(cutter.radius_mm() + (kToCorner + kNearEdges) * edge_);
        int first[3], last[3];
        for (int axis = 0; axis < 3; ++axis) {
            const double from = std::max(box.min[axis], box_.min[axis]) - box_.min[axis];
            const double to = std::min(box.max[axis], box_.max[axis]) - box_.min[axis];
            if (!(from <= to)) return;
            first[axis] = static_cast<int>(from / edge_);
            last[axis] = std::min(static_cast<int>(to / edge_), count(axis) - 1);
        }
        for (int k = first[2]; k <= last[2]; ++k) {
            for (int j = first[1]; j <= last[1]; ++j) {
                for (int i = first[0]; i <= last[0]; ++i) look(cutter, pose, {i, j, k});
            }
        }
    }
    // The session carves whole moves: what lies within one of them never has a surface.
    void end_move() { most_ = std::max(most_, surface_); }

    double most_surface_cells() const { return static_cast<double>(most_); }
    double touched_cells() const { return static_cast<double>(touched_); }

  private:
    int count(int axis) const { return std::max(1, static_cast<int>(std::ceil(box_.size()[axis] / edge_))); }
    field::BrickCoord size() const { return {count(0), count(1), count(2)}; }

    void look(const milling::Cutter& cutter, const motion::ToolPose& pose, field::BrickCoord cell) {
        const field::BrickRef was = index_.get(cell);
        if (was == field::kAir) return;
        const Vec3 middle = box_.min + edge_ * Vec3{cell.i + 0.5, cell.j + 0.5, cell.k + 0.5};
        const FromTool tool = from_tool(cutter, pose, middle);
        const double half_mm = half_extent_mm(tool.normal);
        if (tool.mm > 0 && beyond_cell_mm(middle, middle - tool.mm * tool.normal) > kNearEdges * edge_)
            return;
        bool air = tool.mm <= -half_mm - kClearEdges * edge_;
        field::BrickRef now = was == field::kUntouched ? kInner : was;
        bool is_inner = was == kInner;
        if (!air) {
            if (was == field::kUntouched) {
                const double blank_mm = blank_.distance_mm(middle);
                air = blank_mm > kToCorner * edge_;
                is_inner = blank_mm < -(kToCorner + kClearEdges) * edge_;
            }
            if (!air && !is_inner) {
                if (was == field::kUntouched) {
                    now = kFirstBorder + static_cast<field::BrickRef>(border_.size());
                    border_.emplace_back();
                }
                air = is_cleared(cutter, pose, middle, border_[now - kFirstBorder]);
            }
            if (!air && was != field::kUntouched) return;
        }
        if (was == field::kUntouched) ++touched_;
        index_.set(cell, air ? field::kAir : now);
        if (was != field::kUntouched) --surface_;
        if (!air) ++surface_;
    }

    // Cells with a surface: inside the blank, or at its border, each with a place in border_.
    static constexpr field::BrickRef kInner = field::kFirstBrick, kFirstBorder = kInner + 1;
    // The blank as 3 x 3 x 3 points of a cell see it, computed when first asked for.
    struct BlankPoints {
        std::array<float, 27> mm;
        std::bitset<27> is_known, has_surface_near;  // nearest point of the surface within the cell
    };

    // Half the extent of a cell along a normal. A plane with this normal meets the cell if it is nearer to
    // the middle.
    double half_extent_mm(Vec3 n) const {
        return 0.5 * edge_ * (std::abs(n.x) + std::abs(n.y) + std::abs(n.z));
    }
    // Returns the distance of a point from a cell, 0 inside.
    double beyond_cell_mm(Vec3 middle, Vec3 point) const {
        const Vec3 away = point - middle;
        return length(Vec3{std::max(0.0, std::abs(away.x) - 0.5 * edge_),
                           std::max(0.0, std::abs(away.y) - 0.5 * edge_),
                           std::max(0.0, std::abs(away.z) - 0.5 * edge_)});
    }
    // Returns true for a cell at the border of the blank if the pose leaves no material in it.
    bool is_cleared(const milling::Cutter& cutter, const motion::ToolPose& pose, Vec3 middle,
                    BlankPoints& blank) const {
        const auto is_near = [&](Vec3 surface) { return beyond_cell_mm(middle, surface) <= clear_mm_; };
        for (std::size_t n = 0; n < blank.mm.size(); ++n) {
            const auto half_edges = [&](std::size_t step) { return static_cast<double>(n / step % 3) - 1; };
            const Vec3 point = middle + 0.5 * edge_ * Vec3{half_edges(1), half_edges(3), half_edges(9)};
            const FromTool tool = from_tool(cutter, pose, point);
            const bool is_covered = tool.mm < -clear_mm_;
            const bool has_tool_near = is_near(point - tool.mm * tool.normal);
            if (is_covered && !has_tool_near) continue;
            if (!blank.is_known[n]) {
                blank.is_known[n] = true;
                const double mm = blank_.distance_mm(point);
                blank.mm[n] = static_cast<float>(mm);
                blank.has_surface_near[n] = mm > 0 && is_near(point - mm * blank_.gradient(point));
            }
            const auto blank_mm = static_cast<double>(blank.mm[n]);
            if (std::min(tool.mm, -blank_mm) >= -clear_mm_) return false;
            // Between the points: the nearest point of the blank is material if the tool is farther, and from
            // a point in the tool the nearest point of its surface is if the outside of the blank is farther.
            if (tool.mm - blank_mm >= -2 * clear_mm_ &&
                (is_covered ? has_tool_near : blank.has_surface_near[n]))
                return false;
        }
        return true;
    }

    const field::Shape& blank_;
    Box3 box_;
    double edge_, clear_mm_;
    field::BrickIndex index_;
    std::vector<BlankPoints> border_;
    std::size_t surface_ = 0, most_ = 0, touched_ = 0;
};

// Returns the approximate largest distance that a point of the tool moves.
double travel_mm(const motion::Move& move, const milling::Cutter& cutter) {
    return motion::path_length_mm(move) + cutter.length_mm * length(move.end.axis - move.start.axis);
}

double steps_of(const motion::Move& move, const milling::Cutter& cutter, double edge) {
    return std::floor(travel_mm(move, cutter) / (0.5 * edge)) + 1;
}

// Number of straight moves that share a sweep with the move before them.
double joined_parts(std::span<const motion::Move> moves, std::span<const char> shares_sweep) {
    double count = 0;
    for (std::size_t n = 0; n < shares_sweep.size(); ++n) {
        const bool straight = !moves[n].quadratic && moves[n].start.axis == moves[n].end.axis;
        if (shares_sweep[n] && straight) ++count;
    }
    return count;
}

// Calls visit(move, cutter, is_last) for the moves of earlier jobs and of the setup.
template <class Visit>
void over_moves(const MillSetup& setup, const Visit& visit) {
    std::size_t left = setup.moves.size();
    for (const EarlierCuts& cuts : setup.earlier) left += cuts.moves.size();
    for (const EarlierCuts& cuts : setup.earlier) {
        for (std::size_t n = 0; n < cuts.moves.size(); ++n)
            visit(cuts.moves[n], cuts.cutters[cuts.cutter_of_move[n]], --left == 0);
    }
    for (std::size_t n = 0; n < setup.moves.size(); ++n)
        visit(setup.moves[n], setup.cutters[setup.cutter_of_move[n]], --left == 0);
}

// Returns the number of cell tests that the marking would need.
double tests_at(const MillSetup& setup, double edge) {
    const Vec3 blank = setup.blank->bounds_mm().size();
    double tests = 0, travelled = 0;
    over_moves(setup, [&](const motion::Move& move, const milling::Cutter& c, bool is_last) {
        // Short moves share their poses.
        travelled += travel_mm(move, c);
        if (travelled < 0.5 * edge && !is_last) return;
        const auto cells = [&](double extent, double room) { return std::min(extent, room) / edge + 1; };
        const double across = c.diameter_mm + 2 * (kToCorner + kNearEdges) * edge;
        tests += (travelled / (0.5 * edge) + 1) * cells(across, blank.x) * cells(across, blank.y) *
                 cells(c.length_mm + 2 * (kToCorner + kNearEdges) * edge, blank.z);
        travelled = 0;
    });
    return tests;
}

}  // namespace

MemoryEstimate::MemoryEstimate(const MillSetup& setup, double cell_mm)
    : blank_(setup.blank->bounds_mm()),
      coarse_mm_(field::kBrickCells * cell_mm),
      solid_bytes_(static_cast<double>(setup.solid_bytes)) {
    const Vec3 size = blank_.size();
    const auto cells = [&] {
        return (size.x / coarse_mm_ + 1) * (size.y / coarse_mm_ + 1) * (size.z / coarse_mm_ + 1);
    };
    while (cells() > kMostCells || tests_at(setup, coarse_mm_) > kMostTests) coarse_mm_ *= 1.3;
    CoarseStock stock(*setup.blank, coarse_mm_, field::FieldQuery::kClearCells * cell_mm);
    double travelled = 0;
    const milling::Cutter* last_cutter = nullptr;
    over_moves(setup, [&](const motion::Move& move, const milling::Cutter& cutter, bool is_last) {
        ++moves_;
        if (move.quadratic || move.start.axis != move.end.axis) ++curved_moves_;
        if (move.kind == motion::MoveKind::dwell) return;
        travelled += travel_mm(move, cutter);
        if (&cutter == last_cutter && travelled < 0.5 * coarse_mm_ && !is_last) return;
        const double steps = steps_of(move, cutter, coarse_mm_);
        for (double s = &cutter == last_cutter ? 1 : 0; s <= steps; ++s)
            stock.sweep(cutter, motion::pose_at(move, s / steps));
        stock.end_move();
        travelled = 0;
        last_cutter = &cutter;
    });
    std::vector<char> shares = joins_of(setup);
    for (std::size_t n = 0; n < shares.size(); ++n)
        shares[n] =
            shares[n] && milling::shares_sweep(setup.moves[n], setup.cutters[setup.cutter_of_move[n]]);
    joined_parts_ = joined_parts(setup.moves, shares);
    for (const EarlierCuts& cuts : setup.earlier)
        joined_parts_ += joined_parts(cuts.moves, cuts.shares_sweep);
    surface_cells_ = stock.most_surface_cells();
    touched_cells_ = stock.touched_cells();
}

double MemoryEstimate::cut_bricks(double cell_mm) const {
    const double cells_per_brick = coarse_mm_ / (field::kBrickCells * cell_mm);
    return surface_cells_ * cells_per_brick * cells_per_brick;
}

double MemoryEstimate::touched_bricks(double cell_mm) const {
    const double cells_per_brick = coarse_mm_ / (field::kBrickCells * cell_mm);
    return touched_cells_ * cells_per_brick * cells_per_brick * std::max(1.0, cells_per_brick);
}

double MemoryEstimate::session_bytes(double cell_mm) const {
    return solid_bytes_ + moves_ * (kMoveBytes + kSweepBytes) - joined_parts_ * (kSweepBytes - kPartBytes) +
           curved_moves_ * (kCurvedSweepBytes - kSweepBytes) +
           field::CarvedField::estimated_bytes(blank_, cell_mm, cut_bricks(cell_mm), touched_bricks(cell_mm));
}

double MemoryEstimate::states_bytes(double cell_mm) const {
    constexpr double kOfField = 7;  // a part in many layers, measured
    return std::min(static_cast<double>(KeptStates::kMostBytes), kOfField * session_bytes(cell_mm));
}

double MemoryEstimate::vertices(double cell_mm) const {
    const Vec3 s = blank_.size() / (field::kBrickCells * cell_mm);
    return 2 * (s.x * s.y + s.y * s.z + s.z * s.x) + kCutBrickVertices * cut_bricks(cell_mm);
}

double MemoryEstimate::mesh_bytes(double cell_mm) const {
    const Vec3 s = blank_.size() / (field::kBrickCells * cell_mm);
    return kVertexBytes * vertices(cell_mm) + kInHandBytes + kLayerBrickBytes * s.x * s.y;
}

std::optional<MemoryShortage> memory_shortage(
    const MillSetup& setup, double budget_bytes,
    const std::function<double(const MemoryEstimate& estimate, double cell_mm)>& bytes_at) {
    constexpr double kCoarser = 1.1;  // factor from one tried spacing to the next
    const auto need_at = [&](double cell) { return bytes_at(MemoryEstimate(setup, cell), cell); };
    MemoryShortage shortage;
    shortage.need_bytes = shortage.least_bytes = need_at(setup.cell_mm);
    if (shortage.need_bytes <= budget_bytes) return {};
    const Vec3 size = setup.blank->bounds_mm().size();
    const double largest = std::max({size.x, size.y, size.z});
    double cell = setup.cell_mm;
    while (cell < largest && shortage.least_bytes > budget_bytes) {
        cell *= kCoarser;
        shortage.least_bytes = need_at(cell);
    }
    if (cell < largest) shortage.fitting_cell_mm = cell;
    return shortage;
}

}  // namespace tribo::session
