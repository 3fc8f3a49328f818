// SPDX-License-Identifier: MIT
// The probability of chatter where modes or cutting forces are known with a spread only.
#pragma once

#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "base/parallel.hpp"
#include "dynamics/stability_chart.hpp"
#include "session/chatter/program_chatter.hpp"
#include "session/chatter/steady_cut.hpp"
#include "sweep/band.hpp"

namespace tribo::session {

inline constexpr std::size_t kCases = 40, kFewCases = 20;

// The cut as it may be in truth: `count` cases, equally likely, always the same ones. Empty where nothing has
// a spread. Every value with one is lognormal, 9 of 10 within its band: the cutting forces altogether, and of
// each mode frequency, damping and stiffness, all independent of each other; the estimated modes of a tool
// are off together. A Latin hypercube (McKay, Beckman and Conover 1979): each value takes each of its `count`
// quantiles once.
std::vector<SteadyCut> cases_of(const SteadyCut& cut, std::size_t count = kCases);

// The share of the cases that chatter. There must be some.
double probability_of_chatter(std::span<const SteadyCut> cases, double spindle_rpm, double axial_depth_mm);

// At the cut's own speed and depth; absent without a spread of modes or forces.
std::optional<double> chatter_probability(const SteadyCut& cut, std::size_t count = kCases);
// Of the row of a program that chatters most; absent likewise, or without such a row.
std::optional<double> chatter_probability(const ProgramChatter& chatter, const MillSetup& setup,
                                          std::size_t count = kCases);

// The number of depths, from the least one, before the first that chatters. Depths are asked in steps that
// double: a narrower island of chatter may be missed.
std::size_t stable_depths(const SteadyCut& cut, double spindle_rpm, std::span<const double> depths_mm);

// The band of the least depth at which a case chatters; where it does not, the length of the cutting edges
// counts. There must be cases.
sweep::Band limit_band_mm(std::span<const SteadyCut> cases, double spindle_rpm, const ParallelFor& parallel);

// Adds the probability to a chart of the cut: of each point the share of the cases whose first border lies
// below, with its bands joined to at most kRowBands. Nothing where nothing has a spread. `parallel` and
// `may_go_on` as in stability_chart(). Takes about ten multipliers for each speed and case.
void add_probability(const SteadyCut& cut, dynamics::StabilityChart& chart, const ParallelFor& parallel,
                     const std::function<bool(double fraction)>& may_go_on = {}, std::size_t count = kCases);

}  // namespace tribo::session
