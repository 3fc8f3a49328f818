// SPDX-License-Identifier: MIT
#include "noise/learn/learning.hpp"

#include <algorithm>
#include <cmath>
#include <complex>

#include "base/math.hpp"
#include "base/text/decimal.hpp"
#include "base/text/limit_text.hpp"
#include "noise/learn/sound_statistics.hpp"
#include "noise/learn/texture_learning.hpp"
#include "noise/model/fourier.hpp"
#include "noise/model/levinson.hpp"

namespace tribo::noise {
namespace {

constexpr double kWhite = 1e-11;         // added to r_0, because the top of a band-limited recording is empty
constexpr double kHeldOutBlockS = 0.25;  // alternate blocks are used for fitting and for testing
constexpr double kSame = 1e-9;           // relative difference of equal speeds and forces

// For the bass: 2.7 Hz at 44.1 kHz, fine enough for the lowest third octave and for a mains line.
constexpr std::size_t kBassFrame = 16384;
constexpr std::size_t kBassOrder = 100;
constexpr double kLeastBass = 1e-6;  // share of the power; below it there is no bass model
constexpr double kBassToleranceDb = 1, kLowestBandHz = 63;
constexpr double kThirdOctave = 1.2589254117941673, kSixthOctave = 1.1220184543019633;  // 10^0.1, 10^0.05

using Pieces = std::vector<std::span<const double>>;

// Recordings at one speed and force.
struct Group {
    double speed = 0, force = 0;
    std::vector<std::size_t> members;  // indices of the prepared recordings
};

bool same(double a, double b) {
    return std::abs(a - b) <= kSame * std::max(a, b);
}

std::vector<Group> grouped(std::span<const Recording> recordings) {
    std::vector<Group> groups;
    for (std::size_t n = 0; n < recordings.size(); ++n) {
        const Recording& r = recordings[n];
        const auto found = std::ranges::find_if(groups, [&](const Group& g) {
            return same(g.speed, r.speed_mm_per_s) && same(g.force, r.force_n);
        });
        if (found != groups.end()) {
            found->members.push_back(n);
        } else {
            groups.push_back({r.speed_mm_per_s, r.force_n, {n}});
        }
    }
    std::ranges::sort(groups, [](const Group& a, const Group& b) {
        return same(a.force, b.force) ? a.speed < b.speed : a.force < b.force;
    });
    return groups;
}

// Returns every other block of the pieces.
Pieces alternate(const Pieces& pieces, std::size_t block, std::size_t which) {
    Pieces half;
    std::size_t n = 0;
    for (const std::span<const double> piece : pieces) {
        // Whole blocks only: a short rest would be mostly window.
        const std::size_t own = std::max<std::size_t>(std::min(block, piece.size() / 2), 1);
        for (std::size_t at = 0; at + own <= piece.size(); at += own, ++n) {
            if (n % 2 == which) half.push_back(piece.subspan(at, own));
        }
    }
    return half;
}

// Divides a power spectrum by that of the high-pass, and continues it flat below the corner.
void restore_below(std::vector<double>& power, double rate_hz, double highpass_hz) {
    if (!(highpass_hz > 0)) return;
    const double corner = math::tan(math::kPi * highpass_hz / rate_hz);
    const auto last = static_cast<double>(power.size() - 1);
    const auto first = static_cast<std::size_t>(std::ceil(2 * highpass_hz / rate_hz * last));
    for (std::size_t k = first; k + 1 < power.size(); ++k) {
        const double w = math::tan(0.5 * math::kPi * static_cast<double>(k) / last) / corner;
        const double w4 = w * w * w * w;
        power[k] *= (1 + w4) / w4;
    }
    // The mean over the half octave above the corner.
    const std::size_t end = std::min(first + std::max<std::size_t>(first / 2, 2), power.size());
    double mean = 0;
    for (std::size_t k = first; k < end; ++k) mean += power[k] / static_cast<double>(end - first);
    for (std::size_t k = 0; k < first; ++k) power[k] = mean;
}

// Mean power spectrum under Hann windows of `frame` samples (a power of two) with half overlap, bins 0 ...
// `frame`, times `weight`. Pieces shorter than `shortest` are skipped.
struct WindowedPower {
    std::vector<double> bins;
    double weight = 0;
};
WindowedPower windowed_power(std::span<const std::span<const double>> pieces, double sample_rate_hz,
                             double highpass_hz, std::size_t frame, std::size_t shortest) {
    // Frames are padded to twice their length, so that the correlation does not wrap around.
    WindowedPower power{std::vector<double>(frame + 1)};
    std::vector<std::complex<double>> x(2 * frame);
    for (const std::span<const double> piece : pieces) {
        const std::size_t length = std::min(piece.size(), frame);
        if (length < shortest) continue;  // mostly window
        for (std::size_t at = 0; at + length <= piece.size(); at += std::max<std::size_t>(length / 2, 1)) {
            std::ranges::fill(x, 0.0);
            for (std::size_t n = 0; n < length; ++n) {
                const double phase =
                    math::kTwoPi * (static_cast<double>(n) + 0.5) / static_cast<double>(length);
                const double hann = 0.5 - 0.5 * math::cos(phase);
                x[n] = hann * piece[at + n];
                power.weight += hann * hann;
            }
            fourier(x);
            for (std::size_t k = 0; k < power.bins.size(); ++k) power.bins[k] += std::norm(x[k]);
        }
    }
    restore_below(power.bins, sample_rate_hz, highpass_hz);
    return power;
}

// Returns the distance in dB between the models of one half of the sound and the spectrum of the other half,
// for orders 1 ... most, as the mean of both directions. The measure is the spectrum, which is heard, and not
// the prediction error: an impulsive sound is predicted from a few samples, but so few poles do not give its
// spectrum.
std::vector<double> held_out_errors(const Pieces& pieces, double rate_hz, double highpass_hz, int most) {
    const auto block = static_cast<std::size_t>(kHeldOutBlockS * rate_hz);
    const std::vector<double> hz = spectrum_hz(rate_hz);
    std::vector<double> r[2], heard_db[2];
    for (std::size_t half = 0; half < 2; ++half) {
        const Pieces own = alternate(pieces, block, half);
        r[half] = windowed_autocorrelation(own, rate_hz, highpass_hz, most);
        heard_db[half] = spectrum_db(own);
    }
    std::vector<double> errors(static_cast<std::size_t>(most));
    if (!(r[0][0] > 0) || !(r[1][0] > 0)) return errors;
    for (std::size_t fold = 0; fold < 2; ++fold) {
        const std::vector<double> k = levinson(r[fold], kWhite);
        for (std::size_t p = 1; p <= errors.size(); ++p) {
            const ArModel model{rate_hz, {k.begin(), k.begin() + static_cast<std::ptrdiff_t>(p)}};
            errors[p - 1] += 0.5 * shape_distance_db(spectrum_db(model, hz), heard_db[1 - fold], hz);
        }
    }
    return errors;
}

// Returns the smallest order whose error on held-out sound is close to that of the best order.
int chosen_order(std::span<const double> errors) {
    const double best = *std::ranges::min_element(errors);
    std::size_t order = 1;
    while (errors[order - 1] > best + kOrderToleranceDb) ++order;
    return static_cast<int>(order);
}

// Returns the joint autocorrelation of all members of a group, at the sample rate of the first.
std::vector<double> group_autocorrelation(const Group& group, std::span<const PreparedRecording> prepared,
                                          double highpass_hz, int order) {
    std::vector<double> sum(static_cast<std::size_t>(order) + 1);
    const double rate_hz = prepared[group.members[0]].sample_rate_hz;
    for (const std::size_t n : group.members) {
        const double own_hz = prepared[n].sample_rate_hz;
        std::vector<double> r = windowed_autocorrelation(prepared[n].pieces(), own_hz, highpass_hz, order);
        if (own_hz != rate_hz) {
            const double power = r[0];
            const ArModel model = at_rate({own_hz, levinson(r, kWhite)}, rate_hz);
            r = autocorrelation_of(model.reflection, order);
            for (double& v : r) v *= power;
        }
        for (std::size_t k = 0; k < sum.size(); ++k)
            sum[k] += r[k] / static_cast<double>(group.members.size());
    }
    return sum;
}

// Returns the member with the most sound.
const PreparedRecording& longest_of(const Group& group, std::span<const PreparedRecording> prepared) {
    const PreparedRecording* longest = &prepared[group.members[0]];
    for (const std::size_t n : group.members) {
        if (prepared[n].sound.size() > longest->sound.size()) longest = &prepared[n];
    }
    return *longest;
}

VoiceModel group_model(const Group& group, std::span<const PreparedRecording> prepared,
                       const LearningOptions& options, int order) {
    VoiceModel model;
    model.speed_mm_per_s = group.speed;
    model.force_n = group.force;
    const std::vector<double> r = group_autocorrelation(group, prepared, options.highpass_hz, order);
    model.level_db = 10 * math::log10(r[0]);
    model.spectrum = {prepared[group.members[0]].sample_rate_hz, levinson(r, kWhite)};
    const PreparedRecording& longest = longest_of(group, prepared);
    const Pieces pieces = longest.pieces();
    const bool one_rate = longest.sample_rate_hz == model.spectrum.sample_rate_hz;
    if (options.method == Method::burg && one_rate) model.spectrum.reflection = burg(pieces, order);
    if (one_rate) model.bass = learn_bass(pieces, model.spectrum, options.highpass_hz);
    if (options.textures && one_rate) model.texture = learn_texture(pieces, model.spectrum, group.speed);
    return model;
}

Result<std::vector<PreparedRecording>> prepared_all(std::span<const Recording> recordings,
                                                    const LearningOptions& options, Learned& learned) {
    if (recordings.empty()) return fail("no recording was given", "give at least one");
    std::vector<PreparedRecording> prepared;
    for (const Recording& r : recordings) {
        const auto in_range = [&](const Limit& limit, double value) -> Result<void> {
            if (limit.range.contains(value)) return {};
            return fail_at(r.name, 0, 0, out_of_range(limit, value), range_remedy(limit));
        };
        if (auto good = in_range(kLimits.finger_speed, r.speed_mm_per_s); !good)
            return std::unexpected(good.error());
        if (auto good = in_range(kLimits.finger_force, r.force_n); !good)
            return std::unexpected(good.error());
        Result<PreparedRecording> one = prepare(r, options.highpass_hz);
        if (!one) return std::unexpected(one.error());
        learned.warnings.insert(learned.warnings.end(), one->warnings.begin(), one->warnings.end());
        prepared.push_back(*std::move(one));
    }
    return prepared;
}

}  // namespace

std::vector<double> windowed_autocorrelation(std::span<const std::span<const double>> pieces,
                                             double sample_rate_hz, double highpass_hz, int lags) {
    const std::size_t shortest = shortest_of_use(pieces, 2 * (static_cast<std::size_t>(lags) + 1));
    const WindowedPower power =
        windowed_power(pieces, sample_rate_hz, highpass_hz, kAutocorrelationFrame, shortest);
    const std::size_t half = power.bins.size() - 1;
    std::vector<std::complex<double>> x(2 * half);
    for (std::size_t k = 0; k < x.size(); ++k) x[k] = power.bins[k <= half ? k : 2 * half - k];
    fourier(x);
    std::vector<double> r(static_cast<std::size_t>(lags) + 1);
    for (std::size_t k = 0; k < r.size(); ++k) {
        r[k] = x[k].real() / (static_cast<double>(x.size()) * std::max(power.weight, 1e-300));
    }
    return r;
}

std::optional<BassModel> learn_bass(std::span<const std::span<const double>> pieces, const ArModel& whole,
                                    double highpass_hz) {
    const double rate_hz = whole.sample_rate_hz;
    const auto divisor = static_cast<std::size_t>(std::floor(rate_hz / kBassRateHz + 0.5));
    if (divisor < 2) return std::nullopt;
    const double bass_rate_hz = rate_hz / static_cast<double>(divisor);
    const std::vector<double> power =
        windowed_power(pieces, rate_hz, highpass_hz, kBassFrame, kBassFrame).bins;
    const double bin_hz = 0.5 * rate_hz / static_cast<double>(power.size() - 1);
    std::vector<double> r(kBassOrder + 1);
    double all = 0;
    for (std::size_t k = 1; k + 1 < power.size(); ++k) {
        const double hz = static_cast<double>(k) * bin_hz;
        all += power[k];
        if (hz >= 0.5 * bass_rate_hz) continue;
        const double bass = power[k] * bass_share(hz);
        for (std::size_t lag = 0; lag < r.size(); ++lag) {
            r[lag] += bass * math::cos(math::kTwoPi * hz / bass_rate_hz * static_cast<double>(lag));
        }
    }
    if (!(r[0] > kLeastBass * all)) return std::nullopt;
    BassModel model{{bass_rate_hz, levinson(r, kWhite)}, r[0] / all};

    // Return a bass model only if the error of the whole model, over third octaves, is audible.
    double error = 0, bands = 0;
    for (double middle = kLowestBandHz; middle < kBassHz; middle *= kThirdOctave) {
        double heard = 0, modelled = 0;
        const double low = middle / kSixthOctave, high = middle * kSixthOctave;
        for (auto k = static_cast<std::size_t>(std::ceil(low / bin_hz));
             static_cast<double>(k) * bin_hz < high; ++k) {
            heard += power[k] / all;
            modelled += power_at(whole, static_cast<double>(k) * bin_hz) * bin_hz / (0.5 * rate_hz);
        }
        if (!(heard > 0 && modelled > 0)) continue;
        const double db = 10 * math::log10(heard / modelled);
        error += db * db;
        ++bands;
    }
    if (bands == 0 || std::sqrt(error / bands) < kBassToleranceDb) return std::nullopt;
    return model;
}

Result<Learned> learn(std::span<const Recording> recordings, const LearningOptions& options) {
    Learned learned;
    const Result<std::vector<PreparedRecording>> prepared = prepared_all(recordings, options, learned);
    if (!prepared) return std::unexpected(prepared.error());
    const std::vector<Group> groups = grouped(recordings);
    if (options.order) {
        learned.order = *options.order;
    } else {
        std::vector<double> errors(kMostLearnedOrder);
        for (const PreparedRecording& p : *prepared) {
            const std::vector<double> own =
                held_out_errors(p.pieces(), p.sample_rate_hz, options.highpass_hz, kMostLearnedOrder);
            for (std::size_t n = 0; n < errors.size(); ++n) {
                errors[n] += own[n] / static_cast<double>(prepared->size());
            }
        }
        learned.order = chosen_order(errors);
        learned.held_out_db = errors;
    }
    learned.recordings.resize(recordings.size());
    for (std::size_t g = 0; g < groups.size(); ++g) {
        learned.voices.models.push_back(group_model(groups[g], *prepared, options, learned.order));
        for (const std::size_t n : groups[g].members) {
            const PreparedRecording& p = (*prepared)[n];
            learned.recordings[n] = {recordings[n].name,
                                     static_cast<int>(g),
                                     static_cast<double>(p.sound.size()) / p.sample_rate_hz,
                                     p.level_db,
                                     p.peak_db,
                                     p.silent_share,
                                     p.clipped_share};
        }
    }
    learned.voices.law = fit_level_law(learned.voices.models);
    return learned;
}

}  // namespace tribo::noise
