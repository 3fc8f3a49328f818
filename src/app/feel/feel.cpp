// SPDX-License-Identifier: MIT
#include "app/feel/feel.hpp"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <memory>
#include <thread>
#include <utility>
#include <vector>

#include "app/exit.hpp"
#include "app/feel/feel_source.hpp"
#include "app/interrupt.hpp"
#include "app/outputs.hpp"
#include "app/progress.hpp"
#include "app/render/render_job.hpp"
#include "base/text/decimal.hpp"
#include "base/text/printable.hpp"
#include "devices/arm/device_search.hpp"
#include "devices/arm/force_plugin.hpp"
#include "devices/servo/servo_thread.hpp"
#include "field/mesh/mesh_field.hpp"
#include "files/disk_source.hpp"
#include "files/files.hpp"
#include "files/machine_limits.hpp"
#include "files/model/model_file.hpp"
#include "haptics/servo/simulated_hand.hpp"
#include "job/loader.hpp"
#include "readers/mesh/model.hpp"
#include "readers/tables/feel_trace_csv.hpp"
#include "readers/tables/stroke_csv.hpp"
#include "report/feel_stats_json.hpp"
#include "session/chatter/surface_recorder.hpp"
#include "session/feel/feel_session.hpp"
#include "session/feel/vibration_track.hpp"
#include "session/live/live_mill.hpp"

namespace tribo::app {
namespace {

// Limit for the memory of a run: each tick needs a row of the trace and its text.
constexpr double kMostTicks = 20e6;
// With a real clock, the part in cut mode is milled at this interval.
constexpr std::chrono::milliseconds kMillEvery{5};
// Drivers and firmware let an arm go 5 ms after a force. With ticks of 4 ms one may be a little late.
constexpr double kLeastArmRateHz = 250;

report::DurationFigures figures_of(const devices::DurationHistogram& histogram) {
    const auto us = [](std::uint64_t ns) { return 1e-3 * static_cast<double>(ns); };
    return {us(histogram.quantile_ns(0.5)), us(histogram.quantile_ns(0.99)), us(histogram.quantile_ns(0.999)),
            us(histogram.max_ns())};
}

FileResult<haptics::Stroke> read_stroke(const FeelCall& call) {
    const auto bytes = files::read_file(call.stroke);
    if (!bytes) return std::unexpected(bytes.error());
    const auto points = readers::read_probe_stroke(*bytes, {call.stroke});
    if (!points) return std::unexpected(FileFailure(points.error()));
    const double seconds = points->back().t_s - points->front().t_s;
    if (seconds * call.rate_hz > kMostTicks) {
        return std::unexpected(FileFailure(
            {call.stroke, 0, 0, "the stroke is too long for this rate", "lower --rate or split the stroke"}));
    }
    std::vector<haptics::StrokePoint> stroke;
    for (const readers::ProbePoint& p : *points) stroke.push_back({p.t_s, p.position_mm});
    return haptics::Stroke(std::move(stroke));
}

std::unique_ptr<haptics::Device> simulated_hand(const FeelCall& call, haptics::Stroke stroke) {
    auto hand = std::make_unique<haptics::SimulatedHand>(std::move(stroke), 1 / call.rate_hz);
    const auto ticks = static_cast<int>(std::round(call.arm.delay_s() * call.rate_hz));
    if (ticks == 0) return hand;
    return std::make_unique<haptics::DelayedHand>(std::move(hand), ticks);
}

Result<std::unique_ptr<haptics::Device>> open_device(const FeelCall& call, haptics::Stroke stroke,
                                                     const Box3& blank) {
    if (call.device == "playback")
        return std::make_unique<haptics::PlaybackHand>(std::move(stroke), 1 / call.rate_hz);
    if (call.device == "simulated") return simulated_hand(call, std::move(stroke));
    return devices::open_arm(call.device, mounting(call.arm, blank));
}

// Runs the servo over a whole stroke and keeps its results.
class Run {
  public:
    Run(haptics::Device& device, haptics::ForceSource& source, const haptics::SafetyLimits& limits,
        double start_s, double end_s, double rate_hz, double delay_s)
        : servo_(device, source, limits, delay_s),
          start_s_(start_s),
          rate_hz_(rate_hz),
          count_(static_cast<std::size_t>(std::floor((end_s - start_s) * rate_hz + 1e-6)) + 1) {
        trace_.resize(count_);
    }

