// SPDX-License-Identifier: MIT
// The vibration of a cut in the sound of a live view: at the rate of the sound, in the time of the listener.
#pragma once

#include <array>
#include <complex>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "protocol/live_frame.hpp"
#include "session/chatter/bending_tool.hpp"

namespace tribo::session {

// One BendingTool for each cutter. It is cut by one piece at a time, for as long as the caller likes: so the
// cut at the clock vibrates in its true pitch at any speed of play. Between cuts it goes on in air until
// everything has died out. A tool at rest costs nothing. One thread.
class LiveVibration {
  public:
    // A piece of sound as it is needed here. Reused, it keeps its memory.
    struct Cut {
        std::size_t cutter = 0;
        std::vector<dynamics::Mode> modes;  // in the frame of the vibration
        std::vector<milling::EngagementBand> bands;
        milling::ToolTravel per_tooth;
        double spindle_rpm = 0;
        std::complex<double> feed;
    };

    // None for values out of range. Allocates.
    static std::unique_ptr<LiveVibration> make(const protocol::LiveBending& bending, int sample_rate_hz);

    // Reads a piece, and makes room for it. False: nothing vibrates in it. That is also so for values out of
    // range, for teeth that follow each other by more than kLongestPitchS or less than four samples, and for
    // so many pieces of edge that the sound would stutter. Allocates.
    bool read(const protocol::LiveSoundPiece& piece, Cut& cut);

    // The next samples, while this cut is cut: what the vibration adds to the force (contact::ForceTrace).
    // `number` names the cut. At most kMostSamples, valid until the next call. Real-time safe.
    std::span<const std::array<float, 2>> run(const Cut& cut, std::size_t number, std::size_t samples);
    // The next samples, in air. Real-time safe.
    void rest(std::size_t samples);
    // Angle of the spindle from the feed of this cut at the next sample, as in ContactSample::phase_rad.
    double phase_rad(const Cut& cut) const;

    static constexpr std::size_t kMostSamples = 256;
    static constexpr double kLongestPitchS = 0.5;

  private:
    LiveVibration(const protocol::LiveBending& bending, int sample_rate_hz);
    bool teeth_can_be_followed(std::size_t cutter, double spindle_rpm) const;
    double work(std::size_t cutter, std::span<const milling::EngagementBand> bands) const;

    double rate_hz_;
    struct Tool {
        milling::Cutter cutter;
        std::vector<dynamics::Mode> modes;
        double ring_samples;  // a vibration dies out in it
        int steps;            // in a sample
        BendingTool bends;
    };
    std::vector<Tool> tools_;
    std::optional<std::size_t> awake_, engaged_;  // a tool; the number of a cut
    Cut last_;
    bool in_air_ = false;
    double air_samples_ = 0;
    std::array<std::array<float, 2>, kMostSamples> added_n_{};
};

}  // namespace tribo::session
