// SPDX-License-Identifier: MIT
// Reads the files of a live job again on a thread of its own. The picture goes on meanwhile.
#pragma once

#include <chrono>
#include <functional>
#include <future>
#include <optional>

#include "session/live/live_mill.hpp"

namespace tribo::app {

class InputReader {
  public:
    // `read` is called on another thread. The destructor waits for its end.
    explicit InputReader(std::function<Result<session::LiveInput>()> read) : read_(std::move(read)) {}

    // Begins to read unless a thread reads already. Returns what was read once it is there. Does not wait.
    std::optional<Result<session::LiveInput>> poll() {
        if (!reading_.valid()) reading_ = std::async(std::launch::async, read_);
        if (reading_.wait_for(std::chrono::seconds(0)) != std::future_status::ready) return std::nullopt;
        return reading_.get();
    }

  private:
    std::function<Result<session::LiveInput>()> read_;
    std::future<Result<session::LiveInput>> reading_;
};

}  // namespace tribo::app
