// SPDX-License-Identifier: MIT
// Makes the force source of `tribo feel` from a milled job or a model.
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
#include "session/feel/vibration_track.hpp"

namespace tribo::app {

// Refuses a file of --bake that is there and is no baked table: a new table would replace it.
FileResult<void> check_bake_file(const std::string& path);

class FeelSource {
  public:
    // `surface_n_per_mm`: stable stiffness of the device. `start_s`: start of the stroke.
    FeelSource(const FeelCall& call, const job::Job& job, double surface_n_per_mm, double start_s,
               const haptics::DeviceLimits& limits);

    // Mills the job, or reads the baked table if that is enough. Check interrupted() afterwards.
    // `in_time`: in cut mode the same job with short moves, which is milled during the stroke.
    FileResult<void> make(session::MillSetup setup, std::optional<session::MillSetup> in_time);
    // Uses a surface from a model file.
    void make(std::unique_ptr<const contact::DistanceField> surface);
    haptics::ForceSource& source() { return *source_; }
    // Mills up to `now_s` after the start of the stroke. One thread, not the servo thread.
    void mill_to(double now_s) {
        if (stock_) stock_->advance(start_s_ + now_s);
    }
    bool mills_in_time() const { return stock_ != nullptr; }
    // Prints facts about the table.
    void print() const;
    const std::optional<report::ForceTableFigures>& table_figures() const { return figures_; }

  private:
    FileResult<contact::ForceTableOptions> table_options() const;
    // Reads the table in the --bake file, if it belongs to this job.
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
    // Of a job with modes: what vibration adds to the force, or what it left on the part.
    std::optional<session::VibrationTrack> vibration_;
    std::optional<session::VibratingForce> vibrating_;
    surface::FormError form_error_;
    haptics::TextureMap textures_;
    std::unique_ptr<session::StockAtTime> stock_;
    std::unique_ptr<haptics::ForceSource> source_;
    std::size_t knots_ = 0, table_bytes_ = 0, texture_records_ = 0;
    bool from_bake_ = false;
    std::optional<report::ForceTableFigures> figures_;
};

}  // namespace tribo::app
