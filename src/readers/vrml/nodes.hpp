// SPDX-License-Identifier: MIT
// The 54 nodes of VRML 2.0 as this reader sees them.
#pragma once

#include <cstdint>
#include <span>
#include <string_view>

namespace tribo::readers {

enum class VrmlRole : std::uint8_t {
    group,        // its children are seen
    transform,    // a group with a place
    choice,       // Switch: one child or none is seen
    level,        // LOD: its first level is seen
    inline_file,  // the nodes of another file are seen; they stand in its field `children` once read
    shape,        // its geometry is seen
    face_set,     // IndexedFaceSet
    box,
    cone,
    cylinder,
    sphere,
    grid,  // ElevationGrid
    extrusion,
    coordinate,  // points for geometry
    appearance,
    material,
    colour,      // colours for geometry
    no_surface,  // geometry of points, lines or letters: passed over with a warning
    silent,      // has no geometry
    script,      // has fields of its own making, so its inside is skipped unread
    instance     // of a prototype, where it stands in the body of another
};

// Geometry that this reader makes triangles of.
constexpr bool is_surface(VrmlRole role) {
    return role >= VrmlRole::face_set && role <= VrmlRole::extrusion;
}

struct VrmlNodeType {
    std::string_view name;
    VrmlRole role = VrmlRole::silent;
    std::span<const std::string_view> used = {};    // fields whose values the reader keeps
    std::span<const std::string_view> passed = {};  // for nodes with used fields: the other fields it knows
};

// The type of that name; null where VRML 2.0 has none.
const VrmlNodeType* find_vrml_node(std::string_view name);

}  // namespace tribo::readers
