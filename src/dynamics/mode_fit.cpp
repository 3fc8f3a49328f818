// SPDX-License-Identifier: MIT
#include "dynamics/mode_fit.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <tuple>

#include "base/limits.hpp"
#include "base/math.hpp"
#include "base/text/limit_text.hpp"
#include "dynamics/modal_model.hpp"

namespace tribo::dynamics {
namespace {

using Complex = std::complex<double>;

// Damping of the modes that are tried; those in between are found by the refinement.
constexpr std::array kDampings{0.002, 0.004, 0.008, 0.016, 0.032, 0.064, 0.128, 0.256};
// A mode that is tried is compared with what is left within so many half bandwidths of its frequency.
constexpr double kReach = 6;
// Of an F-test of a mode in its surroundings. Noise reaches about 8 somewhere among thousands of points.
constexpr double kLeastF = 18;
constexpr double kCertain = 1e300;
// A lower peak, as a share of the largest response, is no mode but what the model does not know.
constexpr double kLeastPeak = 0.01;
// What is left of a response without noise after rounding, as a share of it.
constexpr double kRounding = 1e-20;
constexpr std::size_t kLeastPoints = 12;
constexpr std::size_t kLeastAround = 10;  // points on each side in an F-test
constexpr int kFirstSteps = 12;           // of the refinement, until the best of several modes is chosen

// The signs in which responses come: as they should first.
struct Sense {
    bool time = false, force = false;
};
constexpr std::array kSenses{Sense{false, false}, Sense{false, true}, Sense{true, false}, Sense{true, true}};

Complex turned(Complex h, Sense sense) {
    if (sense.time) h = std::conj(h);
    return sense.force ? -h : h;
}

// How well a mode of one frequency and damping explains what is left, in each of kSenses.
struct Tried {
    double hz = 0, damping = 0, size = 0;  // size: sum of squares of the answer of a unit mode
    std::array<double, kSenses.size()> match{};

