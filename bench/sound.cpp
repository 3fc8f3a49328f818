// SPDX-License-Identifier: MIT
// What a source in space costs, and how clean it is when it moves, beside OpenAL Soft; and whether factors
// looked up in a table beat factors worked out.
#include <cmath>
#include <complex>
#include <numbers>

#include "base/noise_hash.hpp"
#include "contact/perceptual_table.hpp"
#include "harness.hpp"
#include "peers/openal_peer.hpp"
#include "sound/place/spatial_source.hpp"
#include "sound/play/workshop.hpp"

namespace tribo::bench {
namespace {

constexpr double kRate = 48000, kPi = std::numbers::pi;
constexpr int kSources = 16, kSeconds = 1;

// On a circle of 2 m around the head, a turn in 2 s.
double angle_at(double t, int source) {
    return kPi * t + source;
}
Vec3 place_at(double t, int source) {
    return {2 * std::sin(angle_at(t, source)), 2 * std::cos(angle_at(t, source)), 0};
}
Vec3 velocity_at(double t, int source) {
    return {2 * kPi * std::cos(angle_at(t, source)), -2 * kPi * std::sin(angle_at(t, source)), 0};
}

// Where everybody is at the start of each block, worked out beforehand: not the engines' work.
struct Scenes {
    std::vector<Vec3> places, velocities;  // block, source
    Scenes(int blocks, int frames, int sources, bool moving) {
        for (int b = 0; b < blocks; ++b) {
            const double t = moving ? b * frames / kRate : 0;
            for (int n = 0; n < sources; ++n) {
                places.push_back(place_at(t, n));
                velocities.push_back(moving ? velocity_at(t, n) : Vec3{});
            }
        }
    }
};

double sample_of(std::size_t frame) {
    return 0.25 * std::sin(2 * kPi * 1000 / kRate * static_cast<double>(frame));
}

// Nanoseconds per frame and source of the thread's own time.
double own_ns(const std::shared_ptr<const sound::Head>& head, const sound::EarKernels& kernels, bool moving) {
    std::vector<sound::SpatialSource> sources;
    for (int n = 0; n < kSources; ++n) sources.emplace_back(head, kernels);
    constexpr int kQuanta = static_cast<int>(kSeconds * kRate) / sound::kQuantumFrames;
    sound::Quantum pressure;
    for (std::size_t n = 0; n < pressure.size(); ++n) pressure[n] = sample_of(n);
    const Scenes scenes(kQuanta, sound::kQuantumFrames, kSources, moving);
    const Vec3* place = scenes.places.data();
    const double start = thread_s();
    for (int q = 0; q < kQuanta; ++q) {
        sound::Ears ears;
        for (sound::SpatialSource& source : sources) source.add(pressure, *place++, {}, ears);
        keep(ears);
    }
    return 1e9 * (thread_s() - start) / (kQuanta * sound::kQuantumFrames * kSources);
}

std::optional<double> peer_ns(bool head, bool moving) {
    std::vector<float> sound;
    for (std::size_t n = 0; n < 48000; ++n) sound.push_back(static_cast<float>(sample_of(n)));
    const auto seconds = [&](int sources) -> std::optional<double> {
        const auto scene = OpenAlScene::open(sources, head, sound);
        if (!scene) return std::nullopt;
        std::vector<float> block(2 * OpenAlScene::kFrames);
        const int blocks = static_cast<int>(kSeconds * kRate) / OpenAlScene::kFrames;
        const Scenes scenes(blocks, OpenAlScene::kFrames, sources, moving);
        const double start = thread_s();
        for (int b = 0; b < blocks; ++b) {
            for (int n = 0; n < sources && (moving || b == 0); ++n) {
                const auto at = static_cast<std::size_t>(b * sources + n);
                scene->place(n, scenes.places[at], scenes.velocities[at]);
            }
            scene->render(block);
            keep(block);
        }
        return thread_s() - start;
    };
    const auto none = seconds(0), all = seconds(kSources);
    if (!none || !all) return std::nullopt;
    return 1e9 * (*all - *none) / (kSeconds * kRate * kSources);
}

// Energy further than 150 Hz from 1 kHz under that near it, in dB (more is cleaner).
double clean_db(const std::vector<float>& left) {
    const sound::FourierTransform fourier(17);
    std::vector<std::complex<double>> x(fourier.size());
    for (std::size_t n = 0; n < x.size(); ++n) {
        const double a = 2 * kPi * (static_cast<double>(n) + 0.5) / static_cast<double>(x.size());
        const double w =
            0.35875 - 0.48829 * std::cos(a) + 0.14128 * std::cos(2 * a) - 0.01168 * std::cos(3 * a);
        x[n] = w * static_cast<double>(left[n + left.size() - x.size()]);
    }
    fourier.forward(x);
    double near = 0, far = 0;
    for (std::size_t k = 1; k < x.size() / 2; ++k) {
        const double hz = static_cast<double>(k) * kRate / static_cast<double>(x.size());
        (std::abs(hz - 1000) < 150 ? near : far) += std::norm(x[k]);
    }
    return 10 * std::log10(near / far);
}

double own_clean_db(const std::shared_ptr<const sound::Head>& head) {
    sound::SpatialSource source(head);
    std::vector<float> left;
    for (std::size_t frame = 0; left.size() < 150000; frame += sound::kQuantumFrames) {
        sound::Quantum pressure;
        for (std::size_t n = 0; n < pressure.size(); ++n) pressure[n] = sample_of(frame + n);
        sound::Ears ears;
        source.add(pressure, place_at(static_cast<double>(frame) / kRate, 0), {}, ears);
        left.insert(left.end(), ears.left.begin(), ears.left.end());
    }
    return clean_db(left);
}

std::optional<double> peer_clean_db() {
    std::vector<float> sound;
    for (std::size_t n = 0; n < 48000; ++n) sound.push_back(static_cast<float>(sample_of(n)));
    const auto scene = OpenAlScene::open(1, true, sound);
    if (!scene) return std::nullopt;
    std::vector<float> left, block(2 * OpenAlScene::kFrames);
    while (left.size() < 150000) {
        const double t = static_cast<double>(left.size()) / kRate;
        scene->place(0, place_at(t, 0), velocity_at(t, 0));
        scene->render(block);
        for (std::size_t n = 0; n < block.size(); n += 2) left.push_back(block[n]);
    }
    return clean_db(left);
}

// The paper's look-up of rolloff and Doppler factor by distance and speed, beside working them out.
void measure_factors(Report& report) {
    contact::DenseFunction rolloff, doppler;
    for (int n = 0; n <= 4000; ++n) {
        const double metres = 0.1 * std::pow(1000.0, n / 4000.0), speed = -60 + 0.03 * n;
        rolloff.at.push_back(metres);
        rolloff.values.push_back(sound::rolloff_at(metres));
        doppler.at.push_back(speed);
        doppler.values.push_back(sound::kSoundSpeed / (sound::kSoundSpeed + speed));
    }
    // Half a JND: 0.2 dB of level, 0.1 % of pitch.
    const auto apart = [](double jnd_share) {
        return [jnd_share](std::span<const double> truth, std::span<const double> shown) {
            return std::abs(shown[0] / truth[0] - 1) / jnd_share;
        };
    };
    const auto near = contact::build_perceptual_table(rolloff, apart(0.047));
    const auto pitch = contact::build_perceptual_table(doppler, apart(0.002));
    const CounterNoise noise(1);
    std::vector<double> metres, speeds;
    for (std::uint64_t n = 0; n < 4096; ++n) {
        metres.push_back(0.2 + 40 * noise.uniform(2 * n));
        speeds.push_back(-50 + 100 * noise.uniform(2 * n + 1));
    }
    const auto timed = [&](auto factors) {
        return median_of(9, [&] {
            double sum = 0;
            const double start = thread_s();
            for (int round = 0; round < 50; ++round) {
                for (std::size_t n = 0; n < metres.size(); ++n) sum += factors(metres[n], speeds[n]);
            }
            keep(sum);
            return 1e9 * (thread_s() - start) / (50.0 * static_cast<double>(metres.size()));
        });
    };
    const double direct = timed([](double m, double v) {
        return sound::rolloff_at(m) + sound::kSoundSpeed / (sound::kSoundSpeed + v);
    });
    contact::PerceptualTable::Cursor near_cursor, pitch_cursor;
    const double looked_up = timed([&](double m, double v) {
        double a = 0, b = 0;
        near.look_up(m, {&a, 1}, near_cursor);
        pitch.look_up(v, {&b, 1}, pitch_cursor);
        return a + b;
    });
    report.note("rolloff by " + std::to_string(near.knots()) + " knots, Doppler by " +
                std::to_string(pitch.knots()) + "; a table pays where a factor costs more than the look-up");
    report.add({"rolloff and Doppler from the perceptual table",
                looked_up,
                "ns",
                {},
                Better::lower,
                "worked out",
                direct});
}

// Percent of a core that the soundtrack of a cut takes, told a hundred times a second: a slot with 32
// harmonics, past a listener.
double soundtrack_percent(const std::shared_ptr<const sound::Head>& head, const sound::Workshop& workshop) {
    sound::SoundtrackOptions options;
    options.head = head;
    options.tool = sound::tool_body(12, 60, 0.03);
    sound::apply(workshop, options);
    sound::Soundtrack track(options);
    contact::ForceSpectrum spectrum;
    spectrum.order_step = 2;
    for (int n = 0; n <= 32; ++n) {
        const double newton = 20.0 / (n + 1);
        spectrum.harmonics.push_back({newton, {0, newton}, newton, 5000.0 / (n + 1)});
    }
    constexpr int kPerSecond = 100, kLength = 5;
    std::vector<float> block(sound::kChannels * static_cast<std::size_t>(kRate) / kPerSecond);
    const double start = thread_s();
    for (int n = 0; n < kPerSecond * kLength; ++n) {
        contact::ContactSample cut;
        cut.t_s = static_cast<double>(n) / kPerSecond;
        cut.position_mm = {0.3 * n, 100, 0};
        cut.removed_mm3_per_s = 500;
        cut.phase_rate_rad_per_s = 6000 / 60.0 * 2 * kPi;
        cut.phase_rad = cut.phase_rate_rad_per_s * cut.t_s;
        cut.spectrum = &spectrum;
        cut.edges = 2;
        track.excite(cut);
        track.render(block);
        keep(block);
    }
    return 100 * (thread_s() - start) / kLength;
}

}  // namespace

void measure_sound(Report& report) {
    report.section("Sound in space, 48 kHz, a source that circles the head at 2 m in 2 s");
    const auto sphere = sound::Head::sphere(kRate), pan = sound::Head::panning(kRate);
    const auto ns = [&](const auto& head, const sound::EarKernels& kernels, bool moving) {
        return median_of(5, [&] { return own_ns(head, kernels, moving); });
    };
    const std::string peer = "OpenAL Soft";
    report.add({"source with a head of 128 taps, moving", ns(sphere, sound::ear_kernels(), true), "ns/frame",
                18, Better::lower, peer, peer_ns(true, true)});
    report.add({"source with a head of 128 taps, still",
                ns(sphere, sound::ear_kernels(), false),
                "ns/frame",
                {},
                Better::lower,
                peer,
                peer_ns(true, false)});
    report.add({"source with a head of 128 taps, moving, SSE2", ns(sphere, *sound::ear_kernels_sse2(), true),
                "ns/frame"});
    report.add({"source by panning, moving",
                ns(pan, sound::ear_kernels(), true),
                "ns/frame",
                {},
                Better::lower,
                peer,
                peer_ns(false, true)});
    report.add({"tone of a moving source over its stray energy", own_clean_db(sphere), "dB", 60,
                Better::higher, peer, peer_clean_db()});
    const auto percent = [&](const sound::Workshop& workshop) {
        return median_of(5, [&] { return soundtrack_percent(sphere, workshop); });
    };
    report.add({"soundtrack of a cut, force alone", percent({}), "% of a core"});
    report.add({"soundtrack of a cut with machine, chips and room",
                percent({.machine = 1, .room = 1, .chips = sound::ChipMaterial::steel}), "% of a core", 1});
    measure_factors(report);
}

}  // namespace tribo::bench
