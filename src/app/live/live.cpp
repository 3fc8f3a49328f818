// SPDX-License-Identifier: MIT
#include "app/live/live.hpp"

#include <algorithm>
#include <cstdio>
#include <mutex>

#include "app/exit.hpp"
#include "app/interrupt.hpp"
#include "app/live/input_reader.hpp"
#include "app/live/live_server.hpp"
#include "app/live/live_view.hpp"
#include "app/render/render_job.hpp"
#include "app/uncertain_flag.hpp"
#include "devices/arm/device_search.hpp"
#include "files/disk_source.hpp"
#include "files/files.hpp"
#include "job/job_files.hpp"
#include "job/program_file.hpp"
#include "job/toml/jnd_profile_toml.hpp"
#include "session/uncertain/force_bands.hpp"
#include "tribo/threads.hpp"

namespace tribo::app {
namespace {

// Opens the requested arm. Returns null for the simulated hand, also if "auto" finds no arm.
Result<std::unique_ptr<haptics::Device>> open_device(const LiveCall& call, const Box3& blank) {
    if (call.device == "simulated") return nullptr;
    auto arm = devices::open_arm(call.device, mounting(call.arm, blank));
    if (!arm && call.device == "auto") return nullptr;
    return arm;
}

// Reads the job and refuses what does not fit into memory. A program that reads its files again refuses
// pipes.
FileResult<PreparedJob> read_job(const LiveCall& call, std::optional<int> sound_rate_hz) {
    const session::MillOptions options{call.resolution_mm, {}, session::LiveMill::kPieceMm};
    auto read = prepare_job(call.job, call.program, options, sound_rate_hz, files::Pipes::refuse);
    if (!read) return read;
    // The part is milled for the picture, and ahead of it for the hand.
    const RunOutputs made{.mesh = true, .sound = sound_rate_hz.has_value(), .sessions = 2, .states = true};
    if (auto fits = check_memory(call.job, read->setup, read->part, made, call.memory_mb); !fits)
        return std::unexpected(FileFailure(fits.error()));
    return read;
}

session::LiveInput live_input(PreparedJob job) {
    session::LiveExtras extras;
    extras.listening = job::listening_to(job.job, job.setup.blank->bounds_mm());
    if (job.part) extras.designed = std::make_shared<const TriangleMesh>(std::move(job.part->mesh));
    extras.material = job.material.name;
    extras.program = {job.job.path.file, job::shown_program(files::DiskSource(), job.job)};
    extras.warnings = std::move(job.warnings);
    return {std::move(job.setup), std::move(extras)};
}

LiveViewOptions show_options(const LiveCall& call, const PreparedJob& loaded,
                             const contact::JndProfile& profile, const haptics::DeviceLimits& limits) {
    LiveViewOptions options;
    options.info.version = TRIBO_VERSION;
    options.info.job = call.job;
    options.profile = profile;
    options.settings.force_scale = loaded.job.haptics.force_scale;
    options.settings.jnd = contact::ForceTableOptions{}.most_jnd;
    options.settings.cases = call.uncertain.has_value();
    if (call.uncertain) options.settings.case_count = static_cast<std::size_t>(*call.uncertain);
    const job::JobHaptics& h = loaded.job.haptics;
    haptics::ContactOptions& contact = options.feel.contact;
    options.feel.delay_s = call.arm.delay_s();
    contact.stiffness_n_per_mm = stable_stiffness(h.stiffness_n_per_mm, limits, options.feel.rate_hz,
                                                  call.arm, call.job, options.arm_warnings);
    report(options.arm_warnings);
    contact.friction_kinetic = h.friction_kinetic.value_or(0);
    contact.friction_static = std::max(h.friction_static.value_or(0), contact.friction_kinetic);
    return options;
}

// How the files of a job looked, for two threads.
class Stamps {
  public:
    void set(files::FileStamps stamps) {
        const std::lock_guard lock(mutex_);
        stamps_ = std::move(stamps);
    }
    bool have_changed() const {
        const std::lock_guard lock(mutex_);
        return files::have_changed(stamps_);
    }

  private:
    mutable std::mutex mutex_;
    files::FileStamps stamps_;
};

}  // namespace

int live(const LiveCall& call) {
    if (call.job.empty()) {
        if (auto good = refuse_flags(call.program, "", "none is named", "name the program"); !good)
            return report(good.error());
        if (call.uncertain)
            return report(fail("--uncertain is given, but no job is named", "name the job").error());
        return live_without_job(call);
    }
    const bool sounds = call.audio == "native";
    auto first =
        read_job(call, sounds ? std::optional(sound::SoundtrackOptions().sample_rate_hz) : std::nullopt);
    if (!first) return report(first.error());
    if (auto spread = check_uncertain(call.job, call.uncertain, session::has_spread(first->setup)); !spread)
        return report(spread.error());
    report(first->warnings);

    const auto files = live_page(call);
    if (!files) return report(files.error());

    contact::JndProfile profile;
    if (const std::string& file = first->job.haptics.profile; !file.empty()) {
        const auto read = job::read_jnd_profile(files::DiskSource(), file);
        if (!read) return report(job::at_key(first->job, read.error()));
        profile = *read;
    }
    auto arm = open_device(call, first->setup.blank->bounds_mm());
    if (!arm) {
        report(arm.error());
        return kRefused;
    }
    LiveViewOptions show_how =
        show_options(call, *first, profile, *arm ? (*arm)->limits() : haptics::kSimulatedLimits);

    std::unique_ptr<LiveAudio> audio;
    show_how.info.audio = call.audio;
    if (sounds) {
        auto opened = LiveAudio::open(first->track);
        if (opened) {
            audio = *std::move(opened);
            std::printf("sound: %s\n", audio->device().c_str());
        } else {
            report(Warnings{{"", 0, opened.error().cause + "; the page sounds instead"}});
            show_how.info.audio = "browser";
        }
    }

    // When the clock is set back, the program begins again from the current files.
    LiveCall again = call;
    again.program.job_out.clear();
    const auto load_again = [again]() -> Result<session::LiveInput> {
        auto read = read_job(again, {});
        if (!read) return std::unexpected(Error(read.error()));
        return live_input(*std::move(read));
    };
    // Of the files of the newest input, also of one that failed.
    Stamps stamps;
    stamps.set(files::stamps_of_files_read());
    const auto reload = [load_again, &stamps] {
        auto input = load_again();
        stamps.set(files::stamps_of_files_read());
        return input;
    };
    show_how.make_setup = [load_again]() -> Result<session::MillSetup> {
        auto input = load_again();
        if (!input) return std::unexpected(input.error());
        return std::move(input->setup);
    };
    std::optional<session::LiveInput> ready = live_input(*std::move(first));
    const auto make_input = [&ready, reader = std::make_shared<InputReader>(reload)] {
        return ready ? std::optional(Result<session::LiveInput>(*std::exchange(ready, std::nullopt)))
                     : reader->poll();
    };
    auto mill = session::LiveMill::create(
        make_input, parallel_for_over(call.threads > 0 ? call.threads : available_threads()),
        [&stamps] { return stamps.have_changed(); });
    if (!mill) return report(mill.error());

    LiveView show(**mill, std::move(show_how), *std::move(arm), std::move(audio));
    int exit_code = kDone;
    auto server = open_live_server(call, call.job, show.handlers(*files), exit_code);
    if (!server) return exit_code;
    show.run(*server);
    server.reset();
    return interrupted_exit_code();
}

}  // namespace tribo::app
