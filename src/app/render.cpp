// SPDX-License-Identifier: MIT
#include "app/render.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <fstream>

#include "app/exit.hpp"
#include "app/interrupt.hpp"
#include "app/progress.hpp"
#include "app/render_sinks.hpp"
#include "app/threads.hpp"
#include "field/box_shape.hpp"
#include "field/contour.hpp"
#include "field/mesh_shape.hpp"
#include "formats/stl.hpp"
#include "io/gltf.hpp"
#include "io/job_toml.hpp"
#include "io/memory.hpp"
#include "io/model_file.hpp"
#include "io/output_folder.hpp"
#include "io/picture.hpp"
#include "io/program_file.hpp"
#include "io/summary_json.hpp"
#include "session/mill_setup.hpp"
#include "surface/deviation.hpp"

namespace tribo::app {
namespace {

constexpr double kMegabyte = 1e6;

struct Solid {
    std::unique_ptr<const field::Shape> shape;
    double volume_mm3 = 0;
};

io::FileResult<Solid> read_solid(const formats::JobSolid& solid) {
    if (!solid.model) return Solid{std::make_unique<field::BoxShape>(solid.box_mm), solid.box_mm.volume()};
    auto model = io::read_model_file(*solid.model);
    if (!model) return std::unexpected(model.error());
    auto shape = field::MeshShape::make(std::move(model->mesh));
    if (!shape) {
        Error error = shape.error();
        error.file = solid.model->path;
        return std::unexpected(io::Failure(error));
    }
    const double volume = volume_mm3((*shape)->mesh());
    return Solid{std::move(*shape), volume};
}

// Everything the job names, read and checked.
struct Loaded {
    formats::Job job;
    milling::Material material;
    session::MillSetup setup;
    std::optional<formats::Model> part;
    Warnings warnings;
};

io::FileResult<Loaded> load(const RenderCall& call) {
    Loaded loaded;
    auto job = io::read_job(call.job);
    if (!job) return std::unexpected(job.error());
    loaded.job = std::move(*job);
    auto program = io::read_program(loaded.job);
    if (!program) return std::unexpected(program.error());
    loaded.warnings = program->warnings;
    session::MillInputs inputs;
    inputs.program = std::move(*program);
    auto blank = read_solid(loaded.job.stock);
    if (!blank) return std::unexpected(blank.error());
    inputs.blank = std::move(blank->shape);
    inputs.blank_volume_mm3 = blank->volume_mm3;
    for (const formats::JobSolid& fixture : loaded.job.fixtures) {
        auto solid = read_solid(fixture);
        if (!solid) return std::unexpected(solid.error());
        inputs.fixtures.push_back(std::move(solid->shape));
    }
    if (loaded.job.part) {
        auto part = io::read_model_file(*loaded.job.part);
        if (!part) return std::unexpected(part.error());
        loaded.part = std::move(*part);
        loaded.warnings.insert(loaded.warnings.end(), loaded.part->warnings.begin(),
                               loaded.part->warnings.end());
    }
    auto material = session::job_material(loaded.job);
    if (!material) {
        Error error = material.error();
        if (error.file.empty()) error.file = call.job;
        return std::unexpected(io::Failure(error));
    }
    loaded.material = std::move(*material);
    auto setup = session::prepare_mill(loaded.job, std::move(inputs), {call.resolution_mm, call.until_s},
                                       loaded.warnings);
    if (!setup) {
        Error error = setup.error();
        if (error.file.empty()) error.file = call.job;
        return std::unexpected(io::Failure(error));
    }
    loaded.setup = std::move(*setup);
    return loaded;
}

// The most that the run may hold at once, bytes, at a spacing of the grid.
double bytes_at(const RenderCall& call, const session::MillSetup& setup, double cell) {
    const Box3 blank = setup.blank->bounds_mm();
    const Vec3 s = blank.size();
    const double faces = 2 * (s.x * s.y + s.y * s.z + s.z * s.x);
    double swept = 0;
    for (std::size_t n = 0; n < setup.moves.size(); ++n) {
        const milling::Cutter& c = setup.cutters[setup.cutter_of_move[n]];
        swept += motion::path_length_mm(setup.moves[n]) * c.diameter_mm;
    }
    // A cut surface lies within the blank: repeated passes make no more of it than a few layers of its faces.
    const double surface = std::min(faces + 2 * swept, 3 * faces);
    double bytes = field::CarvedField::estimated_bytes(blank, cell, surface);
    if (call.wants("mesh") || call.wants("report")) bytes += surface / (cell * cell) * 60;
    constexpr double kPerMove = sizeof(motion::Move) + 2 * sizeof(motion::MoveTiming) + 320;
    return bytes + kPerMove * static_cast<double>(setup.moves.size()) + 30 * kMegabyte;
}

// Refuses what would not fit, naming the finest spacing that would.
Result<void> check_memory(const RenderCall& call, const Loaded& loaded) {
    const double budget =
        call.memory_mb ? *call.memory_mb * kMegabyte : static_cast<double>(io::default_memory_budget_bytes());
    const double need = bytes_at(call, loaded.setup, loaded.setup.cell_mm);
    if (budget <= 0 || need <= budget) return {};
    double fits = loaded.setup.cell_mm;
    const Vec3 size = loaded.setup.blank->bounds_mm().size();
    const double largest = std::max({size.x, size.y, size.z});
    while (fits < largest && bytes_at(call, loaded.setup, fits) > budget) fits *= 1.05;
    char cause[160], remedy[160];
    std::snprintf(cause, sizeof cause,
                  "the job may take %.0f MB at a resolution of %.3g mm, and %.0f MB are allowed",
                  need / kMegabyte, loaded.setup.cell_mm, budget / kMegabyte);
    if (fits < largest) {
        std::snprintf(remedy, sizeof remedy, "try --resolution %.3g, or allow more with --memory", fits);
    } else {
        std::snprintf(remedy, sizeof remedy, "allow at least %.0f MB with --memory",
                      std::ceil(bytes_at(call, loaded.setup, largest) / kMegabyte));
    }
    return fail_at(call.job, 0, 0, cause, remedy);
}

Vec3 listener(const formats::Job& job, const Box3& blank) {
    if (job.sound.listener_mm) return *job.sound.listener_mm;
    const Vec3 c = blank.centre();
    return {c.x, c.y, blank.max.z};
}

io::Summary summary_of(const RenderCall& call, const Loaded& loaded, const session::MillSession& session) {
    const session::MillTotals& t = session.totals();
    io::Summary s;
    s.job = call.job;
    s.version = TRIBO_VERSION;
    s.duration_s = t.duration_s;
    s.cutting_s = t.cutting_s;
    s.path_mm = t.path_mm;
    s.removed_mm3 = t.removed_mm3;
    s.remaining_mm3 = t.remaining_mm3;
    s.mean_force_n = t.mean_force_n;
    s.peak_force_n = t.peak_force_n;
    s.peak_torque_nm = 1e-3 * t.peak_torque_nmm;
    s.peak_power_w = t.peak_power_w;
    s.force_low_factor = loaded.material.spread_low;
    s.force_high_factor = loaded.material.spread_high;
    if (t.rows > 0) s.tooth_passing_hz = t.tooth_passing_hz;
    s.resolution_mm = session.setup().cell_mm;
    s.as_published = call.as_published;
    s.warnings = loaded.warnings;
    for (const session::MillCollision& c : t.collisions) {
        s.collisions.push_back({c.line, c.t_s, milling::name(c.kind), c.tip_mm});
    }
    return s;
}

std::vector<std::pair<std::string, std::string>> facts_of(const Loaded& loaded) {
    const milling::Material& m = loaded.material;
    char k[200], band[200];
    const milling::CuttingCoefficients& c = m.coefficients;
    std::snprintf(k, sizeof k, "Ktc %.4g, Krc %.4g, Kac %.4g N/mm2; Kte %.4g, Kre %.4g, Kae %.4g N/mm", c.ktc,
                  c.krc, c.kac, c.kte, c.kre, c.kae);
    std::snprintf(band, sizeof band, "forces may really be %.2g to %.2g times what stands here", m.spread_low,
                  m.spread_high);
    std::vector<std::pair<std::string, std::string>> facts{
        {"Material", std::string(m.name) + ": " + std::string(m.what)},
        {"Source", std::string(m.source)},
        {"Coefficients", k},
        {"Band", band},
    };
    if (!m.note.empty()) facts.emplace_back("Note", std::string(m.note));
    facts.emplace_back("Not modelled", "chatter, deflection of tool and part, heat, wear");
    return facts;
}

// The files of one render, in the order in which they are made.
class Outputs {
  public:
    Outputs(const RenderCall& call, Loaded& loaded, io::OutputFolder& folder, const ParallelFor& parallel)
        : call_(call), loaded_(loaded), folder_(folder), parallel_(parallel) {}

