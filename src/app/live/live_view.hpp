// SPDX-License-Identifier: MIT
// Live view of `tribo live` for all clients: mills the part, runs the finger, sends frames and answers
// commands.
#pragma once

#include <deque>
#include <memory>
#include <mutex>

#include "app/live/live_audio.hpp"
#include "app/live/web_files.hpp"
#include "app/render/force_builder.hpp"
#include "devices/servo/servo_thread.hpp"
#include "net/server.hpp"
#include "protocol/live_message.hpp"
#include "session/live/frame_cache.hpp"
#include "session/live/live_controller.hpp"

namespace tribo::app {

// Queue from the server thread to the thread of the live view, which sends all answers.
class LiveInbox {
  public:
    struct Event {
        enum class Kind { connected, overflowed, message } kind;
        net::ClientId client;
        std::string text = {};        // of a message
        net::ResumeInfo resume = {};  // of `connected`
    };
    void put(const Event& event);
    std::deque<Event> take_all();

  private:
    std::mutex mutex_;
    std::deque<Event> events_;
};

struct LiveViewOptions {
    protocol::LiveServerInfo info;  // materials and device are added here
    protocol::LiveSettings settings;
    contact::JndProfile profile;
    session::LiveForceOptions feel;
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
    void answer(const LiveInbox::Event& event, net::Server& server);
    void obey(const LiveInbox::Event& event, net::Server& server);
    void replay(net::ClientId to, net::Server& server);
    void show_changes(net::Server& server);
    void show_input_error(net::Server& server);
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
    LiveInbox inbox_;
    std::unique_ptr<ForceBuilder> builder_;
    int force_changes_ = 0;       // last requested from the builder
    int sessions_ = 0;            // of the mill, seen last
    std::uint64_t built_of_ = 0;  // key of the cut that the builder mills
    std::string input_error_;     // last reported problem of the files
    std::unique_ptr<LiveAudio> audio_;
    std::unique_ptr<devices::ServoThread> servo_;
    int pictures_ = 0;
    bool arm_gone_ = false;
    std::string trouble_;  // last reported problem of the arm
    std::vector<std::uint8_t> frame_;
};

}  // namespace tribo::app
