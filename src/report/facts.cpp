// SPDX-License-Identifier: MIT
#include "report/facts.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

#include "base/math.hpp"
#include "base/mesh_edges.hpp"
#include "base/text/printable.hpp"
#include "field/mesh/mesh_distance.hpp"
#include "files/json/json.hpp"
#include "job/program_tools.hpp"
#include "job/words/tool_words.hpp"
#include "milling/sweep/scallop.hpp"
#include "milling/tool/cutter_shape.hpp"
#include "motion/path/close_passes.hpp"

namespace tribo::report {
namespace {

constexpr std::string_view kPathNames[] = {"keyframes", "gcode", "apt"};

std::string_view path_name(job::PathKind kind) {
    return kPathNames[static_cast<std::size_t>(kind)];
}

// At most three decimals, without trailing zeros.
std::string number(double value) {
    std::array<char, 64> text = {};
    std::snprintf(text.data(), text.size(), "%.3f", value);
    std::string out = text.data();
    out.erase(out.find_last_not_of('0') + 1);
    if (out.ends_with('.')) out.pop_back();
    return out == "-0" ? "0" : out;
}

std::string range(double least, double most, const char* unit) {
    return number(least) + (most > least ? " to " + number(most) : "") + " " + unit;
}

std::string box_text(const Box3& box) {
    const auto side = [](const char* name, double a, double b) {
        return std::string(name) + " " + number(a) + " to " + number(b);
    };
    return side("x", box.min.x, box.max.x) + ", " + side("y", box.min.y, box.max.y) + ", " +
           side("z", box.min.z, box.max.z) + " mm";
}

std::string clock_text(double seconds) {
    const long s = std::lround(seconds);
    return s < 60 ? number(seconds) + " s"
                  : (s >= 3600 ? std::to_string(s / 3600) + " h " : "") + std::to_string(s / 60 % 60) +
                        " min " + std::to_string(s % 60) + " s";
}

files::Json box_json(const Box3& box) {
    return files::Json::array({files::triple(box.min), files::triple(box.max)});
}

// Builds text and JSON together.
class Builder {
  public:
    explicit Builder(const char* kind) {
        json["schema"] = "tribo.inspect/1";
        json["kind"] = kind;
    }
    void line(std::string name, std::string text) {
        facts.lines.emplace_back(std::move(name), std::move(text));
    }
    Facts finish() {
        json["warnings"] = files::Json::array();
        for (const Warning& w : facts.warnings) json["warnings"].push_back(w.message());
        facts.json = files::pretty(json);
        return std::move(facts);
    }

