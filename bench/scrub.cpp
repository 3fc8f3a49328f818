// SPDX-License-Identifier: MIT
// A clock that jumps to and fro in the finishing job: the part as it was, and its picture.
#include <algorithm>

#include "base/noise_hash.hpp"
#include "cuts.hpp"
#include "harness.hpp"
#include "session/live/part_picture.hpp"

namespace tribo::bench {

void measure_scrub(Report& report) {
    report.section("Jumps of the clock: 16,121 moves, 8.5 m, D1 flat, 0.1 mm grid, 1 thread");
    const FinishingJob job;
    session::MillSession session(session_setup(job.block_mm, job.cutter, moves_through(job.tips)),
                                 serial_for);
    session.keep_states();
    session.run({});
    session::PartPicture picture(session.stock());
    const auto show = [](session::ChunkCoord, const session::PartPicture::Piece&) {};
    const auto always = [] { return true; };
    picture.mark(picture.all());
    picture.update(always, show);
    const CounterNoise noise(1);
    constexpr std::uint64_t kJumps = 60;
    std::vector<double> part_ms, seen_ms;
    for (std::uint64_t n = 0; n < kJumps; ++n) {
        const double t_s = noise.uniform(n) * session.duration_s(), start = thread_s();
        if (t_s < session.milled_s()) session.set_back(t_s);
        session.run_to(t_s, {});
        part_ms.push_back(1e3 * (thread_s() - start));
        picture.mark(picture.all());
        picture.update(always, show, true);
        seen_ms.push_back(1e3 * (thread_s() - start));
    }
    const auto p95 = [](std::vector<double> values) {
        std::ranges::sort(values);
        return values[values.size() * 95 / 100];
    };
    report.add({"part, median", median(part_ms), "ms"});
    report.add({"part, 95 %", p95(part_ms), "ms"});
    report.add({"part and rough picture, median", median(seen_ms), "ms"});
    report.add({"part and rough picture, 95 %", p95(seen_ms), "ms", 300});
    report.add({"states", 1e-6 * static_cast<double>(session.kept_states()->bytes()), "MB", 256});
}

}  // namespace tribo::bench
