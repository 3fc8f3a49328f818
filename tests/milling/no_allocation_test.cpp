// SPDX-License-Identifier: MIT
// What is marked real-time safe never allocates: this program's operator new counts.
#include <gtest/gtest.h>

#include "base/counted_allocations.hpp"
#include "milling/force/force.hpp"
#include "reference_cases.hpp"

namespace tribo::milling {
namespace {

using tribo::test::allocations;

TEST(NoAllocation, in_a_force_model_that_has_seen_its_pieces) {
    for (const CutterKind kind : {CutterKind::flat, CutterKind::ball}) {
        for (const double runout : {0.0, 0.01}) {
            reference::Cut c = reference::cases()[1].cut;
            c.cutter.kind = kind;
            c.cutter.runout_mm = runout;
            c.engagement.bands.push_back({5, 6, 0.5, 1.5});
            ForceModel model(c.cutter, c.k);
            contact::ForceSpectrum spectrum;
            model.engage(c.engagement, c.feed);
            model.spectrum(16, spectrum);
            (void)model.peaks();

            const long before = allocations;
            double sum = 0;
            for (int i = 0; i < 10; ++i) {
                c.feed.across_mm = 0.05 - 1e-3 * i;
                model.engage(c.engagement, c.feed);
                model.spectrum(16, spectrum);
                sum += model.peaks().peak_force_n + model.at(0.1 * i).torque_nmm + model.mean().torque_nmm;
                sum += evaluate(spectrum, 0.1 * i).torque_nmm;
            }
            EXPECT_EQ(allocations - before, 0) << static_cast<int>(kind) << " " << runout;
            EXPECT_GT(sum, 0);
        }
    }
}

// A plain tool has its room from the start: nothing to warm up but the peaks.
TEST(NoAllocation, in_the_first_engagement_of_a_plain_tool) {
    const reference::Cut c = reference::cases()[1].cut;
    ForceModel model(c.cutter, c.k);
    const long before = allocations;
    model.engage(c.engagement, c.feed);
    EXPECT_GT(model.at(0.5).torque_nmm, 0);
    EXPECT_EQ(allocations - before, 0);
}

}  // namespace
}  // namespace tribo::milling
