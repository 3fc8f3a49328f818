// SPDX-License-Identifier: MIT
// The C ABI of tribo.wasm for the worker of the mill page: files in by name, a job opened, time that passes,
// frames out (docs/live-protocol.md). The frames are the same as those of an engine. One open mill per
// module.
//
// Texts go in as bytes and a length, in memory from tribo_allocate; what comes out stays until the next call.
#include <array>
#include <cstdint>
#include <cstring>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "base/text/decimal.hpp"
#include "job/memory_source.hpp"
#include "milling/tool/materials.hpp"
#include "motion/machine/machine.hpp"
#include "session/live/live_audit.hpp"
#include "session/live/live_compare.hpp"
#include "session/live/single_threaded_touch.hpp"
#include "surface/part_difference.hpp"
#include "wasm/mill_job.hpp"

#define TRIBO_EXPORT(name) extern "C" __attribute__((export_name(#name)))

namespace {

using namespace tribo;

struct Mill {
    job::MemorySource files;                  // given by the page
    std::unique_ptr<session::LiveMill> kept;  // see mill_keep()
    // Each of these three must be destroyed before those above it.
    std::unique_ptr<session::LiveMill> live;
    std::unique_ptr<session::LiveController> controller;
    std::unique_ptr<session::SingleThreadedTouch> touch;
    bool files_changed = false;  // since the open job was read
    std::string text;
    std::vector<double> audit_lines;
    std::array<double, 2> volumes_mm3{};
    std::vector<double> joined;
    std::vector<std::uint8_t> frames;  // each: u32 length, u32 0, its bytes, zeros to a multiple of 8
};

Mill& mill() {
    static Mill the_mill;
    return the_mill;
}

std::string text_of(const char* bytes, std::uint32_t length) {
    return {bytes, length};
}

bool refuse(const Error& error) {
    mill().text = error.text();
    return false;
}

void keep(std::span<const std::uint8_t> frame) {
    std::vector<std::uint8_t>& all = mill().frames;
    const auto length = static_cast<std::uint32_t>(frame.size());
    for (unsigned n = 0; n < 8; ++n) all.push_back(n < 4 ? static_cast<std::uint8_t>(length >> (8 * n)) : 0);
    all.insert(all.end(), frame.begin(), frame.end());
    all.resize((all.size() + 7) / 8 * 8);
}

void append(const std::optional<session::CutStretch>& stretch, std::vector<double>& numbers) {
    if (!stretch) {
        numbers.insert(numbers.end(), 6 + session::kQuantities, std::numeric_limits<double>::quiet_NaN());
        return;
    }
    const auto& [x, y, z] = stretch->tip_mm;
    numbers.insert(numbers.end(),
                   {stretch->from_s, stretch->to_s, static_cast<double>(stretch->line), x, y, z});
    numbers.insert(numbers.end(), stretch->value.begin(), stretch->value.end());
}

}  // namespace

// Stores a file; `bytes` may be released afterwards.
TRIBO_EXPORT(mill_put_file)
void mill_put_file(const char* name, std::uint32_t name_length, const char* bytes, std::uint32_t length) {
    mill().files.put(text_of(name, name_length), text_of(bytes, length));
    mill().files_changed = true;
}
TRIBO_EXPORT(mill_forget_files) void mill_forget_files() {
    mill().files.clear();
    mill().files_changed = true;
}

