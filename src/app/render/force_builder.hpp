// SPDX-License-Identifier: MIT
// A thread of its own that mills a job ahead and makes what a hand feels of it, again whenever something
// changes, while the live view goes on.
#pragma once

#include <condition_variable>
#include <functional>
#include <mutex>
#include <optional>
#include <thread>

#include "session/live/force_look_ahead.hpp"

namespace tribo::app {

class ForceBuilder {
  public:
    // `make_setup` is called on the thread.
    explicit ForceBuilder(std::function<Result<session::MillSetup>()> make_setup);
    ~ForceBuilder();
    ForceBuilder(const ForceBuilder&) = delete;
    ForceBuilder& operator=(const ForceBuilder&) = delete;

    // The newest one counts.
    void request(const session::CutChange& change, const contact::ForceTableOptions& options);

    struct Built {
        std::optional<contact::ForceTable> table;
        std::optional<haptics::TextureMap> textures;  // comes once
    };
    // What is new since the last call. Does not wait for the thread's work.
    Built take();

  private:
    struct Request {
        session::CutChange change;
        contact::ForceTableOptions options;
    };
    void work(const std::function<Result<session::MillSetup>()>& make_setup);

    std::mutex mutex_;
    std::condition_variable wake_;
    std::optional<Request> request_;
    Built built_;
    bool stop_ = false;
    std::thread thread_;
};

}  // namespace tribo::app