    io::FileResult<void> open(double duration_s, const Box3& blank) {
        if (call_.wants("forces")) {
            auto file = ForceFile::create(folder_.file("forces.csv"));
            if (!file) return std::unexpected(file.error());
            forces_.emplace(std::move(*file));
            if (call_.as_published) {
                auto published = PublishedForceFile::create(folder_.file("published_forces.csv"));
                if (!published) return std::unexpected(published.error());
                published_.emplace(std::move(*published));
            }
        }
        if (call_.wants("sound")) {
            const formats::JobSound& s = loaded_.job.sound;
            SoundFileOptions options;
            options.format.sample_rate_hz = options.track.sample_rate_hz = call_.sample_rate_hz;
            options.format.bits = s.bits;
            options.track.gain_db = s.gain_db;
            options.track.listener_mm = listener(loaded_.job, blank);
            options.track.distance_factor = s.distance_factor;
            options.track.as_published = call_.as_published;
            auto file = SoundFile::create(folder_.file("sound.wav"), options, duration_s);
            if (!file) return std::unexpected(file.error());
            sound_.emplace(std::move(*file));
        }
        return {};
    }

    void add(const session::MillRow& row, const session::MillSetup& setup) {
        if (forces_) forces_->add(row);
        if (published_) published_->add(row, setup.cutters[row.cutter], setup.coefficients);
        if (sound_) sound_->add(row);
        if (call_.wants("report")) report_.add(row);
    }

