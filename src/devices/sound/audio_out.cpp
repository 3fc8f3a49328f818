// SPDX-License-Identifier: MIT
#include "devices/sound/audio_out.hpp"

#include <RtAudio.h>
#include <algorithm>
#include <fcntl.h>
#include <unistd.h>

namespace tribo::devices {
namespace {

constexpr unsigned kStereo = 2;

// Discards all output to stderr while it exists: libasound and JACK print errors about missing cards.
class QuietStderr {
  public:
    QuietStderr() : kept_(dup(STDERR_FILENO)) {
        const int nowhere = open("/dev/null", O_WRONLY | O_CLOEXEC);
        if (kept_ >= 0 && nowhere >= 0) dup2(nowhere, STDERR_FILENO);
        if (nowhere >= 0) close(nowhere);
    }
    ~QuietStderr() {
        if (kept_ < 0) return;
        dup2(kept_, STDERR_FILENO);
        close(kept_);
    }
    QuietStderr(const QuietStderr&) = delete;
    QuietStderr& operator=(const QuietStderr&) = delete;

  private:
    int kept_;
};

std::unexpected<Error> no_sound(const std::string& why) {
    return fail("no sound: " + why, "go on without, or connect a sound card (tribo devices lists them)");
}

}  // namespace

struct AudioOut::Stream {
    RtAudio audio;
    AudioRender render;

    static int play(void* out, void*, unsigned frames, double, RtAudioStreamStatus, void* self) {
        static_cast<Stream*>(self)->render({static_cast<float*>(out), kStereo * std::size_t{frames}});
        return 0;
    }
};

AudioOut::AudioOut() = default;

AudioOut::~AudioOut() {
    if (!stream_) return;
    const QuietStderr quiet;
    try {
        if (stream_->audio.isStreamRunning()) stream_->audio.abortStream();
        if (stream_->audio.isStreamOpen()) stream_->audio.closeStream();
    } catch (const RtAudioError&) {
        return;  // the device is already gone
    }
}

Result<std::unique_ptr<AudioOut>> AudioOut::open(const AudioOutOptions& options, AudioRender render) {
    if (options.sample_rate_hz < 8000 || options.sample_rate_hz > 192000 || options.buffer_frames < 16 ||
        options.buffer_frames > 8192) {
        return no_sound("a sample rate or buffer length that no device has");
    }
    const QuietStderr quiet;
    auto out = std::unique_ptr<AudioOut>(new AudioOut);
    try {
        out->stream_ = std::make_unique<Stream>();
        Stream& s = *out->stream_;
        s.render = std::move(render);
        s.audio.showWarnings(false);
        if (s.audio.getDeviceCount() == 0) return no_sound("there is no sound card");
        RtAudio::StreamParameters parameters;
        parameters.deviceId = s.audio.getDefaultOutputDevice();
        parameters.nChannels = kStereo;
        const RtAudio::DeviceInfo info = s.audio.getDeviceInfo(parameters.deviceId);
        if (!info.probed || info.outputChannels < kStereo) return no_sound("no device plays stereo");
        out->device_ = info.name;
        auto frames = static_cast<unsigned>(options.buffer_frames);
        RtAudio::StreamOptions how;
        how.flags = RTAUDIO_MINIMIZE_LATENCY | RTAUDIO_SCHEDULE_REALTIME;
        how.numberOfBuffers = 2;
        how.streamName = "tribo";
        s.audio.openStream(&parameters, nullptr, RTAUDIO_FLOAT32,
                           static_cast<unsigned>(options.sample_rate_hz), &frames, &Stream::play, &s, &how);
        out->buffer_frames_ = static_cast<int>(frames);
        out->sample_rate_hz_ = static_cast<int>(s.audio.getStreamSampleRate());
        if (out->sample_rate_hz_ != options.sample_rate_hz) {
            return no_sound(info.name + " plays " + std::to_string(out->sample_rate_hz_) + " Hz only");
        }
        s.audio.startStream();
    } catch (const RtAudioError& error) {
        return no_sound(error.getMessage());
    }
    return out;
}

double AudioOut::latency_s() const {
    const long told = stream_->audio.getStreamLatency();
    return static_cast<double>(std::max<long>(told, 2L * buffer_frames_)) / sample_rate_hz_;
}

}  // namespace tribo::devices