    double compliance(std::size_t sense) const { return match[sense] / size; }
    // Of the sum of squares.
    double gain(std::size_t sense) const { return match[sense] > 0 ? match[sense] * match[sense] / size : 0; }
};

Tried try_mode(const Response& response, std::span<const Complex> left, double hz, double damping) {
    constexpr std::size_t kMostLookedAt = 400;
    const std::span<const double> all = response.hz;
    const double reach = kReach * std::max(damping * hz, response.step_hz);
    const auto from = static_cast<std::size_t>(std::ranges::lower_bound(all, hz - reach) - all.begin());
    const auto to = static_cast<std::size_t>(std::ranges::upper_bound(all, hz + reach) - all.begin());
    const std::size_t stride = 1 + (to - from) / kMostLookedAt;
    // Less the means: what is even across the peak belongs to others.
    Complex mean_g{}, mean_h{};
    double gg = 0, same = 0, other = 0, weights = 0;
    std::size_t count = 0;
    for (std::size_t n = from; n < to; n += stride, ++count) {
        const Complex g = unit_answer(all[n] / hz, damping), h = left[n];
        const double w = response.weight[n] * response.weight[n];
        mean_g += w * g;
        mean_h += w * h;
        gg += w * std::norm(g);
        same += w * (g.real() * h.real() + g.imag() * h.imag());
        other += w * (g.real() * h.real() - g.imag() * h.imag());
        weights += w;
    }
    Tried tried{hz, damping};
    if (count < 4 || !(weights > 0)) return tried;
    const double re = mean_g.real() * mean_h.real() / weights, im = mean_g.imag() * mean_h.imag() / weights;
    gg -= std::norm(mean_g) / weights;
    same -= re + im;
    other -= re - im;
    if (!(gg > 0)) return tried;
    const auto scale = static_cast<double>(stride);
    tried.size = scale * gg;
    tried.match = {scale * same, -scale * same, scale * other, -scale * other};
    return tried;
}

std::vector<Tried> try_modes(const Response& response, std::span<const Complex> left) {
    std::vector<Tried> all;
    for (const double damping : kDampings) {
        double next_hz = 0;
        for (const double hz : response.hz) {
            if (hz < next_hz || damping < response.least_damping(hz)) continue;
            next_hz = hz * (1 + damping / 2);
            const Tried tried = try_mode(response, left, hz, damping);
            if (tried.size > 0) all.push_back(tried);
        }
    }
    return all;
}

// The best ones, each of another peak.
std::vector<ModalModel::Mode> candidates(const Response& response, std::span<const Complex> left) {
    std::vector<Tried> all = try_modes(response, left);
    std::ranges::sort(all, {}, [](const Tried& t) { return std::tuple(-t.gain(0), t.hz, t.damping); });
    constexpr std::size_t kTried = 3;
    std::vector<ModalModel::Mode> chosen;
    for (const Tried& c : all) {
        if (chosen.size() == kTried || !(c.gain(0) > 0)) break;
        const bool again = std::ranges::any_of(chosen, [&](const ModalModel::Mode& other) {
            return std::abs(c.hz - other.hz) < other.damping * other.hz + 2 * response.step_hz;
        });
        if (!again) chosen.push_back({c.hz, c.damping, c.compliance(0)});
    }
    return chosen;
}

// The variance of the errors is a (1 + b |h|^2): noise of the electronics, and noise that grows with the
// blow. The weights of `response` become those of the most likely b.
void weigh_by_noise(const ModalModel& model, Response& response) {
    const std::vector<Complex> errors = model.errors();
    const auto count = static_cast<double>(errors.size());
    std::vector<double> square(errors.size()), size(errors.size());
    double mean_size = 0;
    for (std::size_t n = 0; n < errors.size(); ++n) {
        const double w = response.measured(response.hz[n]) * response.measured(response.hz[n]);
        square[n] = w * std::norm(errors[n]);
        size[n] = w * std::norm(response.h[n] - errors[n]);
        mean_size += size[n] / count;
    }
    if (!(mean_size > 0)) return;
    constexpr int kSteps = 20;
    constexpr double kStep = 4;
    double best = 0, least = std::numeric_limits<double>::infinity(), grown = 0.01 / mean_size;
    for (int step = 0; step <= kSteps; ++step) {
        const double b = step == 0 ? 0 : grown;
        if (step > 0) grown *= kStep;
        double even = 0, logarithms = 0;
        for (std::size_t n = 0; n < errors.size(); ++n) {
            const double variance = 1 + b * size[n];
            even += square[n] / variance / count;
            logarithms += math::log(variance) / count;
        }
        const double unlikely = math::log(even) + logarithms;
        if (unlikely < least) {
            least = unlikely;
            best = b;
        }
    }
    response.power = 0;
    for (std::size_t n = 0; n < errors.size(); ++n) {
        response.weight[n] = response.measured(response.hz[n]) / std::sqrt(1 + best * size[n]);
        response.power += response.weight[n] * response.weight[n] * std::norm(response.h[n]);
    }
}

class Fit {
  public:
    Fit(const Response& response, std::optional<int> wanted) : response_(response), wanted_(wanted) {}

    ModalModel run() {
        ModalModel model(response_);
        model.refine();
        const auto most = static_cast<std::size_t>(wanted_.value_or(kMostModesFound));
        while (model.modes().size() < most && !exact(model)) {
            auto next = with_more(model);
            if (!next) break;
            model = *std::move(next);
        }
        if (!exact(model)) weigh(model);
        while (!wanted_ && drop_one(model)) {
            if (!exact(model)) weigh(model);
        }
        model.refine(200);
        return model;
    }

  private:
    bool exact(const ModalModel& model) const {
        return model.sum_of_squares() <= kRounding * response_.power;
    }

    // What a wrong weight leaves in the errors looks like noise of its own.
    void weigh(ModalModel& model) {
        constexpr int kRounds = 3;
        for (int round = 0; round < kRounds; ++round) {
            weigh_by_noise(model, response_);
            model.look_again();
            model.refine();
        }
        weighed_ = true;
    }

    // Whether the last `added` modes of a model are more than noise and what the model does not know.
    bool stand_out(const ModalModel& with, const ModalModel& without, std::size_t first,
                   std::size_t added) const {
        for (std::size_t n = first; n < first + added; ++n) {
            const ModalModel::Mode& mode = with.modes()[n];
            if (mode.peak() * response_.measured(mode.hz) < kLeastPeak) return false;
        }
        return significance(with, without, with.modes()[first], added) > kLeastF;
    }

