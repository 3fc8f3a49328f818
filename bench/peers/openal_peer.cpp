// SPDX-License-Identifier: MIT
#include "peers/openal_peer.hpp"

#if defined(TRIBO_OPENAL)
#include <AL/al.h>
#include <AL/alc.h>
#include <AL/alext.h>
#include <cstdint>

namespace tribo::bench {

struct OpenAlScene::Handles {
    ALCdevice* device = nullptr;
    ALCcontext* context = nullptr;
    ALuint buffer = 0;
    std::vector<ALuint> sources;
    LPALCRENDERSAMPLESSOFT render = nullptr;
};

OpenAlScene::OpenAlScene() : handles_(std::make_unique<Handles>()) {}

OpenAlScene::~OpenAlScene() {
    if (handles_->context != nullptr) {
        alDeleteSources(static_cast<ALsizei>(handles_->sources.size()), handles_->sources.data());
        alDeleteBuffers(1, &handles_->buffer);
        alcMakeContextCurrent(nullptr);
        alcDestroyContext(handles_->context);
    }
    if (handles_->device != nullptr) alcCloseDevice(handles_->device);
}

std::unique_ptr<OpenAlScene> OpenAlScene::open(int sources, bool head, std::span<const float> sound) {
    const auto open_loopback = reinterpret_cast<LPALCLOOPBACKOPENDEVICESOFT>(
        alcGetProcAddress(nullptr, "alcLoopbackOpenDeviceSOFT"));
    if (open_loopback == nullptr) return nullptr;
    auto scene = std::unique_ptr<OpenAlScene>(new OpenAlScene);
    Handles& h = *scene->handles_;
    h.device = open_loopback(nullptr);
    h.render = reinterpret_cast<LPALCRENDERSAMPLESSOFT>(alcGetProcAddress(nullptr, "alcRenderSamplesSOFT"));
    if (h.device == nullptr || h.render == nullptr) return nullptr;
    const ALCint attributes[] = {ALC_FORMAT_CHANNELS_SOFT,
                                 ALC_STEREO_SOFT,
                                 ALC_FORMAT_TYPE_SOFT,
                                 ALC_FLOAT_SOFT,
                                 ALC_FREQUENCY,
                                 48000,
                                 ALC_HRTF_SOFT,
                                 head ? ALC_TRUE : ALC_FALSE,
                                 ALC_MONO_SOURCES,
                                 256,
                                 0};
    h.context = alcCreateContext(h.device, attributes);
    if (h.context == nullptr || alcMakeContextCurrent(h.context) == ALC_FALSE) return nullptr;
    if (head) {
        ALCint status = ALC_FALSE;
        alcGetIntegerv(h.device, ALC_HRTF_SOFT, 1, &status);
        if (status == ALC_FALSE) return nullptr;
    }
    alSpeedOfSound(343);
    alDistanceModel(AL_INVERSE_DISTANCE_CLAMPED);
    alGenBuffers(1, &h.buffer);
    std::vector<std::int16_t> samples;
    for (const float v : sound) samples.push_back(static_cast<std::int16_t>(v * 32767));
    alBufferData(h.buffer, AL_FORMAT_MONO16, samples.data(),
                 static_cast<ALsizei>(samples.size() * sizeof(std::int16_t)), 48000);
    h.sources.resize(static_cast<std::size_t>(sources));
    if (sources > 0) alGenSources(sources, h.sources.data());
    for (const ALuint s : h.sources) {
        alSourcei(s, AL_BUFFER, static_cast<ALint>(h.buffer));
        alSourcei(s, AL_LOOPING, AL_TRUE);
        alSource3f(s, AL_POSITION, 0, 0, -2);
        alSourcePlay(s);
    }
    if (alGetError() != AL_NO_ERROR) return nullptr;
    alcSuspendContext(h.context);
    return scene;
}

void OpenAlScene::place(int source, Vec3 at, Vec3 v) {
    const ALuint s = handles_->sources[static_cast<std::size_t>(source)];
    const auto f = [](double x) { return static_cast<float>(x); };
    alSource3f(s, AL_POSITION, f(at.x), f(at.z), f(-at.y));
    alSource3f(s, AL_VELOCITY, f(v.x), f(v.z), f(-v.y));
}

void OpenAlScene::render(std::span<float> stereo) {
    alcProcessContext(handles_->context);
    handles_->render(handles_->device, stereo.data(), static_cast<ALCsizei>(stereo.size() / 2));
    alcSuspendContext(handles_->context);
}

std::string OpenAlScene::version() const {
    return alGetString(AL_VERSION);
}

}  // namespace tribo::bench

#else

namespace tribo::bench {

struct OpenAlScene::Handles {};
OpenAlScene::OpenAlScene() = default;
OpenAlScene::~OpenAlScene() = default;
std::unique_ptr<OpenAlScene> OpenAlScene::open(int, bool, std::span<const float>) {
    return nullptr;
}
void OpenAlScene::place(int, Vec3, Vec3) {}
void OpenAlScene::render(std::span<float>) {}
std::string OpenAlScene::version() const {
    return {};
}

}  // namespace tribo::bench

#endif
