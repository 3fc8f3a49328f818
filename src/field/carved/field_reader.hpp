// SPDX-License-Identifier: MIT
// A carved field as seen from another thread while carving continues, for example from a servo, which must
// not wait.
#pragma once

#include "field/carved/carved_field.hpp"

namespace tribo::field {

// After each carve the field shows its state to its reader: the tables of that moment. The bricks of these
// tables are not changed any more (the next carve changes copies of the bricks that it cuts). The reader
// takes the newest state when it wants. The state that it holds stays valid until it takes the next one.
//
// The carving thread makes and destroys the reader while the other thread does not use it, and within the
// life of the field. A field has at most one reader at a time. The other thread calls the rest: real-time
// safe, no side ever waits for the other. Cost for the carver: a copy of each brick (3 kB) that a batch cuts,
// and of the table of chunks.
class FieldReader final : public contact::DistanceField {
  public:
    explicit FieldReader(CarvedField& field);
    FieldReader(const FieldReader&) = delete;
    FieldReader& operator=(const FieldReader&) = delete;
    ~FieldReader() override;

    // Takes the newest state. Returns false if there is no new one. The newest state contains every carve()
    // that finished before the call.
    bool refresh();
    // Number of states shown up to the one that is read now.
    Version version() const { return reading_->version; }

    double distance_mm(Vec3 p) const override { return reading_->query.distance_mm(p); }
    Vec3 normal(Vec3 p) const override { return reading_->query.sample(p).normal; }
    contact::SurfaceSample sample(Vec3 p) const override { return reading_->query.sample(p); }
    contact::SurfaceSample sample_piece(std::uint32_t piece, Vec3 p) const override {
        return reading_->query.sample_piece(piece, p);
    }
    double clearance_mm(Vec3 p, double enough_mm) const override {
        return reading_->query.clearance_mm(p, enough_mm);
    }
    contact::SurfaceSample nearest(Vec3 p, double within_mm, contact::NearHint& hint) const override {
        return reading_->query.nearest(p, within_mm, hint);
    }

  private:
    FieldShow& show_;
    const ShownField* reading_;
    CarvedField& field_;
};

}  // namespace tribo::field
