// SPDX-License-Identifier: MIT
// From measured head responses to the grid.
#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "base/math.hpp"
#include "sound/place/complex.hpp"
#include "sound/place/head.hpp"

namespace tribo::sound {
namespace {

constexpr std::size_t kMostDirections = 100000;
constexpr int kMostTaps = 16384;
constexpr std::size_t kNeighbours = 14;  // among which the triangle around a direction is looked for
// Where a set's level is taken: low enough that a head hardly disturbs the field (a rigid sphere by 0.1 dB on
// average), high enough that loudspeakers still play.
constexpr double kLevelFromHz = 200, kLevelToHz = 400;
// Below the first sets tell of their loudspeaker and room, from the second on of the head that was measured.
constexpr double kBassHz = 400, kBodyHz = 800;
// Directions this far from the median plane tell left from right (sine of 20 degrees).
constexpr double kAside = 0.342;
// How often what the grid leaves of the measurements is put onto it again.
constexpr int kRefinements = 12;

struct Weighted {
    std::size_t index = 0;
    double weight = 0;
};

// Barycentric weights of `d` in the spherical triangle: the solution of [a b c] w = d, scaled to sum 1.
bool is_inside(Vec3 a, Vec3 b, Vec3 c, Vec3 d, double* w) {
    const double volume = dot(a, cross(b, c));
    if (std::abs(volume) < 1e-9) return false;
    w[0] = dot(d, cross(b, c)) / volume;
    w[1] = dot(d, cross(c, a)) / volume;
    w[2] = dot(d, cross(a, b)) / volume;
    constexpr double kRounding = -1e-9;
    if (w[0] < kRounding || w[1] < kRounding || w[2] < kRounding) return false;
    const double sum = w[0] + w[1] + w[2];
    for (int n = 0; n < 3; ++n) w[n] = std::max(w[n], 0.0) / sum;
    return true;
}

// Radius of the circle through three unit vectors, as the squared distance of its plane's pole.
double circle(Vec3 a, Vec3 b, Vec3 c) {
    const Vec3 pole = normalized(cross(b - a, c - a));
    return squared_length(a - (dot(pole, a) < 0 ? -1.0 : 1.0) * pole);
}

// The measured directions that stand for `d`: the corners of the smallest triangle around it; outside of all
// triangles a mean of those near it, the wider the further they are.
std::vector<Weighted> around(const std::vector<Vec3>& all, Vec3 d) {
    std::vector<std::pair<double, std::size_t>> near(all.size());
    for (std::size_t n = 0; n < all.size(); ++n) near[n] = {squared_length(all[n] - d), n};
    const std::size_t few = std::min(kNeighbours, near.size());
    std::partial_sort(near.begin(), near.begin() + static_cast<std::ptrdiff_t>(few), near.end());
    if (near[0].first < 1e-10) return {{near[0].second, 1}};
    double best = 1e300;
    std::vector<Weighted> corners;
    for (std::size_t i = 0; i < few; ++i) {
        for (std::size_t j = i + 1; j < few; ++j) {
            for (std::size_t k = j + 1; k < few; ++k) {
                const std::size_t at[3] = {near[i].second, near[j].second, near[k].second};
                double w[3];
                if (!is_inside(all[at[0]], all[at[1]], all[at[2]], d, w)) continue;
                const double size = circle(all[at[0]], all[at[1]], all[at[2]]);
                if (size >= best) continue;
                best = size;
                corners = {{at[0], w[0]}, {at[1], w[1]}, {at[2], w[2]}};
            }
        }
    }
    if (!corners.empty()) return corners;
    double sum = 0;
    for (const auto& [squared, index] : near) {
        const double weight = math::exp(-4 * (squared - near[0].first) / near[0].first);
        if (weight < 1e-4) continue;
        corners.push_back({index, weight});
        sum += weight;
    }
    for (Weighted& c : corners) c.weight /= sum;
    return corners;
}

// The spectrum of a response at frequencies of another sample rate: a long transform, and cubics between its
// bins.
class Resampled {
  public:
    Resampled(const HrirSet& set, const MinimumPhase& phase)
        : rate_(set.sample_rate_hz),
          bins_(phase.bins()),
          bin_hz_(phase.bin_hz()),
          fourier_(log2_size(set)),
          work_(fourier_.size()) {}

