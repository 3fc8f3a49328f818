// SPDX-License-Identifier: MIT
#include "files/sound/hrir_file.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <gtest/gtest.h>
#include <numbers>
#include <rapidcheck/gtest.h>

#include "sound/ears.hpp"

namespace tribo::files {
namespace {

using Complex = std::complex<double>;
constexpr double kPi = std::numbers::pi;
constexpr double kRate = 48000;

const FileResult<sound::HrirSet>& shipped() {
    static const FileResult<sound::HrirSet> set = builtin_hrirs();
    return set;
}

const sound::Head& head() {
    static const auto made = sound::Head::measured(*shipped(), kRate);
    return **made;
}

// What both ears get of a tone, from the responses as they are measured and from the head made of them.
using Both = std::array<Complex, 2>;
Both measured(std::size_t direction, double hz) {
    const sound::HrirSet& set = *shipped();
    Both out;
    const auto taps = static_cast<std::size_t>(set.taps);
    for (std::size_t ear = 0; ear < 2; ++ear) {
        const Complex turn = std::polar(1.0, -2 * kPi * hz / set.sample_rate_hz);
        Complex phase = 1;
        for (std::size_t k = 0; k < taps; ++k) {
            out[ear] += static_cast<double>(set.responses[(2 * direction + ear) * taps + k]) * phase;
            phase *= turn;
        }
    }
    return out;
}
Both made(const sound::EarResponses& heard, double hz) {
    Both out;
    for (std::size_t ear = 0; ear < 2; ++ear) {
        for (std::size_t k = 0; k < sound::kHeadTaps; ++k) {
            out[ear] += static_cast<double>(heard.taps[ear][k]) *
                        std::polar(1.0, -2 * kPi * hz / kRate * static_cast<double>(k));
        }
        out[ear] *= std::polar(1.0, -2 * kPi * hz * heard.delay_s[ear]);
    }
    return out;
}

// The delay of the right ear behind the left: the peak of the cross-correlation from 300 to 1500 Hz.
template <class At>
double arrival_offset_s(At at) {
    std::vector<std::pair<double, Complex>> cross;
    for (double hz = 300; hz <= 1500; hz += 25) {
        const Both b = at(hz);
        cross.emplace_back(2 * kPi * hz, b[0] * std::conj(b[1]));
    }
    const auto alike = [&](double t) {
        double sum = 0;
        for (const auto& [w, c] : cross) sum += (c * std::polar(1.0, -w * t)).real();
        return sum;
    };
    double best = 0;
    for (double t = -1e-3; t < 1e-3; t += 5e-6) best = alike(t) > alike(best) ? t : best;
    for (double step = 2.5e-6; step > 1e-8; step /= 2) {
        for (const double t : {best - step, best + step}) best = alike(t) > alike(best) ? t : best;
    }
    return best;
}

double decibel(double power) {
    return 10 * std::log10(power);
}

class BuiltinHrirs : public testing::Test {
  protected:
    void SetUp() override {
        if (!shipped()) GTEST_SKIP() << shipped().error().text();
    }
};

TEST_F(BuiltinHrirs, are_the_set_that_the_notes_describe) {
    EXPECT_EQ(shipped()->directions.size(), 710u);
    EXPECT_EQ(shipped()->taps, 512);
    EXPECT_EQ(shipped()->sample_rate_hz, 44100);
    EXPECT_TRUE(std::ranges::all_of(shipped()->extra_delays_s, [](double d) { return d == 0; }));
    // A source at the left is louder at the left ear and earlier there.
    sound::EarResponses heard;
    head().hear({-5, 0, 0}, heard);
    const Both left = made(heard, 4000);
    EXPECT_GT(decibel(std::norm(left[0]) / std::norm(left[1])), 6);
    EXPECT_GT(heard.delay_s[1] - heard.delay_s[0], 400e-6);
}

// What the head makes of every measured direction, beside the measurement.
struct Kept {
    std::vector<double> offsets_us, levels_db, at_1_khz_db;  // made less measured; both ears
};
const Kept& kept() {
    static const Kept k = [] {
        const auto broadband = [](auto at) {
            std::array<double, 2> sum{0, 0};
            for (double hz = 200; hz < 18000; hz += 50) {
                const Both b = at(hz);
                for (std::size_t ear = 0; ear < 2; ++ear) sum[ear] += std::norm(b[ear]);
            }
            return sum;
        };
        Kept made_of;
        sound::EarResponses heard;
        for (std::size_t n = 0; n < shipped()->directions.size(); n += 5) {
            head().hear(5 * shipped()->directions[n], heard);
            const auto a = [&](double hz) { return made(heard, hz); };
            const auto b = [&](double hz) { return measured(n, hz); };
            made_of.offsets_us.push_back(1e6 * (arrival_offset_s(a) - arrival_offset_s(b)));
            const auto whole = broadband(a), truth = broadband(b);
            for (std::size_t ear = 0; ear < 2; ++ear) {
                made_of.levels_db.push_back(decibel(whole[ear] / truth[ear]));
                made_of.at_1_khz_db.push_back(decibel(std::norm(a(1000)[ear]) / std::norm(b(1000)[ear])));
            }
        }
        return made_of;
    }();
    return k;
}

TEST_F(BuiltinHrirs, keep_arrival_offset_and_level_in_128_taps) {
    // One number for the whole set is free: its level.
    double gain = 0;
    for (const double db : kept().levels_db) gain += db / static_cast<double>(kept().levels_db.size());
    ASSERT_GT(kept().offsets_us.size(), 140u);
    for (const double us : kept().offsets_us) EXPECT_LT(std::abs(us), 10);
    for (const double db : kept().levels_db) EXPECT_LT(std::abs(db - gain), 0.3);
    for (const double db : kept().at_1_khz_db) EXPECT_LT(std::abs(db - gain), 0.1);
}

TEST_F(BuiltinHrirs, have_the_free_fields_level_in_the_bass_as_a_rigid_sphere_has) {
    const auto sphere = sound::Head::sphere(kRate);
    sound::EarResponses heard;
    const auto mean_db = [&](const sound::Head& of, double hz) {
        double sum = 0, count = 0;
        for (std::size_t n = 0; n < shipped()->directions.size(); n += 5) {
            of.hear(5 * shipped()->directions[n], heard);
            for (const Complex p : made(heard, hz)) {
                sum += decibel(std::norm(p));
                ++count;
            }
        }
        return sum / count;
    };
    for (const double hz : {30.0, 60.0, 100.0, 200.0, 300.0}) {
        EXPECT_NEAR(mean_db(head(), hz), 0, 0.5) << hz;
        EXPECT_NEAR(mean_db(*sphere, hz), 0, 0.2) << hz;
    }
}

TEST_F(BuiltinHrirs, made_for_headphones_lose_what_all_directions_share_and_keep_what_tells_them_apart) {
    const auto equal = sound::Head::measured(*shipped(), kRate, sound::Equalization::diffuse);
    ASSERT_TRUE(equal);
    const auto sphere = sound::Head::sphere(kRate);
    constexpr double kBand = 1.1225;  // a sixth of an octave
    double before = 0, after = 0;
    for (double hz = 1000; hz < 12000; hz *= std::pow(2, 1.0 / 3)) {
        double power = 0, raw = 0;
        const std::size_t count = shipped()->directions.size();
        for (std::size_t n = 0; n < count; n += 7) {
            sound::EarResponses a, b;
            (*equal)->hear(2 * shipped()->directions[n], a);
            head().hear(2 * shipped()->directions[n], b);
            for (const double f : {hz / kBand, hz, hz * kBand}) {
                const Both x = made(a, f), y = made(b, f);
                for (std::size_t ear = 0; ear < 2; ++ear)
                    power += std::norm(x[ear]), raw += std::norm(y[ear]);
            }
            // The difference of the ears is what it was.
            const Both x = made(a, hz), y = made(b, hz);
            EXPECT_NEAR(20 * std::log10(std::abs(x[0]) / std::abs(x[1])),
                        20 * std::log10(std::abs(y[0]) / std::abs(y[1])), 1)
                << n << ' ' << hz;
        }
        const double means = 6.0 * std::ceil(static_cast<double>(count) / 7);
        EXPECT_NEAR(10 * std::log10(power / means), 0, 1) << hz;
        after = std::max(after, std::abs(10 * std::log10(power / means)));
        before = std::max(before, std::abs(10 * std::log10(raw / means)));
    }
    EXPECT_GT(before, 10);  // there was something to lose
    // In the bass it is the sphere still, in every direction.
    for (std::size_t n = 0; n < shipped()->directions.size(); n += 11) {
        sound::EarResponses a, b;
        (*equal)->hear(2 * shipped()->directions[n], a);
        sphere->hear(2 * shipped()->directions[n], b);
        for (const double hz : {100.0, 200.0, 400.0}) {
            const Both x = made(a, hz), y = made(b, hz);
            for (std::size_t ear = 0; ear < 2; ++ear)
                EXPECT_NEAR(20 * std::log10(std::abs(x[ear]) / std::abs(y[ear])), 0, 1) << n << ' ' << hz;
        }
    }
}

TEST_F(BuiltinHrirs, leave_no_stray_energy_beside_a_tone_that_circles_the_head) {
    const auto made_once = sound::Head::measured(*shipped(), kRate);
    sound::SpatialSource source(*made_once);
    const auto heard = sound::test::hear(source, 3000, sound::test::tone(1000), sound::test::circling(2, 2));
    for (const std::vector<float>* ear : {&heard.left, &heard.right}) {
        EXPECT_LT(sound::test::stray_db(std::span(*ear).last(1 << 17), 1000), -65);
    }
}

TEST(PackedHrirs, come_back_as_they_were) {
    sound::HrirSet set;
    set.sample_rate_hz = 44100;
    set.taps = 8;
    for (const Vec3 d : {Vec3{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {-1, 0, 0}}) {
        set.directions.push_back(d);
        for (int k = 0; k < 16; ++k) set.responses.push_back(0.1f * static_cast<float>(k));
        set.extra_delays_s.insert(set.extra_delays_s.end(), {0, 1e-3});
    }
    const std::string bytes = packed_hrirs(set);
    const auto back = unpacked_hrirs(bytes);
    ASSERT_TRUE(back);
    EXPECT_EQ(back->responses, set.responses);
    EXPECT_EQ(back->directions, set.directions);
    EXPECT_EQ(back->extra_delays_s, set.extra_delays_s);
    // Every way of cutting them off is refused.
    for (std::size_t n = 0; n < bytes.size(); ++n) EXPECT_FALSE(unpacked_hrirs(bytes.substr(0, n))) << n;
    EXPECT_FALSE(unpacked_hrirs(bytes + "x"));
}

RC_GTEST_PROP(PackedHrirs, survive_whatever_a_child_writes, ()) {
    std::string bytes = "TRIBO-HRIR-1 ok\n" + *rc::gen::arbitrary<std::string>();
    RC_ASSERT(!unpacked_hrirs(bytes));
    bytes = "TRIBO-HRIR-1 no\n" + *rc::gen::arbitrary<std::string>();
    RC_ASSERT(!unpacked_hrirs(bytes));
}

// In the bass one head is like another: the measured one and the sphere, by direction and ear.
TEST(MeasuredHead, has_the_bass_of_a_sphere) {
    const auto sphere = sound::Head::sphere(kRate);
    sound::EarResponses a, b;
    for (int row = 0; row < sound::Head::kRows; ++row) {
        for (int column = 0; column < sound::Head::kColumns; ++column) {
            const Vec3 d = sound::Head::grid_direction(row, column);
            head().hear(2 * d, a);
            sphere->hear(2 * d, b);
            for (const double hz : {30.0, 100.0, 200.0, 300.0, 400.0}) {
                const Both of_set = made(a, hz), of_sphere = made(b, hz);
                for (std::size_t ear = 0; ear < 2; ++ear) {
                    EXPECT_NEAR(decibel(std::norm(of_set[ear]) / std::norm(of_sphere[ear])), 0, 1)
                        << hz << " Hz at " << d.x << " " << d.y << " " << d.z;
                }
            }
        }
    }
}

// Whoever names the ears: a source beyond 20 degrees from the median plane is earlier and louder in the ear
// on its side.
TEST(MeasuredHead, hears_a_source_earlier_and_louder_on_its_side_however_the_set_names_its_ears) {
    for (const bool exchanged : {false, true}) {
        sound::HrirSet set = *shipped();
        EXPECT_EQ(sound::ear_order(set), sound::EarOrder::right);
        if (exchanged) {
            sound::exchange_ears(set);
            EXPECT_EQ(sound::ear_order(set), sound::EarOrder::exchanged);
            sound::exchange_ears(set);
        }
        const auto made_of_it = sound::Head::measured(set, kRate);
        ASSERT_TRUE(made_of_it);
        const auto sphere = sound::Head::sphere(kRate);
        for (const sound::Head* each : {made_of_it->get(), sphere.get()}) {
            sound::EarResponses heard;
            for (int row = 0; row < sound::Head::kRows; ++row) {
                for (int column = 0; column < sound::Head::kColumns; ++column) {
                    const Vec3 d = sound::Head::grid_direction(row, column);
                    if (std::abs(d.x) < std::sin(20 * kPi / 180)) continue;
                    each->hear(2 * d, heard);
                    double power[2] = {0, 0};
                    for (std::size_t ear = 0; ear < 2; ++ear)
                        for (const float v : heard.taps[ear])
                            power[ear] += static_cast<double>(v) * static_cast<double>(v);
                    const std::size_t near = d.x > 0 ? 1 : 0;
                    EXPECT_GT(power[near], power[1 - near]) << d.x << " " << d.y << " " << d.z;
                    EXPECT_LT(heard.delay_s[near], heard.delay_s[1 - near])
                        << d.x << " " << d.y << " " << d.z;
                }
            }
        }
    }
}

TEST(MeasuredHead, does_not_guess_where_its_ears_are_alike_or_contradict_each_other) {
    sound::HrirSet set = *shipped();
    const auto taps = static_cast<std::size_t>(set.taps);
    sound::HrirSet alike = set;
    for (std::size_t n = 0; n < set.directions.size(); ++n) {
        for (std::size_t k = 0; k < taps; ++k)
            alike.responses[(2 * n + 1) * taps + k] = alike.responses[2 * n * taps + k];
        alike.extra_delays_s[2 * n + 1] = alike.extra_delays_s[2 * n];
    }
    EXPECT_EQ(sound::ear_order(alike), sound::EarOrder::unclear);
    // Earlier in one ear, louder in the other.
    sound::HrirSet torn = set;
    for (std::size_t n = 0; n < set.directions.size(); ++n) {
        const double later = 0.002 * (1 + set.directions[n].x);
        torn.extra_delays_s[2 * n] += 0.004 - later;
        torn.extra_delays_s[2 * n + 1] += later;
    }
    EXPECT_EQ(sound::ear_order(torn), sound::EarOrder::unclear);
}

}  // namespace
}  // namespace tribo::files
