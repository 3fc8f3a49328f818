// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>

#include "app/compare/compare_outputs.hpp"

namespace tribo::app {
namespace {

constexpr double kLeastRangeMm = 1e-3;  // of the colours

// The colours end at the largest difference of this share of the vertices, so that a lug that one part lacks
// does not hide the rest.
constexpr double kRangeShare = 0.98;

double range_of(const std::vector<float>& one, const std::vector<float>& other) {
    std::vector<float> sizes;
    for (const std::vector<float>* list : {&one, &other})
        for (const float mm : *list)
            if (mm != 0) sizes.push_back(std::abs(mm));
    if (sizes.empty()) return kLeastRangeMm;
    const auto place =
        sizes.begin() + static_cast<std::ptrdiff_t>(kRangeShare * static_cast<double>(sizes.size() - 1));
    std::ranges::nth_element(sizes, place);
    return std::max<double>(*place, kLeastRangeMm);
}

report::ReportPart coloured(const surface::ComparedPart& part, const surface::ComparedPart& a,
                            const surface::ComparedPart& b, const ParallelFor& parallel) {
    report::ReportPart shown;
    shown.untouched.assign(part.mesh().positions.size(), 0);
    shown.mesh = report::with_fewer_vertices(part.mesh(), report::kMostPartVertices, shown.untouched);
    shown.deviation_mm = surface::differences_at(shown.mesh, a, b, parallel);
    return shown;
}

}  // namespace

std::optional<PartComparison> compare_parts(const ComparedRun& a, const ComparedRun& b,
                                            const ParallelFor& parallel) {
    if (a.part() == nullptr || b.part() == nullptr || a.mesh.triangles.empty() || b.mesh.triangles.empty())
        return {};
    PartComparison parts;
    parts.volumes = surface::volume_difference(*a.part(), *b.part(), parallel);
    const surface::ComparedPart of_a(*a.part(), a.mesh), of_b(*b.part(), b.mesh);
    parts.surfaces = surface::surface_difference(of_a, of_b, parallel);
    parts.a = coloured(of_a, of_a, of_b, parallel);
    parts.b = coloured(of_b, of_a, of_b, parallel);
    parts.a->deviation_range_mm = parts.b->deviation_range_mm =
        range_of(parts.a->deviation_mm, parts.b->deviation_mm);
    return parts;
}

std::vector<std::string> compare_set_up(const ComparedRun& a, const ComparedRun& b) {
    std::vector<std::string> differs;
    if (a.record && b.record) {
        if (a.record->stock != b.record->stock) differs.push_back("The stock, or its frame, differs.");
        if (a.record->cutters != b.record->cutters) differs.push_back("The cutters differ.");
        if (a.record->moves != b.record->moves) differs.push_back("The paths of the moves differ.");
    } else {
        const std::string& name = a.record ? b.name : a.name;
        differs.push_back("Whether stock, cutters and path are the same is not known: " + name +
                          " holds no record of them.");
    }
    for (const ComparedRun* run : {&a, &b})
        for (const std::string& what : run->missing) differs.push_back(run->name + " lacks " + what + ".");
    return differs;
}

}  // namespace tribo::app
