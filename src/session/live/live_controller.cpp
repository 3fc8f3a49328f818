// SPDX-License-Identifier: MIT
#include "session/live/live_controller.hpp"

#include <tuple>
#include <utility>

#include "milling/tool/materials.hpp"
#include "session/chatter/probability.hpp"
#include "session/uncertain/force_bands.hpp"

namespace tribo::session {
namespace {

// The settings that change the forces of the cut.
auto cut_of(const protocol::LiveSettings& s) {
    return std::tie(s.feed_percent, s.spindle_percent, s.helix_deg, s.material);
}

// Bands and probabilities are of the same cases.
static_assert(protocol::kBandCases == kCases);

}  // namespace

LiveController::LiveController(LiveMill& mill, const LiveForceOptions& options,
                               std::unique_ptr<haptics::Device> arm, protocol::LiveSettings settings)
    : mill_(mill),
      job_settings_(std::move(settings)),
      settings_(job_settings_),
      applied_(settings_),
      finger_(options, std::move(arm), mill.session().stock().blank().bounds_mm().max) {
    follow_job();
    if (settings_.cases) mill_.set_change(change());
    mill_.set_session_observer([this](MillSession* session) { finger_.force_source().set_session(session); });
}

LiveController::~LiveController() {
    mill_.set_session_observer({});
    finger_.force_source().set_session(nullptr);
}

LiveScene LiveController::scene() const {
    LiveScene s;
    s.program_s = mill_.clock_s();
    s.pace = mill_.pace();
    s.cut_mode = settings_.cut_mode;
    s.cutting_force = settings_.cutting_force;
    s.stopped = settings_.stopped;
    return s;
}

Result<void> LiveController::obey(const protocol::LiveCommand& command) {
    using protocol::LiveOp;
    protocol::LiveSettings wanted = settings_;
    switch (command.op) {
        case LiveOp::play:
        case LiveOp::pause:
            mill_.play(command.op == LiveOp::play);
            break;
        case LiveOp::speed:
            mill_.set_speed(command.value);
            break;
        case LiveOp::seek:
            mill_.set_clock(command.value);
            break;
        case LiveOp::resync:
            break;
        case LiveOp::finger:
            finger_.set_pointer(command.position_mm, command.on);
            break;
        case LiveOp::mode:
            wanted.cut_mode = command.word == "cut";
            break;
        case LiveOp::force:
            wanted.cutting_force = command.on;
            break;
        case LiveOp::cases:
            wanted.cases = command.on;
            break;
        case LiveOp::stop:
        case LiveOp::release:
            wanted.stopped = command.op == LiveOp::stop;
            break;
        case LiveOp::set:
            for (const protocol::LiveNumber& n : protocol::kLiveNumbers) {
                if (n.key == command.word) wanted.*n.member = command.value;
            }
            break;
        case LiveOp::material:
            if (command.word != job_settings_.material) {
                const auto known = milling::find_material(command.word);
                if (!known) return std::unexpected(known.error());
            }
            wanted.material = command.word;
            break;
    }
    settings_ = wanted;
    // Immediately, not only with the next picture.
    if (settings_.stopped) finger_.stop(scene());
    return {};
}

void LiveController::follow_job() {
    if (sessions_ == mill_.sessions()) return;
    sessions_ = mill_.sessions();
    const auto follow = [this]<class Value>(Value protocol::LiveSettings::* setting, const Value& of_job) {
        for (protocol::LiveSettings* followed : {&settings_, &applied_}) {
            if (followed->*setting == job_settings_.*setting) followed->*setting = of_job;
        }
        job_settings_.*setting = of_job;
    };
    follow(&protocol::LiveSettings::helix_deg, mill_.session().setup().cutters.front().helix_deg);
    follow(&protocol::LiveSettings::material, mill_.extras().material);
    follow(&protocol::LiveSettings::has_spread, session::has_spread(mill_.session().setup()));
}

void LiveController::apply() {
    follow_job();
    const bool recut = cut_of(settings_) != cut_of(applied_);
    const bool rescaled = settings_.force_scale != applied_.force_scale || settings_.jnd != applied_.jnd;
    const bool bands_anew = settings_.cases != applied_.cases;
    applied_ = settings_;
    if (recut || bands_anew) mill_.set_change(change());
    if (recut || rescaled) ++force_changes_;
    if (rescaled) use_force();
}

CutChange LiveController::change() const {
    CutChange change;
    change.feed_factor = 0.01 * settings_.feed_percent;
    change.speed_factor = 0.01 * settings_.spindle_percent;
    if (settings_.helix_deg != job_settings_.helix_deg) change.helix_deg = settings_.helix_deg;
    if (settings_.material != job_settings_.material) {
        const auto material = milling::find_material(settings_.material);
        change.coefficients = material->coefficients;
        change.force_low_factor = material->spread_low;
        change.force_high_factor = material->spread_high;
    }
    if (settings_.cases) change.uncertain_cases = settings_.case_count;
    return change;
}

contact::ForceTableOptions LiveController::table_options() const {
    contact::ForceTableOptions options;
    options.hand_per_tool = settings_.force_scale;
    options.most_jnd = settings_.jnd;
    return options;
}

void LiveController::set_force(contact::ForceTable table) {
    table_ = std::move(table);
    use_force();
}

void LiveController::use_force() {
    haptics::ForceScaling scaling;
    scaling.gain = settings_.force_scale;
    scaling.limit_n = finger_.limits().max_force_n;
    finger_.force_source().set_force(table_, scaling);
}

}  // namespace tribo::session
