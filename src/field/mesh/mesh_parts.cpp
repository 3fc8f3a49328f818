// SPDX-License-Identifier: MIT
#include "field/mesh/mesh_parts.hpp"

#include <algorithm>
#include <cstdint>
#include <utility>

#include "base/groups.hpp"

namespace tribo::field {
namespace {

// Bodies that touch count as overlapping, mm.
constexpr double kTouch = 1e-3;

struct Component {
    TriangleMesh mesh;
    Box3 box;
    bool is_closed = true;
    double volume_mm3 = 0;  // of a closed one
};

std::vector<Component> take_apart(const TriangleMesh& mesh, const std::vector<std::uint32_t>& number,
                                  std::size_t count) {
    std::vector<Component> all(count);
    constexpr std::uint32_t kNone = 0xFFFFFFFF;
    std::vector<std::uint32_t> moved(mesh.positions.size(), kNone);
    for (const Triangle& t : mesh.triangles) {
        TriangleMesh& own = all[number[t[0]]].mesh;
        Triangle as = t;
        for (std::uint32_t& corner : as) {
            std::uint32_t& to = moved[corner];
            if (to == kNone) {
                to = static_cast<std::uint32_t>(own.positions.size());
                own.positions.push_back(mesh.positions[corner]);
            }
            corner = to;
        }
        own.triangles.push_back(as);
    }
    std::erase_if(all, [](const Component& one) { return !(area_mm2(one.mesh) > 0); });
    for (Component& one : all) {
        one.box = bounds(one.mesh);
        one.is_closed = tribo::is_closed(one.mesh);
        if (one.is_closed) one.volume_mm3 = volume_mm3(one.mesh);
    }
    return all;
}

double volume_of(const Box3& box) {
    const Vec3 size = box.max - box.min;
    return size.x * size.y * size.z;
}

// Gives each hollow to what it is in, and turns it where it is in nothing.
void place_hollows(std::vector<Component>& all) {
    for (Component& hollow : all) {
        if (!hollow.is_closed || hollow.volume_mm3 >= 0) continue;
        Component* around = nullptr;
        for (Component& one : all) {
            const bool holds = one.is_closed && one.volume_mm3 > 0 && one.box.contains(hollow.box.min) &&
                               one.box.contains(hollow.box.max);
            if (holds && (around == nullptr || volume_of(one.box) < volume_of(around->box))) around = &one;
        }
        if (around == nullptr) {
            for (Triangle& t : hollow.mesh.triangles) std::swap(t[1], t[2]);
            hollow.volume_mm3 = -hollow.volume_mm3;
        } else {
            append(around->mesh, hollow.mesh);
            hollow.mesh = {};
        }
    }
    std::erase_if(all, [](const Component& one) { return one.mesh.triangles.empty(); });
}

}  // namespace

void append(TriangleMesh& to, const TriangleMesh& more) {
    const auto first = static_cast<std::uint32_t>(to.positions.size());
    to.positions.insert(to.positions.end(), more.positions.begin(), more.positions.end());
    for (const Triangle& t : more.triangles)
        to.triangles.push_back({t[0] + first, t[1] + first, t[2] + first});
}

std::vector<std::uint32_t> components_of(const TriangleMesh& mesh, std::size_t& count) {
    Groups connected(mesh.positions.size());
    for (const Triangle& t : mesh.triangles) {
        for (const std::uint32_t corner : {t[1], t[2]}) connected.join(t[0], corner);
    }
    constexpr std::uint32_t kNone = 0xFFFFFFFF;
    std::vector<std::uint32_t> number(mesh.positions.size(), kNone);
    count = 0;
    for (const Triangle& t : mesh.triangles) {
        const std::uint32_t top = connected.of(t[0]);
        if (number[top] == kNone) number[top] = static_cast<std::uint32_t>(count++);
        for (const std::uint32_t corner : t) number[corner] = number[top];
    }
    return number;
}

std::vector<MeshPart> parts_of(TriangleMesh mesh, double thickness_mm) {
    std::size_t count = 0;
    const std::vector<std::uint32_t> number = components_of(mesh, count);
    if (count <= 1 || count > kMostComponents) {
        const bool closed = tribo::is_closed(mesh);
        std::vector<MeshPart> whole;
        whole.push_back({std::move(mesh), closed});
        return whole;
    }
    std::vector<Component> all = take_apart(mesh, number, count);
    place_hollows(all);
    struct Place {
        MeshPart part;
        std::vector<Box3> boxes;
    };
    std::vector<Place> places;
    for (const Component& one : all) {
        const Box3 box = one.box.inflated(one.is_closed ? kTouch : thickness_mm + kTouch);
        const auto has_room = [&](const Place& place) {
            return place.part.is_closed == one.is_closed &&
                   std::ranges::none_of(place.boxes, [&](const Box3& other) { return other.overlaps(box); });
        };
        auto place = std::ranges::find_if(places, has_room);
        if (place == places.end() && places.size() >= kMostParts) {
            place = std::ranges::find_if(places,
                                         [&](const Place& p) { return p.part.is_closed == one.is_closed; });
        }
        if (place == places.end()) {
            places.push_back({{{}, one.is_closed}, {}});
            place = places.end() - 1;
        }
        append(place->part.mesh, one.mesh);
        place->boxes.push_back(box);
    }
    std::vector<MeshPart> parts;
    parts.reserve(places.size());
    for (Place& place : places) parts.push_back(std::move(place.part));
    return parts;
}

}  // namespace tribo::field
