// SPDX-License-Identifier: MIT
// What `tribo feel` feels: a job milled, and the force that comes out of it.
#pragma once

#include <memory>
#include <optional>

#include "app/feel.hpp"
#include "formats/job.hpp"
#include "io/feel_stats_json.hpp"
#include "io/files.hpp"
#include "session/feel_session.hpp"

namespace tribo::app {

class FeelSource {
  public:
    // `surface_n_per_mm`: stiffness that the device keeps stable; `start_s`: where the stroke begins.
    FeelSource(const FeelCall& call, const formats::Job& job, double surface_n_per_mm, double start_s,
               const haptics::DeviceLimits& limits);

    // Mills, or reads the baked table where that is all that is needed. Look at interrupted() afterwards.
    io::FileResult<void> make(session::MillSetup setup);
    haptics::ForceSource& source() { return *source_; }
    // What there is to say about the table.
    void print() const;
    const std::optional<io::ForceTableFigures>& table_figures() const { return figures_; }

  private:
    io::FileResult<contact::ForceTableOptions> table_options() const;
    // The table in the file that --bake names, where it is this job's.
    std::optional<contact::ForceTable> baked(std::uint64_t key) const;
    bool mill(session::MillSetup setup, const ParallelFor& parallel);
    void inspect();
    void cut(contact::ForceTable table, const ParallelFor& parallel);

    const FeelCall& call_;
    const formats::Job& job_;
    double surface_n_per_mm_, start_s_;
    haptics::ForceScaling scaling_;
    std::unique_ptr<session::MillSession> milled_;
    session::CutRecord record_;
    std::unique_ptr<session::CutterTrack> track_;
    std::unique_ptr<session::TableForce> force_;
    haptics::TextureMap textures_;
    std::unique_ptr<haptics::ForceSource> source_;
    std::size_t knots_ = 0, table_bytes_ = 0, texture_records_ = 0;
    bool from_bake_ = false;
    std::optional<io::ForceTableFigures> figures_;
};

}  // namespace tribo::app
