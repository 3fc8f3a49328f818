// SPDX-License-Identifier: MIT
#include "readers/vrml/nodes.hpp"

#include <algorithm>
#include <array>

namespace tribo::readers {
namespace {

using namespace std::string_view_literals;

constexpr std::array kChildren{"children"sv};
constexpr std::array kGroupPassed{"bboxCenter"sv,  "bboxSize"sv,      "description"sv,    "parameter"sv,
                                  "url"sv,         "collide"sv,       "axisOfRotation"sv, "proxy"sv,
                                  "addChildren"sv, "removeChildren"sv};
constexpr std::array kTransformUsed{"children"sv, "translation"sv,      "rotation"sv,
                                    "scale"sv,    "scaleOrientation"sv, "center"sv};
constexpr std::array kChoiceUsed{"choice"sv, "whichChoice"sv};
constexpr std::array kLevelUsed{"level"sv};
constexpr std::array kLevelPassed{"center"sv, "range"sv};
constexpr std::array kInlineUsed{"url"sv};
constexpr std::array kInlinePassed{"bboxCenter"sv, "bboxSize"sv};
constexpr std::array kShapeUsed{"geometry"sv, "appearance"sv};
constexpr std::array kAppearanceUsed{"material"sv};
constexpr std::array kAppearancePassed{"texture"sv, "textureTransform"sv};
constexpr std::array kMaterialUsed{"diffuseColor"sv};
constexpr std::array kMaterialPassed{"ambientIntensity"sv, "emissiveColor"sv, "shininess"sv,
                                     "specularColor"sv, "transparency"sv};
constexpr std::array kColourUsed{"color"sv};
constexpr std::array kFaceSetUsed{"coord"sv, "coordIndex"sv, "ccw"sv,         "solid"sv,
                                  "color"sv, "colorIndex"sv, "creaseAngle"sv, "colorPerVertex"sv};
constexpr std::array kFaceSetPassed{"normal"sv,        "texCoord"sv,        "normalIndex"sv,
                                    "texCoordIndex"sv, "normalPerVertex"sv, "convex"sv};
constexpr std::array kBoxUsed{"size"sv};
constexpr std::array kConeUsed{"bottomRadius"sv, "height"sv, "side"sv, "bottom"sv};
constexpr std::array kCylinderUsed{"radius"sv, "height"sv, "side"sv, "bottom"sv, "top"sv};
constexpr std::array kSphereUsed{"radius"sv};
constexpr std::array kGridUsed{"height"sv, "xDimension"sv, "xSpacing"sv,    "zDimension"sv,     "zSpacing"sv,
                               "ccw"sv,    "solid"sv,      "creaseAngle"sv, "colorPerVertex"sv, "color"sv};
constexpr std::array kGridPassed{"normal"sv, "texCoord"sv, "normalPerVertex"sv, "set_height"sv};
constexpr std::array kExtrusionUsed{"crossSection"sv, "spine"sv, "scale"sv, "orientation"sv, "beginCap"sv,
                                    "endCap"sv,       "ccw"sv,   "solid"sv, "creaseAngle"sv};
constexpr std::array kExtrusionPassed{"convex"sv, "set_crossSection"sv, "set_orientation"sv, "set_scale"sv,
                                      "set_spine"sv};
constexpr std::array kCoordinateUsed{"point"sv};

constexpr std::array kNodes{
    VrmlNodeType{"Anchor", VrmlRole::group, kChildren, kGroupPassed},
    VrmlNodeType{"Appearance", VrmlRole::appearance, kAppearanceUsed, kAppearancePassed},
    VrmlNodeType{"AudioClip"},
    VrmlNodeType{"Background"},
    VrmlNodeType{"Billboard", VrmlRole::group, kChildren, kGroupPassed},
    VrmlNodeType{"Box", VrmlRole::box, kBoxUsed},
    VrmlNodeType{"Collision", VrmlRole::group, kChildren, kGroupPassed},
    VrmlNodeType{"Color", VrmlRole::colour, kColourUsed},
    VrmlNodeType{"ColorInterpolator"},
    VrmlNodeType{"Cone", VrmlRole::cone, kConeUsed},
    VrmlNodeType{"Coordinate", VrmlRole::coordinate, kCoordinateUsed},
    VrmlNodeType{"CoordinateInterpolator"},
    VrmlNodeType{"Cylinder", VrmlRole::cylinder, kCylinderUsed},
    VrmlNodeType{"CylinderSensor"},
    VrmlNodeType{"DirectionalLight"},
    VrmlNodeType{"ElevationGrid", VrmlRole::grid, kGridUsed, kGridPassed},
    VrmlNodeType{"Extrusion", VrmlRole::extrusion, kExtrusionUsed, kExtrusionPassed},
    VrmlNodeType{"Fog"},
    VrmlNodeType{"FontStyle"},
    VrmlNodeType{"Group", VrmlRole::group, kChildren, kGroupPassed},
    VrmlNodeType{"ImageTexture"},
    VrmlNodeType{"IndexedFaceSet", VrmlRole::face_set, kFaceSetUsed, kFaceSetPassed},
    VrmlNodeType{"IndexedLineSet", VrmlRole::no_surface},
    VrmlNodeType{"Inline", VrmlRole::inline_file, kInlineUsed, kInlinePassed},
    VrmlNodeType{"LOD", VrmlRole::level, kLevelUsed, kLevelPassed},
    VrmlNodeType{"Material", VrmlRole::material, kMaterialUsed, kMaterialPassed},
    VrmlNodeType{"MovieTexture"},
    VrmlNodeType{"NavigationInfo"},
    VrmlNodeType{"Normal"},
    VrmlNodeType{"NormalInterpolator"},
    VrmlNodeType{"OrientationInterpolator"},
    VrmlNodeType{"PixelTexture"},
    VrmlNodeType{"PlaneSensor"},
    VrmlNodeType{"PointLight"},
    VrmlNodeType{"PointSet", VrmlRole::no_surface},
    VrmlNodeType{"PositionInterpolator"},
    VrmlNodeType{"ProximitySensor"},
    VrmlNodeType{"ScalarInterpolator"},
    VrmlNodeType{"Script", VrmlRole::script},
    VrmlNodeType{"Shape", VrmlRole::shape, kShapeUsed},
    VrmlNodeType{"Sound"},
    VrmlNodeType{"Sphere", VrmlRole::sphere, kSphereUsed},
    VrmlNodeType{"SphereSensor"},
    VrmlNodeType{"SpotLight"},
    VrmlNodeType{"Switch", VrmlRole::choice, kChoiceUsed},
    VrmlNodeType{"Text", VrmlRole::no_surface},
    VrmlNodeType{"TextureCoordinate"},
    VrmlNodeType{"TextureTransform"},
    VrmlNodeType{"TimeSensor"},
    VrmlNodeType{"TouchSensor"},
    VrmlNodeType{"Transform", VrmlRole::transform, kTransformUsed, kGroupPassed},
    VrmlNodeType{"Viewpoint"},
    VrmlNodeType{"VisibilitySensor"},
    VrmlNodeType{"WorldInfo"},
};
static_assert(kNodes.size() == 54);
static_assert(std::is_sorted(kNodes.begin(), kNodes.end(),
                             [](const VrmlNodeType& a, const VrmlNodeType& b) { return a.name < b.name; }));

}  // namespace

const VrmlNodeType* find_vrml_node(std::string_view name) {
    const auto found = std::lower_bound(kNodes.begin(), kNodes.end(), name,
                                        [](const VrmlNodeType& n, std::string_view s) { return n.name < s; });
    return found != kNodes.end() && found->name == name ? &*found : nullptr;
}

}  // namespace tribo::readers
