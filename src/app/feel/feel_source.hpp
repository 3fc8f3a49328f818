// SPDX-License-Identifier: MIT
// What `tribo feel` feels: a job milled, and the force that comes out of it.
#pragma once

#include <memory>
#include <optional>

#include "app/feel/feel.hpp"
#include "files/files.hpp"
#include "haptics/servo/force_table_player.hpp"
#include "job/job.hpp"
#include "report/feel_stats_json.hpp"
#include "session/cut/stock_at_time.hpp"
#include "session/feel/feel_session.hpp"

namespace tribo::app {

class FeelSource {
  public:
    // `surface_n_per_mm`: stiffness that the device keeps stable; `start_s`: where the stroke begins.
    FeelSource(const FeelCall& call, const job::Job& job, double surface_n_per_mm, double start_s,
               const haptics::DeviceLimits& limits);

    // Mills, or reads the baked table where that is all that is needed. Look at interrupted() afterwards.
    // `in_time`: in cut mode the same job in short moves, which is milled while it is felt.
    FileResult<void> make(session::MillSetup setup, std::optional<session::MillSetup> in_time);
    // A surface that was only read, as it is.
    void make(std::unique_ptr<const contact::DistanceField> surface);
    haptics::ForceSource& source() { return *source_; }
    // Mills on to the moment of the stroke, `now_s` after its start; on one thread, any but the servo's.
    void mill_to(double now_s) {
        if (stock_) stock_->advance(start_s_ + now_s);
    }
    bool mills_in_time() const { return stock_ != nullptr; }
    // What there is to say about the table.
    void print() const;
    const std::optional<report::ForceTableFigures>& table_figures() const { return figures_; }

  private:
    FileResult<contact::ForceTableOptions> table_options() const;
    // The table in the file that --bake names, where it is this job's.
    std::optional<contact::ForceTable> baked(std::uint64_t key) const;
    bool mill(session::MillSetup setup, const ParallelFor& parallel);
    haptics::ContactOptions contact_options(haptics::ProbeShape& probe) const;
    void inspect(const contact::DistanceField& surface);
    void cut(contact::ForceTable table, const ParallelFor& parallel);

    const FeelCall& call_;
    const job::Job& job_;
    double surface_n_per_mm_, start_s_;
    haptics::ForceScaling scaling_;
    std::unique_ptr<session::MillSession> milled_;
    std::unique_ptr<const contact::DistanceField> surface_;
    session::CutRecord record_;
    std::unique_ptr<session::CutterTrack> track_;
    std::unique_ptr<haptics::ForceTablePlayer> force_;
    haptics::TextureMap textures_;
    std::unique_ptr<session::StockAtTime> stock_;
    std::unique_ptr<haptics::ForceSource> source_;
    std::size_t knots_ = 0, table_bytes_ = 0, texture_records_ = 0;
    bool from_bake_ = false;
    std::optional<report::ForceTableFigures> figures_;
};

}  // namespace tribo::app
