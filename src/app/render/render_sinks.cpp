// SPDX-License-Identifier: MIT
#include "app/render/render_sinks.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "base/math.hpp"
#include "readers/tables/forces_csv.hpp"
#include "sound/play/calibration.hpp"
#include "sound/play/workshop.hpp"

namespace tribo::app {
namespace {

// What the report lets one hear starts this long before the first chip.
constexpr double kLeadInS = 0.2;
// Rows that end and start within this are one cut.
constexpr double kSameCutS = 1e-6;
// Length of the waveforms of figure 8, s.
constexpr double kWaveS = 0.02;

contact::ContactSample sample_of(const session::MillRow& row, int edges, double t_s) {
    const milling::ToolFrame& f = row.frame;
    const milling::ForceRow& v = row.values;
    contact::ContactSample s;
    s.t_s = t_s;
    s.position_mm = v.tip_mm;
    s.normal = v.axis;
    s.force_n = v.mean_n.x * f.x + v.mean_n.y * f.y + v.mean_n.z * f.z;
    const double speed = v.feed_mm_per_min / 60;
    const double tooth = row.feed.across_mm, down = row.feed.down_mm;
    const double whole = std::hypot(tooth, down);
    if (whole > 0) s.slip_mm_per_s = speed * ((tooth / whole) * f.x - (down / whole) * f.z);
    s.area_mm2 = speed > 0 ? row.chip_mm3_per_s / speed : 0;
    s.removed_mm3_per_s = row.chip_mm3_per_s;
    s.phase_rate_rad_per_s = v.spindle_rpm / 60 * math::kTwoPi;
    s.phase_rad = row.spindle_angle_rad + s.phase_rate_rad_per_s * (t_s - v.t_s);
    s.spectrum = &row.spectrum;
    s.edges = edges;
    return s;
}

}  // namespace

FileResult<ForceFile> ForceFile::create(const std::string& path) {
    auto file = files::FileWriter::create(path);
    if (!file) return std::unexpected(file.error());
    file->write(readers::forces_csv_header);
    return ForceFile(std::move(*file));
}

void ForceFile::add(const session::MillRow& row) {
    line_.clear();
    readers::append_force_row(line_, row.values);
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

void PublishedForceFile::add(const session::MillRow& row, const milling::Cutter& cutter,
                             const milling::CuttingCoefficients& k) {
    const auto cut = milling::published_cut(cutter, k, row.feed.across_mm);
    if (!cut) return;
    milling::EngagedEdges edges(cutter, k);
    edges.engage(row.engagement, row.feed);
    const Vec3 printed = milling::published_peaks(milling::PublishedForm::printed, *cut, edges).peak_n;
    const Vec3 corrected = milling::published_peaks(milling::PublishedForm::corrected, *cut, edges).peak_n;
    char line[256];
    const int n = std::snprintf(line, sizeof line, "%.6f,%d,%.4f,%.4f,%.4f,%.3f,%.3f,%.3f\n", row.values.t_s,
                                row.values.line, printed.x, printed.y, printed.z, corrected.x, corrected.y,
                                corrected.z);
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

void SoundFile::add(const session::MillRow& row, int edges) {
    const auto sink = [this](std::span<const float> block) { write(block); };
    const double start = row.values.t_s;
    if (start > last_end_s_ + kSameCutS) {
        // The tool was in the air: no cut until it meets material again.
        end_cut();
        contact::ContactSample none;
        none.position_mm = row.values.tip_mm;
        none.phase_rate_rad_per_s = row.values.spindle_rpm / 60 * math::kTwoPi;  // it idles
        if (heard_from_ < 0) {
            none.t_s = std::max(0.0, start - kLeadInS);
            track_->play_to(none, sink);
            heard_from_ = track_->frames_rendered();
        }
        none.t_s = start;
        track_->play_to(none, sink);
        track_->play_to(sample_of(row, edges, start), sink);
    }
    track_->play_to(sample_of(row, edges, 0.5 * (start + row.end_s)), sink);
    last_end_s_ = row.end_s;
    idle_ = {};
    idle_.position_mm = row.values.tip_mm;
    idle_.phase_rate_rad_per_s = row.values.spindle_rpm / 60 * math::kTwoPi;
}

void SoundFile::end_cut() {
    if (last_end_s_ < 0) return;
    track_->play_on(last_end_s_, [this](std::span<const float> block) { write(block); });
    idle_.t_s = last_end_s_;
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
    for (const sound::Extremes& e : waveform_.columns()) {
        constexpr auto kPascal = static_cast<float>(sound::kFullScalePascal);
        sound.envelope_pascal.emplace_back(kPascal * e.min, kPascal * e.max);
    }
    sound.heard_from_s = static_cast<double>(std::max<std::int64_t>(heard_from_, 0)) / rate;
    sound.rate_hz = rate;
    sound.stereo = heard_;
    return sound;
}

void ReportRows::add(const session::MillRow& row) {
    const milling::ForceRow& v = row.values;
    rows.push_back({v.t_s, row.end_s - v.t_s, v.line, v.tip_mm, length(v.mean_n), row.peaks.peak_force_n,
                    v.entry_deg, v.exit_deg, v.axial_depth_mm, v.spindle_rpm, v.feed_mm_per_min});
    if (row.peaks.peak_force_n > worst_.force_n) {
        worst_ = {row.peaks.peak_force_n, row.engagement,         row.feed,           row.cutter, v.t_s,
                  v.spindle_rpm,          v.feed_mm_per_min / 60, row.chip_mm3_per_s, v.line};
    }
}

std::optional<report::ReportTurn> ReportRows::turn(const session::MillSetup& setup) const {
    if (worst_.force_n <= 0) return std::nullopt;
    constexpr int kSteps = 360;
    milling::ForceModel model(setup.cutters[worst_.cutter], setup.coefficients);
    model.engage(worst_.engagement, worst_.feed);
    report::ReportTurn turn;
    turn.t_s = worst_.t_s;
    turn.rpm = worst_.rpm;
    turn.line = worst_.line;
    for (int n = 0; n < kSteps; ++n) turn.force_n.push_back(model.at(n * math::kTwoPi / kSteps).force_n);
    contact::ForceSpectrum spectrum;
    model.spectrum(setup.harmonics, spectrum);
    for (std::size_t n = 1; n < spectrum.harmonics.size(); ++n) {
        const contact::ForceHarmonic& h = spectrum.harmonics[n];
        const double amplitude = 2 * std::sqrt(std::norm(h.x) + std::norm(h.y));
        turn.spectrum.emplace_back(spectrum.order(n) * worst_.rpm / 60, amplitude);
    }
    return turn;
}

std::vector<report::ReportWave> ReportRows::waves(const session::MillSetup& setup,
                                                  const sound::SoundtrackOptions& options) const {
    std::vector<report::ReportWave> waves;
    if (worst_.force_n <= 0) return waves;
    // The force's own wave: chips and machine would hide it.
    sound::SoundtrackOptions force_alone = options;
    sound::furnish({}, force_alone);
    force_alone.chips.learned.reset();
    const auto wave = [&](double speed, double feed) {
        milling::ForceModel model(setup.cutters[worst_.cutter], setup.coefficients);
        model.engage(worst_.engagement, (feed / speed) * worst_.feed);
        contact::ForceSpectrum spectrum;
        model.spectrum(setup.harmonics, spectrum);
        contact::ContactSample cut;
        cut.position_mm = options.listener_mm;
        cut.force_n = model.mean().force_n;
        cut.phase_rate_rad_per_s = worst_.rpm * speed / 60 * math::kTwoPi;
        cut.spectrum = &spectrum;
        cut.edges = setup.cutters[worst_.cutter].flutes;
        char label[80];
        std::snprintf(label, sizeof label, "%.0f rpm, %.0f mm/min, peak %.0f N", worst_.rpm * speed,
                      worst_.feed_mm_per_s * feed * 60, model.peaks().peak_force_n);
        std::vector<float> samples = sound::steady_wave(cut, force_alone, kWaveS);
        for (float& sample : samples) sample *= static_cast<float>(sound::kFullScalePascal);
        waves.push_back({label, static_cast<double>(options.sample_rate_hz), std::move(samples)});
    };
    wave(1, 1);
    wave(1.5, 0.5);
    return waves;
}

}  // namespace tribo::app
