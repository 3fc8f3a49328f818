// SPDX-License-Identifier: MIT
// A blank from which shapes are carved: the stock under the cutter. It has two levels (README, "One field,
// two levels"): a sparse grid of bricks finds the shapes that make the surface, and the maximum over those
// few shapes measures the surface exactly.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "base/parallel.hpp"
#include "contact/distance_field.hpp"
#include "field/carved/field_show.hpp"
#include "field/carved/field_state.hpp"

namespace tribo::field {

// Any number of threads may read while no thread carves. Only one thread may carve; it may use others through
// `parallel`. To read while another thread carves, use a FieldReader.
class CarvedField final : public contact::DistanceField {
  public:
    // The first node is this many cells outside the blank. The fraction keeps nodes off the round coordinates
    // where programs put their planes, so that signs at nodes seldom depend on rounding.
    static constexpr double kMarginCells = 2.37;

    // cell_mm > 0: the spacing of the grid. It limits which shapes can be found: a shape whose share of the
    // surface is thinner than a cell may be missed, an error of at most cell^2 / (8 R) on a wall of radius R;
    // where two surfaces meet, a third one that takes a corner of less than a cell may be missed there. It
    // does not limit the accuracy of the rest.
    CarvedField(std::unique_ptr<const Shape> blank, double cell_mm, ParallelFor parallel = serial_for);

    // Removes the volumes of the shapes from the material, one after the other (at most kMostAtOnce).
    // removed_mm3 receives the volume that each of them removed. Cost: the bricks on the border of each
    // shape, and one test for each brick of its bounding box.
    void carve(std::span<std::unique_ptr<const Shape>> shapes, std::span<double> removed_mm3);
    static constexpr std::size_t kMostAtOnce = 1024;
    // The same for one shape; returns the removed volume.
    double carve(std::unique_ptr<const Shape> shape);

    // The field as it is now, to go back to. It shares with `like`, another state of this field or an empty
    // one, what is the same in both. Cost: a copy of each brick that differs.
    FieldState state(const FieldState& like = {}) const;
    // Puts the field into one of its states, with the same bits. The shapes that were carved after it stay:
    // carve_again() carves them in their order, and carve() goes on after the last of them.
    void restore(const FieldState& state);
    // Carves the next `count` of these shapes (at most kMostAtOnce).
    void carve_again(std::size_t count);
    std::size_t shapes_to_carve_again() const { return tables_->shapes.size() - 1 - carved_; }

    // Exact at the surface, clamped to about one cell away from it. Bounded time, no allocation.
    double distance_mm(Vec3 p) const override { return tables_->query.distance_mm(p); }
    Vec3 normal(Vec3 p) const override { return tables_->query.sample(p).normal; }
    contact::SurfaceSample sample(Vec3 p) const override { return tables_->query.sample(p); }
    contact::SurfaceSample sample_piece(std::uint32_t piece, Vec3 p) const override {
        return tables_->query.sample_piece(piece, p);
    }
    // Searches at most three bricks (21 cells) far.
    double clearance_mm(Vec3 p, double enough_mm) const override {
        return tables_->query.clearance_mm(p, enough_mm);
    }
    contact::SurfaceSample nearest(Vec3 p, double within_mm, contact::NearHint& hint) const override {
        return tables_->query.nearest(p, within_mm, hint);
    }
    // Returns true if distance_mm < -skin_mm (0 <= skin_mm << cell). Measures no exact distance where the
    // grid gives the answer.
    bool is_material(Vec3 p, double skin_mm = 0) const { return tables_->query.is_material(p, skin_mm); }
    ShapeId emptied_by(Vec3 p, double skin_mm) const { return tables_->query.emptied_by(p, skin_mm); }
    // Signed like a distance; its size is a lower bound of the distance to any surface (field_query.hpp).
    double clear_way_mm(Vec3 p, double enough_mm) const { return tables_->query.clear_way_mm(p, enough_mm); }
    double cell_mm() const { return cell_; }
    double near_mm() const { return near_; }
    const Shape& blank() const { return tables_->query.blank(); }
    const Shape& shape(ShapeId id) const { return tables_->query.shape(id); }
    // Gives the blank back. After that the field can only be destroyed.
    std::unique_ptr<const Shape> release_blank() { return std::move(tables_->shapes[0]); }
    double removed_mm3() const { return removed_; }
    Lattice lattice(BrickCoord b) const { return tables_->query.lattice(b); }
    BrickCoord size() const { return tables_->index.size(); }
    Vec3 centre(BrickCoord b) const;
    // Distance from a brick's centre to its corners.
    double brick_radius_mm() const { return brick_radius_; }
    BrickRef ref(BrickCoord b) const { return tables_->index.get(b); }
    const Brick& brick(BrickRef ref) const { return tables_->pool[ref]; }
    // Returns true if all bricks in the chunk of `b` are untouched, false if this is not known.
    bool is_untouched_chunk(BrickCoord b) const { return tables_->index.table().is_untouched_chunk(b); }
    std::size_t bricks_in_use() const { return tables_->pool.in_use(); }
    std::size_t shapes_carved() const { return carved_; }
    // Changes of bricks so far, those of carve_again() too: a measure of the work of carving.
    std::uint64_t brick_updates() const { return brick_updates_; }
    std::size_t bytes() const { return tables_->pool.bytes() + tables_->index.bytes(); }

