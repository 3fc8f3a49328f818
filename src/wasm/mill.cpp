// SPDX-License-Identifier: MIT
// The C ABI of tribo.wasm for the mill page's worker: files in by name, a job opened, time that passes,
// frames out (docs/live-protocol.md) that the page cannot tell from an engine's. One mill a module.
//
// Texts go in as bytes and a length, in memory from tribo_allocate; what comes out stays until the next call.
#include <cstdint>
#include <cstring>
#include <memory>
#include <string>
#include <vector>

#include "job/memory_source.hpp"
#include "milling/tool/materials.hpp"
#include "session/live/live_mill.hpp"
#include "session/live/live_touch.hpp"
#include "wasm/mill_job.hpp"

#define TRIBO_EXPORT(name) extern "C" __attribute__((export_name(#name)))

namespace {

using namespace tribo;

struct Mill {
    job::MemorySource files;  // as the page has put them
    std::unique_ptr<session::LiveMill> live;
    std::unique_ptr<session::SingleThreadedTouch> touch;  // goes before its mill
    double helix_deg = 0;                                 // of the job's first cutter
    std::string material;                                 // its name; empty: the job's own
    std::string text;
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

}  // namespace

// Puts a file; `bytes` may be released afterwards.
TRIBO_EXPORT(mill_put_file)
void mill_put_file(const char* name, std::uint32_t name_length, const char* bytes, std::uint32_t length) {
    mill().files.put(text_of(name, name_length), text_of(bytes, length));
}
TRIBO_EXPORT(mill_forget_files) void mill_forget_files() {
    mill().files.clear();
}

// Opens a job or a program of the files; `part` names a model as its designed surface, or nothing. cell_mm 0:
// as fine as the job needs. 1: opened, mill_text() has its warnings, one a line; 0: refused, it says why, and
// what was open stays.
TRIBO_EXPORT(mill_open)
std::uint32_t mill_open(const char* name, std::uint32_t name_length, const char* part,
                        std::uint32_t part_length, double cell_mm) {
    const std::string job = text_of(name, name_length), surface = text_of(part, part_length);
    const auto cell = cell_mm > 0 ? std::optional(cell_mm) : std::nullopt;
    auto loaded = wasm::load_mill(mill().files, job, surface, cell);
    if (!loaded) return refuse(loaded.error());
    std::string warnings;
    const std::string material = loaded->material;
    for (const Warning& w : loaded->warnings) warnings += w.message() + "\n";
    session::LiveExtras extras{loaded->listening, {}};
    if (loaded->part) extras.designed = std::make_shared<const TriangleMesh>(*std::move(loaded->part));
    // Set back, the program begins again from the files.
    auto ready = std::make_shared<std::optional<session::MillSetup>>(std::move(loaded->setup));
    const auto make_setup = [=]() -> Result<session::MillSetup> {
        if (*ready) return *std::exchange(*ready, std::nullopt);
        auto again = wasm::load_mill(mill().files, job, surface, cell);
        if (!again) return std::unexpected(again.error());
        return std::move(again->setup);
    };
    auto live = session::LiveMill::create(make_setup, serial_for, std::move(extras));
    if (!live) return refuse(live.error());
    mill().touch.reset();
    mill().live = std::move(*live);
    mill().touch = std::make_unique<session::SingleThreadedTouch>(*mill().live);
    mill().helix_deg = mill().live->session().setup().cutters.front().helix_deg;
    mill().material = material;
    mill().text = warnings;
    return true;
}

// What there was to say last, ended by a zero.
TRIBO_EXPORT(mill_text) const char* mill_text() {
    return mill().text.c_str();
}

TRIBO_EXPORT(mill_play) void mill_play(std::uint32_t on) {
    if (mill().live) mill().live->play(on != 0);
}
TRIBO_EXPORT(mill_speed) void mill_speed(double seconds_per_second) {
    if (mill().live) mill().live->set_speed(seconds_per_second);
}
TRIBO_EXPORT(mill_seek) void mill_seek(double t_s) {
    if (mill().live) mill().live->set_clock(t_s);
}

// Where a hand would have the finger, and whether there is one.
TRIBO_EXPORT(mill_finger) void mill_finger(double x_mm, double y_mm, double z_mm, std::uint32_t down) {
    if (mill().touch) mill().touch->lead({x_mm, y_mm, z_mm}, down != 0);
}
TRIBO_EXPORT(mill_feel)
void mill_feel(double force_scale, double jnd, std::uint32_t cut_mode, std::uint32_t force,
               std::uint32_t stopped) {
    if (!mill().touch) return;
    mill().touch->set({force_scale, jnd, cut_mode != 0, force != 0, stopped != 0});
}

// Overrides of feed and spindle, > 0; the helix in degrees; a material by its name, or nothing: the job's.
// 1: done; 0: refused, mill_text() says why.
TRIBO_EXPORT(mill_change)
std::uint32_t mill_change(double feed_factor, double speed_factor, double helix_deg, const char* material,
                          std::uint32_t material_length) {
    if (!mill().live) return 0;
    session::CutChange change;
    change.feed_factor = feed_factor;
    change.speed_factor = speed_factor;
    if (helix_deg != mill().helix_deg) change.helix_deg = helix_deg;
    const std::string name = text_of(material, material_length);
    if (!name.empty() && name != mill().material) {
        const auto known = milling::find_material(name);
        if (!known) return refuse(known.error());
        change.coefficients = known->coefficients;
    }
    mill().live->set_change(change);
    return 1;
}
TRIBO_EXPORT(mill_helix_deg) double mill_helix_deg() {
    return mill().helix_deg;
}
// The job's material, then all that are known, one a line.
TRIBO_EXPORT(mill_materials) const char* mill_materials() {
    mill().text = mill().material;
    for (const milling::Material& m : milling::materials()) mill().text += "\n" + m.name;
    return mill().text.c_str();
}

// dt_s of the viewer's time passes; mills on for at most so many looks at it (a few moves each), as there is
// no clock here. Gives the bytes of frames at mill_frames(), or -1: refused, mill_text() says why.
TRIBO_EXPORT(mill_tick) std::int32_t mill_tick(double dt_s, std::uint32_t looks) {
    mill().frames.clear();
    if (!mill().live) return 0;
    std::uint32_t left = looks;
    const auto may_go_on = [&] { return left > 0 && left-- > 0; };
    if (auto done = mill().live->tick(dt_s, may_go_on, keep); !done) {
        refuse(done.error());
        return -1;
    }
    mill().touch->tick(dt_s, keep);
    return static_cast<std::int32_t>(mill().frames.size());
}
TRIBO_EXPORT(mill_frames) const std::uint8_t* mill_frames() {
    return mill().frames.data();
}
