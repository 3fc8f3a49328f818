// SPDX-License-Identifier: MIT
// The first reflections of a room: what walls, floor and ceiling send back once.
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

// A box around the place where the listener begins. Nothing (low_m = high_m): no room.
struct Room {
    std::string_view name = "none", what = "the open";
    Vec3 low_m, high_m;        // of its walls, from that place; low below 0, high above
    double reflection = 0;     // of the pressure at a wall, 0 ... 1
    double highest_hz = 5000;  // above it walls take more: 6 dB per octave
    double level = 1;          // of the pressure

    bool reflects() const { return reflection > 0 && level > 0; }
};

// "none" comes first. Sizes and reflections are typical, not measured.
std::span<const Room> rooms();
// The six first images of a source in a box (Allen and Berkley 1979), each with its way, its side and 1 / r.
// An image reaches the ears by straight lines, as loud at the far ear as half its shadow would have it; a
// place that changes is followed by a crossfade over a quantum. A source or listener beyond a wall counts as
// standing close to it. Later reflections are left out.
//
// Real-time safe after construction, about 10 ns a frame; nothing where nothing is under way. One thread at a
// time.
class RoomReflections {
  public:
    // `centre_m`: where the listener begins. `ears_apart_m` 0: two loudspeakers, no difference in time.
    RoomReflections(const Room& room, Vec3 centre_m, double sample_rate_hz, double ears_apart_m);

    // Adds the next quantum; arguments as of SpatialSource::add.
    void add(const Quantum& pressure_pa, Vec3 place_m, const Listener& listener, Ears& out);

    bool sounding() const { return silent_quanta_ <= quanta_to_pass_; }
    // What is on its way now has been heard after this time.
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
    std::vector<float> line_;          // twice, so that any stretch of it is in one piece
    std::size_t size_ = 0, now_ = 0;
    std::int64_t silent_quanta_ = std::int64_t{1} << 40, quanta_to_pass_ = 0;
    bool placed_ = false;
    Vec3 place_m_;
    Listener listener_;
    Taps here_{};
};

}  // namespace tribo::sound
