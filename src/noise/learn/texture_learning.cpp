// SPDX-License-Identifier: MIT
#include "noise/learn/texture_learning.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>

#include "base/math.hpp"
#include "base/noise_hash.hpp"
#include "noise/learn/sound_statistics.hpp"
#include "noise/learn/texture_fitting.hpp"
#include "noise/play/model_noise.hpp"
#include "noise/play/slow_level.hpp"

namespace tribo::noise {
namespace {

using PieceSpans = std::span<const std::span<const double>>;

constexpr std::array<double, 4> kCrossoversHz{400, 1500, 5000, 12000};
constexpr double kFineFrameS = 0.003;
constexpr double kFramesPerBandwidth = 4;  // minimum of frame length * bandwidth of a band
// Memory times of the level process, at the learned speed.
constexpr std::array<double, kMostLengths> kMemoryS{0.002, 0.006, 0.02, 0.06};
// Least excess of the level deviation over that of Gaussian noise for a texture.
constexpr double kLeastDeviationDb = 0.7;
// With fewer grains their sizes are unknown.
constexpr std::size_t kFewestGrains = 8;
constexpr double kGrainReachS = 0.0005;
constexpr double kSurroundingsS = 0.01;
// Least share of the energy of a grain in its five middle samples; it is a tenth for noise of constant level.
constexpr double kGrainConcentration = 0.2;

// Quantile of the normal distribution: rational approximation of Acklam (2003), to 1e-9.
double normal_quantile(double p) {
    if (p > 0.5) return -normal_quantile(1 - p);
    if (p < 0.02425) {
        const double q = std::sqrt(-2 * math::log(p));
        return (((((-7.784894002430293e-03 * q - 3.223964580411365e-01) * q - 2.400758277161838e+00) * q -
                  2.549732539343734e+00) *
                     q +
                 4.374664141464968e+00) *
                    q +
                2.938163982698783e+00) /
               ((((7.784695709041462e-03 * q + 3.224671290700398e-01) * q + 2.445134137142996e+00) * q +
                 3.754408661907416e+00) *
                    q +
                1);
    }
    const double q = p - 0.5, r = q * q;
    return (((((-3.969683028665376e+01 * r + 2.209460984245205e+02) * r - 2.759285104469687e+02) * r +
              1.383577518672690e+02) *
                 r -
             3.066479806614716e+01) *
                r +
            2.506628277459239e+00) *
           q /
           (((((-5.447609879822406e+01 * r + 1.615858368580409e+02) * r - 1.556989798598866e+02) * r +
              6.680131188771972e+01) *
                 r -
             1.328068155288572e+01) *
                r +
            1);
}

// Levels of one band at two frame lengths.
struct BandLevels {
    std::vector<double> fine,
        coarse;  // dB, at kFrameS (or longer in narrow bands), and at the longest of them
    double power = 0;
};

struct Analysis {
    std::vector<BandLevels> bands;
    double fine_s = kFineFrameS;
};

std::vector<double> corners_at(double rate_hz) {
    std::vector<double> corners;
    for (const double hz : kCrossoversHz) {
        if (hz < 0.4 * rate_hz) corners.push_back(hz);
    }
    return corners;
}

Analysis analysed(const std::vector<double>& sound, double rate_hz) {
    Analysis a;
    const std::vector<double> corners = corners_at(rate_hz);
    const auto coarse =
        static_cast<std::size_t>(std::max(kFineFrameS, kFramesPerBandwidth / corners[0]) * rate_hz);
    a.bands.resize(corners.size() + 1);
    for (std::size_t b = 0; b < a.bands.size(); ++b) {
        const double low = b > 0 ? corners[b - 1] : 0, high = b < corners.size() ? corners[b] : 0.5 * rate_hz;
        const auto fine =
            static_cast<std::size_t>(std::max(kFineFrameS, kFramesPerBandwidth / (high - low)) * rate_hz);
        const std::vector<double> x = band_of(sound, b, corners, rate_hz);
        for (const double v : x) a.bands[b].power += v * v / static_cast<double>(x.size());
        a.bands[b].fine = frame_levels_db(x, fine);
        a.bands[b].coarse = frame_levels_db(x, coarse);
    }
    return a;
}

double deviation(const std::vector<double>& x) {
    double mean = 0, square = 0;
    for (const double v : x) mean += v;
    mean /= static_cast<double>(x.size());
    for (const double v : x) square += (v - mean) * (v - mean);
    return std::sqrt(square / static_cast<double>(x.size()));
}

// Maps levels to Gaussian numbers of the same order.
std::vector<double> gaussianized(const std::vector<double>& levels) {
    std::vector<std::size_t> order(levels.size());
    for (std::size_t n = 0; n < order.size(); ++n) order[n] = n;
    std::ranges::sort(order, [&](std::size_t a, std::size_t b) {
        return levels[a] != levels[b] ? levels[a] < levels[b] : a < b;
    });
    std::vector<double> g(levels.size());
    for (std::size_t n = 0; n < order.size(); ++n) {
        g[order[n]] = normal_quantile((static_cast<double>(n) + 0.5) / static_cast<double>(order.size()));
    }
    return g;
}

double correlation(const std::vector<double>& a, const std::vector<double>& b, std::size_t lag = 0) {
    const std::size_t count = std::min(a.size(), b.size());
    if (count <= lag + 1) return 0;
    double ab = 0, aa = 0, bb = 0;
    for (std::size_t n = lag; n < count; ++n) {
        ab += a[n] * b[n - lag];
        aa += a[n] * a[n];
        bb += b[n - lag] * b[n - lag];
    }
    return aa * bb > 0 ? ab / std::sqrt(aa * bb) : 0;
}

// Returns the distribution of the levels at g = -4 ... 4, with deviations from the middle scaled by `shrink`.
std::vector<double> level_table(std::vector<double> levels, double shrink) {
    std::ranges::sort(levels);
    const auto count = static_cast<double>(levels.size());
    std::vector<double> table(kLevelSteps);
    const double middle = levels[levels.size() / 2];
    for (std::size_t n = 0; n < table.size(); ++n) {
        const double g = -kLevelReach + 0.5 * static_cast<double>(n);
        std::size_t rank = 0;
        while (rank + 1 < levels.size() && normal_quantile((static_cast<double>(rank) + 0.5) / count) < g)
            ++rank;
        table[n] = middle + shrink * (levels[rank] - middle);
    }
    return table;
}

// Returns the shares of the memory times that explain an autocorrelation best, by projected coordinate
// descent. `real` is the share of the variance that is not noise of the frames; its unexplained rest goes to
// a memory shorter than a frame.
std::vector<double> memory_shares(const std::vector<double>& g, double frame_s, double real) {
    constexpr std::array<std::size_t, 10> kLags{1, 2, 3, 5, 8, 12, 20, 32, 50, 80};
    std::vector<double> w(kMemoryS.size(), 0.25);
    const auto basis = [&](std::size_t lag, std::size_t m) {
        return math::exp(-static_cast<double>(lag) * frame_s / kMemoryS[m]);
    };
    std::array<double, kLags.size()> wanted;
    for (std::size_t n = 0; n < kLags.size(); ++n) wanted[n] = correlation(g, g, kLags[n]);
    for (int round = 0; round < 300; ++round) {
        for (std::size_t m = 0; m < w.size(); ++m) {
            double slope = 0, curve = 1e-9;
            for (std::size_t n = 0; n < kLags.size(); ++n) {
                double rest = wanted[n];
                for (std::size_t k = 0; k < w.size(); ++k) {
                    if (k != m) rest -= w[k] * basis(kLags[n], k);
                }
                slope += rest * basis(kLags[n], m);
                curve += basis(kLags[n], m) * basis(kLags[n], m);
            }
            w[m] = std::max(slope / curve, 0.0);
        }
    }
    double sum = 0;
    for (const double v : w) sum += v;
    w[0] += std::max(real - sum, 0.0);
    sum = std::max(sum, real);
    for (double& v : w) v = sum > 0 ? v / sum : 1.0 / static_cast<double>(w.size());
    return w;
}

std::vector<double> joined(const auto& pieces) {
    std::vector<double> all;
    for (const auto& piece : pieces) all.insert(all.end(), piece.begin(), piece.end());
    return all;
}

std::vector<double> plain_noise(const ArModel& model, std::size_t count, std::uint64_t seed) {
    ModelNoise noise(model, seed);
    std::vector<double> x(count);
    noise.render(0, x);
    return x;
}

// Returns the prediction error of the model with mean square 1. `scale` becomes its normalisation factor.
std::vector<double> residual_of(const std::vector<double>& x, const std::vector<double>& a, double& scale) {
    std::vector<double> e(x.size());
    double square = 0;
    for (std::size_t n = 0; n < x.size(); ++n) {
        double v = x[n];
        for (std::size_t k = 0; k < std::min(a.size(), n); ++k) v += a[k] * x[n - 1 - k];
        e[n] = v;
        square += v * v;
    }
    scale = square > 0 ? std::sqrt(static_cast<double>(e.size()) / square) : 0;
    for (double& v : e) v *= scale;
    return e;
}

// Inverse of residual_of().
std::vector<double> filtered(const std::vector<double>& e, const std::vector<double>& a, double scale) {
    std::vector<double> x(e.size());
    for (std::size_t n = 0; n < e.size(); ++n) {
        double v = scale > 0 ? e[n] / scale : 0;
        for (std::size_t k = 0; k < std::min(a.size(), n); ++k) v -= a[k] * x[n - 1 - k];
        x[n] = v;
    }
    return x;
}

}  // namespace

GrainModel take_grains(std::vector<double>& residual, double sample_rate_hz, double speed_mm_per_s) {
    GrainModel grains;
    const auto reach = static_cast<std::size_t>(std::max(kGrainReachS * sample_rate_hz, 2.0));
    const auto around = static_cast<std::size_t>(kSurroundingsS * sample_rate_hz);
    std::vector<std::size_t> places;
    std::vector<double> sizes, floors, window;
    double energy = 0;
    for (const double v : residual) energy += v * v;
    for (std::size_t begin = 0; begin + around <= residual.size(); begin += around) {
        // The median absolute value of a Gaussian is 0.6745 of its deviation.
        const std::size_t from = begin > around / 2 ? begin - around / 2 : 0;
        const std::size_t to = std::min(residual.size(), begin + 3 * around / 2);
        window.clear();
        for (std::size_t n = from; n < to; ++n) window.push_back(std::abs(residual[n]));
        std::ranges::nth_element(window, window.begin() + static_cast<std::ptrdiff_t>(window.size() / 2));
        const double floor = kGrainThreshold * window[window.size() / 2] / 0.6745;
        for (std::size_t n = std::max(begin, reach); n < begin + around && n + reach < residual.size(); ++n) {
            const double size = std::abs(residual[n]);
            if (!(size > floor)) continue;
            bool largest = true;
            double near = 0, core = 0;
            for (std::size_t m = n - reach; m <= n + reach; ++m) {
                largest = largest && std::abs(residual[m]) <= size;
                near += residual[m] * residual[m];
                if (m + 2 >= n && m <= n + 2) core += residual[m] * residual[m];
            }
            if (!largest || core < kGrainConcentration * near) continue;
            places.push_back(n);
            sizes.push_back(std::copysign(std::sqrt(near), residual[n]));
            floors.push_back(floor / kGrainThreshold);
            n += reach;
        }
    }
    if (places.size() < kFewestGrains) return grains;
    const CounterNoise fill(1);
    double taken = 0, last_gap = 0, gaps = 0, squares = 0;
    for (std::size_t k = 0; k < places.size(); ++k) {
        for (std::size_t m = places[k] - reach; m <= places[k] + reach; ++m) {
            taken += residual[m] * residual[m];
            residual[m] = floors[k] * fill.gaussian(m);
        }
        if (k == 0) continue;
        last_gap = static_cast<double>(places[k] - places[k - 1]);
        gaps += last_gap;
        squares += last_gap * last_gap;
    }
    // Impulses, white like the noise between them: the filter of the model colours both.
    grains.shape = {1};
    const auto count = static_cast<double>(places.size() - 1);
    const double mean = gaps / count;
    grains.scatter = std::min(std::sqrt(std::max(squares / count - mean * mean, 0.0)) / mean, 1.0);
    // Random grains that are closer than the reach are found as one grain.
    const double rate = static_cast<double>(places.size()) / static_cast<double>(residual.size());
    grains.per_mm =
        rate / (1 - grains.scatter * rate * static_cast<double>(reach)) * sample_rate_hz / speed_mm_per_s;
    grains.share = std::clamp(taken / energy, 0.0, 1.0);
    std::ranges::sort(sizes);
    // Sizes of all grains. If there are more than the table can hold, each entry is the RMS of neighbouring
    // sizes.
    const std::size_t steps = std::min<std::size_t>(sizes.size(), kMostGrainSizes);
    for (std::size_t n = 0; n < steps; ++n) {
        const std::size_t begin = n * sizes.size() / steps, end = (n + 1) * sizes.size() / steps;
        double sum = 0, energy_of_step = 0;
        for (std::size_t k = begin; k < end; ++k) {
            sum += sizes[k];
            energy_of_step += sizes[k] * sizes[k];
        }
        grains.sizes.push_back(
            std::copysign(std::sqrt(energy_of_step / static_cast<double>(end - begin)), sum));
    }
    std::ranges::sort(grains.sizes);
    return grains;
}

std::optional<TextureModel> learn_texture(PieceSpans pieces, const ArModel& model, double speed_mm_per_s) {
    TextureModel texture;
    const double rate = model.sample_rate_hz;
    const std::vector<double> level = joined(without_slow_level(pieces, rate));
    const std::vector<double> predictor = predictor_of(model.reflection);
    double scale = 1;
    std::vector<double> residual = residual_of(level, predictor, scale);
    texture.grains = take_grains(residual, rate, speed_mm_per_s);

    const Analysis own =
        analysed(texture.grains.sizes.empty() ? level : filtered(residual, predictor, scale), rate);
    const Analysis plain = analysed(plain_noise(model, level.size(), 1), rate);
    double largest = 0;
    std::vector<double> shrinks;
    for (std::size_t b = 0; b < own.bands.size(); ++b) {
        const double measured = deviation(own.bands[b].fine), expected = deviation(plain.bands[b].fine);
        const double true_square = measured * measured - expected * expected;
        largest = std::max(largest, true_square);
        shrinks.push_back(std::sqrt(std::max(true_square, 0.0)) / std::max(measured, 1e-9));
        texture.levels_db.push_back(level_table(own.bands[b].fine, shrinks.back()));
    }
    if (largest < kLeastDeviationDb * kLeastDeviationDb && texture.grains.sizes.empty()) return std::nullopt;
    texture.crossovers_hz = corners_at(rate);

    // Memory times, from all bands with short frames together.
    std::vector<double> together;
    double real = 0, weights = 0;
    for (std::size_t b = 2; b < own.bands.size(); ++b) {
        const std::vector<double> g = gaussianized(own.bands[b].fine);
        together.resize(b == 2 ? g.size() : std::min(g.size(), together.size()));
        const double weight = own.bands[b].power * shrinks[b];
        for (std::size_t n = 0; n < together.size(); ++n) together[n] += weight * g[n];
        real += weight * shrinks[b] * shrinks[b];
        weights += weight;
    }
    texture.weights = memory_shares(together, kFineFrameS, real / std::max(weights, 1e-300));
    for (const double s : kMemoryS) texture.lengths_mm.push_back(s * speed_mm_per_s);

    double coherence = 0;
    int pairs = 0;
    std::vector<std::vector<double>> g;
    for (const BandLevels& band : own.bands) g.push_back(gaussianized(band.coarse));
    for (std::size_t a = 0; a < g.size(); ++a) {
        for (std::size_t b = 0; b < a; ++b) {
            coherence += correlation(g[a], g[b]);
            ++pairs;
        }
    }
    texture.coherence = std::clamp(coherence / std::max(pairs, 1), 0.0, 1.0);
    HeardTexture wanted = heard_texture(level, rate, texture.crossovers_hz);
    // Removing the slow level also removes a part of the texture. Use the geometric mean of the kurtosis with
    // and without the slow level.
    const double with_slow = kurtosis(joined(pieces));
    wanted.kurtosis = std::sqrt(with_slow * std::min(with_slow, wanted.kurtosis));
    return fitted_texture(texture, model, speed_mm_per_s, wanted);
}

}  // namespace tribo::noise
