// SPDX-License-Identifier: MIT
#include "noise/learn/texture_fitting.hpp"

#include <algorithm>
#include <cmath>

#include "base/math.hpp"
#include "noise/learn/sound_statistics.hpp"
#include "noise/play/model_noise.hpp"

namespace tribo::noise {
namespace {

constexpr int kSeeds = 6;
constexpr int kRounds = 10;
// Ends after this many rounds without an improvement of 2 %.
constexpr int kPatience = 3;
constexpr double kGain = 0.98;
constexpr double kPlayedS = 5;  // for each seed
// Largest factor for one parameter in one round.
constexpr double kLargestTurn = 2;
// Measured coherence contains the noise of the levels: it is up to this factor too low.
constexpr double kCoherenceWithin = 1.5;
constexpr std::size_t kSteps = kModulationHz.size();
constexpr double kLeast = 1e-12;      // modulation
constexpr double kLeastExcess = 0.1;  // of a kurtosis above 3

// Second-order Butterworth, as in texture_excitation.
void split_off(std::vector<double>& x, double corner_hz, double rate_hz, bool low) {
    const double k = math::tan(math::kPi * corner_hz / rate_hz);
    const double a0 = 1 + std::sqrt(2.0) * k + k * k;
    const double b0 = (low ? k * k : 1) / a0, b1 = low ? 2 * b0 : -2 * b0;
    const double a1 = 2 * (k * k - 1) / a0, a2 = (1 - std::sqrt(2.0) * k + k * k) / a0;
    double s1 = 0, s2 = 0;
    for (double& v : x) {
        const double y = b0 * v + s1;
        s1 = b1 * v - a1 * y + s2;
        s2 = b0 * v - a2 * y;
        v = y;
    }
}

// Measures of the sound of a texture: mean over seeds, of `count` samples each. Of the kurtosis it has the
// geometric mean, and the RMS over the seeds of the difference between its logarithm and the wanted one.
struct Played : HeardTexture {
    double kurtosis_miss = 0;
};

Played played(const TextureModel& texture, const ArModel& model, std::size_t count, double speed_mm_per_s,
              const HeardTexture& wanted) {
    const double travel_mm = speed_mm_per_s * kNoiseBlock / model.sample_rate_hz;
    Played all;
    all.modulation.assign(wanted.modulation.size(), std::vector<double>(kSteps));
    double logarithm = 0, square = 0;
    std::vector<double> x;
    for (int seed = 0; seed < kSeeds; ++seed) {
        ModelNoise noise(model, &texture, 1000 + static_cast<std::uint64_t>(seed));
        x.clear();
        for (std::uint64_t n = 0; x.size() < count; ++n) {
            for (const float v : noise.block(n, travel_mm)) x.push_back(v);
        }
        const HeardTexture one = heard_texture(x, model.sample_rate_hz, texture.crossovers_hz);
        const double miss = math::log(one.kurtosis / wanted.kurtosis);
        logarithm += math::log(one.kurtosis) / kSeeds;
        square += miss * miss / kSeeds;
        for (std::size_t b = 0; b < one.modulation.size(); ++b) {
            for (std::size_t k = 0; k < kSteps; ++k) {
                all.modulation[b][k] += one.modulation[b][k] / kSeeds;
            }
        }
    }
    all.kurtosis = math::exp(logarithm);
    all.kurtosis_miss = std::sqrt(square);
    return all;
}

// Parameters that are fitted until a texture sounds like its recording.
struct Knobs {
    std::vector<double> spread;   // factor for each band, on the deviations of its levels from the middle
    std::vector<double> weights;  // of the memories
    double coherence = 1;
    double crest = 1;   // factor on the levels of the loudest sixth
    double grains = 1;  // factor on the share of the grains
};

TextureModel turned(const TextureModel& texture, const Knobs& knobs) {
    TextureModel out = texture;
    for (std::size_t b = 0; b < out.levels_db.size(); ++b) {
        std::vector<double>& table = out.levels_db[b];
        const double middle = table[kLevelSteps / 2], knee = table[kLevelSteps / 2 + 2];
        for (std::size_t n = 0; n < table.size(); ++n) {
            const double own = n > kLevelSteps / 2 + 2 ? knee + knobs.crest * (table[n] - knee) : table[n];
            table[n] = middle + knobs.spread[b] * (own - middle);
        }
    }
    out.weights = knobs.weights;
    out.coherence = knobs.coherence;
    out.grains.share = std::min(out.grains.share * knobs.grains, 0.98);
    normalize(out);
    return out;
}

double sum_of(const std::vector<double>& v) {
    double sum = 0;
    for (const double x : v) sum += x;
    return sum;
}

double turn(double factor) {
    return std::clamp(factor, 1 / kLargestTurn, kLargestTurn);
}

// Distance between the played and the wanted sound. Modulation spectra: Itakura-Saito distance (Itakura and
// Saito 1968), in which a missed line counts more than a filled gap. Kurtosis: half the squared logarithm,
// which equals this distance for small errors.
double distance(const HeardTexture& wanted, const Played& now) {
    double sum = 0, count = 0;
    for (std::size_t b = 0; b < wanted.modulation.size(); ++b) {
        for (std::size_t k = 0; k < kSteps; ++k) {
            if (!(wanted.modulation[b][k] > 0) || !(now.modulation[b][k] > 0)) continue;
            const double ratio = wanted.modulation[b][k] / now.modulation[b][k];
            sum += ratio - math::log(ratio) - 1;
            ++count;
        }
    }
    return sum / std::max(count, 1.0) + 0.5 * now.kurtosis_miss * now.kurtosis_miss;
}

// One round: moves each parameter a step towards the wanted sound.
void turn_knobs(Knobs& knobs, const TextureModel& measured, std::span<const double> memory_s,
                const HeardTexture& wanted, const HeardTexture& now) {
    const bool grains = !measured.grains.sizes.empty();
    std::vector<double> strength;  // of the modulation, wanted over played
    for (std::size_t b = 0; b < now.modulation.size(); ++b) {
        strength.push_back(std::max(sum_of(wanted.modulation[b]), kLeast) /
                           std::max(sum_of(now.modulation[b]), kLeast));
    }
    double bands = 0;
    for (std::size_t b = 0; b < knobs.spread.size(); ++b) {
        knobs.spread[b] = std::clamp(knobs.spread[b] * turn(std::sqrt(strength[b])), 0.02, 4.0);
        bands += math::log(strength[b]) / static_cast<double>(knobs.spread.size());
    }
    // Coherent bands fluctuate more as a whole.
    knobs.coherence = std::clamp(knobs.coherence * turn(strength.back() / math::exp(bands)),
                                 measured.coherence / kCoherenceWithin,
                                 std::min(measured.coherence * kCoherenceWithin, 1.0));
    // Multiplicative steps that reduce the Itakura-Saito distance of the modulation spectra.
    std::vector<double> weights = knobs.weights;
    for (std::size_t m = 0; m < weights.size(); ++m) {
        double up = 0, down = 0;
        for (std::size_t b = 0; b < now.modulation.size(); ++b) {
            for (std::size_t k = 0; k < kSteps; ++k) {
                const double p = now.modulation[b][k];
                if (!(p > 0)) continue;  // the sound is too short for this step
                const double w = math::kTwoPi * kModulationHz[k] * memory_s[m];
                const double basis = memory_s[m] / (1 + w * w);
                up += basis * wanted.modulation[b][k] / (strength[b] * p * p);
                down += basis / p;
            }
        }
        weights[m] = std::max(weights[m], 1e-3) * turn(up / std::max(down, kLeast));
    }
    const double sum = sum_of(weights);
    for (std::size_t m = 0; m < weights.size(); ++m) knobs.weights[m] = weights[m] / sum;
    // The kurtosis depends on a few loud sounds and scatters; therefore its steps are small.
    const double peak = math::pow(
        turn(std::max(wanted.kurtosis - 3, kLeastExcess) / std::max(now.kurtosis - 3, kLeastExcess)), 0.35);
    if (grains) knobs.grains *= peak;
    knobs.crest = std::clamp(knobs.crest * peak, 0.1, grains ? 1.0 : 4.0);
}

}  // namespace

std::vector<double> band_of(const std::vector<double>& sound, std::size_t band,
                            std::span<const double> crossovers_hz, double sample_rate_hz) {
    std::vector<double> x = sound;
    if (band > 0) split_off(x, crossovers_hz[band - 1], sample_rate_hz, false);
    if (band < crossovers_hz.size()) split_off(x, crossovers_hz[band], sample_rate_hz, true);
    return x;
}

HeardTexture heard_texture(const std::vector<double>& sound, double sample_rate_hz,
                           std::span<const double> crossovers_hz) {
    HeardTexture heard;
    for (std::size_t b = 0; b <= crossovers_hz.size(); ++b) {
        heard.modulation.push_back(modulation_density(band_of(sound, b, crossovers_hz, sample_rate_hz),
                                                      sample_rate_hz, kModulationHz));
    }
    heard.modulation.push_back(modulation_density(sound, sample_rate_hz, kModulationHz));
    heard.kurtosis = kurtosis(sound);
    return heard;
}

TextureModel fitted_texture(const TextureModel& texture, const ArModel& model, double speed_mm_per_s,
                            const HeardTexture& wanted) {
    const auto count = static_cast<std::size_t>(kPlayedS * model.sample_rate_hz);
    std::vector<double> memory_s;
    for (const double mm : texture.lengths_mm) memory_s.push_back(mm / speed_mm_per_s);
    Knobs knobs{std::vector<double>(texture.levels_db.size(), 1), texture.weights, texture.coherence};
    TextureModel best = texture;
    double least = 1e300;
    int last_gain = 0;
    for (int round = 0; round < kRounds; ++round) {
        const TextureModel trial = turned(texture, knobs);
        const Played now = played(trial, model, count, speed_mm_per_s, wanted);
        const double miss = distance(wanted, now);
        if (miss < least) {
            last_gain = miss < kGain * least ? round : last_gain;
            least = miss;
            best = trial;
        }
        if (round - last_gain == kPatience) break;
        turn_knobs(knobs, texture, memory_s, wanted, now);
    }
    return best;
}

}  // namespace tribo::noise
