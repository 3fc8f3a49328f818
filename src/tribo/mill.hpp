// SPDX-License-Identifier: MIT
// A milling job from its file to forces, contacts and the part: the computation of `tribo render`, for
// programs.
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
    // Grid spacing of the stock, 0.001 ... 10 mm; absent: the default spacing of the job.
    std::optional<double> cell_mm{};
    // Mills up to this time of the program; absent: to its end.
    std::optional<double> until_s{};
    int threads = 0;  // upper limit; 0: all that the process may use, which is never exceeded
    // Memory limit of the run; absent: given by the machine.
    std::optional<double> memory_mb{};
};

// An open job or program, milled row by row. One thread at a time.
class Mill {
  public:
    // Opens a job (docs/job.md), or a program in any language that Tribo reads, with an assumed blank and
    // tool. Refuses, with file, line and remedy, inputs that cannot be read or run, and a job that does not
    // fit into memory.
    static FileResult<Mill> open(const std::string& file, const MillOptions& options = {});
    Mill(Mill&&) noexcept;
    Mill& operator=(Mill&&) noexcept;
    ~Mill();

    // Assumptions, and findings of the run (for example rubbing teeth, or a part outside of the stock).
    Warnings warnings() const;
    double duration_s() const;                            // of the program, or until_s
    const std::vector<milling::Cutter>& cutters() const;  // CutRow::cutter is an index into it

    // Receives each piece of the cut in the order of time. The references are valid during the call.
    using OnRow = std::function<void(const milling::CutRow&, const milling::RowForce&)>;
    // Called from time to time with the finished share, 0 ... 1; false stops the run.
    using OnProgress = std::function<bool(double fraction)>;
    // Mills to the end. Returns false if stopped.
    bool run(const OnRow& on_row = {}, const OnProgress& on_progress = {});
    // Mills the moves that begin before `t_s`.
    bool run_to(double t_s, const OnRow& on_row = {}, const OnProgress& on_progress = {});

    // Returns the contact of a row at a time within it, for all senses. The sample refers to `force`.
    contact::ContactSample contact(const milling::CutRow& row, const milling::RowForce& force,
                                   double t_s) const;

    const session::MillTotals& totals() const;  // complete after run() has returned true
    TriangleMesh part() const;                  // the remaining material: closed, outward normals
    // The distance to the remaining material, for haptics::FieldContact. Valid during the life of the mill,
    // except while it runs.
    const contact::DistanceField& surface() const;

  private:
    friend class CutSound;
    struct State;
    explicit Mill(std::unique_ptr<State> state);
    std::unique_ptr<State> state_;
};

}  // namespace tribo
