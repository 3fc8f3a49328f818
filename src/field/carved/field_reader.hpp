// SPDX-License-Identifier: MIT
// A carved field as another thread sees it while carving goes on: a servo, which must not wait.
#pragma once

#include "field/carved/carved_field.hpp"

namespace tribo::field {

// After each carve the field shows itself to its reader: the tables of that moment, whose bricks are then
// left as they are (the next carve changes copies of those that it cuts). The reader takes the newest when it
// wants; what it holds stays true until it takes the next.
//
// Made and destroyed by the carving thread while the other is not in it, and within the field's life; at most
// one at a time for a field. The other thread calls the rest: real-time safe, neither side ever waits for the
// other. Cost for the carver: a copy of each brick (3 kB) that a batch cuts, and of the table of chunks.
class FieldReader final : public contact::DistanceField {
  public:
    explicit FieldReader(CarvedField& field);
    FieldReader(const FieldReader&) = delete;
    FieldReader& operator=(const FieldReader&) = delete;
    ~FieldReader() override;

    // Goes on to the newest state, if there is one; whether there was. What carve() finished before the call
    // is in it.
    bool refresh();
    // States shown so far, up to the one that is read now.
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
