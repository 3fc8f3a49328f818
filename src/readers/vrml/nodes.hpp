// SPDX-License-Identifier: MIT
// The 54 nodes of VRML 2.0, with their roles for this reader.
#pragma once

#include <cstdint>
#include <span>
#include <string_view>

namespace tribo::readers {

enum class VrmlRole : std::uint8_t {
    group,        // its children are visible
    transform,    // a group with a placement
    choice,       // Switch: one child or none is visible
    level,        // LOD: its first level is visible
    inline_file,  // the nodes of another file are visible; after reading they are in its field `children`
    shape,        // its geometry is visible
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
    no_surface,  // geometry of points, lines or letters: ignored with a warning
    silent,      // has no geometry
    script,      // defines its own fields, therefore its body is skipped
    instance     // of a prototype, inside the body of another prototype
};

// True for geometry that this reader converts to triangles.
constexpr bool is_surface(VrmlRole role) {
    return role >= VrmlRole::face_set && role <= VrmlRole::extrusion;
}

struct VrmlNodeType {
    std::string_view name;
    VrmlRole role = VrmlRole::silent;
    std::span<const std::string_view> used = {};    // fields whose values the reader keeps
    std::span<const std::string_view> passed = {};  // the other known fields, for nodes with used fields
};

// Returns the type of that name; null if VRML 2.0 has none.
const VrmlNodeType* find_vrml_node(std::string_view name);

}  // namespace tribo::readers