    // Runs tick after tick without waiting; time is counted, not measured.
    bool count_through(FeelSource& felt, report::FeelStats& stats) {
        devices::TickClock clock;
        Progress progress;
        while (done_ < count_) {
            const double now_s = static_cast<double>(done_) / rate_hz_;
            felt.mill_to(now_s);
            clock.begin();
            const haptics::ServoTick tick = servo_.tick(now_s);
            clock.end();
            keep(tick);
            constexpr std::size_t look = 4096;
            if (done_ % look != 0) continue;
            if (interrupted()) return false;
            progress.update("feeling", static_cast<double>(done_) / static_cast<double>(count_));
        }
        const auto period_ns = static_cast<std::uint64_t>(1e9 / rate_hz_);
        stats.late = clock.wall().count_above(period_ns);
        take(clock, stats);
        return true;
    }

    // Runs with a real clock on a separate thread.
    bool run_in_time(FeelSource& felt, report::FeelStats& stats) {
        std::atomic<double> clock_s = 0;
        std::atomic<bool> over = false;
        devices::ServoThread thread({rate_hz_}, [&](double now_s) {
            clock_s.store(now_s, std::memory_order_relaxed);
            keep(servo_.tick(now_s));
            return done_ < count_ && servo_.is_device_connected() && !interrupted();
        });
        std::thread miller;
        if (felt.mills_in_time()) {
            miller = std::thread([&] {
                while (!over.load(std::memory_order_relaxed)) {
                    felt.mill_to(clock_s.load(std::memory_order_relaxed));
                    std::this_thread::sleep_for(kMillEvery);
                }
            });
        }
        thread.join();
        over = true;
        if (miller.joinable()) miller.join();
        stats.late = thread.late();
        stats.lateness = figures_of(thread.lateness());
        for (const std::string& note : {thread.problems().real_time, thread.problems().memory}) {
            if (!note.empty()) stats.notes.push_back(note);
        }
        take(thread.clock(), stats);
        trace_.resize(done_);
        return !interrupted();
    }

    const std::vector<readers::FeelTraceRow>& trace() const { return trace_; }
    bool is_device_connected() const { return servo_.is_device_connected(); }

  private:
    void keep(const haptics::ServoTick& tick) noexcept {
        trace_[done_++] = {start_s_ + tick.now_s, tick.position_mm, tick.force_n, tick.touching};
    }
    void take(const devices::TickClock& clock, report::FeelStats& stats) const {
        stats.ticks = servo_.ticks();
        stats.rate_hz = rate_hz_;
        stats.cpu = figures_of(clock.cpu());
        stats.wall = figures_of(clock.wall());
        stats.empty_cpu = figures_of(clock.empty_cpu());
        stats.empty_wall = figures_of(clock.empty_wall());
        stats.max_force_n = servo_.max_force_n();
        stats.lowest_energy_nmm = servo_.passivity().lowest_energy_nmm();
        for (int n = 1; n < haptics::kFaultKinds; ++n) {
            const auto fault = static_cast<haptics::Fault>(n);
            const std::uint32_t count = servo_.safety().count(fault);
            if (count > 0) stats.faults.push_back({haptics::name(fault), count});
        }
    }

