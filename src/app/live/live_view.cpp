// SPDX-License-Identifier: MIT
#include "app/live/live_view.hpp"

#include <algorithm>
#include <chrono>
#include <thread>
#include <utility>

#include "app/exit.hpp"
#include "app/interrupt.hpp"
#include "app/live/live_server.hpp"
#include "milling/tool/materials.hpp"

namespace tribo::app {
namespace {

constexpr auto kFrameTime = std::chrono::microseconds(16'667);
// Largest part of the frame time for milling and drawing; the rest is for sending.
constexpr auto kMillingTime = std::chrono::microseconds(13'000);
// If the clock stood still for longer (a sleeping laptop), it advances by this only.
constexpr double kLongestStepS = 0.1;
// Least time between two replays to one client.
constexpr auto kReplayTime = std::chrono::seconds(1);
// Number of pictures between two servo reports.
constexpr int kServoEvery = 15;

net::Bytes shared(std::span<const std::uint8_t> frame) {
    return std::make_shared<const std::vector<std::uint8_t>>(frame.begin(), frame.end());
}

std::array<double, 4> figures_us(const devices::DurationHistogram& h) {
    const auto us = [](std::uint64_t ns) { return 1e-3 * static_cast<double>(ns); };
    return {us(h.quantile_ns(0.5)), us(h.quantile_ns(0.99)), us(h.quantile_ns(0.999)), us(h.max_ns())};
}

}  // namespace

LiveView::LiveView(session::LiveMill& mill, LiveViewOptions options, std::unique_ptr<haptics::Device> arm,
                   std::unique_ptr<LiveAudio> audio)
    : mill_(mill),
      options_(std::move(options)),
      controller_(mill, options_.feel, std::move(arm), options_.settings),
      finger_(controller_.finger()),
      sent_settings_(controller_.settings()),
      audio_(std::move(audio)) {
    for (const milling::WorkpieceMaterial& m : milling::materials())
        options_.info.materials.push_back(m.name);
    options_.info.device = std::string(finger_.limits().name);
    options_.info.max_force_n = finger_.limits().max_force_n;
    options_.info.rate_hz = options_.feel.rate_hz;
    options_.info.arm = finger_.has_arm();
    options_.info.warnings = warnings();
    if (audio_)
        mill_.set_sound_listener([this](session::LiveSoundUpdate news) { audio_->take(std::move(news)); });
    files_told_ = files_message();
    follow_files();
    servo_ = std::make_unique<devices::ServoThread>(devices::ServoThreadOptions{options_.feel.rate_hz},
                                                    [this](double now_s) { return finger_.tick(now_s); });
}

LiveView::~LiveView() {
    servo_.reset();
    mill_.set_sound_listener({});
}

net::ServerHandlers LiveView::handlers(const WebFiles& files) {
    net::ServerHandlers h;
    inbox_.attach(h);
    h.on_get = [&files](std::string_view path, net::AcceptedEncodings accepted) {
        return files.page(path, accepted);
    };
    h.last_words = live_last_words;
    return h;
}

void LiveView::run(net::Server& server) {
    auto before = Clock::now(), next = before;
    const auto frames = [&](std::span<const std::uint8_t> frame) {
        const net::Bytes bytes = shared(frame);
        memory_.take(bytes);
        server.send_all(bytes);
    };
    while (!interrupted()) {
        for (const net::Inbox::Event& event : inbox_.take_all()) answer(event, server);
        show_changes(server);
        replay_where_asked(server);
        const auto now = Clock::now();
        const double dt = std::min(std::chrono::duration<double>(now - before).count(), kLongestStepS);
        before = now;
        const auto has_time = [&] { return Clock::now() - now < kMillingTime && !interrupted(); };
        mill_.tick(dt, has_time, frames);
        if (audio_) audio_->follow(mill_.clock_s(), mill_.speed(), mill_.playing());
        if (sessions_ != mill_.sessions()) {
            show_files(server);
            follow_files();
        }
        collect_forces();
        finger_.show(controller_.scene(), mill_.state().tip_mm, frames);
        if (pictures_++ % kServoEvery == 0) show_servo(server, frames);
        next = std::max(next + kFrameTime, Clock::now());
        std::this_thread::sleep_until(next);
    }
}

// Applies the settings of all messages since the last picture, and tells all clients the newest.
void LiveView::show_changes(net::Server& server) {
    controller_.apply();
    if (force_changes_ != controller_.force_changes()) {
        force_changes_ = controller_.force_changes();
        request_forces();
    }
    if (controller_.settings() == sent_settings_) return;
    sent_settings_ = controller_.settings();
    server.send_text_all(protocol::live_settings(sent_settings_));
}

Warnings LiveView::warnings() const {
    Warnings all = mill_.extras().warnings;
    all.insert(all.end(), options_.arm_warnings.begin(), options_.arm_warnings.end());
    return all;
}

std::string LiveView::files_message() const {
    return protocol::live_files(mill_.input_error(), options_.info.warnings);
}

// Tells what came of the files that were read again.
void LiveView::show_files(net::Server& server) {
    options_.info.warnings = warnings();
    std::string told = files_message();
    if (told == files_told_) return;
    files_told_ = std::move(told);
    if (const std::optional<Error>& error = mill_.input_error()) {
        report(*error);
        std::fprintf(stderr, "the cut before goes on\n");
    } else {
        report(mill_.extras().warnings);
    }
    server.send_text_all(files_told_);
}

// Mills ahead for the hand, again when the files have changed the cut.
void LiveView::follow_files() {
    sessions_ = mill_.sessions();
    const std::uint64_t key = session::bake_key(mill_.session().setup(), {});
    if (builder_ && key == built_of_) return;
    built_of_ = key;
    controller_.set_force({});
    finger_.force_source().set_textures({});
    builder_.reset();  // before the next one: two of them need twice the memory
    builder_ = std::make_unique<ForceBuilder>(options_.make_setup);
    request_forces();
}

void LiveView::request_forces() {
    contact::ForceTableOptions wanted = controller_.table_options();
    wanted.profile = options_.profile;
    builder_->request(mill_.change(), wanted);
}

void LiveView::collect_forces() {
    ForceBuilder::Built built = builder_->take();
    // The files were changed since the mill read them. The next session tries again.
    if (built.error) built_of_ = 0;
    if (built.textures) finger_.force_source().set_textures(*std::move(built.textures));
    if (built.table) controller_.set_force(*std::move(built.table));
}

void LiveView::show_servo(net::Server& server, const protocol::FrameSink& frames) {
    protocol::LiveServo servo = finger_.servo();
    servo.t_s = mill_.clock_s();
    servo.late = static_cast<std::uint32_t>(servo_->late());
    servo.lateness_us = figures_us(servo_->lateness());
    servo.cpu_us = figures_us(servo_->clock().cpu());
    protocol::write_frame(servo, frame_);
    frames(frame_);
    if (std::string trouble = finger_.trouble(); trouble != trouble_) {
        trouble_ = std::move(trouble);
        if (!trouble_.empty()) {
            report(Warnings{{"", 0, trouble_}});
            server.send_text_all(protocol::live_refusal({"", 0, 0, trouble_, ""}));
        }
    }
    if (servo_->running() || std::exchange(arm_gone_, true)) return;
    server.send_text_all(protocol::live_refusal({"", 0, 0, "the arm is gone", "plug it in and start again"}));
}

void LiveView::answer(const net::Inbox::Event& event, net::Server& server) {
    using Kind = net::Inbox::Event::Kind;
    switch (event.kind) {
        case Kind::connected:
            options_.info.resume = event.resume.token;
            options_.info.resumed = event.resume.resumed;
            server.send_text(event.client, protocol::live_server_info(options_.info));
            server.send_text(event.client, protocol::live_settings(controller_.settings()));
            if (mill_.input_error()) server.send_text(event.client, files_told_);
            replay(event.client, server);
            break;
        case Kind::overflowed:
            server.send_text(event.client, protocol::live_lost());
            break;
        case Kind::message:
            obey(event, server);
            break;
        case Kind::disconnected:
            replayed_.erase(event.client);
            if (held_ && held_->by == event.client) {
                finger_.set_pointer(held_->at_mm, false);
                held_.reset();
            }
            break;
    }
}

void LiveView::replay(net::ClientId to, net::Server& server) {
    replayed_[to] = {Clock::now(), false};
    server.replay(to, memory_.replay());
}

void LiveView::replay_where_asked(net::Server& server) {
    for (const auto& [client, replayed] : replayed_) {
        if (replayed.asked && Clock::now() - replayed.at >= kReplayTime) replay(client, server);
    }
}

void LiveView::obey(const net::Inbox::Event& event, net::Server& server) {
    const auto command = protocol::parse_live_command(event.text);
    if (!command) return server.refuse(event.client, protocol::live_refusal(command.error()));
    if (auto obeyed = controller_.obey(*command); !obeyed)
        return server.send_text(event.client, protocol::live_refusal(obeyed.error()));
    if (command->op == protocol::LiveOp::resync) replayed_[event.client].asked = true;
    if (command->op == protocol::LiveOp::finger)
        held_ = command->on ? std::optional<Held>({event.client, command->position_mm}) : std::nullopt;
}

}  // namespace tribo::app
