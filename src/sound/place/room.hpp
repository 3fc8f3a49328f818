// SPDX-License-Identifier: MIT
// First reflections of a room: one from each wall, floor and ceiling.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "base/vec3.hpp"
#include "sound/cut/voice.hpp"
#include "sound/place/spatial_source.hpp"

namespace tribo::sound {

// A box around the start position of the listener. low_m = high_m: no room.
struct Room {
    std::string_view name = "none", what = "the open";
    Vec3 low_m, high_m;        // corners relative to that position; low < 0 < high
    double reflection = 0;     // of the pressure at a wall, 0 ... 1
    double highest_hz = 5000;  // low-pass of the walls, 6 dB per octave above
    double level = 1;          // of the pressure

    bool reflects() const { return reflection > 0 && level > 0; }
};

// "none" comes first. Sizes and reflections are typical, not measured.
std::span<const Room> rooms();
// The six first-order images of a source in a box (Allen and Berkley 1979), each with its delay, its side and
// 1 / r. The far ear gets half of the head shadow. A change of position is a crossfade over a quantum. A
// source or listener outside of the box counts as close to the wall. Later reflections are left out.
//
// Real-time safe after construction, about 10 ns per frame; nothing in silence. One thread at a time.
class RoomReflections {
  public:
    // `centre_m`: start position of the listener. `ears_apart_m` 0: two loudspeakers, no delay between them.
    RoomReflections(const Room& room, Vec3 centre_m, double sample_rate_hz, double ears_apart_m);

    // Adds the next quantum. Arguments as in SpatialSource::add().
    void add(const Quantum& pressure_pa, Vec3 place_m, const Listener& listener, Ears& out);

    bool sounding() const { return silent_quanta_ <= quanta_to_pass_; }
    // Time until all current sound has arrived.
    double seconds_to_silence() const;

  private:
    static constexpr std::size_t kImages = 6;
    struct Tap {
        std::size_t delay = 0;  // frames
        float gain = 0;
    };
    using Taps = std::array<std::array<Tap, kImages>, 2>;  // of the ears
    Taps taps(Vec3 place_m, const Listener& listener) const;

    Room room_;
    Vec3 low_m_, high_m_;
    double sample_rate_hz_, ears_apart_m_;
    double keep_ = 0;                  // of the low-pass
    std::array<double, 2> lowered_{};  // its state
    std::vector<float> line_;          // stored twice, so that every window is contiguous
    std::size_t size_ = 0, now_ = 0;
    std::int64_t silent_quanta_ = std::int64_t{1} << 40, quanta_to_pass_ = 0;
    bool placed_ = false;
    Vec3 place_m_;
    Listener listener_;
    Taps here_{};
};

}  // namespace tribo::sound