    files::Json json;
    Facts facts;
};

std::string tools_text(const std::vector<int>& numbers) {
    std::string text;
    for (const int tool : numbers) text += (text.empty() ? "T" : ", T") + std::to_string(tool);
    return text;
}

// Its kind of docs/job.md.
std::string kind_of(const motion::DeclaredTool& tool) {
    if (!tool.kind.empty()) return tool.kind;
    return tool.corner_mm == 0 ? "flat" : 2 * tool.corner_mm >= tool.diameter_mm ? "ball" : "bull";
}

files::Json declared_tools(const motion::Program& program) {
    files::Json tools = files::Json::array();
    for (const motion::DeclaredTool& tool : program.tools) {
        files::Json entry;
        entry["number"] = tool.number;
        if (tool.diameter_mm > 0) entry["diameter_mm"] = tool.diameter_mm;
        if (tool.diameter_mm > 0) {
            entry["corner_mm"] = tool.corner_mm;
            entry["kind"] = kind_of(tool);
        }
        if (tool.flutes > 0) entry["flutes"] = tool.flutes;
        const std::pair<const char*, double> sizes[] = {
            {"tip_mm", tool.tip_mm},   {"point_deg", tool.point_deg},     {"taper_deg", tool.taper_deg},
            {"side_mm", tool.side_mm}, {"height_mm", tool.height_mm},     {"neck_mm", tool.neck_mm},
            {"edge_mm", tool.edge_mm}, {"stickout_mm", tool.stickout_mm}, {"shank_mm", tool.shank_mm},
        };
        for (const auto& [key, size] : sizes) {
            if (size > 0) entry[key] = size;
        }
        entry["file"] = tool.table.empty() ? program.source : tool.table;
        if (tool.line > 0) entry["line"] = tool.line;
        tools.push_back(std::move(entry));
    }
    return tools;
}

// The shape and sizes of a tool, and where they were read.
std::string declared_text(const motion::DeclaredTool& tool) {
    std::string text = tool.number > 0 ? "T" + std::to_string(tool.number) + ": " : "";
    text += kind_of(tool) + " D" + number(tool.diameter_mm);
    if (tool.corner_mm > 0 && kind_of(tool) != "ball") text += " corner " + number(tool.corner_mm);
    if (tool.point_deg > 0) text += " point " + number(tool.point_deg) + " deg";
    if (tool.taper_deg > 0) text += " taper " + number(tool.taper_deg) + " deg";
    if (tool.tip_mm > 0) text += " tip " + number(tool.tip_mm);
    if (tool.flutes > 0)
        text += ", " + std::to_string(tool.flutes) + (tool.flutes == 1 ? " flute" : " flutes");
    return text + " (" + (tool.table.empty() ? "" : tool.table + ", ") + "line " + std::to_string(tool.line) +
           ")";
}

// The tools that a program calls and neither it nor a table describes: "T3, T4".
std::string undescribed_tools(const motion::Program& program, const std::vector<int>& called) {
    const job::DeclaredTools declared(program);
    std::vector<int> numbers;
    for (const int tool : called) {
        if (declared.find(tool) == nullptr) numbers.push_back(tool);
    }
    return tools_text(numbers);
}

std::string cutter_text(const milling::Cutter& c) {
    std::string text = c.number > 0 ? "T" + std::to_string(c.number) + ": " : "";
    text += std::string(milling::kCutterKindWords[static_cast<std::size_t>(c.kind)]) + " D" +
            number(c.diameter_mm);
    text += job::shape_words(c);
    text += ", " + std::to_string(c.flutes) + (c.flutes == 1 ? " flute" : " flutes") + ", helix " +
            number(c.helix_deg) + " deg, " + number(c.length_mm) + " mm long";
    if (c.stickout_mm > 0) text += ", sticks out " + number(c.stickout_mm) + " mm";
    if (!c.holder.empty()) text += ", holder of " + std::to_string(c.holder.size()) + " steps";
    return text;
}

files::Json cutter_json(const milling::Cutter& c) {
    files::Json json;
    if (c.number > 0) json["number"] = c.number;
    json["kind"] = milling::kCutterKindWords[static_cast<std::size_t>(c.kind)];
    json["diameter_mm"] = c.diameter_mm;
    for (const milling::ShapeKey& key : milling::kShapeKeys) {
        const double size = c.*key.value;
        if (size > 0 && milling::is_shape_key(c.kind, key.name)) json[std::string(key.name)] = size;
    }
    for (const milling::ProfileVertex& v : c.profile) json["profile"].push_back({v.r_mm, v.z_mm, v.bulge});
    json["flutes"] = c.flutes;
    json["helix_deg"] = c.helix_deg;
    json["length_mm"] = c.length_mm;
    if (c.stickout_mm > 0) json["stickout_mm"] = c.stickout_mm;
    return json;
}

// Each [[frf]] with what was fitted to it.
void add_responses(Builder& b, const job::Job& job) {
    for (const job::JobFrf& frf : job.frfs) {
        if (!frf.fit) continue;
        b.json["frf"].push_back(
            {{"file", frf.file}, {"modes", frf.fit->modes.size()}, {"residual", frf.fit->residual}});
        b.line("frf", frf.file + ": " + std::to_string(frf.fit->modes.size()) + " modes, residual " +
                          number(100 * frf.fit->residual) + " %");
    }
}

void add_solid(Builder& b, const job::JobSolid& solid, const std::string& name) {
    if (solid.model) {
        b.json[name]["mesh"] = solid.model->path;
        b.line(name, solid.model->path);
    } else {
        b.json[name]["box_mm"] = box_json(solid.box_mm);
        b.line(name, box_text(solid.box_mm));
    }
}

void add_material(Builder& b, const job::JobMaterial& material) {
    if (!material.coefficients) {
        b.json["material"]["name"] = material.name;
        b.line("material", material.name);
        return;
    }
    const milling::CuttingCoefficients& k = *material.coefficients;
    b.json["material"] = {{"ktc_n_per_mm2", k.ktc}, {"krc_n_per_mm2", k.krc}, {"kac_n_per_mm2", k.kac},
                          {"kte_n_per_mm", k.kte},  {"kre_n_per_mm", k.kre},  {"kae_n_per_mm", k.kae}};
    b.line("material", "own coefficients: ktc " + number(k.ktc) + ", krc " + number(k.krc) + ", kac " +
                           number(k.kac) + " N/mm2; kte " + number(k.kte) + ", kre " + number(k.kre) +
                           ", kae " + number(k.kae) + " N/mm");
}

// Adds the facts of a named file under their own key. Its lines follow the name; its warnings are appended.
void add_inner(Builder& b, const char* name, const Facts& inner) {
    b.json[name] = files::parse(inner.json);
    b.json[name].erase("schema");
    for (const auto& [line_name, text] : inner.lines) b.line(std::string(name) + " " + line_name, text);
    b.facts.warnings.insert(b.facts.warnings.end(), inner.warnings.begin(), inner.warnings.end());
}

// A mesh whose places, counted once, differ by more than this share from its own volume overlaps itself.
constexpr double kSameVolume = 1e-6;

// Smaller or larger parts are rarely milled: their unit is probably wrong, mm.
constexpr double kSmallestPartMm = 3, kLargestPartMm = 5000;

std::string counted(std::uint64_t count, const char* one, const char* many) {
    return std::to_string(count) + " " + (count == 1 ? one : many);
}

// Equal corners count once, however often the file repeats them.
void add_edges(Builder& b, TriangleMesh mesh, bool closed) {
    weld_exactly(mesh);
    const MeshEdges e = describe_edges(mesh);
    b.json["pieces"] = e.pieces;
    b.json["open_edges"] = e.open;
    b.json["holes"] = e.holes;
    b.json["crowded_edges"] = e.crowded;
    b.json["turned_edges"] = e.turned;
    b.line("pieces", std::to_string(e.pieces));
    std::string text = closed || e.open + e.crowded + e.turned == 0 ? "yes" : "no: ";
    if (e.open > 0) text += counted(e.holes, "hole", "holes") + " of " + counted(e.open, "edge", "edges");
    if (e.crowded > 0) {
        text +=
            (e.open > 0 ? ", " : "") + counted(e.crowded, "edge", "edges") + " of more than two triangles";
    }
    if (e.turned > 0) {
        text += (e.open + e.crowded > 0 ? ", " : "") + counted(e.turned, "edge", "edges") +
                " where one side is inside out";
    }
    b.line("closed", text);
}

void add_unit_warning(Builder& b, const Box3& box, const readers::Model& model) {
    if (box.empty()) return;
    const double across = length(box.size());
    if (across >= kSmallestPartMm && across <= kLargestPartMm) return;
    const bool is_small = across < kSmallestPartMm;
    std::string text = "the model is only " + number(across) + " mm across";
    if (!is_small) text = "the model is " + number(across / 1000) + " m across";
    text += ": if its unit is not the millimetre, set unit_mm";
    if (is_small) text += ", 1000 for metres or 25.4 for inches";
    if (model.format == readers::ModelFormat::vrml && is_small) text += "; VRML means metres";
    b.facts.warnings.push_back({"", 0, text});
}

// A smaller share of the path is a lead-in, a corner or the end of a raster.
constexpr double kLeastShareOfPasses = 0.1;

// Distance between passes and height of the cusps between them, from the shape of the inclined cutter (Xia
// and Ge 2001: effective cutting shape).
void add_passes(Builder& b, const milling::Cutter& cutter, std::span<const motion::Move> moves) {
    const motion::ClosePasses passes = motion::close_passes(moves, cutter.diameter_mm);
    if (passes.share < kLeastShareOfPasses) return;
    b.json["passes"] = {{"share", passes.share}, {"sidestep_mm", passes.sidestep_mm}};
    std::string text = number(passes.sidestep_mm) + " mm aside over " +
                       number(std::floor(100 * passes.share)) + " % of the feed path";
    if (cutter.has_profile()) {
        b.line("passes", text + "; the cusps of this kind of cutter are not computed: measure the part");
        return;
    }
    const double scallop =
        milling::scallop_height_mm(cutter, {passes.tilt_rad, passes.turn_rad}, passes.sidestep_mm);
    if (std::isfinite(scallop)) {
        b.json["passes"]["scallop_mm"] = scallop;
        text += ", cusps of " + number(scallop) + " mm on a plane";
    }
    b.line("passes", text);
}

}  // namespace

Facts describe(const motion::Program& program, const motion::ProgramMeter& meter, job::PathKind format,
               double rapid_mm_per_min) {
    const motion::ProgramSummary s = meter.summary(rapid_mm_per_min);
    Builder b("program");
    b.json["format"] = path_name(format);
    b.line("format", std::string(path_name(format)));
    if (!program.dialect.empty()) {
        b.json["dialect"] = program.dialect;
        b.line("dialect", program.dialect);
    }
    b.json["moves"] = s.moves;
    b.json["feed_moves"] = s.feed_moves;
    b.line("moves", std::to_string(s.moves) + ", " + std::to_string(s.feed_moves) + " of them at feed");
    b.json["path_mm"] = s.path_mm;
    b.json["rapid_mm"] = s.rapid_mm;
    b.line("path", number(s.path_mm) + " mm at feed, " + number(s.rapid_mm) + " mm rapid");
    if (!s.bounds_mm.empty()) {
        b.json["bounds_mm"] = box_json(s.bounds_mm);
        b.line("bounds", box_text(s.bounds_mm));
    }
    b.json["tools"] = s.tools;
    if (!s.tools.empty()) b.line("tools", tools_text(s.tools));
    if (!program.tools.empty()) b.json["declared_tools"] = declared_tools(program);
    for (const motion::DeclaredTool& tool : program.tools) {
        if (tool.diameter_mm > 0) b.line("tool", declared_text(tool));
    }
    if (const std::string text = undescribed_tools(program, s.tools); !text.empty())
        b.line("tool", text + ": not described");
    b.json["rotary"] = program.has_rotary_words;
    b.json["tilted"] = s.tilted;
    if (!program.machine.empty()) {
        b.json["machine"] = program.machine;
        b.line("machine", program.machine);
    }
    if (s.tilted) {
        const double tilt_deg = s.tilt_rad * math::kDegPerRad;
        b.json["tilt_deg"] = tilt_deg;
        b.line("axis", "leaves +z, by up to " + number(tilt_deg) + " deg");
    }
    if (program.stock) {
        b.json["stock"]["box_mm"] = box_json(program.stock->box_mm);
        b.line("stock",
               box_text(program.stock->box_mm) + " (line " + std::to_string(program.stock->line) + ")");
    }
    if (s.feed_mm_per_min.most > 0) {
        b.json["feed_mm_per_min"] = {s.feed_mm_per_min.least, s.feed_mm_per_min.most};
        b.line("feed", range(s.feed_mm_per_min.least, s.feed_mm_per_min.most, "mm/min"));
        b.json["feed_s"] = s.feed_s;
        b.line("time", clock_text(s.feed_s) + " at feed, " + clock_text(s.rapid_s) + " rapid");
    }
    if (s.spindle_rpm.most > 0) {
        b.json["spindle_rpm"] = {s.spindle_rpm.least, s.spindle_rpm.most};
        b.line("spindle", range(s.spindle_rpm.least, s.spindle_rpm.most, "rpm"));
    }
    b.json["rapid_s"] = s.rapid_s;
    if (s.dwell_s > 0) b.json["dwell_s"] = s.dwell_s;
    b.facts.warnings = program.warnings;
    return b.finish();
}

Facts describe(const readers::Model& model) {
    Builder b("model");
    const TriangleMesh& mesh = model.mesh;
    b.json["format"] = readers::name(model.format);
    b.line("format", std::string(readers::name(model.format)));
    b.json["triangles"] = mesh.triangles.size();
    b.json["vertices"] = mesh.positions.size();
    b.line("triangles", std::to_string(mesh.triangles.size()) + " on " +
                            std::to_string(mesh.positions.size()) + " vertices");
    const double area = area_mm2(mesh);
    b.json["area_mm2"] = area;
    b.line("area", number(area) + " mm2");
    const Box3 box = bounds(mesh);
    if (!box.empty()) {
        b.json["bounds_mm"] = box_json(box);
        b.line("bounds", box_text(box));
    }
    if (!model.parts.empty()) {
        b.json["parts"] = model.parts.size();
        b.line("parts", std::to_string(model.parts.size()));
    }
    const bool closed = is_closed(mesh);
    b.json["closed"] = closed;
    if (closed) {
        const double of_mesh = volume_mm3(mesh);
        const double volume = std::copysign(field::MeshDistance::of_solid(mesh).volume_mm3(), of_mesh);
        const bool overlaps = std::abs(volume - of_mesh) > kSameVolume * std::abs(volume);
        b.json["volume_mm3"] = volume;
        b.line("volume",
               number(volume) + " mm3" + (overlaps ? "; it overlaps itself, each place counts once" : ""));
    }
    add_edges(b, mesh, closed);
    b.facts.warnings = model.warnings;
    add_unit_warning(b, box, model);
    if (closed && volume_mm3(mesh) < 0) {
        b.facts.warnings.push_back(
            {"", 0, "the model is inside out: its triangles run clockwise seen from outside"});
    }
    return b.finish();
}

Facts describe(const job::Job& job, const Facts* program, const Facts* part,
               std::span<const motion::Move> moves) {
    Builder b("job");
    b.line("format", "job");
    if (job.stock_from) {
        b.json["stock"]["from"] = job.stock_from->path;
        b.line("stock", "as " + job.stock_from->path + " leaves it");
    } else {
        add_solid(b, job.stock, "stock");
    }
    b.json["cutters"] = files::Json::array();
    for (const milling::Cutter& cutter : job.cutters) {
        b.json["cutters"].push_back(cutter_json(cutter));
        b.line("cutter", cutter_text(cutter));
    }
    add_material(b, job.material);
    if (job.process.spindle_rpm > 0) {
        b.json["process"]["spindle_rpm"] = job.process.spindle_rpm;
        b.line("spindle", number(job.process.spindle_rpm) + " rpm");
    }
    if (job.process.feed_mm_per_min > 0) {
        b.json["process"]["feed_mm_per_min"] = job.process.feed_mm_per_min;
        b.line("feed", number(job.process.feed_mm_per_min) + " mm/min");
    }
    b.json["path"][std::string(path_name(job.path.kind))] = job.path.file;
    b.line("path", job.path.file);
    if (job.cutters.size() == 1) add_passes(b, job.cutters[0], moves);
    if (!job.fixtures.empty()) {
        b.json["fixtures"] = job.fixtures.size();
        b.line("fixtures", std::to_string(job.fixtures.size()));
    }
    add_responses(b, job);
    if (program) add_inner(b, "program", *program);
    if (part) add_inner(b, "part", *part);
    return b.finish();
}

std::string aligned(const std::vector<std::pair<std::string, std::string>>& lines) {
    std::size_t width = 0;
    for (const auto& [name, text] : lines) width = std::max(width, name.size());
    std::string out;
    for (const auto& [name, text] : lines) {
        out += "  " + name + std::string(width - name.size() + 2, ' ') + printable(text) + "\n";
    }
    return out;
}

}  // namespace tribo::report
