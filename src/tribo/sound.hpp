// SPDX-License-Identifier: MIT
// The sound of a cut in 3D, from its contact samples: stereo. [sound] of the job defines the listener.
//
//     auto sound = tribo::CutSound::of(*mill, {.ears = tribo::Ears::sphere});
//     sound->excite(mill->contact(row, force, row.start_s));
//     while (sound->frames_left() > 0) {
//         sound->render(block);
//     }
//
// The whole program: examples/source/mill.cpp.
//
// excite(), release() and render() are real-time safe: no allocation, lock, exception or output. One thread
// at a time.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>

#include "contact/contact_sample.hpp"
#include "tribo/mill.hpp"

namespace tribo {

// The way in which directions are rendered.
enum class Ears { as_the_job_says, measured_head, sphere, panning };

struct SoundOptions {
    int sample_rate_hz = 48000;         // 32000 ... 192000
    std::optional<Vec3> listener_mm{};  // stock frame, looks along +y; absent: that of the job
    Ears ears = Ears::as_the_job_says;
};

// The sound of a cut: contact samples in, stereo out.
class CutSound {
  public:
    // Takes machine, room, chips, levels and recordings from the job. Refuses options out of range, and sound
    // files that cannot be read.
    static FileResult<CutSound> of(const Mill& mill, const SoundOptions& options = {});
    CutSound(CutSound&&) noexcept;
    CutSound& operator=(CutSound&&) noexcept;
    ~CutSound();

    const Warnings& warnings() const;  // for example a missing head
    // Moves the contact to `next`, at its time in the track. Render frames_left() frames before the next
    // call. Returns false and changes nothing if a number is not finite. The sample is not kept.
    bool excite(const contact::ContactSample& next);
    std::int64_t frames_left() const;
    // Ends the contact. The sound decays within tail_seconds().
    void release();
    double tail_seconds() const;
    // Renders the next interleaved.size() / 2 frames, within full scale 1.
    void render(std::span<float> interleaved);

  private:
    struct State;
    explicit CutSound(std::unique_ptr<State> state);
    std::unique_ptr<State> state_;
};

}  // namespace tribo
