// SPDX-License-Identifier: MIT
// Receivers of the rows of a session: forces.csv, sound.wav and the data of the report.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "files/files.hpp"
#include "files/sound/wav.hpp"
#include "milling/force/published_force.hpp"
#include "report/report_html.hpp"
#include "session/chatter/program_chatter.hpp"
#include "session/cut/mill_session.hpp"
#include "sound/cut/waveform.hpp"
#include "sound/play/soundtrack.hpp"
#include "sweep/band.hpp"

namespace tribo::app {

// Writes forces.csv row by row.
// PublishedForceFile writes the forces of the paper.
class ForceFile {
  public:
    static FileResult<ForceFile> create(const std::string& path, bool chatter, bool band);
    // `chatter`: null without modes. `band`: of the largest force in a turn; null without cases.
    void add(const milling::CutRow& row, const milling::ForcePeaks& force, const session::RowChatter* chatter,
             const sweep::Band* band);
    FileResult<void> finish();

  private:
    explicit ForceFile(files::FileWriter file) : file_(std::move(file)) {}
    files::FileWriter file_;
    std::string line_;
};

// Writes [K]{A} of the paper, as printed and corrected, for the deepest band of each row at the middle of its
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

// Writes sound.wav, as long as the program, and keeps the part that the report plays.
class SoundFile {
  public:
    static FileResult<SoundFile> create(const std::string& path, const SoundFileOptions& options,
                                        double duration_s);
    // `vibration`: of the row; null: none.
    void add(const milling::CutRow& row, const milling::RowForce& force, int edges,
             const contact::ForceTrace* vibration);
    FileResult<void> finish(double duration_s);
    report::ReportSound for_report() const;
    const sound::SoundtrackOptions& options() const { return options_.track; }

  private:
    SoundFile(files::WavWriter file, const SoundFileOptions& options);
    void write(std::span<const float> block);
    // Ends the sound at the end of the last row.
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

// Collects rows for the plots, and the turn with the largest force.
class ReportRows {
  public:
    // `chatter`: null without modes. `band`: of the largest force in a turn.
    void add(const milling::CutRow& row, const milling::ForcePeaks& force, const session::RowChatter* chatter,
             const sweep::Band& band);
    std::vector<report::ReportRow> rows;
    // Computes the turn with the largest force again, with all instants.
    std::optional<report::ReportTurn> turn(const session::MillSetup& setup) const;
    // Figure 8 of the paper: sound of this cut, and of the same cut at half the feed and 1.5 times the
    // spindle speed.
    std::vector<report::ReportWave> waves(const session::MillSetup& setup,
                                          const sound::SoundtrackOptions& options) const;

  private:
    milling::CutRow worst_;  // with the largest force
    double worst_force_n_ = 0;
};

}  // namespace tribo::app
