// SPDX-License-Identifier: MIT
#include "job/toml/job_writer.hpp"

#include "base/text/decimal.hpp"
#include "base/text/json_string.hpp"
#include "base/text/printable.hpp"
#include "job/toml/sections.hpp"
#include "job/words/tool_words.hpp"

namespace tribo::job {
namespace {

class JobText {
  public:
    explicit JobText(const std::function<std::string(const std::string&)>& path_of) : path_of_(path_of) {}

    void comment(const std::string& text) { text_ += "# " + printable(text) + "\n"; }
    void section(const char* name) { text_ += std::string("\n") + name + "\n"; }
    void number(const char* key, double value) { line(key, format_decimal(value)); }
    // Strings of JSON are strings of TOML too, unless they hold a DEL.
    void string(const char* key, std::string_view value) {
        std::string quoted;
        append_json_string(quoted, value);
        line(key, quoted);
    }
    void file(const char* key, const std::string& name) { string(key, path_of_(name)); }
    void box(const char* key, const Box3& box) {
        line(key, "[" + point(box.min) + ", " + point(box.max) + "]");
    }
    void vertices(const char* key, const std::vector<milling::ProfileVertex>& vertices) {
        std::string value;
        for (const milling::ProfileVertex& v : vertices)
            value += (value.empty() ? "[" : ", ") + point({v.r_mm, v.z_mm, v.bulge});
        line(key, value + "]");
    }
    std::string take() { return std::move(text_); }

  private:
    static std::string point(Vec3 p) {
        return "[" + format_decimal(p.x) + ", " + format_decimal(p.y) + ", " + format_decimal(p.z) + "]";
    }
    void line(const char* key, const std::string& value) { text_ += std::string(key) + " = " + value + "\n"; }

    const std::function<std::string(const std::string&)>& path_of_;
    std::string text_;
};

void write_stock(JobText& text, const JobSolid& stock) {
    text.section("[stock]");
    if (stock.model) {
        text.file("mesh", stock.model->path);
    } else {
        text.box("box_mm", stock.box_mm);
    }
}

void write_cutter(JobText& text, const milling::Cutter& cutter) {
    text.section("[[cutter]]");
    if (cutter.number > 0) text.number("number", cutter.number);
    text.string("kind", kCutterKindWords[static_cast<std::size_t>(cutter.kind)]);
    const bool is_profile = cutter.kind == milling::CutterKind::profile;
    if (!is_profile) text.number("diameter_mm", cutter.diameter_mm);
    for (const milling::ShapeKey& key : milling::kShapeKeys) {
        const double size = cutter.*key.value;
        if (size > 0 && milling::is_shape_key(cutter.kind, key.name)) text.number(key.name.data(), size);
    }
    if (is_profile) text.vertices("profile", cutter.profile);
    text.number("flutes", cutter.flutes);
    text.number("helix_deg", cutter.helix_deg);
    if (!milling::has_own_length(cutter.kind)) text.number("length_mm", cutter.length_mm);
    if (cutter.core_mm > 0) text.number("core_mm", cutter.core_mm);
}

void write_path(JobText& text, const JobPath& path) {
    text.section("[path]");
    text.file(kPathKindWords[static_cast<std::size_t>(path.kind)].data(), path.file);
    if (path.dialect) text.string("dialect", readers::kDialectWords[static_cast<std::size_t>(*path.dialect)]);
    if (!path.tools.empty()) text.file("tools", path.tools);
    if (is_machine_file(path.machine)) {
        text.file("machine", path.machine);
    } else if (!path.machine.empty()) {
        text.string("machine", path.machine);
    }
}

}  // namespace

std::string job_text(const LoadedJob& loaded, const std::function<std::string(const std::string&)>& path_of) {
    const Job& job = loaded.job;
    JobText text(path_of);
    text.comment("The job that stands for " + job.path.file + ".");
    if (!loaded.assumptions.empty()) text.comment("Assumed:");
    for (const Warning& assumption : loaded.assumptions) text.comment("- " + assumption.text);
    write_stock(text, job.stock);
    for (const milling::Cutter& cutter : job.cutters) write_cutter(text, cutter);
    text.section("[material]");
    text.string("name", job.material.name);
    text.section("[process]");
    text.comment("Where the program does not say.");
    text.number("spindle_rpm", job.process.spindle_rpm);
    text.number("feed_mm_per_min", job.process.feed_mm_per_min);
    write_path(text, job.path);
    return text.take();
}

}  // namespace tribo::job
