// SPDX-License-Identifier: MIT
// Where the rows of a session go: forces.csv, sound.wav, and what the report shows.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "files/files.hpp"
#include "files/sound/wav.hpp"
#include "milling/force/published_force.hpp"
#include "report/report_html.hpp"
#include "session/cut/mill_session.hpp"
#include "sound/cut/waveform.hpp"
#include "sound/play/soundtrack.hpp"

namespace tribo::app {

// forces.csv, row by row; with the paper's forces beside the corrected ones in published_forces.csv where
// asked for.
class ForceFile {
  public:
    static FileResult<ForceFile> create(const std::string& path);
    void add(const milling::CutRow& row, const milling::ForcePeaks& force);
    FileResult<void> finish();

  private:
    explicit ForceFile(files::FileWriter file) : file_(std::move(file)) {}
    files::FileWriter file_;
    std::string line_;
};

// The paper's [K]{A}, as printed and as corrected, for each row's deepest band in the middle of its
// engagement.
class PublishedForceFile {
  public:
    static FileResult<PublishedForceFile> create(const std::string& path);
    void add(const milling::CutRow& row, const milling::Cutter& cutter,
             const milling::CuttingCoefficients& k);
    FileResult<void> finish();

  private:
    explicit PublishedForceFile(files::FileWriter file) : file_(std::move(file)) {}
    files::FileWriter file_;
};

struct SoundFileOptions {
    files::WavFormat format;
    sound::SoundtrackOptions track;
};

// sound.wav as long as the program, silent where nothing is cut, and the stretch of it that the report plays.
class SoundFile {
  public:
    static FileResult<SoundFile> create(const std::string& path, const SoundFileOptions& options,
                                        double duration_s);
    void add(const milling::CutRow& row, const milling::RowForce& force, int edges);
    FileResult<void> finish(double duration_s);
    report::ReportSound for_report() const;
    const sound::SoundtrackOptions& options() const { return options_.track; }

  private:
    SoundFile(files::WavWriter file, const SoundFileOptions& options);
    void write(std::span<const float> block);
    // The last row sounds to its end, and no longer.
    void end_cut();

    SoundFileOptions options_;
    files::WavWriter file_;
    std::unique_ptr<sound::Soundtrack> track_;
    sound::Waveform waveform_;
    double last_end_s_ = -1;
    contact::ContactSample idle_;  // the spindle after the last row
    std::vector<float> heard_;
    std::int64_t heard_from_ = -1;  // frame of the first sound
};

// Rows for the plots, and the turn with the largest force.
class ReportRows {
  public:
    void add(const milling::CutRow& row, const milling::ForcePeaks& force);
    std::vector<report::ReportRow> rows;
    // Works the worst turn out again, instant by instant.
    std::optional<report::ReportTurn> turn(const session::MillSetup& setup) const;
    // Figure 8 of the paper: how that cut sounds, and how it would half as fast with the spindle at one and a
    // half times its speed.
    std::vector<report::ReportWave> waves(const session::MillSetup& setup,
                                          const sound::SoundtrackOptions& options) const;

  private:
    milling::CutRow worst_;  // with the largest force
    double worst_force_n_ = 0;
};

}  // namespace tribo::app
