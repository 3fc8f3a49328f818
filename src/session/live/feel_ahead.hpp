// SPDX-License-Identifier: MIT
// A job milled to its end ahead of who watches it, for what a hand will feel: the table of forces along the
// path (rebuilt when feed, speed, material or helix change, without milling again) and the grooves' texture.
#pragma once

#include <functional>

#include "contact/force_table.hpp"
#include "haptics/texture/haptic_texture.hpp"
#include "session/cut/cut_record.hpp"

namespace tribo::session {

class FeelAhead {
  public:
    FeelAhead(MillSetup setup, ParallelFor parallel);

    // Mills on as long as `may_go_on` says so (asked every few moves); whether the end is reached.
    bool run(const std::function<bool()>& may_go_on);

    // After the end. Times are those of the program as it was written, whatever the change.
    contact::ForceTable table(const CutChange& change, const contact::ForceTableOptions& options) const;
    haptics::TextureMap textures() const;

  private:
    ParallelFor parallel_;
    MillSession session_;
    CutRecord record_;
};

}  // namespace tribo::session