    // Left and right at once; each is turned back so that its peak is at 0, `peak` says from where.
    void at(const float* left, const float* right, std::size_t taps, std::vector<Complex>* spectra,
            std::size_t* peak) {
        std::fill(work_.begin(), work_.end(), 0);
        for (int ear = 0; ear < 2; ++ear) {
            const float* x = ear == 0 ? left : right;
            const auto size = [](float a, float b) { return std::abs(a) < std::abs(b); };
            peak[ear] = static_cast<std::size_t>(std::max_element(x, x + taps, size) - x);
            for (std::size_t k = 0; k < taps; ++k) {
                const auto v = static_cast<double>(x[k]);
                Complex& w = work_[(k + work_.size() - peak[ear]) % work_.size()];
                w = ear == 0 ? Complex{v, w.imag()} : Complex{w.real(), v};
            }
        }
        fourier_.forward(work_);
        const double own_hz = rate_ / static_cast<double>(work_.size());
        for (int ear = 0; ear < 2; ++ear) spectra[ear].resize(bins_);
        for (std::size_t k = 0; k < bins_; ++k) {
            // Beyond what was measured the last of it is held.
            const double place = std::min(bin_hz_ * static_cast<double>(k), 0.49 * rate_) / own_hz;
            const auto whole = static_cast<std::size_t>(place);
            const double t = place - static_cast<double>(whole);
            const std::array<double, 4> weight = cubic_weights(t);
            for (int ear = 0; ear < 2; ++ear) {
                Complex sum;
                for (std::size_t n = 0; n < 4; ++n) {
                    sum += weight[n] * ear_at((whole + work_.size() + n - 1) % work_.size(), ear);
                }
                spectra[ear][k] = sum;
            }
        }
    }

