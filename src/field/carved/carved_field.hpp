// SPDX-License-Identifier: MIT
// A blank from which shapes are carved: the stock under the cutter. Two levels (README, "One field, two
// levels"): a sparse grid of bricks finds which shapes make the surface, the maximum over those few measures
// it exactly.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "base/parallel.hpp"
#include "contact/distance_field.hpp"
#include "field/carved/field_show.hpp"

namespace tribo::field {

// Reading is safe from any number of threads while nobody carves; carving is for one thread, which may use
// others through `parallel`. A thread that reads while another carves does so through a FieldReader.
class CarvedField final : public contact::DistanceField {
  public:
    // Nodes within this many cells of the surface decide which shapes a brick keeps.
    static constexpr double kNearCells = 1.8;
    // The first node stands this many cells outside the blank: a fraction that keeps nodes off the round
    // coordinates where programs put their planes, so that signs at nodes are seldom a matter of rounding.
    static constexpr double kMarginCells = 2.37;

    // cell_mm > 0: the spacing of the grid. It bounds what can be found (a shape whose share of the surface
    // is thinner than a cell may be missed, an error of at most cell^2 / (8 R) on a wall of radius R), not
    // how exactly the rest is measured.
    CarvedField(std::unique_ptr<const Shape> blank, double cell_mm, ParallelFor parallel = serial_for);

    // Takes the volumes of the shapes out of the material, one after the other (at most kMostAtOnce);
    // removed_mm3 gets what each of them removed. Cost: the bricks that each shape's border passes through,
    // and one test for each brick of its bounding box.
    void carve(std::span<std::unique_ptr<const Shape>> shapes, std::span<double> removed_mm3);
    static constexpr std::size_t kMostAtOnce = 1024;
    // The same for one; gives the removed volume.
    double carve(std::unique_ptr<const Shape> shape);

    // Exact at the surface; clamped to about one cell away from it. Bounded time, no allocation.
    double distance_mm(Vec3 p) const override { return tables_->query.distance_mm(p); }
    Vec3 normal(Vec3 p) const override { return tables_->query.sample(p).normal; }
    contact::SurfaceSample sample(Vec3 p) const override { return tables_->query.sample(p); }
    contact::SurfaceSample sample_piece(std::uint32_t piece, Vec3 p) const override {
        return tables_->query.sample_piece(piece, p);
    }
    // Looks as far as three bricks (21 cells).
    double clearance_mm(Vec3 p, double enough_mm) const override {
        return tables_->query.clearance_mm(p, enough_mm);
    }
    contact::SurfaceSample nearest(Vec3 p, double within_mm, contact::NearHint& hint) const override {
        return tables_->query.nearest(p, within_mm, hint);
    }
    // Whether distance_mm < -skin_mm (0 <= skin_mm << cell), without the measure where the grid already
    // tells.
    bool is_material(Vec3 p, double skin_mm = 0) const { return tables_->query.is_material(p, skin_mm); }
    // Signed like a distance: no surface is nearer than its size (field_query.hpp).
    double clear_way_mm(Vec3 p, double enough_mm) const { return tables_->query.clear_way_mm(p, enough_mm); }
    double cell_mm() const { return cell_; }
    double near_mm() const { return near_; }
    const Shape& blank() const { return tables_->query.blank(); }
    const Shape& shape(ShapeId id) const { return tables_->query.shape(id); }
    double removed_mm3() const { return removed_; }
    Lattice lattice(BrickCoord b) const { return tables_->query.lattice(b); }
    BrickCoord size() const { return tables_->index.size(); }
    Vec3 centre(BrickCoord b) const;
    // From a brick's centre to its corners.
    double brick_radius_mm() const { return brick_radius_; }
    BrickRef ref(BrickCoord b) const { return tables_->index.get(b); }
    const Brick& brick(BrickRef ref) const { return tables_->pool[ref]; }
    // Whether all bricks of the index's chunk that holds `b` are untouched; false where it is not known.
    bool is_untouched_chunk(BrickCoord b) const { return tables_->index.table().is_untouched_chunk(b); }
    std::size_t bricks_in_use() const { return tables_->pool.in_use(); }
    std::size_t shapes_carved() const { return tables_->shapes.size() - 1; }
    std::size_t bytes() const { return tables_->pool.bytes() + tables_->index.bytes(); }

    using Exact = FieldQuery::Exact;
    Exact exact(BrickRef ref, Vec3 point_mm) const { return tables_->query.exact(ref, point_mm); }
    // The brick that contains the point; out of the grid: one that contains() is false for.
    BrickCoord brick_at(Vec3 point_mm) const { return tables_->query.brick_at(point_mm); }
    bool contains(BrickCoord b) const { return tables_->index.contains(b); }

    // Memory that a field over this blank takes, bytes: with so many bricks that hold a cut surface, and so
    // many that are no longer as they were in the blank, these among them.
    static double estimated_bytes(const Box3& blank_mm, double cell_mm, double cut_bricks,
                                  double touched_bricks);

  private:
    // One shape's part in one brick: brick number, shape number and whether the shape holds all of the brick,
    // in one number that sorts by brick, then by shape.
    using Cut = std::uint64_t;
    // All cuts of one brick, and what becomes of it.
    struct Update {
        std::size_t first = 0, last = 0;  // in cuts_
        BrickCoord coord;
        BrickRef ref = kUntouched;
        BrickRef shown = kUntouched;  // what ref is a copy of, where a reader may see that
        bool drop = false, air = false;
    };
    void gather(const Shape& shape, std::size_t number, std::vector<Cut>& cuts) const;
    void gather_brick(const Shape& shape, std::size_t number, BrickCoord b, std::vector<Cut>& cuts) const;
    void plan_updates(std::size_t shapes);
    void update(Update& u, std::span<const std::unique_ptr<const Shape>> shapes);
    void fill_from_blank(Brick& brick) const;
    double volume_mm3(const float* distance_mm) const;
    double blank_brick_volume(BrickCoord b) const;
    // For FieldReader: shows the field as it is and from now on after each carve, or no more.
    friend class FieldReader;
    FieldShow& begin_show();
    void end_show();
    // The version of what is made now, and whether a brick must be left as it is; 0 and false without reader.
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
    // Of the carve that is going on.
    std::vector<std::vector<Cut>> cuts_of_;  // by shape
    std::vector<Cut> cuts_;                  // by brick
    std::vector<double> removed_by_cut_;
    std::vector<Update> updates_;
};

}  // namespace tribo::field