// Opens a job or a program of the files. `part` names a model as its designed surface, or is empty. cell_mm
// 0: the default spacing of the job. Returns 1 on success: mill_text() has the warnings, one per line.
// Returns 0 if refused: mill_text() has the error, and the open job stays.
TRIBO_EXPORT(mill_open)
std::uint32_t mill_open(const char* name, std::uint32_t name_length, const char* part,
                        std::uint32_t part_length, double cell_mm) {
    const std::string job = text_of(name, name_length), surface = text_of(part, part_length);
    const auto cell = cell_mm > 0 ? std::optional(cell_mm) : std::nullopt;
    auto loaded = wasm::load_mill(mill().files, job, surface, cell);
    if (!loaded) return refuse(loaded.error());
    std::string warnings;
    for (const Warning& w : loaded->extras.warnings) warnings += w.message() + "\n";
    // When the clock is set back, the program begins again from the files.
    auto ready = std::make_shared<std::optional<session::LiveInput>>(*std::move(loaded));
    const auto make_input = [=]() -> Result<session::LiveInput> {
        if (*ready) return *std::exchange(*ready, std::nullopt);
        return wasm::load_mill(mill().files, job, surface, cell);
    };
    mill().files_changed = false;
    auto live = session::LiveMill::create(make_input, serial_for,
                                          [] { return std::exchange(mill().files_changed, false); });
    if (!live) return refuse(live.error());
    mill().touch.reset();
    mill().controller.reset();
    mill().live = std::move(*live);
    mill().controller = std::make_unique<session::LiveController>(*mill().live, session::LiveForceOptions{},
                                                                  nullptr, protocol::LiveSettings());
    mill().touch = std::make_unique<session::SingleThreadedTouch>(*mill().controller);
    mill().text = warnings;
    return true;
}

// Returns the last text, with a terminating zero.
TRIBO_EXPORT(mill_text) const char* mill_text() {
    return mill().text.c_str();
}

// Writes the job that stands for a program of the files, also for one that mill_open() refuses as its rotary
// words have no machine. Returns 1 on success: mill_text() is the job file. Returns 0 if refused: mill_text()
// has the error.
TRIBO_EXPORT(mill_job_text) std::uint32_t mill_job_text(const char* name, std::uint32_t name_length) {
    auto text = wasm::job_of_program(mill().files, text_of(name, name_length));
    if (!text) return refuse(text.error());
    mill().text = *std::move(text);
    return true;
}

