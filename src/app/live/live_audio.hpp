// SPDX-License-Identifier: MIT
// Sound of `tribo live` on the loudspeaker of this machine: the same sound as in a page. A separate thread
// renders it ahead of time and passes it to the device without a lock.
#pragma once

#include <condition_variable>
#include <memory>
#include <mutex>
#include <span>
#include <string>
#include <thread>
#include <vector>

#include "devices/sound/audio_out.hpp"
#include "devices/sound/sample_queue.hpp"
#include "session/live/live_sound.hpp"

namespace tribo::app {

class LiveAudio {
  public:
    // Frames rendered ahead, so that a delay of the thread makes no gap.
    static constexpr std::size_t kAheadFrames = 1024;

    // Returns an error without a loudspeaker.
    static Result<std::unique_ptr<LiveAudio>> open(const sound::SoundtrackOptions& options);
    ~LiveAudio();
    LiveAudio(const LiveAudio&) = delete;
    LiveAudio& operator=(const LiveAudio&) = delete;

    const std::string& device() const { return out_->device(); }
    // Called on one thread: the sound updates of the mill, and the clock at each picture.
    void take(session::LiveSoundUpdate news);
    void follow(double t_s, double speed, bool playing);

  private:
    struct Clock {
        double t_s = 0, speed = 1;
        bool playing = false, fresh = false;
    };
    explicit LiveAudio(const sound::SoundtrackOptions& options) : sound_(options) {}
    void work();

    session::LiveSound sound_;  // used by the thread only
    devices::SampleQueue queue_;
    std::mutex mutex_;
    std::condition_variable wake_;
    std::vector<session::LiveSoundUpdate> news_;
    Clock clock_;
    bool stop_ = false;
    std::unique_ptr<devices::AudioOut> out_;
    std::thread thread_;
};

}  // namespace tribo::app
