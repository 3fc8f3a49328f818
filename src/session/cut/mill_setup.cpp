// SPDX-License-Identifier: MIT
#include "session/cut/mill_setup.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "base/math.hpp"
#include "base/text/decimal.hpp"
#include "motion/path/close_passes.hpp"
#include "motion/path/moves.hpp"
#include "motion/path/path.hpp"
#include "readers/text/move_limit.hpp"
#include "session/cut/cutter_modes.hpp"
#include "session/cut/job_stock.hpp"
#include "session/cut/part_in_stock.hpp"
#include "session/cut/places_in_stock.hpp"
#include "session/cut/speed_warnings.hpp"

namespace tribo::session {
namespace {

// The cutter for a tool number of the program.
class ToolChoice {
  public:
    ToolChoice(const job::Job& job, const motion::Program& program, Warnings& warnings)
        : job_(job), program_(program), warnings_(warnings) {
        for (std::size_t n = 0; n < job.cutters.size(); ++n) index_.emplace(job.cutters[n].number, n);
    }

    Result<std::size_t> cutter_for(const motion::Move& move) {
        const auto& cutters = job_.cutters;
        if (move.tool == 0) return 0;
        if (const auto known = index_.find(move.tool); known != index_.end()) return known->second;
        if (cutters.size() == 1 && cutters[0].number == 0) {
            // The first two are named: with one cutter in mind the second is the surprise.
            const bool is_first = first_ == 0;
            if (is_first) first_ = move.tool;
            if (is_first || (move.tool != first_ && !std::exchange(warned_, true))) {
                warnings_.push_back({program_.source, move.line,
                                     "tool T" + std::to_string(move.tool) +
                                         " is not described; the only cutter stands in for it" +
                                         (is_first ? "" : " as for T" + std::to_string(first_))});
            }
            return 0;
        }
        return fail_at(program_.source, move.line, 0,
                       "tool T" + std::to_string(move.tool) + " is not described by the job",
                       "add a [[cutter]] with number = " + std::to_string(move.tool));
    }

