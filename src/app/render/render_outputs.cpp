// SPDX-License-Identifier: MIT
#include "app/render/render_outputs.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

#include "app/render/part_deviation.hpp"
#include "app/render/report_chatter.hpp"
#include "app/render/report_sheet.hpp"
#include "base/text/decimal.hpp"
#include "field/contour/contour_refine.hpp"
#include "files/model/gltf.hpp"
#include "job/listening.hpp"
#include "readers/mesh/stl.hpp"
#include "report/picture/picture.hpp"
#include "report/surface_csv.hpp"
#include "session/chatter/probability.hpp"
#include "session/chatter/steady_bending.hpp"
#include "session/cut/stock_faces.hpp"

namespace tribo::app {
namespace {

// The colours of deviations end at this at least.
constexpr double kLeastRangeMm = 1e-3;
constexpr std::size_t kVerticesAtOnce = 4096;

// Returns a text about the sources of the sound. It says that not all of them are measured.
std::string sound_of(const job::Job& job) {
    const sound::Workshop w = job::listening_to(job, {}).workshop;
    std::string what(sound::machines()[w.machine].what);
    if (w.room > 0) what += ", " + std::string(sound::rooms()[w.room].what);
    if (!job.sound.recording.empty() || !job.sound.chips.empty() || !job.sound.idle_recording.empty())
        what += "; with recordings";
    if (w.machine > 0) what += "; chips, spindle and room are made up, not measured";
    return what;
}

std::vector<std::pair<std::string, std::string>> facts_of(const PreparedJob& loaded, bool sound) {
    const milling::WorkpieceMaterial& m = loaded.material;
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
    if (sound) facts.emplace_back("Sound", sound_of(loaded.job));
    facts.emplace_back("Not modelled",
                       session::bends_steadily(loaded.job)
                           ? "chatter, deflection of part and holder, heat, wear, chip evacuation"
                       : !loaded.job.can_vibrate()
                           ? "chatter, deflection of tool and part, heat, wear, chip evacuation"
                           : "what vibration does to the forces above; heat, wear, chip evacuation");
    return facts;
}

// What the bands of the report are of.
std::pair<std::string, std::string> fact_of_cases(const report::Summary& summary) {
    std::string text = "bands hold 9 of 10 of " + std::to_string(*summary.uncertain_cases) +
                       " cases of forces, run-out and modes";
    if (summary.chatter_probability)
        text += "; the worst row chatters in " + format_digits(100 * *summary.chatter_probability, 3) +
                " % of them";
    return {"Cases", text};
}

}  // namespace

bool RenderOutputs::writes(const std::string& name) {
    static constexpr std::array<std::string_view, 8> names{
        "summary.json", "forces.csv",   "published_forces.csv", "surface.csv",
        "sound.wav",    "machined.stl", "machined.glb",         "report.html"};
    return std::find(names.begin(), names.end(), name) != names.end();
}

FileResult<void> RenderOutputs::open(const session::MillSession& session, const Box3& blank) {
    if (call_.uncertain)
        bands_.emplace(session.setup(), static_cast<std::size_t>(*call_.uncertain), parallel_);
    if (call_.wants("forces")) {
        auto file =
            ForceFile::create(folder_.file("forces.csv"), loaded_.job.can_vibrate(), bands_.has_value());
        if (!file) return std::unexpected(file.error());
        forces_.emplace(std::move(*file));
        if (call_.as_published) {
            auto published = PublishedForceFile::create(folder_.file("published_forces.csv"));
            if (!published) return std::unexpected(published.error());
            published_.emplace(std::move(*published));
        }
    }
    if (call_.wants("sound")) {
        SoundFileOptions options;
        options.track = loaded_.track;
        options.format.sample_rate_hz = options.track.sample_rate_hz = call_.sample_rate_hz;
        options.format.bits = loaded_.job.sound.bits;
        job::apply(job::listening_to(loaded_.job, blank), options.track);
        options.track.as_published = call_.as_published;
        auto file = SoundFile::create(folder_.file("sound.wav"), options, session.duration_s());
        if (!file) return std::unexpected(file.error());
        sound_.emplace(std::move(*file));
    }
    return {};
}

void RenderOutputs::add(const milling::CutRow& row, const milling::RowForce& force,
                        const session::MillSetup& setup, const session::RowChatter* chatter) {
    const double peak_n = force.peaks.peak_force_n;
    sweep::Band band{setup.force_low_factor * peak_n, peak_n, setup.force_high_factor * peak_n};
    if (bands_) band = bands_->add(row, force.peaks);
    if (forces_) forces_->add(row, force.peaks, chatter, bands_ ? &band : nullptr);
    if (published_) published_->add(row, setup.cutters[row.cutter], setup.coefficients);
    const bool vibrates = chatter != nullptr && chatter->vibration;
    if (sound_)
        sound_->add(row, force, setup.cutters[row.cutter].flutes, vibrates ? &*chatter->vibration : nullptr);
    if (call_.wants("report")) report_.add(row, force.peaks, chatter, band);
}

FileResult<void> RenderOutputs::finish(const session::MillSession& session,
                                       const session::ProgramChatter* chatter,
                                       std::optional<surface::ToothTraces> traces, report::Summary& summary) {
    add_bands(session, chatter, summary);
    if (forces_) {
        if (auto done = forces_->finish(); !done) return done;
    }
    if (published_) {
        if (auto done = published_->finish(); !done) return done;
    }
    if (sound_) {
        if (auto done = sound_->finish(session.totals().duration_s); !done) return done;
    }
    if (traces) {
        form_error_ = surface::FormError(*std::move(traces), session.stock(), parallel_);
        if (auto done = write_surface(summary); !done) return done;
    }
    TriangleMesh mesh;
    std::vector<std::uint8_t> on_blank;
    if (call_.wants("mesh") || call_.wants("report")) {
        mesh = field::fine_contour(session.stock(), parallel_);
        on_blank = session::vertices_on_blank(mesh, session.stock().blank(), parallel_);
        summary.triangles = mesh.triangles.size();
    }
    if (call_.wants("mesh")) {
        if (auto done = write_mesh(mesh, on_blank); !done) return done;
    }
    if (loaded_.part) {
        if (auto done = compare(session, summary); !done) return done;
    }
    if (call_.wants("report"))
        return write_report(session, chatter, summary, std::move(mesh), std::move(on_blank));
    return {};
}

void RenderOutputs::add_bands(const session::MillSession& session, const session::ProgramChatter* chatter,
                              report::Summary& summary) const {
    const session::MillTotals& t = session.totals();
    const session::MillSetup& setup = session.setup();
    constexpr double kMetres = 1e-3;
    std::optional<session::ForceBands::Totals> bands;
    if (bands_) bands = bands_->totals();
    using Totals = session::ForceBands::Totals;
    const auto with_band = [&](double value, sweep::Band Totals::* member, double unit = 1) {
        if (!bands)
            return report::ForceValue{unit * value, unit * value * setup.force_low_factor,
                                      unit * value * setup.force_high_factor};
        const sweep::Band& band = (*bands).*member;
        return report::ForceValue{unit * value, unit * band.low, unit * band.high};
    };
    summary.mean_force_n = with_band(t.mean_force_n, &Totals::mean_force_n);
    summary.peak_force_n = with_band(t.peak_force_n, &Totals::peak_force_n);
    summary.peak_torque_nm = with_band(t.peak_torque_nmm, &Totals::peak_torque_nmm, kMetres);
    summary.peak_power_w = with_band(t.peak_power_w, &Totals::peak_power_w);
    if (!bands_) return;
    const auto cases = static_cast<std::size_t>(*call_.uncertain);
    summary.uncertain_cases = cases;
    if (chatter != nullptr)
        summary.chatter_probability = session::chatter_probability(*chatter, setup, cases);
}

FileResult<void> RenderOutputs::write_surface(report::Summary& summary) {
    const surface::FormError::Extremes& e = form_error_.extremes();
    if (!form_error_.empty())
        summary.form_error = {e.left_mm, e.overcut_mm, e.wave_mm, e.left_line, e.overcut_line};
    if (!call_.wants("surface")) return {};
    auto file = files::FileWriter::create(folder_.file("surface.csv"));
    if (!file) return std::unexpected(file.error());
    file->write(report::surface_csv_header());
    std::string text;
    for (const surface::ToothTrace& trace : form_error_.kept().traces) {
        text.clear();
        report::append_surface_rows(text, trace, form_error_.kept());
        file->write(text);
    }
    return file->finish();
}

FileResult<void> RenderOutputs::write_mesh(const TriangleMesh& mesh, std::span<const std::uint8_t> on_blank) {
    auto stl = files::FileWriter::create(folder_.file("machined.stl"));
    if (!stl) return std::unexpected(stl.error());
    readers::write_stl(mesh, [&](std::string_view bytes) {
        stl->write(bytes);
        return true;
    });
    if (auto done = stl->finish(); !done) return done;
    return files::write_glb(folder_.file("machined.glb"), mesh, session::untouched_triangles(mesh, on_blank));
}

FileResult<void> RenderOutputs::compare(const session::MillSession& session, report::Summary& summary) {
    auto designed = surface::DesignedSurface::make(std::move(loaded_.part->mesh));
    if (!designed) {
        Error error = designed.error();
        error.file = loaded_.job.part->path;
        return std::unexpected(FileFailure(error));
    }
    const surface::DeviationReport d = part_deviation(session, *designed, form_error_, parallel_);
    designed_.emplace(*std::move(designed));
    summary.gouge_max_mm = d.gouge.mm;
    summary.rest_max_mm = d.rest.mm;
    summary.scallop_max_mm = d.scallop.mm;
    if (d.gouge.mm > 0) summary.gouge_at_mm = d.gouge.machined_mm;
    if (d.rest.mm > 0) summary.rest_at_mm = d.rest.machined_mm;
    return {};
}

report::ReportPart RenderOutputs::report_part(const report::Summary& summary, const TriangleMesh& mesh,
                                              std::vector<std::uint8_t> on_blank) const {
    report::ReportPart part;
    part.untouched = std::move(on_blank);
    part.mesh = report::with_fewer_vertices(mesh, report::kMostPartVertices, part.untouched);
    std::vector<float> bent_mm(form_error_.empty() ? 0 : part.mesh.positions.size());
    parallel_((bent_mm.size() + kVerticesAtOnce - 1) / kVerticesAtOnce, [&](std::size_t piece) {
        const std::size_t end = std::min(bent_mm.size(), (piece + 1) * kVerticesAtOnce);
        for (std::size_t n = piece * kVerticesAtOnce; n < end; ++n)
            bent_mm[n] = static_cast<float>(
                form_error_.at(part.mesh.position(static_cast<std::uint32_t>(n))).value_or(0));
    });
    if (!designed_) {
        if (form_error_.empty()) return part;
        const surface::FormError::Extremes& e = form_error_.extremes();
        part.deviation_from = session::bends_steadily(loaded_.job) ? "deviation by bending of the tool"
                                                                   : "deviation by bending of tool and part";
        part.deviation_range_mm = std::max({e.left_mm, e.overcut_mm, kLeastRangeMm});
        part.deviation_mm = std::move(bent_mm);
        return part;
    }
    // The colour scale ends at the largest deviation in machined areas. Areas that the tool never reached
    // exceed it.
    const double range = std::max(summary.scallop_max_mm.value_or(0), summary.gouge_max_mm.value_or(0));
    part.deviation_range_mm = range > 0 ? range : std::max(summary.rest_max_mm.value_or(0), kLeastRangeMm);
    part.deviation_mm = surface::deviations_of(part.mesh, *designed_, parallel_);
    for (std::size_t n = 0; n < bent_mm.size(); ++n) part.deviation_mm[n] += bent_mm[n];
    return part;
}

FileResult<void> RenderOutputs::write_report(const session::MillSession& session,
                                             const session::ProgramChatter* chatter,
                                             const report::Summary& summary, TriangleMesh mesh,
                                             std::vector<std::uint8_t> on_blank) {
    report::ReportData data;
    data.title = call_.job;
    data.subtitle = std::string(loaded_.material.name) + ", " +
                    std::to_string(session.setup().cutters.size()) +
                    (session.setup().cutters.size() == 1 ? " cutter" : " cutters");
    data.summary = summary;
    const std::vector<std::uint8_t> sawn = session::untouched_triangles(mesh, on_blank);
    data.picture_png = files::png_bytes(report::draw_part(mesh, {}, {.on_ground = true, .sawn = sawn}));
    data.part = report_part(summary, mesh, std::move(on_blank));
    mesh = {};
    data.rows = report::thin_rows(report_.rows, 4000);
    data.turn = report_.turn(session.setup());
    if (chatter != nullptr) data.chatter = report_chatter(*chatter, session.setup(), parallel_);
    if (sound_) {
        data.sound = sound_->for_report();
        data.sound->waves = report_.waves(session.setup(), sound_->options());
    }
    data.worst = report::worst_lines(report_.rows);
    data.sheet = report_sheet(call_.job, loaded_, session, report_.rows);
    data.facts = facts_of(loaded_, call_.wants("sound") && !call_.as_published);
    if (summary.uncertain_cases) data.facts.push_back(fact_of_cases(summary));
    return files::write_file(folder_.file("report.html"), report::report_html(data));
}

}  // namespace tribo::app
