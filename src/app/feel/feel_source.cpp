// SPDX-License-Identifier: MIT
#include "app/feel/feel_source.hpp"

#include <algorithm>
#include <cstdio>
#include <filesystem>

#include "app/exit.hpp"
#include "app/interrupt.hpp"
#include "app/progress.hpp"
#include "files/disk_source.hpp"
#include "files/files.hpp"
#include "job/job_files.hpp"
#include "job/toml/jnd_profile_toml.hpp"
#include "readers/tables/force_bake.hpp"
#include "session/chatter/program_chatter.hpp"
#include "tribo/threads.hpp"

namespace tribo::app {
namespace {

// Radius of a fingertip, if --probe-mm is not given.
constexpr double kFingerMm = 8;

}  // namespace

FileResult<void> check_bake_file(const std::string& path) {
    namespace fs = std::filesystem;
    std::error_code error;
    const fs::file_status status = path.empty() ? fs::file_status() : fs::status(path, error);
    if (!fs::exists(status)) return {};
    const auto refuse = [&](const char* cause) {
        return std::unexpected(
            FileFailure({path, 0, 0, cause, "give --bake another name, or delete this first"}));
    };
    if (!fs::is_regular_file(status)) return refuse("this is no file that a force table could be kept in");
    const auto bytes = files::first_bytes(path, readers::kForceBakeMagicBytes);
    if (!bytes) return std::unexpected(bytes.error());
    if (!readers::is_force_bake(*bytes))
        return refuse("this is not a baked force table, and a new table would replace it");
    return {};
}

FeelSource::FeelSource(const FeelCall& call, const job::Job& job, double surface_n_per_mm, double start_s,
                       const haptics::DeviceLimits& limits)
    : call_(call), job_(job), surface_n_per_mm_(surface_n_per_mm), start_s_(start_s) {
    scaling_.gain = job.haptics.force_scale;
    scaling_.law = call.compressive ? haptics::ScalingLaw::compressive : haptics::ScalingLaw::gain;
    scaling_.limit_n = limits.max_force_n;
}

FileResult<contact::ForceTableOptions> FeelSource::table_options() const {
    contact::ForceTableOptions options;
    options.hand_per_tool = scaling_.gain;
    const std::string& profile = call_.profile.empty() ? job_.haptics.profile : call_.profile;
    if (profile.empty()) return options;
    auto read = job::read_jnd_profile(files::DiskSource(), profile);
    if (!read) return std::unexpected(job::at_key(job_, read.error()));
    options.profile = *read;
    return options;
}

std::optional<contact::ForceTable> FeelSource::baked(std::uint64_t key) const {
    if (call_.bake.empty()) return std::nullopt;
    auto file = files::read_file(call_.bake);
    if (!file) return std::nullopt;  // not baked yet
    const auto bytes = std::make_shared<const std::string>(*std::move(file));
    auto bake = readers::read_force_bake(*bytes, bytes, call_.bake);
    if (!bake) {
        report(Warnings{{call_.bake, 0, bake.error().cause + "; it is baked again"}});
        return std::nullopt;
    }
    if (bake->key != key) {
        report(Warnings{{call_.bake, 0, "baked from another job, profile or scale; it is baked again"}});
        return std::nullopt;
    }
    return std::move(bake->table);
}

bool FeelSource::mill(session::MillSetup setup, const ParallelFor& parallel) {
    Progress progress;
    const auto milling = [&](const char* stage) {
        return [&progress, stage](double fraction) {
            progress.update(stage, fraction);
            return !interrupted();
        };
    };
    milled_ = std::make_unique<session::MillSession>(std::move(setup), parallel, milling("earlier jobs"));
    const bool cut = call_.mode == "cut";
    std::optional<session::ProgramChatter> chatter;
    if (job_.can_vibrate()) {
        if (cut) vibration_.emplace(call_.rate_hz, milled_->duration_s());
        chatter.emplace(
            milled_->setup(), session::ProgramChatter::Options{cut, !cut}, parallel,
            [this](const milling::CutRow& row, const milling::RowForce&, const session::RowChatter& of_row) {
                if (vibration_ && of_row.vibration) vibration_->add(*of_row.vibration, row.pose.frame);
            });
    }
    session::MillSinks sinks;
    if (cut || chatter) {
        sinks.row = [&](const milling::CutRow& row, const milling::RowForce& force) {
            if (cut) record_.add(row);
            if (chatter) chatter->add(row, force);
        };
    }
    sinks.progress = milling("milling");
    if (!milled_->run(sinks)) return false;
    if (!chatter) return true;
    chatter->finish();
    if (!cut) form_error_ = surface::FormError(chatter->take_surface(), milled_->stock(), parallel);
    report(session::warnings_of(chatter->totals(), job_.path.file));
    return true;
}

haptics::ContactOptions FeelSource::contact_options(haptics::ProbeShape& probe) const {
    haptics::ContactOptions contact;
    contact.stiffness_n_per_mm = surface_n_per_mm_;
    contact.probe_radius_mm = call_.probe_mm.value_or(0);
    // If one of the two flags is given, neither value is taken from the job.
    const bool called = call_.friction_static || call_.friction_kinetic;
    const auto& friction_static = called ? call_.friction_static : job_.haptics.friction_static;
    const auto& friction_kinetic = called ? call_.friction_kinetic : job_.haptics.friction_kinetic;
    contact.friction_static = friction_static.value_or(0);
    contact.friction_kinetic = friction_kinetic.value_or(contact.friction_static);
    contact.friction_static = std::max(contact.friction_static, contact.friction_kinetic);
    contact.tick_s = 1 / call_.rate_hz;
    if (job_.haptics.probe == job::ProbeKind::ray) probe = haptics::ProbeShape::ray();
    if (job_.haptics.probe == job::ProbeKind::cylinder) {
        // The radius is that of the finger, not of the points on it.
        probe = haptics::ProbeShape::cylinder(call_.probe_mm.value_or(kFingerMm));
        contact.probe_radius_mm = 0;
    }
    return contact;
}

void FeelSource::inspect(const contact::DistanceField& surface) {
    haptics::ProbeShape probe;
    const haptics::ContactOptions contact = contact_options(probe);
    source_ = std::make_unique<session::InspectSource>(surface, contact, std::move(probe),
                                                       form_error_.empty() ? nullptr : &form_error_);
}

void FeelSource::cut(contact::ForceTable table, const ParallelFor& parallel) {
    knots_ = table.table().knots();
    table_bytes_ = table.bytes();
    force_ = std::make_unique<haptics::ForceTablePlayer>(call_.rate_hz);
    force_->replace(std::move(table), scaling_);
    if (call_.texture && milled_)
        textures_ = session::texture_map(record_.rows(), milled_->stock(), parallel);
    texture_records_ = textures_.records().size();
    session::CutSourceOptions options;
    options.start_s = start_s_;
    options.finger_mm = call_.probe_mm.value_or(0);
    options.tick_s = 1 / call_.rate_hz;
    options.texture = call_.texture;
    if (stock_) {
        options.part = &stock_->reader();
        options.contact = contact_options(options.probe);
    }
    if (vibration_) vibrating_.emplace(*force_, *vibration_, scaling_);
    haptics::CuttingForce& force = vibrating_ ? static_cast<haptics::CuttingForce&>(*vibrating_) : *force_;
    source_ = std::make_unique<session::CutSource>(*track_, force, textures_, options);
}

FileResult<void> FeelSource::make(session::MillSetup setup, std::optional<session::MillSetup> in_time) {
    const ParallelFor parallel = parallel_for_over(call_.threads > 0 ? call_.threads : available_threads());
    if (call_.mode != "cut") {
        if (mill(std::move(setup), parallel)) inspect(milled_->stock());
        return {};
    }
    const auto options = table_options();
    if (!options) return std::unexpected(options.error());
    const std::uint64_t key = session::bake_key(setup, *options);
    track_ = std::make_unique<session::CutterTrack>(setup);
    auto table = baked(key);
    from_bake_ = table.has_value();
    if (!table || call_.texture || job_.can_vibrate()) {
        if (!mill(std::move(setup), parallel)) return {};
    }
    if (!table) {
        const auto stretches = session::force_stretches(record_, milled_->setup(), {}, parallel);
        const contact::ForceFunction function = contact::force_function(stretches, *options);
        table = contact::build_force_table(function, *options);
        if (!call_.stats.empty() && !table->table().empty()) {
            const contact::ErrorInJnd error = contact::force_error(*options);
            figures_.emplace();
            figures_->pieces = table->table().pieces().size();
            figures_->knots = table->table().knots();
            figures_->bytes = table->bytes();
            figures_->worst_jnd = contact::worst_error_jnd(table->table(), function.dense, error);
            figures_->uniform_knots = contact::uniform_knots(function.dense, error, options->most_jnd);
        }
        if (!call_.bake.empty()) {
            auto written = files::write_file(call_.bake, readers::write_force_bake(*table, key));
            if (!written) return std::unexpected(written.error());
        }
    }
    if (in_time) stock_ = std::make_unique<session::StockAtTime>(std::move(*in_time), parallel, start_s_);
    cut(std::move(*table), parallel);
    return {};
}

void FeelSource::make(std::unique_ptr<const contact::DistanceField> surface) {
    surface_ = std::move(surface);
    inspect(*surface_);
}

void FeelSource::print() const {
    if (call_.mode != "cut") return;
    std::printf("%-16s %zu knots, %zu bytes%s\n", "force table", knots_, table_bytes_,
                from_bake_ ? ", as baked" : "");
    if (call_.texture) std::printf("%-16s %zu places of eight triangles\n", "texture", texture_records_);
}

}  // namespace tribo::app
