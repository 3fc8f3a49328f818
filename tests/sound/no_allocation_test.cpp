// SPDX-License-Identifier: MIT
// The audio thread never allocates: this program's operator new counts.
#include <gtest/gtest.h>

#include "base/counted_allocations.hpp"
#include "sound/cuts.hpp"
#include "sound/play/workshop.hpp"

namespace tribo::sound {
namespace {

using tribo::test::allocations;

TEST(SoundOfTheAudioThread, never_allocates) {
    const contact::ForceSpectrum two = test::falling_spectrum(2, 64), four = test::falling_spectrum(4, 16);
    std::vector<float> buffer(2 * 128);
    for (int n = 0; n < 3; ++n) {
        SoundtrackOptions options;
        options.as_published = n == 1;
        if (n == 2) {
            options.head = Head::sphere(options.sample_rate_hz);
            apply({.machine = 1, .room = 1, .chips = ChipMaterial::steel}, options);
        }
        Soundtrack track(options);
        const long before = allocations;
        double t = 0;
        for (int k = 0; k < 400; ++k) {
            track.excite(test::cut_at(t,
                                      k % 7 == 0    ? nullptr
                                      : k % 50 < 25 ? &two
                                                    : &four,
                                      60 * k, k % 3 * 100.0));
            track.render(buffer);
            if (k % 90 == 89) track.release();
            t += 128 / 48000.0;
        }
        EXPECT_EQ(allocations - before, 0);
    }
    const long before = allocations;
    delete new int(1);
    EXPECT_GE(allocations - before, 0);
    buffer = std::vector<float>(10);
    EXPECT_GT(allocations - before, 0);  // the counter counts
}

}  // namespace
}  // namespace tribo::sound
