// SPDX-License-Identifier: MIT
// A milling job from its file to forces, contacts and the part: what `tribo render` does, for programs.
//
//     auto mill = tribo::Mill::open(argv[1]);
//     if (!mill) return std::puts(mill.error().text().c_str()), 2;
//     const bool done = mill->run([&](const CutRow& row, const RowForce& force) {
//         double& peak = peak_n[row.line];
//         peak = std::max(peak, force.peaks.peak_force_n);
//     });
//     const tribo::TriangleMesh part = mill->part();
//
// The whole program: examples/source/mill.cpp.
// The same bits on every machine, however many threads there are. Lengths in mm, times in s, forces in N.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/file_result.hpp"
#include "base/mesh.hpp"
#include "contact/contact_sample.hpp"
#include "contact/distance_field.hpp"
#include "milling/engagement/cut_row.hpp"
#include "milling/force/row_force.hpp"
#include "milling/tool/cutter.hpp"
#include "session/cut/mill_totals.hpp"

namespace tribo {

struct MillOptions {
    // Spacing of the stock's grid, 0.001 ... 10 mm; absent: as fine as the job needs.
    std::optional<double> cell_mm{};
    // Mills no further than this time of the program; absent: to its end.
    std::optional<double> until_s{};
    int threads = 0;  // at most; 0: as many as the process may use, which is never exceeded
    // The run may hold as much memory as this; absent: as the machine gives.
    std::optional<double> memory_mb{};
};

// A job or a program, open and milled row by row. One thread at a time.
class Mill {
  public:
    // A job (docs/job.md), or a program in any language that Tribo reads, with a blank and a tool that are
    // assumed. Refused, with file, line and remedy: what cannot be read or run, and what would not fit into
    // memory.
    static FileResult<Mill> open(const std::string& file, const MillOptions& options = {});
    Mill(Mill&&) noexcept;
    Mill& operator=(Mill&&) noexcept;
    ~Mill();

    // What was assumed, and what the run found (teeth that rub, a part that stands out of the stock).
    Warnings warnings() const;
    double duration_s() const;                            // of the program, or until_s
    const std::vector<milling::Cutter>& cutters() const;  // CutRow::cutter is an index into it

    // Each stretch of the cut in the order of time; the references are valid during the call.
    using OnRow = std::function<void(const milling::CutRow&, const milling::RowForce&)>;
    // Told now and then how much is done, 0 ... 1; false stops the run.
    using OnProgress = std::function<bool(double fraction)>;
    // Mills on to the end. False: stopped.
    bool run(const OnRow& on_row = {}, const OnProgress& on_progress = {});
    // Mills on through the moves that begin before `t_s`.
    bool run_to(double t_s, const OnRow& on_row = {}, const OnProgress& on_progress = {});

    // What every sense needs to know of a row, at a time of it. The sample borrows from `force`.
    contact::ContactSample contact(const milling::CutRow& row, const milling::RowForce& force,
                                   double t_s) const;

    const session::MillTotals& totals() const;  // complete when run() gave true
    TriangleMesh part() const;                  // the material that is left: closed, outward normals
    // The distance to the material that is left, for haptics::FieldContact; as long as the mill lives, and
    // while it does not run.
    const contact::DistanceField& surface() const;

  private:
    friend class CutSound;
    struct State;
    explicit Mill(std::unique_ptr<State> state);
    std::unique_ptr<State> state_;
};

}  // namespace tribo