    // The same of one mode, where others may have moved to its place.
    bool is_needed(const ModalModel& with, const ModalModel& without, std::size_t mode) const {
        const ModalModel::Mode& there = with.modes()[mode];
        if (there.peak() * response_.measured(there.hz) < kLeastPeak) return false;
        return std::ranges::any_of(with.modes(), [&](const ModalModel::Mode& m) {
            return significance(with, without, m, 1) > kLeastF;
        });
    }

    // The model with one mode more, if that is significant; else with two more, as both of a close pair are
    // only together.
    std::optional<ModalModel> with_more(const ModalModel& model) const {
        auto one = with_another(model);
        const std::size_t count = model.modes().size();
        if (!one ||
            (wanted_ ? one->sum_of_squares() < model.sum_of_squares() : stand_out(*one, model, count, 1)))
            return one;
        if (wanted_ || exact(*one)) return std::nullopt;
        auto two = with_another(*one);
        if (two && stand_out(*two, model, count, 2)) return two;
        return std::nullopt;
    }

    std::optional<ModalModel> with_another(const ModalModel& model) const {
        std::optional<ModalModel> best;
        const std::vector<Complex> left = model.errors();
        const auto consider = [&best](ModalModel trial) {
            trial.refine(kFirstSteps);
            if (!best || trial.sum_of_squares() < best->sum_of_squares()) best = std::move(trial);
        };
        const std::vector<ModalModel::Mode> found = candidates(response_, left);
        for (const ModalModel::Mode& mode : found) {
            ModalModel trial = model;
            trial.add(mode);
            consider(std::move(trial));
        }
        // Or a peak is two.
        if (!found.empty() && !model.modes().empty()) {
            const auto distance = [&](const ModalModel::Mode& m) { return std::abs(m.hz - found[0].hz); };
            const auto nearest = std::ranges::min_element(model.modes(), {}, distance);
            ModalModel trial = model;
            trial.split(static_cast<std::size_t>(nearest - model.modes().begin()));
            consider(std::move(trial));
        }
        if (best) best->refine();
        return best;
    }

    // Takes the mode out that is least significant, if it is not significant at all.
    bool drop_one(ModalModel& model) const {
        std::optional<ModalModel> least;
        for (std::size_t n = 0; n < model.modes().size(); ++n) {
            ModalModel without = model;
            without.remove(n);
            without.refine();
            if (is_needed(model, without, n)) continue;
            if (!least || without.sum_of_squares() < least->sum_of_squares()) least = std::move(without);
        }
        if (!least) return false;
        model = *std::move(least);
        return true;
    }

    // F of the numbers of `added` modes, from the points around one of them.
    double significance(const ModalModel& with, const ModalModel& without, const ModalModel::Mode& m,
                        std::size_t added) const {
        const std::span<const double> hz = response_.hz;
        const double reach = 3 * m.damping * m.hz;
        const auto low = static_cast<std::size_t>(std::ranges::lower_bound(hz, m.hz - reach) - hz.begin());
        const auto high = static_cast<std::size_t>(std::ranges::upper_bound(hz, m.hz + reach) - hz.begin());
        const auto centre = static_cast<std::size_t>(std::ranges::lower_bound(hz, m.hz) - hz.begin());
        const std::size_t from = std::min(low, centre - std::min(centre, kLeastAround));
        const std::size_t to = std::min(hz.size(), std::max(high, centre + kLeastAround));
        const std::vector<Complex> a = without.errors(), b = with.errors();
        double before = 0, after = 0;
        for (std::size_t n = from; n < to; ++n) {
            const double w = response_.weight[n] * response_.weight[n];
            before += w * std::norm(a[n]);
            after += w * std::norm(b[n]);
        }
        std::size_t used = 2;
        for (const ModalModel::Mode& other : with.modes())
            if (from < to && other.hz >= hz[from] && other.hz <= hz[to - 1]) used += 3;
        if (2 * (to - from) <= used) return 0;
        const auto free = static_cast<double>(2 * (to - from) - used);
        if (after <= kRounding * response_.power) return before > after ? kCertain : 0;
        // With few points the noise there may seem small by chance.
        const double usual =
            weighed_ ? with.sum_of_squares() / static_cast<double>(2 * response_.hz.size()) : 0;
        return (before - after) / static_cast<double>(3 * added) / std::max(after / free, usual);
    }

