// SPDX-License-Identifier: MIT
// Whatever sounds takes its excitation through this one interface: a cut, a spindle, a
// recording.
#pragma once

#include <array>
#include <cstdint>

#include "contact/contact_sample.hpp"

namespace tribo::sound {

// Sound is made in quanta of 64 frames (1.33 ms at 48 kHz), counted from the start: an excitation takes hold
// at the border of a quantum, so the samples do not depend on the blocks in which they are asked for.
inline constexpr int kQuantumFrames = 64;
using Quantum = std::array<double, kQuantumFrames>;

// One source of sound. All calls are real-time safe (no allocation, lock or throw), from one thread at
// a time. Pressure is continuous whatever the excitation does, and exactly zero where there is none.
class Voice {
  public:
    virtual ~Voice() = default;

    // From the next quantum on, the excitation moves linearly from where it is to `next`, reached after
    // `quanta` >= 0 of them (0: at once), and then stays. `next` is finite.
    virtual void excite(const contact::ContactSample& next, std::int64_t quanta) = 0;
    // From the next quantum on there is no contact.
    virtual void release() = 0;
    // Adds the next quantum: sound pressure in Pa, 1 m from the source.
    virtual void add(Quantum& pressure_pa) = 0;
};

}  // namespace tribo::sound
