// SPDX-License-Identifier: MIT
// The finishing job, as a session in this process.
#include "cuts.hpp"
#include "field/contour/contour.hpp"
#include "field/contour/contour_refine.hpp"
#include "harness.hpp"
#include "tribo/threads.hpp"

namespace tribo::bench {

void measure_sessions(Report& report, int repeats) {
    report.section("Finishing job in this process: 16,121 moves, 8.5 m, D1 flat, 0.1 mm grid");
    const FinishingJob job;
    const auto moves = moves_through(job.tips);
    for (const int threads : {1, 2}) {
        const ParallelFor parallel = parallel_for_over(threads);
        const std::string on = threads == 1 ? ", 1 thread" : ", 2 threads";
        double rows = 0, megabytes = 0, triangles = 0;
        std::vector<double> cut, mesh, fine;
        for (int n = 0; n < repeats; ++n) {
            session::MillSession session(session_setup(job.block_mm, job.cutter, moves), parallel);
            double start = wall_s();
            session.run({});
            cut.push_back(wall_s() - start);
            start = wall_s();
            keep(field::contour(session.stock(), parallel).triangles.size());
            mesh.push_back(wall_s() - start);
            start = wall_s();
            triangles = static_cast<double>(field::fine_contour(session.stock(), parallel).triangles.size());
            fine.push_back(wall_s() - start);
            rows = static_cast<double>(session.totals().rows);
            megabytes = 1e-6 * static_cast<double>(session.stock().bytes());
        }
        report.add({"cut with rows and forces" + on, median(cut), "s"});
        report.add({"mesh" + on, median(mesh), "s"});
        report.add({"mesh for files, mended" + on, median(fine), "s"});
        if (threads == 2) {
            report.add({"rows", rows, "", {}, Better::higher});
            report.add({"stock in memory", megabytes, "MB"});
            report.add({"triangles", triangles, ""});
        }
    }
}

}  // namespace tribo::bench
