// SPDX-License-Identifier: MIT
// What a head does to sound from each direction: the two filters and the two delays at its ears.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "base/result.hpp"
#include "base/vec3.hpp"
#include "sound/place/minimum_phase.hpp"

namespace tribo::sound {

// Directions are seen from the head: x to the right ear, y to the front, z up.

// Head responses as they were measured: an impulse response per direction and ear.
struct HrirSet {
    double sample_rate_hz = 0;
    int taps = 0;                        // of each response
    std::vector<Vec3> directions;        // towards the source, unit
    std::vector<float> responses;        // direction, ear (left, right), tap
    std::vector<double> extra_delays_s;  // direction, ear: of the response as a whole
};

// Refuses a set that is no set: sizes that do not fit, numbers that are none, directions that are none.
Result<void> check_hrirs(const HrirSet& set);

// By which ear hears a source at its side earlier and louder, over all directions more than 20 degrees from
// the median plane. `unclear`: the two do not agree, or ears are alike.
enum class EarOrder : std::uint8_t { right, exchanged, unclear };
EarOrder ear_order(const HrirSet& set);
void exchange_ears(HrirSet& set);

// What ears are made for. Headphones that give every ear the sound of a diffuse field, as most do, bring that
// ear's own amplification with them: `diffuse` takes it out of the head, where it would count twice. `none`
// keeps the responses as they were measured.
enum class Equalization : std::uint8_t { diffuse, none };

// A radius within which a source is inside the head: there its direction fades into "everywhere", as the
// angle of a source that passes through the middle would leap. In m; the sphere's radius (Duda and Martens
// 1998).
inline constexpr double kHeadRadius = 0.0875;
inline constexpr double kSoundSpeed = 343;  // m/s, dry air at 20 degrees

// Filters of minimum phase and delays on a grid of 5 degrees, bilinear between. Delays count from the arrival
// at the place of the head's centre, on average over all directions. Immutable, 3 MB; any thread.
class Head {
  public:
    // From measurements. A set's level is that of the free field from 200 to 400 Hz, on average over its
    // directions and ears; below 400 Hz, where sets tell of their loudspeaker and room, it has the magnitude
    // of the sphere below, from 800 Hz on its own. Ears amplify: the shipped set by up to 25 dB near 3 kHz.
    // Takes some 0.5 s.
    // `diffuse`: from 800 Hz on divided by the root of the mean power of all its directions, smoothed over a
    // third octave, by no more than 20 dB either way.
    static Result<std::shared_ptr<const Head>> measured(const HrirSet& set, double sample_rate_hz,
                                                        Equalization equalization = Equalization::none);
    // A rigid sphere with ears 10 degrees behind its sides, in closed form (Duda and Martens 1998), and
    // behind it up to 8 dB less above 3 kHz, as outer ears do. Takes some 30 ms.
    static std::shared_ptr<const Head> sphere(double sample_rate_hz);
    // No head: two loudspeakers with equal power, no difference in time. A source in front has level 1 on
    // both.
    static std::shared_ptr<const Head> panning(double sample_rate_hz);

    double sample_rate_hz() const { return sample_rate_hz_; }
    // Between the ears; 0 for two loudspeakers.
    double ears_apart_m() const { return ears_apart_m_; }
    int taps() const { return taps_; }  // a multiple of 16; the rest of EarResponses is zero

    // Responses to a source at `place` in head radii (longer than 1: that direction). Real-time safe, about
    // 0.3 us.
    void hear(Vec3 place, EarResponses& out, const EarKernels& kernels = ear_kernels()) const;
    // The same of a direction, of any length, and the distance in head radii.
    void hear(Vec3 direction, double radii, EarResponses& out, const EarKernels& kernels) const;

    // Grid of the directions: azimuth from the front to the right, elevation up.
    static constexpr int kStepDeg = 5, kColumns = 360 / kStepDeg, kRows = 180 / kStepDeg + 1;
    static Vec3 grid_direction(int row, int column);

  private:
    Head(double sample_rate_hz, int taps);
    EarResponses& node(int row, int column) {
        return nodes_[static_cast<std::size_t>(row * kColumns + column)];
    }
    const EarResponses& node(int row, int column) const {
        return nodes_[static_cast<std::size_t>(row * kColumns + column)];
    }
    // The poles' columns made alike, delays set to mean 0, and what is heard of a source everywhere.
    void finish();

    double sample_rate_hz_;
    int taps_;
    double ears_apart_m_ = 2 * kHeadRadius;
    std::vector<EarResponses> nodes_;
    HeadTaps everywhere_{};
};

}  // namespace tribo::sound
