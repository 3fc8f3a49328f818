// SPDX-License-Identifier: MIT
// Head-related transfer functions: two filters and two delays at the ears for each direction.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "base/result.hpp"
#include "base/vec3.hpp"
#include "sound/place/minimum_phase.hpp"

namespace tribo::sound {

// Directions are seen from the head: x to the right ear, y to the front, z up.

// Measured head responses: an impulse response per direction and ear.
struct HrirSet {
    double sample_rate_hz = 0;
    int taps = 0;                        // of each response
    std::vector<Vec3> directions;        // towards the source, unit
    std::vector<float> responses;        // direction, ear (left, right), tap
    std::vector<double> extra_delays_s;  // direction, ear: of the response as a whole
};

// Refuses an invalid set: sizes that do not match, values that are not finite, directions of length 0.
Result<void> check_hrirs(const HrirSet& set);

// Order of the ears, from arrival time and level of all directions more than 20 degrees from the median
// plane. `unclear`: time and level disagree, or both ears are alike.
enum class EarOrder : std::uint8_t { right, exchanged, unclear };
EarOrder ear_order(const HrirSet& set);
void exchange_ears(HrirSet& set);

// Equalization of the responses. Most headphones are diffuse-field equalized: they already contain the
// amplification by the ear. `diffuse` removes it from the responses, where it would count twice. `none` keeps
// the measured responses.
enum class Equalization : std::uint8_t { diffuse, none };

// Radius of the head in m; same as the sphere of Duda and Martens 1998. A source inside has no direction: the
// response fades to the mean over all directions, so that a source can pass through the centre without a
// jump.
inline constexpr double kHeadRadius = 0.0875;
inline constexpr double kSoundSpeed = 343;  // m/s, dry air at 20 degrees

// Minimum-phase filters and delays on a grid of 5 degrees, with bilinear interpolation. Delays are relative
// to the arrival at the centre of the head, on average over all directions. Immutable, 3 MB; any thread.
class Head {
  public:
    // From measurements. The mean level from 200 to 400 Hz over all directions and ears is that of the free
    // field. Below 400 Hz measured sets contain loudspeaker and room: the magnitude of sphere() replaces
    // them. From 800 Hz on the measured magnitude is used. Ears amplify: the shipped set by up to 25 dB near
    // 3 kHz. Takes about 0.5 s. `diffuse`: from 800 Hz on divided by the RMS over all directions, smoothed
    // over a third octave, by at most 20 dB up or down.
    static Result<std::shared_ptr<const Head>> measured(const HrirSet& set, double sample_rate_hz,
                                                        Equalization equalization = Equalization::none);
    // A rigid sphere with ears 10 degrees behind the sides, in closed form (Duda and Martens 1998). Sources
    // behind are up to 8 dB quieter above 3 kHz, like with outer ears. Takes about 30 ms.
    static std::shared_ptr<const Head> sphere(double sample_rate_hz);
    // No head: equal-power panning for two loudspeakers, without delays. A source in front has level 1 on
    // both.
    static std::shared_ptr<const Head> panning(double sample_rate_hz);

    double sample_rate_hz() const { return sample_rate_hz_; }
    // Distance between the ears; 0 for two loudspeakers.
    double ears_apart_m() const { return ears_apart_m_; }
    int taps() const { return taps_; }  // a multiple of 16; the rest of EarResponses is zero

    // Responses to a source at `place`, in head radii (beyond 1 only the direction matters). Real-time safe,
    // about 0.3 us.
    void hear(Vec3 place, EarResponses& out, const EarKernels& kernels = ear_kernels()) const;
    // The same for a direction of any length and a distance in head radii.
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
    // Makes the columns at the poles equal, sets the mean delay to 0, and computes the mean over all
    // directions.
    void finish();

    double sample_rate_hz_;
    int taps_;
    double ears_apart_m_ = 2 * kHeadRadius;
    std::vector<EarResponses> nodes_;
    HeadTaps everywhere_{};
};

}  // namespace tribo::sound
