// SPDX-License-Identifier: MIT
// What the teeth of a tool that bends leave on the surface, recorded row by row.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "dynamics/mode.hpp"
#include "session/cut/mill_session.hpp"
#include "surface/form_error.hpp"

namespace tribo::session {

// A tooth makes the surface where its way goes along it: at the ends of its cut, at 0 deg where it comes from
// the wall on the left of the feed, at 180 deg where it runs out to the wall on the right. This recorder
// takes the displacement at these instants, at several heights of the edge. Floors of flat bottoms are left
// out. Run-out counts by what the other teeth reach less than the farthest one. One thread.
class SurfaceRecorder {
  public:
    // The setup must outlive this object.
    explicit SurfaceRecorder(const MillSetup& setup);

    // The row whose samples come next, with its bands as they are simulated. `frame`: of the vibration.
    // `rotation_rad`: that of the first sample, at the time `t_s`.
    void begin(const milling::CutRow& row, std::span<const milling::EngagementBand> bands,
               const milling::ToolFrame& frame, double rotation_rad, double t_s);
    // A sample: the rotation of flute 0 from y of the frame, and the displacement of tool against part.
    void add(double rotation_rad, Vec3 displacement_mm);
    // The row is over.
    void end();
    // What comes next does not continue what was before.
    void interrupt();

    // In place of all that: a row whose displacement is known at each rotation, and the same after
    // `period_rad`. The teeth of one period in the middle of the row stand for all.
    using Displacement = std::function<Vec3(double rotation_rad, double height_mm)>;
    void add_steady(const milling::CutRow& row, double period_rad, const Displacement& displacement_mm);

    static constexpr std::size_t kMostMarks = 4'000'000;
    // Of a run of that setup, whose schedule is there: about 65 bytes a mark, with its trace, and four marks
    // for each tooth that passes in a feed move.
    static double estimated_bytes(const MillSetup& setup);
    // The line of the program from which on nothing is recorded: there are kMostMarks.
    std::optional<int> full_at_line() const { return full_at_line_; }
    static Warning full_warning(const std::string& program_file, int line);

    surface::ToothTraces take() { return std::move(record_); }

  private:
    struct Sample {
        double rotation_rad = 0;
        Vec3 displacement_mm;
    };
    // A height of the edge at an end of its cut.
    struct Watch {
        int side = 0;  // 0: the begin of the cut, 1: its end
        double height_mm = 0;
        double angle_rad = 0;  // of the tip of an edge that is there
        Vec3 normal;           // of the tooth, outward, in the frame of the vibration
        double next_rad = 0;   // rotation of flute 0 at the next passage
        std::size_t next_tooth = 0;
        surface::ToothTrace trace;
        std::vector<surface::ToothMark> marks;
        std::uint32_t recorded_as = 0;  // number of the trace, if it has marks
    };
    // Where the tool is at a share of a row.
    struct Place {
        Vec3 tip_mm;
        milling::ToolFrame frame;
    };

    Place place(const milling::CutRow& row, double t_s) const;
    double inner_s(const milling::CutRow& row) const;
    // `places`: at the begin, within, and at the end of the row.
    void watch(const milling::CutRow& row, const milling::EngagementBand& band,
               const std::array<Place, 3>& places);
    void find_next(Watch& watch, double after_rad) const;
    Vec3 displacement_at(double rotation_rad) const;
    void mark(Watch& watch, Vec3 displacement_mm);
    bool continues(const Watch& watch, const Watch& before) const;

    const MillSetup& setup_;
    std::shared_ptr<const motion::Schedule> schedule_;
    double fastest_rad_per_s_ = 0;
    std::vector<std::vector<double>> phases_rad_;  // of the teeth of each cutter
    std::size_t cutter_ = 0;
    double feed_rad_ = 0;                 // from x of the frame to that of the feed
    double begin_rad_ = 0, row_rad_ = 0;  // rotation at the start of the row, and over it
    double next_rad_ = 0;                 // of all watches
    std::array<Sample, 4> last_{};
    int samples_ = 0;                           // of last_ that are known
    std::vector<Watch> watches_, before_;       // of this row and of the one before
    std::size_t count_ = 0, count_before_ = 0;  // of those that are used; the others keep their memory
    surface::ToothTraces record_;
    std::optional<int> full_at_line_;
};

}  // namespace tribo::session
