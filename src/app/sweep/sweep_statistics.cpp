// SPDX-License-Identifier: MIT
#include "app/sweep/sweep_statistics.hpp"

#include <algorithm>
#include <cmath>

#include "sweep/band.hpp"

namespace tribo::app {
namespace {

// Of each result so many values are kept for quantiles: these are then good to 0.2 % of the cases.
constexpr std::size_t kMostKept = 1 << 18;
constexpr std::size_t kMostReasons = 1000, kColumns = 30;

// Failures of one kind differ in numbers.
std::string without_numbers(const std::string& text) {
    std::string kind;
    for (const char c : text) {
        const bool is_digit = c >= '0' && c <= '9';
        if (!is_digit) kind += c;
        if (is_digit && (kind.empty() || kind.back() != '#')) kind += '#';
    }
    return kind;
}

}  // namespace

void SweepStatistics::Output::add(std::uint64_t number, double value) {
    if (count == 0 || value < least) least = value, least_case = number;
    if (count == 0 || value > most) most = value, most_case = number;
    sum += value;
    if (count++ % stride != 0) return;
    values.push_back(value);
    if (values.size() < kMostKept) return;
    for (std::size_t n = 0; n < values.size() / 2; ++n) values[n] = values[2 * n];
    values.resize(values.size() / 2);
    stride *= 2;
}

SweepStatistics::Output& SweepStatistics::output(const std::string& name) {
    const auto [found, is_new] = outputs_.try_emplace(name);
    if (is_new) {
        names_.push_back(name);
        if (plan_.design == sweep::Design::sobol) found->second.sensitivity.emplace(plan_.axes.size());
    }
    return found->second;
}

void SweepStatistics::add(std::uint64_t number, const std::optional<CaseResult>& result) {
    const std::uint64_t place = number % plan_.block();
    // The cases with inputs from A and B belong to no sample of the inputs.
    const bool counts = place < 2;
    if (place == 0)
        for (auto& [name, output] : outputs_) output.block.clear();
    if (result) {
        ++finished_;
        if (!result->error.empty()) {
            ++failed_;
            const std::string kind = without_numbers(result->error);
            if (failures_.size() < kMostReasons || failures_.contains(kind)) {
                report::SweepFailure& failure = failures_[kind];
                if (failure.count++ == 0) failure.reason = result->error, failure.example = number;
            }
        }
        for (const auto& [name, value] : result->values) {
            Output& output = this->output(name);
            if (counts) output.add(number, value);
            // A result that other cases of the block lack leaves a gap there.
            output.block.resize(place, std::nan(""));
            output.block.push_back(value);
        }
    }
    if (plan_.design != sweep::Design::sobol || place + 1 != plan_.block()) return;
    for (auto& [name, output] : outputs_) {
        output.block.resize(plan_.block(), std::nan(""));
        output.sensitivity->add(output.block);
    }
}

std::vector<report::SweepOutput> SweepStatistics::outputs() const {
    std::vector<report::SweepOutput> all;
    for (const std::string& name : names_) {
        const Output& from = outputs_.at(name);
        if (from.count == 0) continue;
        report::SweepOutput& to = all.emplace_back();
        to.name = name;
        to.count = from.count;
        to.mean = from.sum / static_cast<double>(from.count);
        to.least = from.least, to.most = from.most;
        to.least_case = from.least_case, to.most_case = from.most_case;
        std::vector<double> values = from.values;
        to.band = sweep::band_of(values);
        to.histogram.resize(kColumns);
        const double width = (to.most - to.least) / static_cast<double>(kColumns);
        for (const double value : values) {
            const double column = width > 0 ? (value - to.least) / width : 0;
            ++to.histogram[std::min(static_cast<std::size_t>(column), kColumns - 1)];
        }
        if (!from.sensitivity || from.sensitivity->blocks() == 0) continue;
        for (const sweep::SobolIndex& index : from.sensitivity->indices())
            to.shares.push_back({index.first, index.total});
    }
    return all;
}

std::vector<report::SweepFailure> SweepStatistics::failures() const {
    std::vector<report::SweepFailure> all;
    for (const auto& [kind, failure] : failures_) all.push_back(failure);
    std::ranges::sort(all, [](const report::SweepFailure& a, const report::SweepFailure& b) {
        return a.count != b.count ? a.count > b.count : a.example < b.example;
    });
    return all;
}

}  // namespace tribo::app
