// SPDX-License-Identifier: MIT
#include "session/cut/cut_record.hpp"

#include <cmath>
#include <gtest/gtest.h>

#include "session/block_setup.hpp"

namespace tribo::session {
namespace {

// A slot 1 mm deep, half out of the block at first, so that the force swells.
MillSetup slot(double feed_mm_per_min = 600, double rpm = 6000, double helix_deg = 30) {
    MillSetup s = block_setup({{0, 0, -5}, {20, 20, 0}},
                              {.diameter_mm = 8, .helix_deg = helix_deg, .length_mm = 30}, 0.5);
    motion::Move cut = straight_cut({-6, 2, -1}, {26, 14, -1}, feed_mm_per_min);
    cut.line = 1;
    add_cut(s, cut, rpm);
    return s;
}

struct Cut {
    CutRecord record;
    std::unique_ptr<MillSession> session;
};

Cut cut(MillSetup setup) {
    Cut c;
    c.session = std::make_unique<MillSession>(std::move(setup), serial_for);
    MillSinks sinks;
    sinks.row = [&](const milling::CutRow& row, const milling::RowForce&) { c.record.add(row); };
    c.session->run(sinks);
    return c;
}

void expect_alike(const std::vector<contact::ForceStretch>& a, const std::vector<contact::ForceStretch>& b,
                  double relative) {
    ASSERT_EQ(a.size(), b.size());
    for (std::size_t n = 0; n < a.size(); ++n) {
        EXPECT_NEAR(a[n].start_s, b[n].start_s, 1e-9);
        EXPECT_NEAR(a[n].end_s, b[n].end_s, 1e-9);
        EXPECT_NEAR(a[n].rate_rad_per_s, b[n].rate_rad_per_s, 1e-9);
        ASSERT_EQ(a[n].spectrum.harmonics.size(), b[n].spectrum.harmonics.size());
        const double size = std::abs(b[n].spectrum.harmonics[0].x) + std::abs(b[n].spectrum.harmonics[0].y);
        for (std::size_t h = 0; h < a[n].spectrum.harmonics.size(); ++h) {
            EXPECT_NEAR(std::abs(a[n].spectrum.harmonics[h].x - b[n].spectrum.harmonics[h].x), 0,
                        relative * size);
            EXPECT_NEAR(std::abs(a[n].spectrum.harmonics[h].y - b[n].spectrum.harmonics[h].y), 0,
                        relative * size);
        }
    }
}

TEST(CutRecord, gives_the_sessions_own_spectra_where_nothing_changes) {
    std::vector<contact::ForceSpectrum> spectra;
    std::vector<double> phases;
    CutRecord record;
    MillSession session(slot(), serial_for);
    MillSinks sinks;
    sinks.row = [&](const milling::CutRow& row, const milling::RowForce& force) {
        record.add(row);
        spectra.push_back(force.spectrum);
        phases.push_back(row.phase_rad);
    };
    session.run(sinks);
    ASSERT_GT(spectra.size(), 30U);
    const auto stretches = force_stretches(record, session.setup());
    ASSERT_EQ(stretches.size(), spectra.size());
    for (std::size_t n = 0; n < spectra.size(); ++n) {
        EXPECT_EQ(stretches[n].phase_rad, phases[n]);
        for (std::size_t h = 0; h < spectra[n].harmonics.size(); ++h) {
            EXPECT_EQ(stretches[n].spectrum.harmonics[h].x, spectra[n].harmonics[h].x);
            EXPECT_EQ(stretches[n].spectrum.harmonics[h].z, spectra[n].harmonics[h].z);
        }
    }
}

// What a change gives is what milling the changed job gives.
TEST(CutRecord, follows_feed_speed_helix_and_material_as_a_new_run_would) {
    const Cut base = cut(slot());
    {
        const Cut faster = cut(slot(900));
        CutChange change;
        change.feed_factor = 1.5;
        expect_alike(force_stretches(base.record, base.session->setup(), change),
                     force_stretches(faster.record, faster.session->setup()), 1e-6);
    }
    {
        const Cut turning = cut(slot(600, 9000));
        CutChange change;
        change.speed_factor = 1.5;
        expect_alike(force_stretches(base.record, base.session->setup(), change),
                     force_stretches(turning.record, turning.session->setup()), 1e-6);
    }
    {
        const Cut steep = cut(slot(600, 6000, 45));
        CutChange change;
        change.helix_deg = 45;
        expect_alike(force_stretches(base.record, base.session->setup(), change),
                     force_stretches(steep.record, steep.session->setup()), 1e-6);
    }
    CutChange twice;
    twice.coefficients = base.session->setup().coefficients;
    for (double* k : {&twice.coefficients->ktc, &twice.coefficients->krc, &twice.coefficients->kac,
                      &twice.coefficients->kte, &twice.coefficients->kre, &twice.coefficients->kae})
        *k *= 2;
    const auto plain = force_stretches(base.record, base.session->setup());
    const auto doubled = force_stretches(base.record, base.session->setup(), twice);
    for (std::size_t n = 0; n < plain.size(); ++n) {
        EXPECT_NEAR(doubled[n].spectrum.harmonics[0].x.real(), 2 * plain[n].spectrum.harmonics[0].x.real(),
                    1e-9);
    }
}

TEST(CutRecord, tells_jobs_apart_by_their_key) {
    const contact::ForceTableOptions options;
    const std::uint64_t key = bake_key(slot(), options);
    EXPECT_EQ(bake_key(slot(), options), key);
    EXPECT_NE(bake_key(slot(601), options), key);
    EXPECT_NE(bake_key(slot(600, 6001), options), key);
    EXPECT_NE(bake_key(slot(600, 6000, 31), options), key);
    contact::ForceTableOptions finer;
    finer.profile.force_magnitude = 0.05;
    EXPECT_NE(bake_key(slot(), finer), key);
}

}  // namespace
}  // namespace tribo::session
