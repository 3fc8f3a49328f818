// SPDX-License-Identifier: MIT
#include "app/render/report_sheet.hpp"

#include <algorithm>
#include <filesystem>

#include "base/text/decimal.hpp"
#include "files/files.hpp"
#include "files/sha256.hpp"
#include "job/words/tool_words.hpp"

namespace tribo::app {
namespace {

std::string digits(double value) {
    return format_digits(value, 4);
}

std::string place(Vec3 p) {
    return digits(p.x) + ", " + digits(p.y) + ", " + digits(p.z);
}

std::string box_words(const Box3& box) {
    const Vec3 size = box.size();
    return digits(size.x) + " x " + digits(size.y) + " x " + digits(size.z) + " mm, from (" + place(box.min) +
           ") to (" + place(box.max) + ") mm";
}

std::string solid_words(const job::JobSolid& solid) {
    return solid.model ? solid.model->path : box_words(solid.box_mm);
}

report::HtmlTable set_up(const std::string& file, const PreparedJob& loaded,
                         const session::MillSession& session) {
    const job::Job& job = loaded.job;
    report::HtmlTable table;
    table.title = "Set-up sheet";
    table.hint =
        "Coordinates are those of the stock, mm. The program counts from its zero point, (0, 0, 0) unless it "
        "shifts it.";
    table.header = {"Item", "Value"};
    const auto add = [&](const char* name, const std::string& text) { table.rows.push_back({name, text}); };
    add("Job", file);
    if (job.path.file != file) add("Program", job.path.file);
    add("Machine", job.path.machine.empty() ? (job.machine.kinematics ? "axes as in the job" : "three axes")
                                            : job.path.machine);
    add("Material", std::string(loaded.material.name));
    const std::string box = box_words(session.stock().blank().bounds_mm());
    if (job.stock_from) {
        add("Stock", "as " + job.stock_from->path + " leaves it: " + box);
    } else {
        add("Stock", job.stock.model ? job.stock.model->path + ": " + box : box);
    }
    if (job.setup)
        add("Clamped", "zero at (" + place(job.setup->origin_mm) + ") mm of the earlier job, x along (" +
                           place(job.setup->x) + "), z along (" + place(job.setup->z) + ")");
    for (const job::JobSolid& fixture : job.fixtures) add("Fixture", solid_words(fixture));
    return table;
}

std::string range_words(double low, double high) {
    return low < high ? digits(low) + " to " + digits(high) : digits(high);
}

std::string holder_words(const milling::Cutter& cutter) {
    if (cutter.holder.empty()) return "not given";
    double most = 0, height = 0;
    for (const milling::HolderStep& step : cutter.holder) {
        most = std::max(most, step.diameter_mm);
        height += step.length_mm;
    }
    return "D" + digits(most) + ", " + digits(height) + " long";
}

report::HtmlTable tools(const session::MillSetup& setup, std::span<const report::ReportRow> rows) {
    report::HtmlTable table;
    table.title = "Tools";
    table.hint =
        "Lengths in mm, the stick-out from the tip to the face of the holder. Force: the largest, N.";
    table.header = {"T",         "Cutter", "Edges",          "Stick-out", "Holder", "Spindle, rpm",
                    "In cut, s", "Force",  "Deepest cut, mm"};
    for (std::size_t n = 0; n < setup.cutters.size(); ++n) {
        const milling::Cutter& cutter = setup.cutters[n];
        double cut_s = 0, force_n = 0, depth_mm = 0, least_rpm = 0, most_rpm = 0;
        for (const report::ReportRow& row : rows) {
            if (row.cutter != n) continue;
            least_rpm = cut_s > 0 ? std::min(least_rpm, row.rpm) : row.rpm;
            most_rpm = std::max(most_rpm, row.rpm);
            cut_s += row.duration_s;
            force_n = std::max(force_n, row.peak_n);
            depth_mm = std::max(depth_mm, row.depth_mm);
        }
        const bool cuts = cut_s > 0;
        table.rows.push_back({cutter.number > 0 ? std::to_string(cutter.number) : "", job::tool_words(cutter),
                              digits(cutter.length_mm),
                              cutter.stickout_mm > 0 ? digits(cutter.stickout_mm) : "not given",
                              holder_words(cutter), cuts ? range_words(least_rpm, most_rpm) : "cuts nothing",
                              cuts ? format_digits(cut_s, 3) : "", cuts ? format_digits(force_n, 3) : "",
                              cuts ? format_digits(depth_mm, 3) : ""});
    }
    return table;
}

// All that this process has read and that still stands there.
report::HtmlTable files_read() {
    report::HtmlTable table;
    table.title = "Files";
    table.hint = "The page was made of these, as sha256sum counts them.";
    table.header = {"File", "SHA-256"};
    for (const auto& [name, stamp] : files::stamps_of_files_read()) {
        std::error_code error;
        // A pipe can be read once.
        if (stamp == files::FileStamp{} || !std::filesystem::is_regular_file(name, error)) continue;
        const auto bytes = files::read_file(name, files::kLargestInputBytes, files::Pipes::refuse);
        if (bytes) table.rows.push_back({name, files::sha256(*bytes)});
    }
    return table;
}

}  // namespace

std::vector<report::HtmlTable> report_sheet(const std::string& file, const PreparedJob& loaded,
                                            const session::MillSession& session,
                                            std::span<const report::ReportRow> rows) {
    return {set_up(file, loaded, session), tools(session.setup(), rows), files_read()};
}

}  // namespace tribo::app
