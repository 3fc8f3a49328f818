// SPDX-License-Identifier: MIT
// A sound source in space, rendered for the two ears of a listener.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

#include "base/vec3.hpp"
#include "sound/cut/voice.hpp"
#include "sound/place/ear_kernels.hpp"
#include "sound/place/head.hpp"
#include "sound/play/calibration.hpp"

namespace tribo::sound {

// Axes of a head in the world: to the right ear, to the front, up. Orthonormal.
struct HeadAxes {
    Vec3 right{1, 0, 0}, front{0, 1, 0}, up{0, 0, 1};

    // A world direction in the frame of the head: x right, y front, z up.
    Vec3 to_head_frame(Vec3 direction) const {
        return {dot(direction, right), dot(direction, front), dot(direction, up)};
    }
};

// Position and orientation of the listener. `forward` and `up` may have any length and angle. If they define
// no direction, +y and +z are used.
struct Listener {
    Vec3 position_m;  // some functions use mm and say so
    Vec3 forward{0, 1, 0};
    Vec3 up{0, 0, 1};
    double reference_m = kReferenceDistance;  // a nearer source gets no louder

    bool operator==(const Listener&) const = default;
    HeadAxes axes() const;
};

using EarQuantum = std::array<float, kQuantumFrames>;
struct Ears {
    EarQuantum left{}, right{};
};

// Longest travel time in s (86 m). A source further away has this delay.
inline constexpr double kLongestTravelSeconds = 0.25;
// Additional delay of every source in s: the nearer ear is closer than the centre of the head, and the
// interpolator looks ahead.
inline constexpr double kEarLeadSeconds = 0.0008;

// Pressure of a source at `distance_m` relative to the pressure at 1 m: 1 / r, limited to its value at the
// reference distance.
double rolloff_at(double distance_m, double reference_m = kReferenceDistance);

// A moving fractional delay line with one read per ear gives travel time, interaural delay and Doppler shift,
// per sample. It uses the position where the sound left the source, so the Doppler ratio is
// (c + v_l) / (c - v_s) for any motion of both. Then 1 / r and the head filter, linear from one quantum to
// the next, so without steps. The pitch ratio is limited to 1/4 ... 4, also for a source faster than sound.
//
// Real-time safe after construction (96 KB at 48 kHz). One thread at a time. Silence costs nothing.
class SpatialSource {
  public:
    explicit SpatialSource(std::shared_ptr<const Head> head, const EarKernels& kernels = ear_kernels());

    // Adds the next quantum. `pressure_pa`: at 1 m from the source. `place_m` and `listener` hold at the end
    // of the quantum; both move in straight lines from the quantum before. The first positions hold from the
    // start. In silence a jump takes effect at once.
    void add(const Quantum& pressure_pa, Vec3 place_m, const Listener& listener, Ears& out);

    // Whether sound is still travelling or ringing.
    bool sounding() const { return under_way() || tail_ > 0; }
    // Time until all current sound has arrived.
    double seconds_to_silence() const;

  private:
    struct State {                      // at the end of a quantum
        std::array<double, 2> delay{};  // frames
        double gain = 1;
    };
    void write(const Quantum& pressure_pa);
    bool under_way() const { return silent_quanta_ < quanta_to_pass(); }
    std::int64_t quanta_to_pass() const;
    // The retarded position: the source position from which sound arrives now.
    Vec3 retarded(const Listener& listener);
    State state(Vec3 place_m, const Listener& listener, EarResponses& heard);
    void settle(Vec3 place_m, const Listener& listener);
    void play(bool moves, Ears& out);

    std::shared_ptr<const Head> head_;
    const EarKernels* kernels_;
    const InterpolatorTable* table_;
    double frames_per_metre_;

    std::vector<float> line_;                             // stored twice, so that every window is contiguous
    std::size_t size_;                                    // of one
    std::size_t now_ = 0;                                 // write position of the current quantum
    std::int64_t silent_quanta_ = std::int64_t{1} << 40;  // since the last sound was written

    std::vector<Vec3> places_;  // of the source, ends of quanta; a ring
    std::size_t newest_ = 0;
    double travelled_ = 0;  // quanta
    double slower_ = 0;     // growth of travelled_ in the last quantum
    Listener listener_;     // of the last quantum
    HeadAxes axes_;         // of listener_
    double unmoved_ = 0;    // quanta without motion of source and listener

    bool placed_ = false;
    State before_, here_, after_;
    std::array<EarResponses, 2> responses_;  // at the end of the last quantum and of this one
    std::size_t to_ = 0;                     // index of the later one
    std::array<std::array<float, kHeadTaps + kQuantumFrames>, 2> ear_{};  // input of the filters
    int tail_ = 0;  // quanta until the filters are silent
};

}  // namespace tribo::sound
