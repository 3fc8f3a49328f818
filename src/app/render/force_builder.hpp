// SPDX-License-Identifier: MIT
// A separate thread that mills a job ahead of the live view and makes its force table and textures. It makes
// the table again after each change.
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
    // `make_setup` is called on this thread.
    explicit ForceBuilder(std::function<Result<session::MillSetup>()> make_setup);
    ~ForceBuilder();
    ForceBuilder(const ForceBuilder&) = delete;
    ForceBuilder& operator=(const ForceBuilder&) = delete;

    // Only the newest request is processed.
    void request(const session::CutChange& change, const contact::ForceTableOptions& options);

    struct Built {
        std::optional<contact::ForceTable> table;
        std::optional<haptics::TextureMap> textures;  // set once
        std::optional<Error> error;                   // no setup: nothing else will follow
    };
    // Results since the last call. Does not wait.
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
