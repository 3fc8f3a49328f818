// SPDX-License-Identifier: MIT
#include "formats/vrml_faces.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "formats/model_text.hpp"

namespace tribo::formats {
namespace {

class FaceSetReader {
  public:
    FaceSetReader(const VrmlTree& tree, VrmlNodeId node, std::string_view text,
                  PolygonTriangulator& triangulator)
        : tree_(tree), node_(node), text_(text), triangulator_(triangulator) {}

    Result<VrmlFaces> read() {
        if (auto ok = read_flags(); !ok) return std::unexpected(ok.error());
        const auto points = coordinates();
        if (!points) return std::unexpected(points.error());
        if (auto ok = read_indices(points->size() / 3); !ok) return std::unexpected(ok.error());
        keep_used_points(*points);
        if (auto ok = cut_faces(); !ok) return std::unexpected(ok.error());
        if (!ccw_) {
            for (Triangle& t : faces_.triangles) std::swap(t[1], t[2]);
        }
        return std::move(faces_);
    }

  private:
    static constexpr std::uint32_t kFaceEnd = 0xFFFFFFFF;

    std::unexpected<Error> fail_at_value(const VrmlValue& value, std::string cause) const {
        return fail_at({}, value.start.line, value.start.column, std::move(cause), "export the model again");
    }

    Result<void> read_flags() {
        for (const auto& [name, flag] : {std::pair{"ccw", &ccw_}, std::pair{"solid", &faces_.solid}}) {
            const VrmlValue* value = tree_.find(node_, name);
            if (!value) continue;
            if (value->kind != VrmlValue::Kind::booleans) {
                return fail_at_value(*value, quoted(name) + " must be TRUE or FALSE");
            }
            *flag = value->truth;
        }
        if (const VrmlValue* angle = tree_.find(node_, "creaseAngle")) {
            const auto numbers = tree_.numbers_of(*angle);
            if (numbers.size() != 1 || numbers[0] < 0) {
                return fail_at_value(*angle, "'creaseAngle' must be one number, 0 or more");
            }
            faces_.crease_angle_rad = numbers[0];
        }
        return {};
    }

    Result<std::span<const double>> coordinates() const {
        const VrmlValue* coord = tree_.find(node_, "coord");
        if (!coord || coord->kind == VrmlValue::Kind::null) return std::span<const double>{};
        const auto nodes = tree_.nodes_of(*coord);
        if (nodes.size() != 1 || tree_.nodes[nodes[0]].type->role != VrmlRole::coordinate) {
            return fail_at_value(*coord, "'coord' must be a Coordinate node");
        }
        const VrmlValue* points = tree_.find(nodes[0], "point");
        if (!points || points->kind == VrmlValue::Kind::null) return std::span<const double>{};
        const auto numbers = tree_.numbers_of(*points);
        if (numbers.empty() || numbers.size() % 3 != 0) {
            return fail_at_value(*points, "'point' must hold three numbers for each point");
        }
        return numbers;
    }

    // The place of a list's number `at`.
    std::unexpected<Error> fail_at_number(const VrmlValue& list, std::size_t at, std::string cause) const {
        VrmlLexer lexer(text_);
        lexer.rewind(list.start);
        VrmlToken token = lexer.next();
        for (std::size_t numbers = 0; token.kind != VrmlTokenKind::end; token = lexer.next()) {
            if (token.kind == VrmlTokenKind::number && numbers++ == at) break;
        }
        return fail_at({}, token.line, token.column, std::move(cause), "export the model again");
    }

    Result<void> read_indices(std::size_t points) {
        const VrmlValue* list = tree_.find(node_, "coordIndex");
        if (!list || list->kind == VrmlValue::Kind::null) return {};
        const auto numbers = tree_.numbers_of(*list);
        if (numbers.empty()) return fail_at_value(*list, "'coordIndex' must hold numbers");
        corners_.reserve(numbers.size() + 1);
        for (std::size_t i = 0; i < numbers.size(); ++i) {
            const double index = numbers[i];
            if (index == -1) {
                corners_.push_back(kFaceEnd);
            } else if (index >= 0 && index < static_cast<double>(points) && std::floor(index) == index) {
                corners_.push_back(static_cast<std::uint32_t>(index));
            } else {
                return fail_at_number(*list, i,
                                      "a face uses a point that is not one of the " + std::to_string(points) +
                                          ", which count from 0");
            }
        }
        corners_.push_back(kFaceEnd);
        return {};
    }

    void keep_used_points(std::span<const double> xyz) {
        std::vector<std::uint32_t> used;
        used.reserve(corners_.size());
        for (const std::uint32_t corner : corners_) {
            if (corner != kFaceEnd) used.push_back(corner);
        }
        std::sort(used.begin(), used.end());
        used.erase(std::unique(used.begin(), used.end()), used.end());
        faces_.points.reserve(used.size());
        for (const std::size_t i : used)
            faces_.points.push_back({xyz[3 * i], xyz[3 * i + 1], xyz[3 * i + 2]});
        for (std::uint32_t& corner : corners_) {
            if (corner == kFaceEnd) continue;
            corner =
                static_cast<std::uint32_t>(std::lower_bound(used.begin(), used.end(), corner) - used.begin());
        }
    }

    Result<void> cut_faces() {
        std::vector<Vec3> points;
        for (std::size_t first = 0, i = 0; i < corners_.size(); ++i) {
            if (corners_[i] != kFaceEnd) continue;
            const auto face = std::span<const std::uint32_t>(corners_).subspan(first, i - first);
            first = i + 1;
            if (face.size() < 3) continue;
            points.clear();
            for (const std::uint32_t corner : face) points.push_back(faces_.points[corner]);
            if (!triangulator_.append(face, points, faces_.triangles)) {
                const VrmlNode& node = tree_.nodes[node_];
                return fail_at({}, node.line, node.column,
                               "the concave faces are too many and too long to be cut into triangles",
                               "export the model as triangles");
            }
        }
        return {};
    }

    const VrmlTree& tree_;
    VrmlNodeId node_;
    std::string_view text_;
    PolygonTriangulator& triangulator_;
    VrmlFaces faces_;
    bool ccw_ = true;
    std::vector<std::uint32_t> corners_;  // each face ends with kFaceEnd
};

}  // namespace

std::uint64_t count_triangles(const VrmlTree& tree, VrmlNodeId face_set) {
    const VrmlValue* list = tree.find(face_set, "coordIndex");
    if (!list) return 0;
    std::uint64_t triangles = 0, corners = 0;
    const auto end_face = [&] {
        if (corners > 2) triangles += corners - 2;
        corners = 0;
    };
    for (const double index : tree.numbers_of(*list)) {
        if (index == -1) {
            end_face();
        } else {
            ++corners;
        }
    }
    end_face();
    return triangles;
}

Result<VrmlFaces> read_vrml_faces(const VrmlTree& tree, VrmlNodeId face_set, std::string_view text,
                                  PolygonTriangulator& triangulator) {
    return FaceSetReader(tree, face_set, text, triangulator).read();
}

}  // namespace tribo::formats