  private:
    // Bins an eighth of a response's own or finer: a cubic through four follows the turning phase.
    static int log2_size(const HrirSet& set) {
        int log2 = 12;
        while ((1 << log2) < 8 * set.taps) ++log2;
        return log2;
    }
    Complex ear_at(std::size_t k, int ear) const {
        const Complex a = work_[k], b = work_[(work_.size() - k) % work_.size()];
        return ear == 0 ? Complex{0.5 * (a.real() + b.real()), 0.5 * (a.imag() - b.imag())}
                        : Complex{0.5 * (a.imag() + b.imag()), 0.5 * (b.real() - a.real())};
    }
    double rate_;
    std::size_t bins_;
    double bin_hz_;
    FourierTransform fourier_;
    std::vector<Complex> work_;
};

void add(const EarResponses& what, double times, EarResponses& to) {
    for (std::size_t ear = 0; ear < 2; ++ear) {
        to.delay_s[ear] += times * what.delay_s[ear];
        for (std::size_t k = 0; k < kHeadTaps; ++k)
            to.taps[ear][k] += static_cast<float>(times) * what.taps[ear][k];
    }
}

// What a set has to be multiplied by to have the level of the free field: 0 dB on average of the logarithms
// over directions and ears.
double gain_to_free_field(const HrirSet& set) {
    constexpr int kTones = 9;
    std::array<Complex, kTones> turn;
    for (int n = 0; n < kTones; ++n) {
        const double hz = kLevelFromHz + (kLevelToHz - kLevelFromHz) * n / (kTones - 1);
        double sine, cosine;
        math::sincos(math::kTwoPi * hz / set.sample_rate_hz, sine, cosine);
        turn[static_cast<std::size_t>(n)] = {cosine, -sine};
    }
    const auto taps = static_cast<std::size_t>(set.taps);
    double logs = 0, sounding = 0;
    for (std::size_t first = 0; first < set.responses.size(); first += taps) {
        double power = 0;
        for (const Complex by : turn) {
            double re = 0, im = 0;
            for (std::size_t k = taps; k-- > 0;) {
                const double was = re;
                re = was * by.real() - im * by.imag() + static_cast<double>(set.responses[first + k]);
                im = was * by.imag() + im * by.real();
            }
            power += (re * re + im * im) / kTones;
        }
        if (!(power > 0)) continue;
        logs += math::log(power);
        ++sounding;
    }
    // A set that is further off than that has no level of its own, and float has its limits.
    constexpr double kMost = 1e6;
    return sounding > 0 ? std::clamp(math::exp(-0.5 * logs / sounding), 1 / kMost, kMost) : 1;
}

// The magnitude of a filter.
double magnitude(const HeadTaps& taps, double hz, double sample_rate_hz) {
    double sine, cosine, re = 0, im = 0;
    math::sincos(math::kTwoPi * hz / sample_rate_hz, sine, cosine);
    for (std::size_t n = kHeadTaps; n-- > 0;) {
        const double was = re;
        re = was * cosine + im * sine + static_cast<double>(taps[n]);
        im = im * cosine - was * sine;
    }
    return std::sqrt(re * re + im * im);
}

// Multiplies by `wanted` over `is` below kBassHz, by nothing from kBodyHz on, along the logarithm in between.
template <class Wanted, class Is>
void correct_bass(std::vector<Complex>& spectrum, double bin_hz, const Wanted& wanted, const Is& is) {
    for (std::size_t k = 0; static_cast<double>(k) * bin_hz < kBodyHz; ++k) {
        const double hz = static_cast<double>(k) * bin_hz, has = is(k, hz);
        if (!(has > 0)) {
            spectrum[k] = {wanted(hz), 0};
            continue;
        }
        const double share = std::clamp((kBodyHz - hz) / (kBodyHz - kBassHz), 0.0, 1.0);
        const double by = math::exp(share * math::log(wanted(hz) / has));
        spectrum[k] = {by * spectrum[k].real(), by * spectrum[k].imag()};
    }
}

// One over the root of the mean power, bin by bin, smoothed over a third octave.
std::vector<double> equalizer_of(std::span<const double> power, double bin_hz) {
    constexpr double kSixthOctave = 1.122462048309373, kMost = 10;  // 20 dB
    std::vector<double> by(power.size(), 1);
    for (std::size_t k = 1; k < by.size(); ++k) {
        const double hz = static_cast<double>(k) * bin_hz;
        const auto first = static_cast<std::size_t>(hz / kSixthOctave / bin_hz + 0.5);
        const auto last =
            std::min(static_cast<std::size_t>(hz * kSixthOctave / bin_hz + 0.5), power.size() - 1);
        double sum = 0;
        for (std::size_t n = first; n <= last; ++n) sum += power[n];
        const double mean = sum / static_cast<double>(last - first + 1);
        by[k] = std::clamp(1 / std::sqrt(std::max(mean, 1e-30)), 1 / kMost, kMost);
    }
    return by;
}

// How long after its response begins an ear hears, s: where it first has a fifth of its peak.
double arrival_s(const HrirSet& set, std::size_t direction, std::size_t ear) {
    const auto taps = static_cast<std::size_t>(set.taps);
    const float* response = set.responses.data() + (2 * direction + ear) * taps;
    float peak = 0;
    for (std::size_t k = 0; k < taps; ++k) peak = std::max(peak, std::abs(response[k]));
    std::size_t first = 0;
    while (first < taps && std::abs(response[first]) < 0.2f * peak) ++first;
    return set.extra_delays_s[2 * direction + ear] + static_cast<double>(first) / set.sample_rate_hz;
}

double power_of(const HrirSet& set, std::size_t direction, std::size_t ear) {
    const auto taps = static_cast<std::size_t>(set.taps);
    const float* response = set.responses.data() + (2 * direction + ear) * taps;
    double power = 0;
    for (std::size_t k = 0; k < taps; ++k) {
        const auto v = static_cast<double>(response[k]);
        power += v * v;
    }
    return power;
}

}  // namespace

Result<void> check_hrirs(const HrirSet& set) {
    const auto bad = [](const std::string& cause) {
        return fail("the head responses " + cause, "try another SOFA file, or the built-in set");
    };
    if (!(set.sample_rate_hz >= 8000 && set.sample_rate_hz <= 384000)) {
        return bad("have no sample rate between 8 and 384 kHz");
    }
    if (set.directions.size() < 4 || set.directions.size() > kMostDirections) {
        return bad("are of " + std::to_string(set.directions.size()) +
                   " directions (4 to 100000 are possible)");
    }
    if (set.taps < 8 || set.taps > kMostTaps) {
        return bad("are " + std::to_string(set.taps) + " samples long (8 to 16384 are possible)");
    }
    const std::size_t responses = 2 * set.directions.size();
    if (set.responses.size() != responses * static_cast<std::size_t>(set.taps) ||
        set.extra_delays_s.size() != responses) {
        return bad("do not have the size that they claim");
    }
    for (const Vec3 d : set.directions) {
        if (!is_finite(d) || std::abs(length(d) - 1) > 1e-3) return bad("come from no direction");
    }
    for (const double d : set.extra_delays_s) {
        if (!(d >= 0 && d <= 1)) return bad("are delayed by less than nothing or more than a second");
    }
    double sum = 0;
    for (const float v : set.responses) {
        if (!std::isfinite(v) || std::abs(v) > 1e6f) return bad("hold a number that is none");
        sum += std::abs(static_cast<double>(v));
    }
    if (sum == 0) return bad("are silent");
    return {};
}

EarOrder ear_order(const HrirSet& set) {
    // A source on the right comes first and louder to the right ear.
    double leads = 0, louder = 0;
    for (std::size_t n = 0; n < set.directions.size(); ++n) {
        const double right = set.directions[n].x;
        if (std::abs(right) < kAside) continue;
        const double side = right > 0 ? 1 : -1;
        const double lead_s = side * (arrival_s(set, n, 0) - arrival_s(set, n, 1));
        const double left = power_of(set, n, 0), other = power_of(set, n, 1);
        leads += lead_s > 0 ? 1 : lead_s < 0 ? -1 : 0;
        louder += side * (other - left) > 0 ? 1 : side * (other - left) < 0 ? -1 : 0;
    }
    if (leads > 0 && louder > 0) return EarOrder::right;
    if (leads < 0 && louder < 0) return EarOrder::exchanged;
    return EarOrder::unclear;
}

void exchange_ears(HrirSet& set) {
    const auto taps = static_cast<std::ptrdiff_t>(set.taps);
    for (std::size_t n = 0; n < set.directions.size(); ++n) {
        const auto left = set.responses.begin() + static_cast<std::ptrdiff_t>(2 * n) * taps;
        std::swap_ranges(left, left + taps, left + taps);
        std::swap(set.extra_delays_s[2 * n], set.extra_delays_s[2 * n + 1]);
    }
}

Result<std::shared_ptr<const Head>> Head::measured(const HrirSet& set, double sample_rate_hz,
                                                   Equalization equalization) {
    if (auto ok = check_hrirs(set); !ok) return std::unexpected(ok.error());
    MinimumPhase phase(sample_rate_hz);
    Resampled resampled(set, phase);
    const double gain = gain_to_free_field(set);
    const std::shared_ptr<const Head> sphere = Head::sphere(sample_rate_hz);
    EarResponses round_head;
    std::vector<EarResponses> by_direction;
    std::vector<Complex> spectra[2];
    std::size_t peak[2];
    const auto respond = [&](std::size_t n) {
        const auto taps = static_cast<std::size_t>(set.taps);
        const float* left = set.responses.data() + 2 * n * taps;
        resampled.at(left, left + taps, taps, spectra, peak);
        for (std::vector<Complex>& spectrum : spectra) {
            for (Complex& v : spectrum) v *= gain;
        }
    };
    std::vector<double> equalizer;
    if (equalization == Equalization::diffuse) {
        std::vector<double> power(phase.bins());
        const double share = 0.5 / static_cast<double>(set.directions.size());
        for (std::size_t n = 0; n < set.directions.size(); ++n) {
            respond(n);
            for (const std::vector<Complex>& spectrum : spectra) {
                for (std::size_t k = 0; k < power.size(); ++k) power[k] += share * squared(spectrum[k]);
            }
        }
        equalizer = equalizer_of(power, phase.bin_hz());
    }
    for (std::size_t n = 0; n < set.directions.size(); ++n) {
        respond(n);
        for (std::size_t k = 0; k < equalizer.size(); ++k) {
            for (std::vector<Complex>& spectrum : spectra) spectrum[k] *= equalizer[k];
        }
        // Twice: the filters are shorter than the measurement, and what they leave of its bass is corrected
        // too.
        sphere->hear(2 * set.directions[n], round_head);
        EarResponses made;
        for (int pass = 0; pass < 2; ++pass) {
            for (std::size_t ear = 0; ear < 2; ++ear) {
                correct_bass(
                    spectra[ear], phase.bin_hz(),
                    [&](double hz) { return magnitude(round_head.taps[ear], hz, sample_rate_hz); },
                    [&](std::size_t k, double hz) {
                        return pass == 0 ? std::sqrt(squared(spectra[ear][k]))
                                         : magnitude(made.taps[ear], hz, sample_rate_hz);
                    });
            }
            if (pass == 0)
                made.taps = phase.filters(spectra[0], spectra[1]);
            else
                made = phase.split(spectra[0], spectra[1]);
        }
        by_direction.push_back(made);
        for (std::size_t ear = 0; ear < 2; ++ear) {
            by_direction.back().delay_s[ear] +=
                set.extra_delays_s[2 * n + ear] + static_cast<double>(peak[ear]) / set.sample_rate_hz;
        }
    }
    const auto head = std::shared_ptr<Head>(new Head(sample_rate_hz, kHeadTaps));
    std::vector<std::vector<Weighted>> corners;
    for (int r = 0; r < kRows; ++r) {
        for (int c = 0; c < kColumns; ++c) corners.push_back(around(set.directions, grid_direction(r, c)));
    }
    // Twice interpolated, a measurement between the grid's directions would come out blurred: what is missing
    // there is put onto the grid until the grid gives the measurements back.
    std::vector<EarResponses> missing = std::move(by_direction);
    const std::vector<EarResponses> wanted = missing;
    for (int round = 0;; ++round) {
        for (std::size_t n = 0; n < corners.size(); ++n) {
            for (const Weighted& w : corners[n]) add(missing[w.index], w.weight, head->nodes_[n]);
        }
        if (round == kRefinements) break;
        EarResponses heard;
        for (std::size_t n = 0; n < wanted.size(); ++n) {
            head->hear(2 * set.directions[n], heard);
            missing[n] = wanted[n];
            add(heard, -1, missing[n]);
        }
    }
    head->finish();
    return std::shared_ptr<const Head>(head);
}

}  // namespace tribo::sound
