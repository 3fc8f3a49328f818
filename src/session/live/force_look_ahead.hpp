// SPDX-License-Identifier: MIT
// Mills a whole job ahead of the live view, for the haptic device: the force table along the path and the
// texture of the grooves. A change of feed, spindle speed, material or helix rebuilds the table without
// milling again.
#pragma once

#include <functional>

#include "contact/force_table.hpp"
#include "haptics/texture/haptic_texture.hpp"
#include "session/cut/cut_record.hpp"

namespace tribo::session {

class ForceLookAhead {
  public:
    ForceLookAhead(MillSetup setup, ParallelFor parallel);

    // Continues milling while `has_time` is true (checked every few moves). True at the end of the job.
    bool run(const std::function<bool()>& has_time);

    // Valid after the end. Times are program times at the programmed feed.
    contact::ForceTable table(const CutChange& change, const contact::ForceTableOptions& options) const;
    haptics::TextureMap textures() const;

  private:
    ParallelFor parallel_;
    MillSession session_;
    CutRecord record_;
};

}  // namespace tribo::session
