// SPDX-License-Identifier: MIT
// Writes the output files of one render.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "app/render/render.hpp"
#include "app/render/render_job.hpp"
#include "app/render/render_sinks.hpp"
#include "base/parallel.hpp"
#include "files/output_folder.hpp"
#include "report/summary_json.hpp"
#include "session/uncertain/force_bands.hpp"
#include "surface/designed_surface.hpp"
#include "surface/form_error.hpp"

namespace tribo::app {

class RenderOutputs {
  public:
    // All arguments must outlive this object.
    RenderOutputs(const RenderCall& call, PreparedJob& loaded, files::OutputFolder& folder,
                  const ParallelFor& parallel)
        : call_(call), loaded_(loaded), folder_(folder), parallel_(parallel) {}

    // True for the names of all files that a render may write.
    static bool writes(const std::string& name);

    // Call before the session runs.
    FileResult<void> open(const session::MillSession& session, const Box3& blank);
    bool needs_rows() const { return forces_ || sound_ || bands_ || call_.wants("report"); }
    // `chatter`: null without modes.
    void add(const milling::CutRow& row, const milling::RowForce& force, const session::MillSetup& setup,
             const session::RowChatter* chatter);
    // Call after it. Adds results and bands to `summary`. Moves the mesh of the designed part out of the job.
    // `chatter`: null without modes. `traces`: what the teeth left, if it was recorded.
    FileResult<void> finish(const session::MillSession& session, const session::ProgramChatter* chatter,
                            std::optional<surface::ToothTraces> traces, report::Summary& summary);

  private:
    void add_bands(const session::MillSession& session, const session::ProgramChatter* chatter,
                   report::Summary& summary) const;
    FileResult<void> write_surface(report::Summary& summary);
    // `on_blank`: of the vertices, see stock_faces.hpp.
    FileResult<void> write_mesh(const TriangleMesh& mesh, std::span<const std::uint8_t> on_blank);
    FileResult<void> compare(const session::MillSession& session, report::Summary& summary);
    report::ReportPart report_part(const report::Summary& summary, const TriangleMesh& mesh,
                                   std::vector<std::uint8_t> on_blank) const;
    FileResult<void> write_report(const session::MillSession& session, const session::ProgramChatter* chatter,
                                  const report::Summary& summary, TriangleMesh mesh,
                                  std::vector<std::uint8_t> on_blank);

    const RenderCall& call_;
    PreparedJob& loaded_;
    files::OutputFolder& folder_;
    const ParallelFor& parallel_;
    std::optional<ForceFile> forces_;
    std::optional<PublishedForceFile> published_;
    std::optional<SoundFile> sound_;
    ReportRows report_;
    std::optional<session::ForceBands> bands_;
    surface::FormError form_error_;                     // by bending of tool and part
    std::optional<surface::DesignedSurface> designed_;  // once compared
};

}  // namespace tribo::app
