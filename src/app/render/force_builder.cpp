// SPDX-License-Identifier: MIT
#include "app/render/force_builder.hpp"

#include <utility>

namespace tribo::app {

ForceBuilder::ForceBuilder(std::function<Result<session::MillSetup>()> make_setup)
    : thread_([this, make = std::move(make_setup)] { work(make); }) {}

ForceBuilder::~ForceBuilder() {
    {
        const std::lock_guard lock(mutex_);
        stop_ = true;
    }
    wake_.notify_one();
    thread_.join();
}

void ForceBuilder::request(const session::CutChange& change, const contact::ForceTableOptions& options) {
    {
        const std::lock_guard lock(mutex_);
        request_ = {change, options};
    }
    wake_.notify_one();
}

ForceBuilder::Built ForceBuilder::take() {
    const std::lock_guard lock(mutex_);
    return std::exchange(built_, {});
}

void ForceBuilder::work(const std::function<Result<session::MillSetup>()>& make_setup) {
    auto setup = make_setup();
    if (!setup) {
        const std::lock_guard lock(mutex_);
        built_.error = setup.error();
        return;
    }
    // One thread: the other threads work for the picture.
    session::ForceLookAhead ahead(*std::move(setup), serial_for);
    const auto has_time = [this] {
        const std::lock_guard lock(mutex_);
        return !stop_;
    };
    if (!ahead.run(has_time)) return;
    auto textures = std::optional(ahead.textures());
    for (;;) {
        std::unique_lock lock(mutex_);
        if (textures) built_.textures = std::exchange(textures, std::nullopt);
        wake_.wait(lock, [this] { return stop_ || request_.has_value(); });
        if (stop_) return;
        const Request request = *std::exchange(request_, std::nullopt);
        lock.unlock();
        auto table = ahead.table(request.change, request.options);
        lock.lock();
        built_.table = std::move(table);
    }
}

}  // namespace tribo::app