  private:
    const job::Job& job_;
    const motion::Program& program_;
    Warnings& warnings_;
    std::map<int, std::size_t> index_;  // of the cutter, by its number
    int first_ = 0;                     // the tool that the only cutter, without a number, stood in for first
    bool warned_ = false;               // of a second one
};

std::size_t most_moves(const MillOptions& options) {
    return options.memory_bytes == 0 ? readers::kMostMoves : readers::most_moves(options.memory_bytes);
}

// Counts the pieces of all moves before any is made.
Result<void> check_pieces(const motion::Program& program, const MillOptions& options) {
    const std::size_t most = most_moves(options);
    double pieces = 0;
    for (const motion::Move& move : program.moves) {
        pieces += static_cast<double>(motion::count_elementary(move));
        if (options.longest_piece_mm) pieces += motion::path_length_mm(move) / *options.longest_piece_mm;
        if (pieces <= static_cast<double>(most)) continue;
        return fail_at(program.source, move.line, 0,
                       "up to here the moves are split into more than " + std::to_string(most) + " pieces",
                       "split the program, check its unit, or allow more memory");
    }
    return {};
}

void warn_where_the_grid_is_coarse(const MillSetup& setup, double thickness_mm, const std::string& source,
                                   Warnings& warnings) {
    if (thickness_mm < setup.cell_mm) {
        warnings.push_back({source, 0,
                            "the grid is coarse for a stock that is " + format_digits(thickness_mm, 2) +
                                " mm thick: less than one cell; what is removed and the force may be off by "
                                "several per cent, try --resolution " +
                                format_digits(thickness_mm / 3, 2)});
    }
    for (const milling::Cutter& cutter : setup.cutters) {
        if (cutter.diameter_mm < 4 * setup.cell_mm) {
            warnings.push_back({source, 0,
                                "the grid is coarse for a cutter of " + format_decimal(cutter.diameter_mm) +
                                    " mm: fewer than four cells across; try a finer --resolution"});
        }
    }
}

// What the forces of cutters with a profile leave out.
void warn_of_points(const MillSetup& setup, const std::string& source, Warnings& warnings) {
    using milling::CutterKind;
    for (const milling::Cutter& cutter : setup.cutters) {
        if (!cutter.has_profile()) continue;
        const std::string name = cutter.number > 0 ? "tool T" + std::to_string(cutter.number) : "the tool";
        if (cutter.kind == CutterKind::drill) {
            warnings.push_back(
                {source, 0,
                 name + " is a drill: the thrust of its chisel edge is not modelled; core_mm, the "
                        "diameter of its web, keeps that part out of the forces"});
        } else if (cutter.profile.front().r_mm == 0 && cutter.core_mm == 0 &&
                   cutter.profile.front().bulge == 0) {
            warnings.push_back(
                {source, 0,
                 name + " cuts with a sharp point, where its edge hardly moves: there it ploughs, "
                        "and the forces of the model are too low; tip_mm gives it a flat tip"});
        }
    }
}

// Scallops are accurate on a grid of up to half the sidestep. On a coarser grid cusps merge.
constexpr double kLeastCellsPerSidestep = 2;
// A smaller share of the path is a lead-in, a corner or the end of a raster.
constexpr double kWorthAWarning = 0.1;

void warn_of_passes_below_the_grid(const MillSetup& setup, const std::string& source, Warnings& warnings) {
    constexpr double kRounding = 1e-6;  // of coordinates in text, relative
    const double within = kLeastCellsPerSidestep * setup.cell_mm * (1 - kRounding);
    const motion::ClosePasses close = motion::close_passes(setup.moves, within);
    if (close.share < kWorthAWarning) return;
    // Rounded down, so that the recommended spacing is fine enough.
    const double sidestep = close.sidestep_mm * (1 + kRounding), finest = sidestep / kLeastCellsPerSidestep;
    double digit = 1e-6;
    while (finest >= 100 * digit) digit *= 10;
    warnings.push_back({source, 0,
                        "along " + format_decimal(std::floor(100 * close.share)) +
                            " % of the feed path the next pass is only " +
                            format_decimal(std::floor(1000 * sidestep) / 1000) +
                            " mm aside, less than two cells of " + format_decimal(setup.cell_mm) +
                            " mm: the ridges between are not resolved; try --resolution " +
                            format_decimal(static_cast<float>(std::floor(finest / digit) * digit))});
}

}  // namespace

double default_cell_mm(const job::LoadedJob& loaded, const Box3& blank_mm) {
    const Vec3 size = blank_mm.size();
    double cell = std::min(std::max({size.x, size.y, size.z}) / 400, loaded.blank.thickness_mm / 3);
    for (const milling::Cutter& cutter : loaded.job.cutters) cell = std::min(cell, cutter.radius_mm() / 4);
    return std::clamp(cell, 0.02, 1.0);
}

Result<milling::WorkpieceMaterial> job_material(const job::Job& job) {
    if (!job.material.coefficients) return milling::find_material(job.material.name);
    milling::WorkpieceMaterial own;
    own.name = "own coefficients";
    own.what = "as the job file gives them";
    own.source = "job file";
    const double spread = job.material.spread;
    own.note = spread > 0 ? "the band is as the job file gives it"
                          : "no spread is known; the band is the calibration's own";
    own.coefficients = *job.material.coefficients;
    own.spread_low = 1 / (1 + spread);
    own.spread_high = 1 + spread;
    if (auto ok = milling::check(own.coefficients); !ok) return std::unexpected(ok.error());
    return own;
}

Result<MillSetup> prepare_moves(const job::Job& job, const motion::Program& program,
                                const MillOptions& options, Warnings& warnings) {
    if (program.has_rotary_words && program.machine.empty()) {
        return fail_at(program.source, program.first_rotary_line, 0,
                       "rotary words mean nothing without a machine",
                       "add machine = \"NAME\" to [path] of the job, or --machine NAME to the call; NAME is "
                       "one of " +
                           motion::machine_names() + " or a .toml file that describes one");
    }
    if (program.moves.empty()) {
        return fail_at(program.source, 0, 0, "the program moves nothing", "give it at least one feed move");
    }
    auto material = job_material(job);
    if (!material) {
        Error error = material.error();
        if (error.file.empty()) error.file = job.file;
        return std::unexpected(error);
    }

    if (auto fits = check_pieces(program, options); !fits) return std::unexpected(fits.error());

    MillSetup setup;
    setup.cutters = job.cutters;
    setup.coefficients = material->coefficients;
    setup.force_low_factor = material->spread_low;
    setup.force_high_factor = material->spread_high;
    setup.until_s = options.until_s;
    setup.variation = {job.process.spindle_variation, job.process.spindle_variation_hz};
    setup.on_machine = !program.machine.empty();
    setup.timing.rapid_mm_per_min = job.machine.rapid_mm_per_min;
    setup.timing.acceleration_mm_per_s2 = job.machine.acceleration_mm_per_s2;
    if (job.engagement) {
        setup.engagement =
            PrescribedEngagement{job.engagement->entry_deg * math::kRadPerDeg,
                                 job.engagement->exit_deg * math::kRadPerDeg, job.engagement->axial_depth_mm};
    }
    ToolChoice tools(job, program, warnings);
    // Most moves are elementary. Growing step by step would take up to three times the memory.
    setup.moves.reserve(program.moves.size());
    setup.cutter_of_move.reserve(program.moves.size());
    setup.rpm_of_move.reserve(program.moves.size());
    for (const motion::Move& move : program.moves) {
        const auto cutter = tools.cutter_for(move);
        if (!cutter) return std::unexpected(cutter.error());
        const double rpm = move.spindle_rpm > 0 ? move.spindle_rpm : job.process.spindle_rpm;
        if (!(rpm > 0) && move.kind == motion::MoveKind::feed) {
            return fail_at(program.source, move.line, 0, "the spindle has no speed here",
                           "add an S word to the program or spindle_rpm to [process]");
        }
        const auto add = [&](const motion::Move& piece) {
            setup.moves.push_back(piece);
            setup.cutter_of_move.push_back(*cutter);
            setup.rpm_of_move.push_back(rpm);
        };
        for (const motion::Move& piece : motion::to_elementary(move)) {
            if (!options.longest_piece_mm) {
                add(piece);
                continue;
            }
            for (const motion::Move& part : motion::in_pieces(piece, *options.longest_piece_mm)) add(part);
        }
    }
    const Warnings found = speed_warnings(setup, program.source);
    warnings.insert(warnings.end(), found.begin(), found.end());
    auto times = motion::schedule(setup.moves, setup.timing);
    if (!times) {
        Error error = times.error();
        if (error.file.empty()) error.file = program.source;
        return std::unexpected(error);
    }
    setup.schedule = std::make_shared<const motion::Schedule>(*std::move(times));
    return setup;
}

Result<MillSetup> prepare_mill(const job::LoadedJob& loaded, const MillOptions& options, Warnings& warnings) {
    auto stock = stock_of(loaded, warnings, options.memory_bytes);
    if (!stock) return std::unexpected(stock.error());
    auto prepared = prepare_moves(loaded.job, loaded.program, options, warnings);
    if (!prepared) return std::unexpected(prepared.error());
    MillSetup setup = *std::move(prepared);
    if (auto done = add_modes(loaded.job, setup, warnings); !done) return std::unexpected(done.error());
    add_places_in_stock(setup, stock->blank->bounds_mm());
    setup.cell_mm = options.cell_mm.value_or(default_cell_mm(loaded, stock->blank->bounds_mm()));
    warn_where_the_grid_is_coarse(setup, loaded.blank.thickness_mm, loaded.job.file, warnings);
    warn_of_points(setup, loaded.job.file, warnings);
    warn_of_passes_below_the_grid(setup, loaded.job.file, warnings);
    if (loaded.part) warn_of_part_outside(loaded.part->mesh, *stock->blank, loaded.job.file, warnings);
    setup.blank = std::move(stock->blank);
    setup.blank_volume_mm3 = stock->blank_volume_mm3;
    setup.earlier = std::move(stock->earlier);
    setup.stock_hash = stock->hash;
    setup.solid_bytes = loaded.solid_bytes;
    for (const job::Solid& fixture : loaded.fixtures) setup.fixtures.push_back(job::shape_of(fixture));
    return setup;
}

}  // namespace tribo::session