    using Exact = FieldQuery::Exact;
    double at_node_mm(const Brick& brick, int node) const { return tables_->query.at_node_mm(brick, node); }
    // The distances at all nodes of a brick that is not air.
    void sample_nodes(BrickCoord b, float* distance_mm) const;
    Exact exact(BrickRef ref, Vec3 point_mm) const { return tables_->query.exact(ref, point_mm); }
    // Returns the brick that contains the point. Outside the grid: a brick for which contains() is false.
    BrickCoord brick_at(Vec3 point_mm) const { return tables_->query.brick_at(point_mm); }
    bool contains(BrickCoord b) const { return tables_->index.contains(b); }

    // Estimates the memory of a field over this blank, bytes. `cut_bricks` hold a cut surface;
    // `touched_bricks` are all bricks that differ from the blank, the cut bricks included.
    static double estimated_bytes(const Box3& blank_mm, double cell_mm, double cut_bricks,
                                  double touched_bricks);

  private:
    // The cut of one shape in one brick: brick number, shape number, and a bit for a shape that contains the
    // whole brick. All are in one number that sorts by brick, then by shape.
    using Cut = std::uint64_t;
    // All cuts of one brick, and their result.
    struct Update {
        std::size_t first = 0, last = 0;  // in cuts_
        BrickCoord coord;
        BrickRef ref = kUntouched;
        BrickRef shown = kUntouched;  // the brick that ref is a copy of, if a reader may see it
        bool drop = false, air = false;
    };
    // Carves `count` shapes of the store.
    void carve_stored(std::size_t count, std::span<double> removed_mm3);
    void restore(BrickCoord coord, bool is_touched, const Brick* kept);
    void gather(const Shape& shape, std::size_t number, std::vector<Cut>& cuts) const;
    void gather_brick(const Shape& shape, std::size_t number, BrickCoord b, std::vector<Cut>& cuts) const;
    void plan_updates(std::size_t shapes);
    void update(Update& u);
    void fill_from_blank(Brick& brick) const;
    double volume_mm3(const NodeSteps* steps) const;
    void sample_blank(BrickCoord b, NodeSteps* steps) const;
    double blank_brick_volume(BrickCoord b) const;
    // For FieldReader: begin_show() shows the present state and, from now on, the state after each carve;
    // end_show() stops this.
    friend class FieldReader;
    FieldShow& begin_show();
    void end_show();
    // Version of the bricks that are made now (0 without a reader); is_shown: true if the brick must not be
    // changed.
    Version version() const { return showing_ ? show_->shown() + 1 : 0; }
    bool is_shown(BrickRef ref) const { return showing_ && tables_->pool[ref].version <= show_->shown(); }
    BrickRef take_brick(BrickCoord coord);
    void release(BrickRef ref);
    void point_to(BrickCoord coord, BrickRef ref);

    double cell_, near_, brick_radius_;
    ParallelFor parallel_;
    std::unique_ptr<FieldTables> tables_;
    std::unique_ptr<FieldShow> show_;
    bool showing_ = false;
    double removed_ = 0;
    std::size_t carved_ = 0;                    // shapes
    std::uint64_t change_ = 0;                  // number of the current carve
    std::vector<std::uint64_t> chunk_changes_;  // of the last carve that changed each chunk; 0: none
    std::uint64_t brick_updates_ = 0;
    // State of the current carve.
    std::vector<std::vector<Cut>> cuts_of_;  // by shape
    std::vector<Cut> cuts_;                  // by brick
    std::vector<double> removed_by_cut_;
    std::vector<Update> updates_;
};

}  // namespace tribo::field
