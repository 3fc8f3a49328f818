// SPDX-License-Identifier: MIT
// What a tool that bends leaves: how far the machined surface stands from the one that a stiff tool would
// leave. A tooth makes the surface at the instant at which it passes the place, and the displacement of that
// instant stays in it (surface location error: Schmitz and Smith, Machining Dynamics, ch. 4; a vibration
// leaves waves).
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "base/cell_index.hpp"
#include "base/parallel.hpp"
#include "contact/distance_field.hpp"

namespace tribo::surface {

// A passage of a tooth.
struct ToothMark {
    float at = 0;  // on its trace, 0 to 1
    // Displacement of the tooth out of the material: + where it leaves material, - where it cuts too deep.
    float displaced_mm = 0;
    // What stands after the teeth beside it have cut too, which take off the tops of short waves. Set by
    // FormError.
    float left_mm = 0;
};

// The marks that the teeth make at one height of the edge, along a piece of the path.
struct ToothTrace {
    Vec3 from_mm, to_mm;  // on the surface of a stiff tool
    Vec3 inner_mm;  // also there, between them and far from corners; beside the chord where the path bends
    Vec3 normal;    // unit, out of the material
    double arc_mm = 1;    // radius of the arc that a tooth cuts along the trace
    double width_mm = 0;  // of the surface across the trace for which it stands
    double start_s = 0, end_s = 0;
    int line = 0;                         // of the program
    std::size_t first = 0, count = 0;     // of the marks, sorted by place
    std::optional<std::uint32_t> before;  // the trace that it continues
};

struct ToothTraces {
    std::vector<ToothTrace> traces;  // in the order of time
    std::vector<ToothMark> marks;
};

class FormError {
  public:
    FormError() = default;
    // Keeps the traces that still lie on the surface of the finished part.
    FormError(ToothTraces traces, const contact::DistanceField& machined,
              const ParallelFor& parallel = serial_for);

    // What stands at a point of the machined surface, mm: + material left. Absent: no tooth is known to have
    // made this place. Between the heights and the marks it is interpolated. Real-time safe, some us.
    std::optional<double> at(Vec3 point_mm) const;

    // The same with what a finger needs to know about it.
    struct Wave {
        double left_mm = 0;
        Vec3 along;              // unit, of the path
        double shortest_mm = 0;  // wave length that the marks can hold
    };
    std::optional<Wave> wave_at(Vec3 point_mm) const;

    struct Extremes {
        double left_mm = 0, overcut_mm = 0;  // >= 0
        double wave_mm = 0;                  // largest difference within a trace: about half a millimetre
        int left_line = 0, overcut_line = 0;
    };
    const Extremes& extremes() const { return extremes_; }
    // Of the traces that begin in that time.
    Extremes extremes_between(double from_s, double to_s) const;
    bool empty() const { return kept_.traces.empty(); }
    const ToothTraces& kept() const { return kept_; }

  private:
    void keep(ToothTraces all, const contact::DistanceField& machined, const ParallelFor& parallel);
    void cut_beside(std::size_t trace);
    Extremes extremes_of(std::span<const ToothTrace> traces) const;
    double left_at(std::uint32_t trace, double at) const;

    ToothTraces kept_;
    std::vector<std::optional<std::uint32_t>> next_;  // the trace that continues it
    CellIndex cells_;
    Extremes extremes_;
};

// A machined surface with its form error, for comparisons with a design. Near the surface only; normals are
// those of the surface without it. The error is left out along edges, as far as twice its largest value.
class SurfaceWithFormError final : public contact::DistanceField {
  public:
    // Both must outlive this object.
    SurfaceWithFormError(const contact::DistanceField& machined, const FormError& error)
        : machined_(machined), error_(error) {}

    double distance_mm(Vec3 point_mm) const override;
    Vec3 normal(Vec3 point_mm) const override { return machined_.normal(point_mm); }

  private:
    const contact::DistanceField& machined_;
    const FormError& error_;
};

}  // namespace tribo::surface
