// SPDX-License-Identifier: MIT
#include "app/render/render_sinks.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "base/math.hpp"
#include "readers/tables/forces_csv.hpp"
#include "session/cut/contact_of_cut.hpp"
#include "sound/play/calibration.hpp"
#include "sound/play/workshop.hpp"

namespace tribo::app {
namespace {

// The sound in the report starts this long before the first chip.
constexpr double kLeadInS = 0.2;
// Rows with a smaller gap are one cut.
constexpr double kSameCutS = 1e-6;
// A row that vibrates is told to the sound at least that often.
constexpr double kVibrationStepS = 0.02;
// Length of the waveforms of figure 8, s.
constexpr double kWaveS = 0.02;

}  // namespace

FileResult<ForceFile> ForceFile::create(const std::string& path, bool chatter, bool band) {
    auto file = files::FileWriter::create(path);
    if (!file) return std::unexpected(file.error());
    file->write(readers::forces_csv_header(chatter, band));
    return ForceFile(std::move(*file));
}

void ForceFile::add(const milling::CutRow& row, const milling::ForcePeaks& force,
                    const session::RowChatter* chatter, const sweep::Band* band) {
    line_.clear();
    readers::ChatterColumns columns;
    if (chatter != nullptr) {
        if (chatter->stability) columns.multiplier = chatter->stability->multiplier;
        columns.peak_displacement_mm = chatter->peak_displacement_mm;
    }
    readers::ForceBandColumns in_truth;
    if (band != nullptr) in_truth = {band->low, band->high};
    readers::append_force_row(line_, row, force, chatter != nullptr ? &columns : nullptr,
                              band != nullptr ? &in_truth : nullptr);
    file_.write(line_);
}

FileResult<void> ForceFile::finish() {
    return file_.finish();
}

FileResult<PublishedForceFile> PublishedForceFile::create(const std::string& path) {
    auto file = files::FileWriter::create(path);
    if (!file) return std::unexpected(file.error());
    file->write(
        "t_s,line,printed_peak_fx_nmm2,printed_peak_fy_nmm2,printed_peak_fz_nmm2,"
        "corrected_peak_fx_n,corrected_peak_fy_n,corrected_peak_fz_n\n");
    return PublishedForceFile(std::move(*file));
}

void PublishedForceFile::add(const milling::CutRow& row, const milling::Cutter& cutter,
                             const milling::CuttingCoefficients& k) {
    const auto cut = milling::published_cut(cutter, k, row.feed.across_mm);
    if (!cut) return;
    milling::EngagedEdges edges(cutter, k);
    edges.engage(row.engagement, row.feed);
    const Vec3 printed = milling::published_peaks(milling::PublishedForm::printed, *cut, edges).peak_n;
    const Vec3 corrected = milling::published_peaks(milling::PublishedForm::corrected, *cut, edges).peak_n;
    char line[256];
    const int n =
        std::snprintf(line, sizeof line, "%.6f,%d,%.4f,%.4f,%.4f,%.3f,%.3f,%.3f\n", row.start_s, row.line,
                      printed.x, printed.y, printed.z, corrected.x, corrected.y, corrected.z);
    file_.write({line, static_cast<std::size_t>(n)});
}

FileResult<void> PublishedForceFile::finish() {
    return file_.finish();
}

SoundFile::SoundFile(files::WavWriter file, const SoundFileOptions& options)
    : options_(options), file_(std::move(file)), track_(std::make_unique<sound::Soundtrack>(options.track)) {}

FileResult<SoundFile> SoundFile::create(const std::string& path, const SoundFileOptions& options,
                                        double duration_s) {
    if (auto ok = sound::check(options.track); !ok) return std::unexpected(FileFailure(ok.error()));
    const double frames = (duration_s + sound::kLongestTailSeconds) * options.track.sample_rate_hz;
    if (frames > static_cast<double>(files::longest_wav_frames(options.format))) {
        return std::unexpected(
            FileFailure({path, 0, 0, "the sound would be longer than a WAV file holds",
                         "render a part with --until, or leave the sound out with --only"}));
    }
    auto file = files::WavWriter::create(path, options.format);
    if (!file) return std::unexpected(file.error());
    return SoundFile(std::move(*file), options);
}

void SoundFile::write(std::span<const float> block) {
    waveform_.add(block);
    const auto most = static_cast<std::size_t>(report::kReportSoundS * options_.track.sample_rate_hz) * 2;
    if (heard_from_ >= 0 && heard_.size() < most) {
        heard_.insert(
            heard_.end(), block.begin(),
            block.begin() + static_cast<std::ptrdiff_t>(std::min(block.size(), most - heard_.size())));
    }
    file_.write(block);
}

void SoundFile::add(const milling::CutRow& row, const milling::RowForce& force, int edges,
                    const contact::ForceTrace* vibration) {
    const auto sink = [this](std::span<const float> block) { write(block); };
    const double start = row.start_s;
    if (start > last_end_s_ + kSameCutS) {
        // The tool was in the air; the cut ends until the next contact.
        end_cut();
        if (heard_from_ < 0) {
            track_->play_to(session::contact_in_air(row, std::max(0.0, start - kLeadInS)), sink);
            heard_from_ = track_->frames_rendered();
        }
        track_->play_to(session::contact_in_air(row, start), sink);
        track_->play_to(session::contact_of_cut(row, force, edges, start), sink);
    }
    if (vibration == nullptr) {
        track_->play_to(session::contact_of_cut(row, force, edges, 0.5 * (start + row.end_s)), sink);
    } else {
        // In steps for which the voice has room, each with the trace until the next one.
        const int steps = std::max(1, static_cast<int>(row.duration_s() / kVibrationStepS) - 1);
        contact::ForceTrace rest = *vibration;
        for (int n = 1; n <= steps; ++n) {
            const double at = steps == 1 ? 0.5 * (start + row.end_s) : start + n * kVibrationStepS;
            contact::ContactSample sample = session::contact_of_cut(row, force, edges, at);
            contact::ForceTrace part = rest;
            if (n < steps) {
                const auto until = static_cast<std::int64_t>((at + kVibrationStepS) * rest.rate_hz);
                const auto left = static_cast<std::int64_t>(rest.force_n.size());
                part.force_n = rest.force_n.first(
                    static_cast<std::size_t>(std::clamp<std::int64_t>(until - rest.first, 0, left)));
            }
            sample.vibration = &part;
            track_->play_to(sample, sink);
            rest.first += static_cast<std::int64_t>(part.force_n.size());
            rest.force_n = rest.force_n.subspan(part.force_n.size());
        }
    }
    last_end_s_ = row.end_s;
    idle_ = session::contact_in_air(row, row.end_s);
}

void SoundFile::end_cut() {
    if (last_end_s_ < 0) return;
    track_->play_on(last_end_s_, [this](std::span<const float> block) { write(block); });
    track_->excite(idle_);
}

FileResult<void> SoundFile::finish(double duration_s) {
    end_cut();
    track_->play_on(duration_s, [this](std::span<const float> block) { write(block); });
    track_->play_out(duration_s, [this](std::span<const float> block) { write(block); });
    return file_.finish();
}

report::ReportSound SoundFile::for_report() const {
    report::ReportSound sound;
    const double rate = options_.track.sample_rate_hz;
    sound.seconds = static_cast<double>(waveform_.frames()) / rate;
    for (const sound::MinMax& e : waveform_.columns()) {
        constexpr auto kPascal = static_cast<float>(sound::kFullScalePascal);
        sound.envelope_pascal.emplace_back(kPascal * e.min, kPascal * e.max);
    }
    sound.heard_from_s = static_cast<double>(std::max<std::int64_t>(heard_from_, 0)) / rate;
    sound.rate_hz = rate;
    sound.stereo = heard_;
    return sound;
}

void ReportRows::add(const milling::CutRow& row, const milling::ForcePeaks& force,
                     const session::RowChatter* chatter, const sweep::Band& band) {
    constexpr double kDegPerRad = 180 / math::kPi;
    const milling::EngagementHull hull = milling::hull(row.engagement);
    rows.push_back({row.start_s, row.duration_s(), row.line, row.pose.tip_mm, length(force.mean_n),
                    force.peak_force_n, band.low, band.high, hull.entry_rad * kDegPerRad,
                    hull.exit_rad * kDegPerRad, hull.axial_depth_mm, row.spindle_rpm,
                    row.feed_mm_per_s() * 60});
    if (chatter != nullptr) {
        if (chatter->stability) rows.back().multiplier = chatter->stability->multiplier;
        rows.back().displacement_mm = chatter->peak_displacement_mm.value_or(0);
    }
    rows.back().cutter = row.cutter;
    if (force.peak_force_n > worst_force_n_) {
        worst_force_n_ = force.peak_force_n;
        worst_ = row;
    }
}

std::optional<report::ReportTurn> ReportRows::turn(const session::MillSetup& setup) const {
    if (worst_force_n_ <= 0) return std::nullopt;
    constexpr int kSteps = 360;
    milling::ForceModel model(setup.cutters[worst_.cutter], setup.coefficients);
    model.engage(worst_.engagement, worst_.feed);
    report::ReportTurn turn;
    turn.t_s = worst_.start_s;
    turn.rpm = worst_.spindle_rpm;
    turn.line = worst_.line;
    for (int n = 0; n < kSteps; ++n) turn.force_n.push_back(model.at(n * math::kTwoPi / kSteps).force_n);
    contact::ForceSpectrum spectrum;
    model.spectrum(setup.harmonics, spectrum);
    for (std::size_t n = 1; n < spectrum.harmonics.size(); ++n) {
        const contact::ForceHarmonic& h = spectrum.harmonics[n];
        const double amplitude = 2 * std::sqrt(std::norm(h.x) + std::norm(h.y));
        turn.spectrum.emplace_back(spectrum.order(n) * worst_.spindle_rpm / 60, amplitude);
    }
    return turn;
}

std::vector<report::ReportWave> ReportRows::waves(const session::MillSetup& setup,
                                                  const sound::SoundtrackOptions& options) const {
    std::vector<report::ReportWave> waves;
    if (worst_force_n_ <= 0) return waves;
    // Only the wave of the force, without chips and machine, which would hide it.
    sound::SoundtrackOptions force_alone = options;
    sound::apply({}, force_alone);
    force_alone.chips.learned.reset();
    const auto wave = [&](double speed, double feed) {
        milling::CutRow cut = worst_;
        cut.spindle_rpm *= speed;
        cut.feed = (feed / speed) * worst_.feed;
        const milling::Cutter& cutter = setup.cutters[cut.cutter];
        milling::ForceModel model(cutter, setup.coefficients);
        model.engage(cut.engagement, cut.feed);
        milling::RowForce force;
        force.peaks = model.peaks();
        model.spectrum(setup.harmonics, force.spectrum);
        contact::ContactSample sample = session::contact_of_cut(cut, force, cutter.flutes, 0);
        sample.position_mm = options.listener_mm;
        sample.phase_rad = 0;
        sample.removed_mm3_per_s = 0;
        char label[80];
        std::snprintf(label, sizeof label, "%.0f rpm, %.0f mm/min, peak %.0f N", cut.spindle_rpm,
                      worst_.feed_mm_per_s() * feed * 60, force.peaks.peak_force_n);
        std::vector<float> samples = sound::steady_wave(sample, force_alone, kWaveS);
        for (float& sample : samples) sample *= static_cast<float>(sound::kFullScalePascal);
        waves.push_back({label, static_cast<double>(options.sample_rate_hz), std::move(samples)});
    };
    wave(1, 1);
    wave(1.5, 0.5);
    return waves;
}

}  // namespace tribo::app
