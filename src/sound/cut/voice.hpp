// SPDX-License-Identifier: MIT
// Interface of all sound sources: a cut, a spindle, a recording.
#pragma once

#include <array>
#include <cstdint>

#include "contact/contact_sample.hpp"

namespace tribo::sound {

// Sound is rendered in quanta of 64 frames (1.33 ms at 48 kHz), counted from the start. An excitation takes
// effect at the start of a quantum, so the samples do not depend on the block size of the caller.
inline constexpr int kQuantumFrames = 64;
using Quantum = std::array<double, kQuantumFrames>;

// One sound source. All calls are real-time safe (no allocation, lock or throw), from one thread at a time.
// The pressure is continuous for any excitation, and exactly zero without one.
class Voice {
  public:
    virtual ~Voice() = default;

    // From the next quantum on, the excitation moves linearly from its current value to `next`. It arrives
    // after `quanta` >= 0 quanta (0: at once) and then stays. `next` is finite.
    virtual void excite(const contact::ContactSample& next, std::int64_t quanta) = 0;
    // Ends the contact from the next quantum on.
    virtual void release() = 0;
    // Adds the next quantum: sound pressure in Pa, 1 m from the source.
    virtual void add(Quantum& pressure_pa) = 0;
};

}  // namespace tribo::sound
