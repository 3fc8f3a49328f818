// SPDX-License-Identifier: MIT
#include "field/contour/contour_table.hpp"

#include <utility>

namespace tribo::field {
namespace {

// Number of slots of the table (more only if two layers need more), and largest number of its layers.
constexpr int kSlots = 1 << 18, kMostLayers = 17;

int layers_of(int size_i, int size_j) {
    const auto area = std::max<std::int64_t>(1, std::int64_t{size_i} * size_j);
    return static_cast<int>(std::clamp<std::int64_t>(kSlots / area, 2, kMostLayers));
}

}  // namespace

SurfaceTable::SurfaceTable(const CarvedField& field, BrickCoord first, BrickCoord last)
    : field_(field),
      first_(first),
      size_i_(std::max(0, last.i - first.i)),
      size_j_(std::max(0, last.j - first.j)),
      layers_(layers_of(size_i_, size_j_)),
      top_(first.k - 1),
      margin_(contour_margin(field)) {
    slots_.resize(static_cast<std::size_t>(size_i_) * static_cast<std::size_t>(size_j_) *
                  static_cast<std::size_t>(layers_));
}

// Empties the layers up to `k`, which replace older ones.
void SurfaceTable::rise_to(int k) {
    const auto area = static_cast<std::ptrdiff_t>(size_i_) * size_j_;
    for (top_ = std::max(top_, k - layers_); top_ < k;) {
        const auto layer = slots_.begin() + area * ((++top_ - first_.k) % layers_);
        std::fill(layer, layer + area, Slot{});
    }
}

void SurfaceTable::begin(std::vector<BrickSurface> batch) {
    batch_ = std::move(batch);
    std::erase_if(batch_, [](const BrickSurface& s) { return s.vertices.empty(); });
    if (batch_.empty()) return;
    const BrickCoord from = batch_.front().coord;
    while (!kept_.empty() && (kept_.front().coord.k < from.k - 1 ||
                              (kept_.front().coord.k == from.k - 1 && kept_.front().coord.j < from.j - 1))) {
        kept_.pop_front();
        ++forgotten_;
    }
    rise_to(batch_.back().coord.k);
    for (std::size_t n = 0; n < batch_.size(); ++n) {
        BrickSurface& s = batch_[n];
        s.first_vertex = static_cast<std::uint32_t>(in_cells_.size());
        in_cells_.insert(in_cells_.end(), s.vertices.begin(), s.vertices.end());
        s.vertices = {};
        slots_[place(s.coord)] = {s.first_vertex, kInBatch + static_cast<std::uint32_t>(n)};
    }
}

void SurfaceTable::add_on_faces(std::size_t n, const std::vector<FaceVertex>& found) {
    std::vector<BrickSurface::OnFace>& keys = batch_[n].on_faces;
    for (const FaceVertex& f : found) {
        const std::uint32_t vertex = kOnFace + static_cast<std::uint32_t>(on_faces_.size());
        on_faces_.push_back(f.position);
        keys.push_back({f.key0, vertex});
        keys.push_back({f.key1, vertex});
    }
    std::sort(keys.begin(), keys.end(), [](const auto& a, const auto& b) { return a.key < b.key; });
}

void SurfaceTable::end() {
    for (BrickSurface& s : batch_) {
        Slot& slot = slots_[place(s.coord)];
        slot.details = kNoDetails;
        if (s.flat && s.on_faces.empty()) continue;
        s.edges = {};
        s.crowded = {};
        slot.details = forgotten_ + static_cast<std::uint32_t>(kept_.size());
        kept_.push_back(std::move(s));
    }
    batch_.clear();
}

}  // namespace tribo::field
