// SPDX-License-Identifier: MIT
// What `tribo live` shows to everybody who watches: the part while it is milled, the finger and what it
// feels, and the answers to what pages ask for.
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
#include "session/live/live_finger.hpp"
#include "session/live/live_memory.hpp"
#include "session/live/live_mill.hpp"

namespace tribo::app {

// From the server's thread to the show's, which alone answers.
class LiveInbox {
  public:
    struct Event {
        enum class Kind { came, lost, message } kind;
        net::ClientId client;
        std::string text = {};      // of a message
        net::Arrival arrival = {};  // of one who came
    };
    void put(const Event& event);
    std::deque<Event> take_all();

  private:
    std::mutex mutex_;
    std::deque<Event> events_;
};

struct LiveShowOptions {
    protocol::LiveServerInfo info;  // materials and device are added here
    protocol::LiveSettings settings;
    contact::JndProfile profile;
    session::LiveFeelOptions feel;
    std::function<Result<session::MillSetup>()> make_setup;  // on any thread
};

class LiveShow {
  public:
    // `arm`: null for the simulated hand.
    // `audio`: null where the engine does not sound.
    LiveShow(session::LiveMill& mill, LiveShowOptions options, std::unique_ptr<haptics::Device> arm,
             std::unique_ptr<LiveAudio> audio);
    ~LiveShow();

    net::ServerHandlers handlers(const WebFiles& files);
    // Until the user ends it.
    Result<void> run(net::Server& server);

  private:
    void answer(const LiveInbox::Event& event, net::Server& server);
    Result<void> obey(const protocol::LiveCommand& command, net::ClientId from, net::Server& server);
    void replay(net::ClientId to, net::Server& server);
    Result<void> recut(const protocol::LiveSettings& wanted);
    void ask_for_force();
    void use_force();
    void take_built();
    void show_servo(net::Server& server, const protocol::FrameSink& frames);
    session::LiveScene scene() const;

    session::LiveMill& mill_;
    LiveShowOptions options_;
    protocol::LiveSettings settings_, told_;
    session::LiveMemory memory_;
    LiveInbox inbox_;
    session::LiveFinger finger_;
    ForceBuilder builder_;
    contact::ForceTable table_;
    std::unique_ptr<LiveAudio> audio_;
    std::unique_ptr<devices::ServoThread> servo_;
    int pictures_ = 0;
    bool arm_gone_ = false;
    std::string trouble_;  // of the arm, as it was last told
    std::vector<std::uint8_t> frame_;
};

}  // namespace tribo::app
