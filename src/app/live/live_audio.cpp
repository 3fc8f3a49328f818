// SPDX-License-Identifier: MIT
#include "app/live/live_audio.hpp"

#include <array>
#include <chrono>
#include <utility>

namespace tribo::app {
namespace {

constexpr std::size_t kBlockFrames = 128;
// Interval at which the thread checks whether the device has taken samples.
constexpr auto kLook = std::chrono::milliseconds(2);

}  // namespace

Result<std::unique_ptr<LiveAudio>> LiveAudio::open(const sound::SoundtrackOptions& options) {
    std::unique_ptr<LiveAudio> audio(new LiveAudio(options));
    devices::AudioOutOptions how;
    how.sample_rate_hz = options.sample_rate_hz;
    auto out = devices::AudioOut::open(
        how, [queue = &audio->queue_](std::span<float> interleaved) { queue->take(interleaved); });
    if (!out) return std::unexpected(out.error());
    audio->out_ = *std::move(out);
    audio->thread_ = std::thread([self = audio.get()] { self->work(); });
    return audio;
}

LiveAudio::~LiveAudio() {
    {
        const std::lock_guard lock(mutex_);
        stop_ = true;
    }
    wake_.notify_one();
    if (thread_.joinable()) thread_.join();
    out_.reset();
}

void LiveAudio::take(session::LiveSoundUpdate news) {
    const std::lock_guard lock(mutex_);
    news_.push_back(std::move(news));
}

void LiveAudio::follow(double t_s, double speed, bool playing) {
    const std::lock_guard lock(mutex_);
    clock_ = {t_s, speed, playing, true};
}

void LiveAudio::work() {
    std::array<float, 2 * kBlockFrames> block;
    std::unique_lock lock(mutex_);
    while (!stop_) {
        const auto all_news = std::exchange(news_, {});
        const Clock clock = std::exchange(clock_, {});
        lock.unlock();
        for (const session::LiveSoundUpdate& news : all_news)
            std::visit([this](const auto& told) { sound_.take(told); }, news);
        const double lead_s =
            static_cast<double>(queue_.frames()) / sound_.sample_rate_hz() + out_->latency_s();
        if (clock.fresh) sound_.follow(clock.t_s, clock.speed, clock.playing, lead_s);
        while (queue_.frames() < kAheadFrames) {
            sound_.render(block);
            queue_.put(block);
        }
        lock.lock();
        wake_.wait_for(lock, kLook, [this] { return stop_; });
    }
}

}  // namespace tribo::app
