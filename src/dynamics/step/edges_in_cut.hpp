// SPDX-License-Identifier: MIT
// Which slices of which teeth are in the cut, from sample to sample.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "dynamics/step/edge_slices.hpp"

namespace tribo::dynamics {

struct EdgeInCut {
    std::uint32_t tooth = 0, slice = 0;
    bool whole = false;  // all of the edge in the slice, or a part that changes from sample to sample
    // Of a straight edge whose steps are told apart: the share of the step in which it cuts, and whether it
    // cuts in the middle of the step.
    double share = 1;
    bool now = true;
};

// Remembers for each edge the sample until which nothing changes, so that edges cost nothing between their
// entry and exit. One thread.
class EdgesInCut {
  public:
    // Angles of the teeth ahead of the first one.
    explicit EdgesInCut(std::vector<double> phase_rad) : phase_rad_(std::move(phase_rad)) {}

    // From the next sample on there are that many slices, all of unknown state. `in_steps`: a straight edge
    // enters and leaves within a step, and the step counts by its share: else the force of a tooth would end
    // up to half a step too early or too late. Allocates for more than before.
    void engage(std::size_t slices, double step_rad, bool in_steps);

    // Call it for each sample, with the slices; `turn_rad`: rotation of the first tooth, in the first turn.
    // Returns whether list() has changed. Real-time safe.
    bool update(std::span<const EdgeSlice> slices, std::size_t sample, double turn_rad) {
        return sample >= next_ && find(slices, sample, turn_rad);
    }

    // Sorted by tooth.
    std::span<const EdgeInCut> list() const { return list_; }

  private:
    enum class State : std::uint8_t { unknown, out, part, whole };
    struct Edge {
        std::size_t next = 0;  // the first sample at which the state may be another one
        State state = State::unknown;
        double share = 1;
        bool now = true;
    };
    bool find(std::span<const EdgeSlice> slices, std::size_t sample, double turn_rad);
    void look(Edge& edge, const EdgeSlice& slice, std::size_t sample, double tip_rad) const;

    std::vector<double> phase_rad_;
    std::vector<Edge> edges_;  // by teeth
    std::vector<EdgeInCut> list_;
    std::size_t next_ = 0;
    double per_rad_ = 0;     // samples
    double spread_rad_ = 0;  // of an edge over its step
};

}  // namespace tribo::dynamics
