// SPDX-License-Identifier: MIT
#include "session/cut/earlier_cuts.hpp"

#include <array>
#include <memory>

#include "base/hash.hpp"
#include "milling/engagement/joined_moves.hpp"
#include "milling/sweep/sweep.hpp"
#include "motion/path/path.hpp"
#include "session/cut/mill_session.hpp"
#include "session/cut/pose_hash.hpp"

namespace tribo::session {
namespace {

// Enough moves that all threads have work, and few enough that a stop takes effect soon.
constexpr std::size_t kCarvedAtOnce = 256;
static_assert(kCarvedAtOnce <= field::CarvedField::kMostAtOnce);

// Calls visit(index, move) for the moves up to until_s that are no dwells. The last one ends there.
template <class Visit>
void over_planned_cuts(const MillSetup& setup, const Visit& visit) {
    const auto schedule = setup.until_s ? schedule_of(setup) : nullptr;
    for (std::size_t n = 0; n < setup.moves.size(); ++n) {
        const motion::Move& move = setup.moves[n];
        const bool is_dwell = move.kind == motion::MoveKind::dwell;
        if (schedule) {
            const motion::MoveTiming& timing = schedule->moves[n];
            if (timing.start_s >= *setup.until_s) return;
            if (timing.end_s > *setup.until_s && !is_dwell) {
                const double length = timing.path_fraction(*setup.until_s) * motion::path_length_mm(move);
                visit(n, motion::first_part(move, motion::parameter_at_length(move, length)));
                continue;
            }
        }
        if (!is_dwell) visit(n, move);
    }
}

class MovesHash {
  public:
    void add(const motion::Move& move, std::size_t cutter) {
        session::add(hash_, move.start);
        session::add(hash_, move.end);
        hash_.add(move.arc.has_value());
        if (move.arc) {
            hash_.add(move.arc->centre_mm);
            hash_.add(move.arc->normal);
            hash_.add(move.arc->turn_rad);
        }
        hash_.add(move.quadratic.has_value());
        if (move.quadratic) {
            hash_.add(move.quadratic->tip_control_mm);
            hash_.add(move.quadratic->axis_control);
        }
        hash_.add(cutter);
    }
    std::uint64_t value() const { return hash_.value(); }

  private:
    Hash hash_;
};

}  // namespace

EarlierCuts planned_cuts(const MillSetup& setup) {
    EarlierCuts cuts;
    cuts.cutters = setup.cutters;
    const std::vector<char> joins = joins_of(setup);
    over_planned_cuts(setup, [&](std::size_t n, const motion::Move& move) {
        cuts.moves.push_back(move);
        cuts.cutter_of_move.push_back(setup.cutter_of_move[n]);
        cuts.shares_sweep.push_back(joins[n] &&
                                    milling::shares_sweep(move, setup.cutters[setup.cutter_of_move[n]]));
    });
    return cuts;
}

std::uint64_t hash_of_planned_moves(const MillSetup& setup) {
    MovesHash hash;
    over_planned_cuts(
        setup, [&](std::size_t n, const motion::Move& move) { hash.add(move, setup.cutter_of_move[n]); });
    return hash.value();
}

std::uint64_t hash_of_moves(const EarlierCuts& cuts) {
    MovesHash hash;
    for (std::size_t n = 0; n < cuts.moves.size(); ++n) hash.add(cuts.moves[n], cuts.cutter_of_move[n]);
    return hash.value();
}

std::uint64_t hash_of_cutters(std::span<const milling::Cutter> cutters) {
    Hash hash;
    for (const milling::Cutter& cutter : cutters) {
        hash.add(static_cast<int>(cutter.kind));
        hash.add(cutter.diameter_mm);
        hash.add(cutter.corner_mm);
        hash.add(cutter.length_mm);
        for (const milling::ProfileVertex& v : cutter.profile) {
            for (const double value : {v.r_mm, v.z_mm, v.bulge}) hash.add(value);
        }
    }
    return hash.value();
}

motion::Move in_frame(const motion::Move& move, const motion::WorkFrame& frame) {
    motion::Move turned = move;
    for (motion::ToolPose* pose : {&turned.start, &turned.end}) {
        pose->tip_mm = frame.from_stock(pose->tip_mm);
        pose->axis = frame.direction_from_stock(pose->axis);
    }
    if (turned.arc) {
        turned.arc->centre_mm = frame.from_stock(turned.arc->centre_mm);
        turned.arc->normal = frame.direction_from_stock(turned.arc->normal);
    }
    if (turned.quadratic) {
        turned.quadratic->tip_control_mm = frame.from_stock(turned.quadratic->tip_control_mm);
        turned.quadratic->axis_control = frame.direction_from_stock(turned.quadratic->axis_control);
    }
    return turned;
}

bool carve(field::CarvedField& stock, std::span<const EarlierCuts> earlier,
           const std::function<bool(double fraction)>& progress) {
    std::size_t all = 0, done = 0;
    for (const EarlierCuts& cuts : earlier) all += cuts.moves.size();
    std::vector<std::unique_ptr<const field::Shape>> shapes;
    std::array<double, kCarvedAtOnce> removed_mm3;
    for (const EarlierCuts& cuts : earlier) {
        for (std::size_t n = 0, end; n < cuts.moves.size(); n = end) {
            std::vector<const motion::Move*> moves;
            for (end = n; end == n || (end < cuts.shares_sweep.size() && cuts.shares_sweep[end]); ++end)
                moves.push_back(&cuts.moves[end]);
            shapes.push_back(milling::make_sweep(cuts.cutters[cuts.cutter_of_move[n]], moves));
            done += moves.size();
            if (done < all && shapes.size() < kCarvedAtOnce) continue;
            stock.carve(shapes, std::span(removed_mm3).first(shapes.size()));
            shapes.clear();
            if (progress && !progress(static_cast<double>(done) / static_cast<double>(all))) return false;
        }
    }
    return true;
}

}  // namespace tribo::session
