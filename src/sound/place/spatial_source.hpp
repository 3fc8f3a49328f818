// SPDX-License-Identifier: MIT
// One source of sound in space, as the two ears of a listener hear it.
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

// The directions of a head in the world: to the right ear, to the front, up; unit, square to each other.
struct HeadAxes {
    Vec3 right{1, 0, 0}, front{0, 1, 0}, up{0, 0, 1};

    // A direction in the world as the head sees it: x right, y front, z up.
    Vec3 seen(Vec3 direction) const {
        return {dot(direction, right), dot(direction, front), dot(direction, up)};
    }
};

// Where somebody listens, and which way. `forward` and `up` need be neither unit nor square to each other;
// where they give no direction, +y and +z hold.
struct Listener {
    Vec3 position_m;  // or mm, where a function says so
    Vec3 forward{0, 1, 0};
    Vec3 up{0, 0, 1};
    double reference_m = kReferenceDistance;  // nearer a source gets no louder

    bool operator==(const Listener&) const = default;
    HeadAxes axes() const;
};

using EarQuantum = std::array<float, kQuantumFrames>;
struct Ears {
    EarQuantum left{}, right{};
};

// The longest way that is travelled, in s (86 m); a source further away sounds as late as one there.
inline constexpr double kLongestTravelSeconds = 0.25;
// What every source comes later than the air would bring it: the nearer ear is nearer than the head's centre,
// and the interpolator looks ahead.
inline constexpr double kEarLeadSeconds = 0.0008;

// Pressure of a source at `distance_m` as a share of the pressure at 1 m: 1 / r, no more than at the
// reference distance.
double rolloff_at(double distance_m, double reference_m = kReferenceDistance);

// One moving fractional delay line, read once per ear: travel time, arrival offset and Doppler shift
// together, per sample (the source's place is that at which the sound left it, so the ratio is (c + v_l) / (c
// - v_s) for any motion of both). Then 1 / r, then the head's filter, which runs linearly from one quantum to
// the next: nothing steps. A place that moves faster than sound is followed at no more than 4 times, and no
// less than a quarter, of the source's pitch.
//
// Real-time safe after construction (96 KB at 48 kHz); one thread at a time. Nothing to hear costs nothing.
class SpatialSource {
  public:
    explicit SpatialSource(std::shared_ptr<const Head> head, const EarKernels& kernels = ear_kernels());

    // Adds the next quantum: `pressure_pa` at 1 m from the source, which is at `place_m` by the end of it, as
    // the listener is where `listener` says (the listener's and the source's ways between two quanta are
    // straight). The first places hold from the start, and whenever nothing is under way a leap is taken at
    // once.
    void add(const Quantum& pressure_pa, Vec3 place_m, const Listener& listener, Ears& out);

    // Whether something is still on its way.
    bool sounding() const { return under_way() || tail_ > 0; }
    // What is on its way now has been heard after this time.
    double seconds_to_silence() const;

  private:
    struct State {                      // at the end of a quantum
        std::array<double, 2> delay{};  // frames
        double gain = 1;
    };
    void write(const Quantum& pressure_pa);
    bool under_way() const { return silent_quanta_ < quanta_to_pass(); }
    std::int64_t quanta_to_pass() const;
    // The place from which sound arrives now, and how many quanta it took.
    Vec3 retarded(const Listener& listener);
    State state(Vec3 place_m, const Listener& listener, EarResponses& heard);
    void settle(Vec3 place_m, const Listener& listener);
    void play(bool moves, Ears& out);

    std::shared_ptr<const Head> head_;
    const EarKernels* kernels_;
    const InterpolatorTable* table_;
    double frames_per_metre_;

    std::vector<float> line_;                             // twice, so that any stretch of it is in one piece
    std::size_t size_;                                    // of one
    std::size_t now_ = 0;                                 // where the quantum in hand was written
    std::int64_t silent_quanta_ = std::int64_t{1} << 40;  // since the last sound was written

    std::vector<Vec3> places_;  // of the source, ends of quanta; a ring
    std::size_t newest_ = 0;
    double travelled_ = 0;  // quanta
    double slower_ = 0;     // what it grew by in the last quantum
    Listener listener_;     // of the last quantum
    HeadAxes axes_;         // its
    double unmoved_ = 0;    // quanta for which neither source nor listener moved

    bool placed_ = false;
    State before_, here_, after_;
    std::array<EarResponses, 2> responses_;  // of the last quantum's end and of this one's
    std::size_t to_ = 0;                     // which of them is the later
    std::array<std::array<float, kHeadTaps + kQuantumFrames>, 2> ear_{};  // what the filters see
    int tail_ = 0;  // quanta for which the filters still ring
};

}  // namespace tribo::sound