    haptics::Servo servo_;
    double start_s_, rate_hz_;
    std::size_t count_, done_ = 0;
    std::vector<readers::FeelTraceRow> trace_;
};

// The object to feel: a job that is milled, or a model.
struct Part {
    job::Job job;
    std::optional<session::MillSetup> setup, in_time;
    std::unique_ptr<const field::MeshField> surface;
    Box3 bounds_mm;
    Warnings warnings;
};

struct GivenFlag {
    const char* flag;
    bool is_given;
};

std::vector<GivenFlag> flags_of_a_cut(const FeelCall& call) {
    return {{"--texture", !call.texture},
            {"--scaling", call.compressive},
            {"--profile", !call.profile.empty()},
            {"--bake", !call.bake.empty()}};
}

FileResult<void> read_model(const FeelCall& call, Part& part) {
    const auto refuse = [&](std::string cause, std::string remedy) {
        return std::unexpected(FileFailure({call.job, 0, 0, std::move(cause), std::move(remedy)}));
    };
    if (call.mode == "cut") return refuse("a model has no cut to feel", "give a job, or --mode inspect");
    if (auto good = refuse_flags(call.program, call.job, "this is a model", "leave the flag out"); !good)
        return std::unexpected(FileFailure(good.error()));
    std::vector<GivenFlag> of_a_job = flags_of_a_cut(call);
    of_a_job.push_back({"--resolution", call.resolution_mm.has_value()});
    of_a_job.push_back({"--until", call.until_s.has_value()});
    for (const auto& [flag, is_given] : of_a_job) {
        if (is_given)
            return refuse(std::string(flag) + " belongs to a cut, and this is a model", "leave the flag out");
    }
    auto model = files::read_model_file({call.job, call.unit_mm});
    if (!model) return std::unexpected(model.error());
    part.warnings = std::move(model->warnings);
    for (Point3f& p : model->mesh.positions) {
        for (float& v : p) v = static_cast<float>(call.scale * static_cast<double>(v));
    }
    auto surface = field::MeshField::make(std::move(model->mesh));
    if (!surface) return refuse(surface.error().cause, surface.error().remedy);
    part.bounds_mm = (*surface)->bounds_mm();
    if ((*surface)->is_sheet()) {
        char text[160];
        std::snprintf(text, sizeof text,
                      "%s open: its front is where its normals point, its back %g mm behind",
                      (*surface)->is_solid() ? "some of the surface is" : "the surface is",
                      field::MeshField::kThicknessMm);
        part.warnings.push_back({call.job, 0, text});
    }
    if (const double skin_mm = (*surface)->skin_mm(); skin_mm > 0) {
        char text[200];
        std::snprintf(
            text, sizeof text,
            "%s, so no side is the outside: the surface is felt from both sides, as a skin of %.3g mm",
            (*surface)->is_two_sided() ? "the surface is there with both sides"
                                       : "some triangles are turned over",
            skin_mm);
        part.warnings.push_back({call.job, 0, text});
    }
    part.surface = std::move(*surface);
    return {};
}

FileResult<void> read_job(const FeelCall& call, Part& part) {
    if (call.unit_mm || call.scale != 1) {
        return std::unexpected(FileFailure({call.job, 0, 0, "a job says the unit of its models itself",
                                            "set 'unit_mm' in the job, or give a model"}));
    }
    const job::LoadOptions limits = files::machine_limits();
    auto loaded = load_job(call.job, call.program, limits);
    if (!loaded) return std::unexpected(loaded.error());
    part.warnings = std::move(loaded->warnings);
    session::MillOptions options{call.resolution_mm, call.until_s};
    options.memory_bytes = limits.memory_bytes;
    auto setup = session::prepare_mill(*loaded, options, part.warnings);
    if (!setup) return std::unexpected(FileFailure(setup.error()));
    RunOutputs made;
    if (loaded->job.can_vibrate()) {
        made.chatter_bytes = call.mode == "cut"
                                 ? session::VibrationTrack::bytes(call.rate_hz, setup->schedule->duration_s)
                                 : session::SurfaceRecorder::estimated_bytes(*setup);
    }
    if (auto fits = check_memory(call.job, *setup, loaded->part, made); !fits)
        return std::unexpected(FileFailure(fits.error()));
    part.bounds_mm = setup->blank->bounds_mm();
    part.setup = std::move(*setup);
    if (call.mode == "cut") {
        Warnings said_before;
        options.longest_piece_mm = session::LiveMill::kPieceMm;
        auto in_pieces = session::prepare_mill(*loaded, options, said_before);
        if (!in_pieces) return std::unexpected(FileFailure(in_pieces.error()));
        part.in_time = std::move(*in_pieces);
    }
    if (auto written = write_job_out(call.program, *loaded, {call.out, call.stats, call.bake}); !written)
        return written;
    part.job = std::move(loaded->job);
    return {};
}

FileResult<void> write_trace(const std::string& path, const std::vector<readers::FeelTraceRow>& trace) {
    auto file = files::FileWriter::create(path);
    if (!file) return std::unexpected(file.error());
    std::string text(readers::feel_trace_header);
    for (const readers::FeelTraceRow& row : trace) {
        readers::append_feel_trace_row(text, row);
        constexpr std::size_t chunk = 1 << 16;
        if (text.size() < chunk) continue;
        file->write(text);
        text.clear();
    }
    file->write(text);
    return file->finish();
}

void print(const report::FeelStats& s, const Box3& part_mm, const std::vector<readers::FeelTraceRow>& trace,
           const std::string& out) {
    const auto place = [](Vec3 p) {
        return '(' + format_digits(p.x, 5) + ", " + format_digits(p.y, 5) + ", " + format_digits(p.z, 5) +
               ')';
    };
    std::printf("%-16s from %s to %s mm\n", "part", place(part_mm.min).c_str(), place(part_mm.max).c_str());
    std::size_t touching = 0;
    for (const readers::FeelTraceRow& row : trace) touching += row.contact ? 1 : 0;
    std::printf("%-16s %llu at %g Hz, %zu in contact\n", "ticks", static_cast<unsigned long long>(s.ticks),
                s.rate_hz, touching);
    std::printf("%-16s at most %.3f N\n", "force", s.max_force_n);
    std::printf("%-16s median %.2f us, 99.9 %% within %.2f us, %llu late\n", "tick", s.cpu.p50_us,
                s.cpu.p999_us, static_cast<unsigned long long>(s.late));
    for (const report::FeelStats::FaultCount& f : s.faults)
        std::printf("%-16s %s, %u times\n", "fault", f.name.c_str(), f.count);
    for (const std::string& note : s.notes) std::printf("%-16s %s\n", "note", note.c_str());
    std::printf("%-16s %s\n", "trace", printable(out).c_str());
}

}  // namespace

int feel(const FeelCall& call) {
    if (auto good = check_bake_file(call.bake); !good) return report(good.error());
    auto stroke = read_stroke(call);
    if (!stroke) return report(stroke.error());
    const double start_s = stroke->start_s(), end_s = stroke->end_s();
    if (call.friction_kinetic.value_or(0) > call.friction_static.value_or(1e9)) {
        return report(Error{call.job, 0, 0, "--friction-kinetic is above --friction", "exchange them"});
    }
    std::unique_ptr<devices::ForcePlugin> plugin;
    if (!call.source.empty()) {
        auto opened = devices::ForcePlugin::open(call.source, call.rate_hz);
        if (!opened) return report(opened.error());
        plugin = std::move(*opened);
    }
    Part part;
    if (auto read = readers::model_format_of_name(call.job) ? read_model(call, part) : read_job(call, part);
        !read)
        return report(read.error());
    if (call.probe_mm == 0 && part.job.haptics.probe == job::ProbeKind::cylinder) {
        return report(Error{call.job, 0, 0, "--probe-mm 0 is a point, and probe = \"cylinder\" a finger",
                            "give its radius, or leave the flag out for one of 8 mm"});
    }
    const std::string& profile = call.profile.empty() ? part.job.haptics.profile : call.profile;
    if (const auto checked = check_outputs({call.out, call.stats, call.bake}, {profile, call.source});
        !checked) {
        return report(checked.error());
    }
    auto device = open_device(call, std::move(*stroke), part.bounds_mm);
    if (!device) {
        report(device.error());
        return kRefused;
    }
    const auto asked =
        call.stiffness_n_per_mm ? call.stiffness_n_per_mm : part.job.haptics.stiffness_n_per_mm;
    const double surface_n_per_mm =
        stable_stiffness(asked, (*device)->limits(), call.rate_hz, call.arm, call.job, part.warnings);
    if (!(*device)->has_motors() && (!call.arm.at_mm.empty() || call.arm.scale != 1)) {
        const char* flag = call.arm.at_mm.empty() ? "--arm-scale" : "--arm-at";
        part.warnings.push_back(
            {call.job, 0, std::string(flag) + " says nothing without an arm: name one by --device"});
    }
    for (const auto& [flag, is_given] : flags_of_a_cut(call)) {
        if (call.mode != "cut" && is_given)
            part.warnings.push_back({call.job, 0, std::string(flag) + " says nothing without --mode cut"});
    }
    if ((*device)->has_motors() && call.rate_hz < kLeastArmRateHz) {
        part.warnings.push_back({call.job, 0,
                                 "--rate " + format_digits(call.rate_hz, 4) +
                                     " chops the force: an arm lets go 5 ms after each; take " +
                                     format_digits(kLeastArmRateHz, 4) + " or more"});
    }
    report(part.warnings);
    FeelSource felt(call, part.job, surface_n_per_mm, start_s, (*device)->limits());
    if (part.surface) {
        felt.make(std::move(part.surface));
    } else if (auto made = felt.make(std::move(*part.setup), std::move(part.in_time)); !made) {
        return report(made.error());
    }
    if (interrupted()) return interrupted_exit_code();
    if (plugin) plugin->set_inner(felt.source());
    report::FeelStats stats;
    stats.version = TRIBO_VERSION;
    stats.device = call.device;
    stats.mode = call.mode;
    Run run(**device, plugin ? *plugin : felt.source(), session::safety_limits(**device, call.rate_hz),
            start_s, end_s, call.rate_hz, call.arm.delay_s());
    const bool by_clock = call.real_time || (*device)->has_motors();
    if (!(by_clock ? run.run_in_time(felt, stats) : run.count_through(felt, stats)))
        return interrupted_exit_code();
    const std::string trouble = (*device)->trouble();
    if (!trouble.empty()) stats.notes.push_back(trouble);
    if (plugin && !plugin->trouble().empty()) stats.notes.push_back(plugin->trouble());
    stats.table = felt.table_figures();
    if (auto done = write_trace(call.out, run.trace()); !done) return report(done.error());
    if (!call.stats.empty()) {
        if (auto done = files::write_file(call.stats, report::feel_stats_json(stats)); !done)
            return report(done.error());
    }
    print(stats, part.bounds_mm, run.trace(), call.out);
    felt.print();
    if (run.is_device_connected()) return kDone;
    report(Error{"", 0, 0, trouble.empty() ? "the arm is gone" : trouble, ""});
    return kRefused;
}

}  // namespace tribo::app