// Executes a command (protocol/live_command.hpp): its operation and its values. Returns 1 on success, 0 if
// refused; mill_text() has the error.
TRIBO_EXPORT(mill_command)
std::uint32_t mill_command(const char* op, std::uint32_t op_length, double value, std::uint32_t on,
                           double x_mm, double y_mm, double z_mm, const char* word,
                           std::uint32_t word_length) {
    if (!mill().controller) return refuse(fail("no job is open", "call mill_open first").error());
    const auto operation = protocol::find_live_operation({op, op_length});
    if (!operation) return refuse(operation.error());
    const protocol::LiveCommand command{
        operation->op, value, on != 0, {x_mm, y_mm, z_mm}, text_of(word, word_length)};
    if (auto good = protocol::check_live_command(*operation, command); !good) return refuse(good.error());
    const auto obeyed = mill().controller->obey(command);
    return obeyed ? 1 : refuse(obeyed.error());
}
// Returns the settings of the open mill, in the form that an engine sends to a page.
TRIBO_EXPORT(mill_settings) const char* mill_settings() {
    mill().text = protocol::live_settings(mill().controller->settings());
    return mill().text.c_str();
}
// Holds what is milled so far against its limits, with the settings of the open mill. Returns 1 on success:
// mill_text() has the verdict and its reasons as JSON, and mill_audit_lines() the numbers of its "lines",
// each kAuditColumns doubles (session/audit/audit_json.hpp). Returns 0 without a job.
TRIBO_EXPORT(mill_audit) std::uint32_t mill_audit() {
    if (!mill().live) return refuse(fail("no job is open", "call mill_open first").error());
    mill().controller->apply();
    session::LiveAudit audit = session::audit_of(*mill().live, serial_for);
    mill().text = std::move(audit.json);
    mill().audit_lines = std::move(audit.lines);
    return true;
}
TRIBO_EXPORT(mill_audit_lines) const double* mill_audit_lines() {
    return mill().audit_lines.data();
}
// Keeps the open mill aside for mill_volumes() and mill_join(); then no job is open.
TRIBO_EXPORT(mill_keep) void mill_keep() {
    mill().touch.reset();
    mill().controller.reset();
    mill().kept = std::move(mill().live);
}
// Returns the volume of the material that only the part of the mill that was kept has, and that only the part
// of the open one has, mm3 (surface/part_difference.hpp). Returns null without both.
TRIBO_EXPORT(mill_volumes) const double* mill_volumes() {
    if (!mill().kept || !mill().live) return nullptr;
    const surface::VolumeDifference v =
        surface::volume_difference(mill().kept->session().stock(), mill().live->session().stock());
    mill().volumes_mm3 = {v.only_a_mm3, v.only_b_mm3};
    return mill().volumes_mm3.data();
}
// Joins the rows of the mill that was kept, A, with those of the open one, B, both as far as they are milled
// (session/compare/compared_rows.hpp). Returns the number of pairs, which are at mill_joined(); mill_text()
// says by what they are joined (session::name_of), and after a tab the width of a step, mm3 or s (0: by
// line). Without both no pairs.
TRIBO_EXPORT(mill_join) std::uint32_t mill_join() {
    mill().joined.clear();
    if (!mill().kept || !mill().live) return 0;
    const auto cuts = session::join(session::compared_rows(*mill().kept, serial_for),
                                    session::compared_rows(*mill().live, serial_for));
    mill().text = std::string(session::name_of(cuts->by)) + "\t" + format_decimal(cuts->step);
    for (const session::CutPair& pair : cuts->pairs) {
        mill().joined.push_back(pair.place);
        append(pair.a, mill().joined);
        append(pair.b, mill().joined);
    }
    return static_cast<std::uint32_t>(cuts->pairs.size());
}
// Returns the pairs: of each its place, then of A and of B from_s, to_s, line, tip (x, y, z) in mm and the
// quantities of session::kQuantityWords; NaN: not known, or nothing is cut there.
TRIBO_EXPORT(mill_joined) const double* mill_joined() {
    return mill().joined.data();
}
// Returns the quantities that are compared, one per line: name, tab, unit.
TRIBO_EXPORT(mill_quantities) const char* mill_quantities() {
    mill().text.clear();
    for (const session::QuantityWords& words : session::kQuantityWords) {
        if (!mill().text.empty()) mill().text += "\n";
        mill().text += std::string(words.name) + "\t" + std::string(words.unit);
    }
    return mill().text.c_str();
}
// Returns all known materials, one per line.
TRIBO_EXPORT(mill_materials) const char* mill_materials() {
    mill().text.clear();
    for (const milling::WorkpieceMaterial& m : milling::materials()) {
        if (!mill().text.empty()) mill().text += "\n";
        mill().text += m.name;
    }
    return mill().text.c_str();
}

// Returns the names of all known machines, separated by ", ".
TRIBO_EXPORT(mill_machines) const char* mill_machines() {
    mill().text = motion::machine_names();
    return mill().text.c_str();
}

// Applies the newest settings and advances the time of the viewer by dt_s. Mills for at most that many checks
// of the time budget (a few moves each), as there is no clock here. Returns the number of bytes of frames at
// mill_frames().
TRIBO_EXPORT(mill_tick) std::uint32_t mill_tick(double dt_s, std::uint32_t looks) {
    mill().frames.clear();
    if (!mill().live) return 0;
    std::uint32_t left = looks;
    const auto has_time = [&] { return left > 0 && left-- > 0; };
    mill().controller->apply();
    mill().live->tick(dt_s, has_time, keep);
    mill().touch->tick(dt_s, keep);
    return static_cast<std::uint32_t>(mill().frames.size());
}
TRIBO_EXPORT(mill_frames) const std::uint8_t* mill_frames() {
    return mill().frames.data();
}
