// SPDX-License-Identifier: MIT
#include "app/touch/press.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdio>
#include <cstring>

#include "app/exit.hpp"
#include "app/interrupt.hpp"
#include "app/outputs.hpp"
#include "app/progress.hpp"
#include "base/text/printable.hpp"
#include "files/image/image_file.hpp"
#include "files/image/png.hpp"
#include "files/json/json.hpp"
#include "files/output_folder.hpp"
#include "readers/tables/stroke_csv.hpp"
#include "tribo/threads.hpp"
#include "tribo/touch_image.hpp"

namespace tribo::app {
namespace {

constexpr double kMostFrames = 100'000;
// Number of rows that one thread draws at a time.
constexpr int kBandRows = 16;

struct Inputs {
    TouchImage touch;  // in the size of the frames
    std::vector<readers::FingerPoint> stroke;
};

FileResult<Inputs> read_inputs(const PressCall& call) {
    auto touch = read_touch_image(call.material, call.size_px);
    if (!touch) return std::unexpected(touch.error());
    FileResult<std::string> bytes = files::read_file(call.stroke);
    if (!bytes) return std::unexpected(bytes.error());
    readers::StrokeOptions options;
    options.source_name = call.stroke;
    auto stroke = readers::read_finger_stroke(*bytes, options);
    if (!stroke) return std::unexpected(FileFailure(stroke.error()));
    return Inputs{*std::move(touch), *std::move(stroke)};
}

// Position of the finger at a time, and whether it touches.
class Finger {
  public:
    explicit Finger(const std::vector<readers::FingerPoint>& points) : points_(points) {}

    // Times must increase from call to call.
    readers::FingerPoint at(double t_s) {
        while (next_ + 1 < points_.size() && points_[next_].t_s < t_s) ++next_;
        const readers::FingerPoint &a = points_[next_ - 1], &b = points_[next_];
        const double part = std::clamp((t_s - a.t_s) / (b.t_s - a.t_s), 0.0, 1.0);
        return {t_s, std::lerp(a.x_mm, b.x_mm, part), std::lerp(a.y_mm, b.y_mm, part),
                std::lerp(a.force_n, b.force_n, part)};
    }

