// SPDX-License-Identifier: MIT
#include "tribo/touch.hpp"

#include <algorithm>
#include <cassert>
#include <optional>
#include <utility>

#include "noise/play/friction_voice.hpp"
#include "tribo/touch_image.hpp"

namespace tribo {
namespace {

constexpr int kLeastSizePx = 16;
constexpr double kLeastRateHz = 1000, kMostRateHz = 192000;

Result<void> check_touch(const TouchOptions& options) {
    if (options.size_px < kLeastSizePx || options.size_px > elastic::kMostNodesPerSide)
        return fail("size_px is out of range", "give 16 to 4096");
    if (!(options.sample_rate_hz >= kLeastRateHz && options.sample_rate_hz <= kMostRateHz))
        return fail("sample_rate_hz is out of range", "give 1000 to 192000");
    return {};
}

}  // namespace

struct TouchMaterial::State {
    TouchImage touch;
    elastic::Sheet sheet;
    std::optional<noise::FrictionVoice> voice;
};

TouchMaterial::TouchMaterial(std::unique_ptr<State> state) : state_(std::move(state)) {}
TouchMaterial::TouchMaterial(TouchMaterial&&) noexcept = default;
TouchMaterial& TouchMaterial::operator=(TouchMaterial&&) noexcept = default;
TouchMaterial::~TouchMaterial() = default;

FileResult<TouchMaterial> TouchMaterial::open(const std::string& file, const TouchOptions& options) {
    if (auto good = check_touch(options); !good) return std::unexpected(FileFailure(good.error()));
    auto touch = read_touch_image(file, options.size_px);
    if (!touch) return std::unexpected(touch.error());
    elastic::Sheet sheet(touch->sheet_size());
    sheet.set_material(touch->sheet_material());
    std::optional<noise::FrictionVoice> voice;
    if (!touch->material.voices.models.empty()) {
        noise::FrictionOptions friction;
        friction.sample_rate_hz = options.sample_rate_hz;
        friction.seed = options.seed;
        voice.emplace(touch->material.voices, friction);
    }
    return TouchMaterial(
        std::make_unique<State>(State{std::move(*touch), std::move(sheet), std::move(voice)}));
}

const Warnings& TouchMaterial::warnings() const {
    return state_->touch.warnings;
}

int TouchMaterial::size_px() const {
    return state_->touch.image.width;
}

double TouchMaterial::width_mm() const {
    return state_->touch.width_mm;
}

void TouchMaterial::press(std::span<const elastic::ContactEllipse> contacts) {
    state_->sheet.press(contacts);
}

bool TouchMaterial::step(double duration_s) {
    return state_->sheet.step(duration_s);
}

std::span<const float> TouchMaterial::depths_mm(int row) const {
    assert(row >= 0 && row < size_px());
    return {state_->sheet.heights(row), static_cast<std::size_t>(size_px())};
}

void TouchMaterial::draw(std::span<std::uint8_t> rgba) const {
    assert(rgba.size() == state_->touch.image.rgba.size());
    const elastic::Finish finish = state_->touch.finish();
    elastic::draw_rows(state_->sheet, state_->touch.image.rgba, rgba, 0, size_px(), &finish);
}

bool TouchMaterial::sounds() const {
    return state_->voice.has_value();
}

void TouchMaterial::rub(double speed_mm_per_s, double force_n) {
    if (state_->voice) state_->voice->set_target(speed_mm_per_s, force_n);
}

void TouchMaterial::render(std::span<float> out) {
    if (state_->voice) return state_->voice->render(out);
    std::ranges::fill(out, 0.0F);
}

}  // namespace tribo
