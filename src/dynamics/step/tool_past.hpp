// SPDX-License-Identifier: MIT
// Where a tool stood when the teeth before each tooth passed, and which of them cut there.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "dynamics/step/tool_place.hpp"
#include "milling/tool/cutter.hpp"

namespace tribo::dynamics {

// A bit for each of the first 64 teeth: it cut wherever it was engaged. Others count as not having cut.
using TeethThatCut = std::uint64_t;
inline TeethThatCut tooth_bit(std::size_t tooth) {
    return tooth < 64 ? TeethThatCut{1} << tooth : 0;
}

// Keeps the samples so far, as many as the passages need. Before the first sample the feed was the same and
// nothing was displaced. Between samples: by a cubic through the four around. One thread; all but set_speed()
// and set_feed() are real-time safe.
class ToolPast {
  public:
    // Teeth that passed before a tooth and are asked: at most.
    static constexpr std::size_t kMostPassages = 16;

    // A tooth that passed before: how far back, and where the tool stood then.
    struct Passage {
        double back_rad = 0, back_samples = 0;
        std::size_t back = 0;             // back_samples, rounded up
        std::size_t even_from = 0;        // number of the sample since which the speed is the same
        std::array<double, 4> weights{};  // of the samples around it then
        std::size_t ahead = 0;            // teeth from this one to that
        std::size_t known_at = 0;         // 1 + number of the sample for which the rest was computed
        TeethThatCut cut = 0;
        ToolPlace place{};
    };

    // `first_rad`: rotation at the first sample.
    ToolPast(const milling::Cutter& cutter, double first_rad);

    // Rotation from a sample to the next one, from now on.
    void set_speed(double step_rad);
    // Feed per rad, from now on. `turns`: it turns the axis.
    void set_feed(const ToolPlace& per_rad, bool turns);
    // The axis has turned.
    bool turns() const { return turns_; }

    std::size_t samples() const { return samples_; }
    // By the feed alone.
    const ToolPlace& fed() const { return fed_; }

    // Rotation of the next sample. Passages are of that time.
    void expect(double rotation_rad) { rotation_rad_ = rotation_rad; }
    // The k-th tooth before this one at its place, 0: the one just before it.
    const Passage& passage(std::size_t tooth, std::size_t k) {
        Passage& p = before_[(alike_ ? 0 : tooth * kMostPassages) + k];
        if (p.known_at != samples_ + 1) look_back(p);
        return p;
    }
    // The tooth of a passage before this one.
    std::size_t tooth_of(const Passage& p, std::size_t tooth) const {
        const std::size_t n = tooth + p.ahead;
        return n < teeth_ ? n : n - teeth_;
    }
    bool cut_whole(const Passage& p, std::size_t tooth) const {
        return (p.cut & tooth_bit(tooth_of(p, tooth))) != 0;
    }
    // The passages before this tooth, back to the first that cut whole: beyond its surface nothing older
    // stands.
    std::span<const Passage> passages(std::size_t tooth) {
        const std::size_t first = alike_ ? 0 : tooth * kMostPassages;
        std::size_t count = 1;
        while (!cut_whole(passage(tooth, count - 1), tooth) && count < passages_) ++count;
        return {&before_[first], count};
    }

    // The sample itself, and the teeth that cut in it.
    void add(const LaneVec3& displacement_mm, TeethThatCut cut) {
        const std::size_t n = samples_ & mask_;
        xy_[n] = fed_.tip_mm.xy + displacement_mm.xy;
        marks_[n] = {rotation_rad_, cut};
        fed_.tip_mm.xy += both(step_rad_) * per_rad_.tip_mm.xy;
        if (deep_) {
            z_[n] = fed_.tip_mm.z + displacement_mm.z;
            fed_.tip_mm.z += step_rad_ * per_rad_.tip_mm.z;
        }
        if (turns_) {
            turn_[n] = fed_.turn_rad;
            fed_.turn_rad += both(step_rad_) * per_rad_.turn_rad;
        }
        ++samples_;
    }

  private:
    struct Mark {
        double rotation_rad = 0;
        TeethThatCut cut = 0;
    };

    void look_back(Passage& p) {
        if (samples_ < p.back + p.even_from + 1) return look_back_anywhere(p);
        see(p, samples_ - p.back, p.weights);
    }
    // Where the speed has changed since, or which was before the first sample.
    void look_back_anywhere(Passage& p) const;
    // By samples n - 1 to n + 2.
    void see(Passage& p, std::size_t n, const std::array<double, 4>& weights) const {
        p.known_at = samples_ + 1;
        const std::size_t a = (n - 1) & mask_, b = n & mask_, c = (n + 1) & mask_, d = (n + 2) & mask_;
        p.cut = marks_[b].cut & marks_[c].cut;
        p.place.tip_mm.xy = (both(weights[0]) * xy_[a] + both(weights[1]) * xy_[b]) +
                            (both(weights[2]) * xy_[c] + both(weights[3]) * xy_[d]);
        if (deep_)
            p.place.tip_mm.z =
                (weights[0] * z_[a] + weights[1] * z_[b]) + (weights[2] * z_[c] + weights[3] * z_[d]);
        if (turns_)
            p.place.turn_rad = (both(weights[0]) * turn_[a] + both(weights[1]) * turn_[b]) +
                               (both(weights[2]) * turn_[c] + both(weights[3]) * turn_[d]);
    }
    // By the feed while the spindle turns by so much.
    void move(ToolPlace& place, double rad) const;
    void keep(std::size_t samples);
    double rotation_of(std::size_t sample) const { return marks_[sample & mask_].rotation_rad; }

    std::size_t teeth_;
    // The height of the tip counts: there is a rounded part.
    bool deep_;
    bool turns_ = false;
    // For each tooth, or for all if they are alike: kMostPassages, the last first, of which passages_ fit.
    bool alike_;
    std::vector<Passage> before_;
    std::size_t passages_ = 1;
    double first_rad_, rotation_rad_ = 0, step_rad_ = 0;
    ToolPlace per_rad_, fed_;
    // Rings, whose length is a power of two; from even_from_ on at the same speed.
    std::vector<D2> xy_, turn_;
    std::vector<double> z_;
    std::vector<Mark> marks_;
    std::size_t mask_ = 0, samples_ = 0, even_from_ = 0;
};

}  // namespace tribo::dynamics