    Response response_;  // its weights become those of the noise
    std::optional<int> wanted_;
    bool weighed_ = false;
};

// The signs in which one mode explains most.
Sense sense_of(const Response& response) {
    ModalModel none(response);
    none.refine();
    const std::vector<Complex> left = none.errors();
    std::array<double, kSenses.size()> most{};
    for (const Tried& tried : try_modes(response, left))
        for (std::size_t n = 0; n < most.size(); ++n) most[n] = std::max(most[n], tried.gain(n));
    // As it is, if the others are no clear gain.
    most[0] *= 2;
    return kSenses[static_cast<std::size_t>(std::ranges::max_element(most) - most.begin())];
}

Result<Response> response_in(std::span<const double> hz, std::span<const Complex> h,
                             const ModeFitOptions& options) {
    Response response;
    std::size_t zeros = 0;
    for (std::size_t n = 0; n < hz.size(); ++n) {
        if (hz[n] <= 0 || hz[n] < options.from_hz || hz[n] > options.to_hz) continue;
        response.hz.push_back(hz[n]);
        response.h.push_back(h[n]);
        zeros += h[n] == Complex{};
    }
    const std::size_t points = response.hz.size();
    if (points < kLeastPoints) {
        return fail("the band has " + std::to_string(points) + " points, too few for a mode",
                    points == hz.size() ? "measure with a finer resolution"
                                        : "let band_hz hold at least " + std::to_string(kLeastPoints));
    }
    if (2 * zeros > points) {
        return fail("the response is 0 at " + std::to_string(zeros) + " of " + std::to_string(points) +
                        " frequencies",
                    "check the channels of the measurement");
    }
    response.prepare(options.derivatives, kMostFitPoints);
    if (!(response.power > 0) || !std::isfinite(response.power))
        return fail("the response is too small or too large to be computed with", "check its unit");
    return response;
}

}  // namespace

Result<ModeFit> fit_modes(std::span<const double> frequency_hz, std::span<const Complex> receptance,
                          const ModeFitOptions& options) {
    assert(frequency_hz.size() == receptance.size());
    auto response = response_in(frequency_hz, receptance, options);
    if (!response) return std::unexpected(response.error());
    ModeFit fit;
    fit.from_hz = response->first_hz;
    fit.to_hz = response->last_hz;
    fit.points = response->points;
    const Sense sense = sense_of(*response);
    for (Complex& h : response->h) h = turned(h, sense);
    fit.other_time_sign = sense.time;
    fit.other_force_sign = sense.force;
    Fit search(*response, options.modes);
    const ModalModel model = search.run();
    for (const ModalModel::Mode& mode : model.modes()) {
        // Beyond the band it stands for what is there.
        if (mode.hz < fit.from_hz || mode.hz > fit.to_hz) continue;
        const FittedMode fitted{mode.hz, mode.damping, response->scale / mode.compliance};
        if (!kLimits.mode_frequency.range.contains(fitted.frequency_hz) ||
            !kLimits.mode_damping.range.contains(fitted.damping_ratio) ||
            !kLimits.mode_stiffness.range.contains(fitted.stiffness_n_per_mm))
            continue;
        fit.modes.push_back(fitted);
    }
    std::ranges::sort(fit.modes, {}, &FittedMode::frequency_hz);
    const std::string band = "from " + plain_number(fit.from_hz) + " to " + plain_number(fit.to_hz) + " Hz";
    if (fit.modes.empty()) {
        return fail("no mode stands out of the response " + band,
                    "choose the band around a peak with band_hz, or measure again: a driving point shows a "
                    "peak at each mode");
    }
    if (options.modes && static_cast<int>(fit.modes.size()) < *options.modes) {
        return fail("only " + std::to_string(fit.modes.size()) + " of " + std::to_string(*options.modes) +
                        " modes are found " + band,
                    "ask for fewer modes, or for a wider band_hz");
    }
    const std::vector<Complex> errors = model.errors();
    double left = 0;
    for (std::size_t n = 0; n < errors.size(); ++n)
        left += response->weight[n] * response->weight[n] * std::norm(errors[n]);
    fit.residual = std::sqrt(left / response->power);
    return fit;
}

}  // namespace tribo::dynamics
