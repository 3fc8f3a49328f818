// SPDX-License-Identifier: MIT
// Live view of `tribo live` for all clients: mills the part, runs the finger, sends frames and answers
// commands.
#pragma once

#include <chrono>
#include <map>
#include <memory>
#include <optional>

#include "app/live/live_audio.hpp"
#include "app/live/web_files.hpp"
#include "app/render/force_builder.hpp"
#include "devices/servo/servo_thread.hpp"
#include "net/inbox.hpp"
#include "protocol/live_message.hpp"
#include "session/live/frame_cache.hpp"
#include "session/live/live_controller.hpp"

namespace tribo::app {

struct LiveViewOptions {
    protocol::LiveServerInfo info;  // materials, device and the warnings of the job are added here
    protocol::LiveSettings settings;
    contact::JndProfile profile;
    session::LiveForceOptions feel;
    Warnings arm_warnings;
    std::function<Result<session::MillSetup>()> make_setup;  // may be called on any thread
};

class LiveView {
  public:
    // `arm`: null for the simulated hand.
    // `audio`: null without native sound.
    LiveView(session::LiveMill& mill, LiveViewOptions options, std::unique_ptr<haptics::Device> arm,
             std::unique_ptr<LiveAudio> audio);
    ~LiveView();

    net::ServerHandlers handlers(const WebFiles& files);
    // Runs until the user interrupts it.
    void run(net::Server& server);

  private:
    using Clock = std::chrono::steady_clock;

    void answer(const net::Inbox::Event& event, net::Server& server);
    void obey(const net::Inbox::Event& event, net::Server& server);
    void replay(net::ClientId to, net::Server& server);
    void replay_where_asked(net::Server& server);
    void show_changes(net::Server& server);
    Warnings warnings() const;
    std::string files_message() const;
    void show_files(net::Server& server);
    void follow_files();
    void request_forces();
    void collect_forces();
    void show_servo(net::Server& server, const protocol::FrameSink& frames);

    session::LiveMill& mill_;
    LiveViewOptions options_;
    session::LiveController controller_;
    session::LiveFinger& finger_;  // owned by controller_
    protocol::LiveSettings sent_settings_;
    session::FrameCache memory_;
    net::Inbox inbox_;
    // Whom the last replay went to, when, and whether the client asked for another.
    struct Replayed {
        Clock::time_point at;
        bool asked = false;
    };
    std::map<net::ClientId, Replayed> replayed_;
    // The client that holds the finger down, and where: it is lifted when this client goes.
    struct Held {
        net::ClientId by;
        Vec3 at_mm;
    };
    std::optional<Held> held_;
    std::unique_ptr<ForceBuilder> builder_;
    int force_changes_ = 0;       // last requested from the builder
    int sessions_ = 0;            // of the mill, seen last
    std::uint64_t built_of_ = 0;  // key of the cut that the builder mills
    std::string files_told_;      // last message about the files
    std::unique_ptr<LiveAudio> audio_;
    std::unique_ptr<devices::ServoThread> servo_;
    int pictures_ = 0;
    bool arm_gone_ = false;
    std::string trouble_;  // last reported problem of the arm
    std::vector<std::uint8_t> frame_;
};

}  // namespace tribo::app