  private:
    const std::vector<readers::FingerPoint>& points_;
    std::size_t next_ = 1;
};

std::string heights_bytes(const elastic::Sheet& sheet) {
    static_assert(std::endian::native == std::endian::little);
    const auto row_bytes = sizeof(float) * static_cast<std::size_t>(sheet.size().width);
    std::string bytes(row_bytes * static_cast<std::size_t>(sheet.size().height), '\0');
    for (int y = 0; y < sheet.size().height; ++y) {
        std::memcpy(bytes.data() + row_bytes * static_cast<std::size_t>(y), sheet.heights(y), row_bytes);
    }
    return bytes;
}

struct Deepest {
    double mm = 0;
    int frame = 0;
};

void note_depth(const elastic::Sheet& sheet, int frame, Deepest& deepest) {
    for (int y = 0; y < sheet.size().height; ++y) {
        const float* row = sheet.heights(y);
        const double least = *std::min_element(row, row + sheet.size().width);
        if (-least > deepest.mm) deepest = {-least, frame};
    }
}

std::string summary(const PressCall& call, const Inputs& inputs, int frames, const Deepest& deepest) {
    files::Json json;
    json["schema"] = "tribo.press/1";
    json["material"] = call.material;
    json["stroke"] = call.stroke;
    json["frames"] = frames;
    json["fps"] = call.fps;
    json["size_px"] = call.size_px;
    json["mm_per_pixel"] = inputs.touch.width_mm / call.size_px;
    json["stiffness_n_per_mm"] = inputs.touch.material.stiffness_n_per_mm;
    json["viscosity_n_s_per_mm"] = inputs.touch.material.viscosity_n_s_per_mm;
    json["radius_mm"] = call.radius_mm;
    json["contact"] = call.contact == elastic::ContactShape::area ? "area" : "point";
    json["as_published"] = call.as_published;
    json["deepest_mm"] = deepest.mm;
    json["deepest_frame"] = deepest.frame;
    json["warnings"] = files::Json::array();
    for (const Warning& w : inputs.touch.warnings) json["warnings"].push_back(w.message());
    return files::pretty(json);
}

}  // namespace

int press(const PressCall& call) {
    const FileResult<Inputs> inputs = read_inputs(call);
    if (!inputs) return report(inputs.error());
    const std::vector<readers::FingerPoint>& stroke = inputs->stroke;
    const double begin_s = stroke.front().t_s, lasts_s = stroke.back().t_s - begin_s;
    // Tolerance for rounding: 0.1 s at 30 fps are three intervals.
    const double intervals = std::floor(lasts_s * call.fps + 1e-6);
    if (intervals >= kMostFrames) {
        return report(Error{call.stroke, 0, 0, "the stroke gives more than 100000 frames",
                            "give a lower --fps or a shorter stroke"});
    }
    const int frames = static_cast<int>(intervals) + 1;
    auto folder = files::OutputFolder::open(call.out, [](const std::string& name) {
        return name == "summary.json" || name.starts_with("frame_");
    });
    if (!folder) return report(folder.error());
    if (const auto checked = check_output_folder(*folder); !checked) return report(checked.error());
    report(inputs->touch.warnings);

    elastic::Sheet sheet(inputs->touch.sheet_size());
    sheet.set_material(inputs->touch.sheet_material());
    const auto scheme = call.as_published ? elastic::TimeScheme::implicit_euler : elastic::TimeScheme::exact;
    const ParallelFor parallel = parallel_for_over(call.threads > 0 ? call.threads : available_threads());
    elastic::Pile pile(inputs->touch.sheet_size());
    elastic::Finish finish = inputs->touch.finish();
    finish.hairs = &pile;
    const files::Image& image = inputs->touch.image;
    files::Image picture = image;
    Finger finger(stroke);
    Progress progress;
    Deepest deepest;
    readers::FingerPoint before;
    int touched_since = -1;  // the first frame of the contact; -1: none
    const auto contact_at = [&](const readers::FingerPoint& at) {
        elastic::ContactEllipse contact;
        contact.x_mm = at.x_mm;
        contact.y_mm = at.y_mm;
        contact.half_width_mm = contact.half_height_mm = call.radius_mm;
        contact.force_n = std::min(at.force_n, elastic::kMostForceN);
        return contact;
    };
    for (int frame = 0; frame < frames; ++frame) {
        const double t_s = begin_s + frame / call.fps;
        const readers::FingerPoint half_way = finger.at(t_s - 0.5 / call.fps), at = finger.at(t_s);
        if (!(at.force_n > 0)) {
            touched_since = -1;
        } else if (touched_since < 0) {
            touched_since = frame;
        }
        elastic::ContactEllipse contact = contact_at(at);
        if (touched_since >= 0) contact.held_s = (frame - touched_since) / call.fps;
        if (touched_since >= 0 && frame > touched_since)
            pile.brush(contact, at.x_mm - before.x_mm, at.y_mm - before.y_mm);
        before = at;
        pile.rise(1 / call.fps);
        // A frame shows what has been pressed until its time: nothing in the first one, then the finger half
        // way from frame to frame. As published, implicit Euler takes the pressure at the end of each step,
        // and steps before the first frame too.
        if (!call.as_published) contact = contact_at(half_way);
        sheet.press({&contact, 1}, {call.contact, call.as_published});
        if (frame > 0 || call.as_published) sheet.step(1 / call.fps, scheme);
        note_depth(sheet, frame, deepest);

        const int bands = (call.size_px + kBandRows - 1) / kBandRows;
        parallel(static_cast<std::size_t>(bands), [&](std::size_t band) {
            const int first = static_cast<int>(band) * kBandRows;
            elastic::draw_rows(sheet, image.rgba, picture.rgba, first,
                               std::min(kBandRows, call.size_px - first),
                               call.as_published ? nullptr : &finish);
        });
        char name[32];
        std::snprintf(name, sizeof name, "frame_%04d", frame);
        if (auto done = files::write_png(folder->file(std::string(name) + ".png"), picture); !done) {
            return report(done.error());
        }
        if (call.heights) {
            const auto done =
                files::write_file(folder->file(std::string(name) + ".f32"), heights_bytes(sheet));
            if (!done) return report(done.error());
        }
        progress.update("pressing", (frame + 1.0) / frames);
        if (interrupted()) return interrupted_exit_code();
    }
    progress.clear();
    const std::string text = summary(call, *inputs, frames, deepest);
    if (auto done = files::write_file(folder->file("summary.json"), text); !done) return report(done.error());
    if (auto done = folder->commit(); !done) return report(done.error());
    std::printf("%-16s %d at %g a second\n", "frames", frames, call.fps);
    std::printf("%-16s %.3f mm in frame %d\n", "deepest", deepest.mm, deepest.frame);
    std::printf("%-16s %s\n", "files", printable(folder->path()).c_str());
    return kDone;
}

}  // namespace tribo::app