    bool needs_rows() const { return forces_ || sound_ || call_.wants("report"); }

    io::FileResult<void> finish(const session::MillSession& session, io::Summary& summary) {
        if (forces_) {
            if (auto done = forces_->finish(); !done) return done;
        }
        if (published_) {
            if (auto done = published_->finish(); !done) return done;
        }
        if (sound_) {
            if (auto done = sound_->finish(session.totals().duration_s); !done) return done;
        }
        TriangleMesh mesh;
        if (call_.wants("mesh") || call_.wants("report")) {
            mesh = field::contour(session.stock(), parallel_);
            summary.triangles = mesh.triangles.size();
        }
        if (call_.wants("mesh")) {
            if (auto done = write_mesh(mesh, session.stock().blank()); !done) return done;
        }
        if (loaded_.part) {
            if (auto done = compare(session, summary); !done) return done;
        }
        if (call_.wants("report")) return write_report(session, summary, std::move(mesh));
        return {};
    }

  private:
    io::FileResult<void> write_mesh(const TriangleMesh& mesh, const field::Shape& blank) {
        auto stl = io::FileWriter::create(folder_.file("machined.stl"));
        if (!stl) return std::unexpected(stl.error());
        formats::write_stl(mesh, [&](std::string_view bytes) {
            stl->write(bytes);
            return true;
        });
        if (auto done = stl->finish(); !done) return done;
        // A cut that is shallower than this looks like the blank's own face.
        constexpr double kOnFaceMm = 1e-3;
        return io::write_glb(folder_.file("machined.glb"), mesh, [&](const Triangle& t) {
            return std::all_of(t.begin(), t.end(), [&](std::uint32_t corner) {
                return std::abs(blank.distance_mm(mesh.position(corner))) <= kOnFaceMm;
            });
        });
    }

    io::FileResult<void> compare(const session::MillSession& session, io::Summary& summary) {
        auto designed = surface::DesignedSurface::make(std::move(loaded_.part->mesh));
        if (!designed) {
            Error error = designed.error();
            error.file = loaded_.job.part->path;
            return std::unexpected(io::Failure(error));
        }
        surface::DeviationOptions options;
        options.pass_width_mm = 0;
        for (const milling::Cutter& c : session.setup().cutters) {
            options.pass_width_mm = std::max(options.pass_width_mm, c.diameter_mm);
        }
        options.blank = &session.stock().blank();
        // Cusps are sharpened from the samples: a cell apart is enough to find them.
        options.spacing_mm =
            std::max(session.setup().cell_mm,
                     std::sqrt(designed->area_mm2() / static_cast<double>(surface::kMaxSamples)));
        const surface::DeviationReport d = surface::compare(session.stock(), *designed, options, parallel_);
        summary.gouge_max_mm = d.gouge.mm;
        summary.rest_max_mm = d.rest.mm;
        summary.scallop_max_mm = d.scallop.mm;
        return {};
    }

