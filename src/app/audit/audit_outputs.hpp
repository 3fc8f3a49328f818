// SPDX-License-Identifier: MIT
// What `tribo audit` writes and prints.
#pragma once

#include <string>
#include <vector>

#include "app/audit/audit.hpp"
#include "app/audit/speed_advice.hpp"
#include "app/render/render_job.hpp"
#include "files/files.hpp"
#include "session/audit/part_errors.hpp"
#include "session/audit/verdict.hpp"
#include "surface/form_error.hpp"

namespace tribo::app {

// True for the names of all files that an audit may write.
bool is_audit_file(const std::string& name);

// audit.csv: a line for each line of the program, while it is milled. With columns of the finished part,
// which is known only in the end, the lines are kept till then.
class AuditCsv {
  public:
    static FileResult<AuditCsv> create(const std::string& path, bool has_form_error, bool has_design);
    void add(const session::LoadTally& line, const session::LoadModel& model,
             const session::MillSetup& setup);
    // `errors`: with a design.
    FileResult<void> finish(const surface::FormError& form_error,
                            const std::optional<session::PartErrors>& errors);

  private:
    struct Row {
        double start_s = 0, end_s = 0;
        std::string text;
    };
    AuditCsv(files::FileWriter file, bool has_form_error, bool has_design)
        : file_(std::move(file)), has_form_error_(has_form_error), has_design_(has_design) {}

    files::FileWriter file_;
    bool has_form_error_, has_design_;
    std::vector<Row> rows_;  // with either
};

// The largest value in each of many equal stretches of the program.
class LoadCurve {
  public:
    explicit LoadCurve(double duration_s) : duration_s_(duration_s), values_(kSteps) {}
    void add(double from_s, double to_s, double value);
    double duration_s() const { return duration_s_; }
    const std::vector<double>& values() const { return values_; }

  private:
    static constexpr std::size_t kSteps = 1000;

    double duration_s_;
    std::vector<double> values_;
};

struct AuditAnswer {
    explicit AuditAnswer(double duration_s) : force_n(duration_s), ratio(duration_s) {}

    session::Audit audit;
    session::Verdict verdict;
    session::AuditFacts facts;
    std::optional<double> scallop_mm, rest_mm;
    std::optional<session::PartErrors> errors;  // with a design
    SpeedAdvice speeds;                         // with --stable
    std::optional<int> uncertain;               // cases of which the bands are
    Warnings warnings;
    LoadCurve force_n, ratio;  // ratio: to the limit that is nearest
};

std::string audit_json(const AuditCall& call, const AuditAnswer& answer, const PreparedJob& loaded,
                       const session::LoadModel& model, const session::MillSession& session);
std::string audit_html(const AuditCall& call, const AuditAnswer& answer, const PreparedJob& loaded,
                       const session::LoadModel& model, const session::MillSession& session);
// For people.
void print(const AuditAnswer& answer, const session::LoadModel& model, const session::MillSession& session);

}  // namespace tribo::app