    io::FileResult<void> write_report(const session::MillSession& session, const io::Summary& summary,
                                      TriangleMesh mesh) {
        io::ReportData data;
        data.title = call_.job;
        data.subtitle = std::string(loaded_.material.name) + ", " +
                        std::to_string(session.setup().cutters.size()) +
                        (session.setup().cutters.size() == 1 ? " cutter" : " cutters");
        data.summary = summary;
        data.picture_png = io::png_bytes(io::draw_part(mesh));
        mesh = {};
        data.rows = io::thin_rows(report_.rows, 4000);
        data.turn = report_.turn(session.setup());
        if (sound_) {
            data.sound = sound_->for_report();
            data.sound->waves = report_.waves(session.setup(), sound_->options());
        }
        data.facts = facts_of(loaded_);
        return io::write_file(folder_.file("report.html"), io::report_html(data));
    }

    const RenderCall& call_;
    Loaded& loaded_;
    io::OutputFolder& folder_;
    const ParallelFor& parallel_;
    std::optional<ForceFile> forces_;
    std::optional<PublishedForceFile> published_;
    std::optional<SoundFile> sound_;
    ReportRows report_;
};

void print(const io::Summary& s, const io::OutputFolder& folder) {
    std::printf("%-16s %.1f s, cutting %.1f s\n", "time", s.duration_s, s.cutting_s);
    std::printf("%-16s %.1f mm\n", "path", s.path_mm);
    std::printf("%-16s %.1f mm3 of %.1f mm3\n", "removed", s.removed_mm3, s.removed_mm3 + s.remaining_mm3);
    std::printf("%-16s mean %.1f N, peak %.1f N (%.2g to %.2g times that)\n", "force", s.mean_force_n,
                s.peak_force_n, s.force_low_factor, s.force_high_factor);
    std::printf("%-16s %.2f N m, %.0f W\n", "peak torque", s.peak_torque_nm, s.peak_power_w);
    if (s.tooth_passing_hz) std::printf("%-16s %.1f Hz\n", "tooth passing", *s.tooth_passing_hz);
    if (s.scallop_max_mm)
        std::printf("%-16s gouge %.3f mm, rest %.3f mm, scallop %.3f mm\n", "deviation", *s.gouge_max_mm,
                    *s.rest_max_mm, *s.scallop_max_mm);
    if (s.triangles)
        std::printf("%-16s %llu triangles\n", "part", static_cast<unsigned long long>(*s.triangles));
    std::printf("%-16s %zu collisions, %zu warnings\n", "findings", s.collisions.size(), s.warnings.size());
    std::printf("%-16s %.2f s, %.0f MB\n", "took", s.seconds, s.peak_memory_mb);
    std::printf("%-16s %s\n", "files", folder.path().c_str());
}

}  // namespace

int render(const RenderCall& call) {
    const auto begin = std::chrono::steady_clock::now();
    auto loaded = load(call);
    if (!loaded) return report(loaded.error());
    if (auto fits = check_memory(call, *loaded); !fits) return report(fits.error());
    auto folder = io::OutputFolder::open(call.out);
    if (!folder) return report(folder.error());
    report(loaded->warnings);

    const ParallelFor parallel = parallel_for_over(call.threads > 0 ? call.threads : available_threads());
    const Box3 blank = loaded->setup.blank->bounds_mm();
    session::MillSession session(std::move(loaded->setup), parallel);
    Outputs outputs(call, *loaded, *folder, parallel);
    if (auto open = outputs.open(session.duration_s(), blank); !open) return report(open.error());
    {
        Progress progress;
        session::MillSinks sinks;
        if (outputs.needs_rows()) {
            sinks.row = [&](const session::MillRow& row) { outputs.add(row, session.setup()); };
        }
        sinks.progress = [&](double fraction) {
            progress.update("milling", fraction);
            return !interrupted();
        };
        if (!session.run(sinks)) return interrupted_exit_code();
    }
    io::Summary summary = summary_of(call, *loaded, session);
    if (auto done = outputs.finish(session, summary); !done) return report(done.error());
    if (interrupted()) return interrupted_exit_code();
    summary.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    summary.peak_memory_mb = static_cast<double>(io::peak_memory_bytes()) / kMegabyte;
    if (auto done = io::write_file(folder->file("summary.json"), io::summary_json(summary)); !done) {
        return report(done.error());
    }
    if (auto done = folder->commit(); !done) return report(done.error());
    print(summary, *folder);
    return kDone;
}

}  // namespace tribo::app
