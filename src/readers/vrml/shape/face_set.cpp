// SPDX-License-Identifier: MIT
#include "readers/vrml/shape/face_set.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "base/sort_unique.hpp"
#include "readers/vrml/fields.hpp"

namespace tribo::readers {
namespace {

class FaceSetReader {
  public:
    FaceSetReader(VrmlTree& tree, VrmlNodeId node, PolygonTriangulator& triangulator)
        : tree_(tree), node_(node), fields_(tree, node), triangulator_(triangulator) {}

    Result<VrmlSurface> read() {
        bool ccw = true;
        for (const auto& [name, flag] : {std::pair{"ccw", &ccw}, std::pair{"solid", &surface_.solid}}) {
            if (auto ok = fields_.read_flag(name, *flag); !ok) return std::unexpected(ok.error());
        }
        if (auto ok = fields_.read_size("creaseAngle", surface_.crease_angle_rad, 0, true); !ok)
            return std::unexpected(ok.error());
        const auto points = coordinates();
        if (!points) return std::unexpected(points.error());
        if (auto ok = read_indices(points->size() / 3); !ok) return std::unexpected(ok.error());
        if (auto ok = cut_faces(*points); !ok) return std::unexpected(ok.error());
        if (auto ok = read_colours(); !ok) return std::unexpected(ok.error());
        keep_used_points(*points);
        if (!ccw) {
            for (Triangle& t : surface_.triangles) std::swap(t[1], t[2]);
        }
        return std::move(surface_);
    }

  private:
    static constexpr std::uint32_t kFaceEnd = 0xFFFFFFFF;

    Result<std::span<const double>> coordinates() const {
        const VrmlValue* coord = tree_.find(node_, "coord");
        if (!coord || coord->kind == VrmlValue::Kind::null) return std::span<const double>{};
        const auto nodes = tree_.nodes_of(*coord);
        if (nodes.size() != 1 || tree_.nodes[nodes[0]].type->role != VrmlRole::coordinate) {
            return fields_.refuse(*coord, "'coord' must be a Coordinate node");
        }
        return VrmlFields(tree_, nodes[0]).read_list("point", 3);
    }

    Result<void> read_indices(std::size_t points) {
        const VrmlValue* list = tree_.find(node_, "coordIndex");
        if (!list || list->kind == VrmlValue::Kind::null) return {};
        const auto numbers = tree_.numbers_of(*list);
        if (numbers.empty()) return fields_.refuse(*list, "'coordIndex' must hold numbers");
        corners_.reserve(numbers.size() + 1);
        for (std::size_t i = 0; i < numbers.size(); ++i) {
            const double index = numbers[i];
            if (index == -1) {
                corners_.push_back(kFaceEnd);
            } else if (index >= 0 && index < static_cast<double>(points) && std::floor(index) == index) {
                corners_.push_back(static_cast<std::uint32_t>(index));
            } else {
                return tree_.refuse(fields_.place_of_number(*list, i),
                                    "a face uses a point that is not one of the " + std::to_string(points) +
                                        ", which count from 0",
                                    "export the model again");
            }
        }
        if (corners_.back() != kFaceEnd) corners_.push_back(kFaceEnd);
        return {};
    }

    // Triangles refer to corners, because corners have colours and points.
    Result<void> cut_faces(std::span<const double> xyz) {
        std::vector<Vec3> points;
        std::vector<std::uint32_t> numbers;
        for (std::size_t first = 0, i = 0; i < corners_.size(); ++i) {
            if (corners_[i] != kFaceEnd) continue;
            points.clear();
            numbers.resize(i - first);
            std::iota(numbers.begin(), numbers.end(), static_cast<std::uint32_t>(first));
            for (; first < i; ++first) {
                const std::size_t p = std::size_t{3} * corners_[first];
                points.push_back({xyz[p], xyz[p + 1], xyz[p + 2]});
            }
            first = i + 1;
            if (numbers.size() >= 3 && !triangulator_.append(numbers, points, surface_.triangles)) {
                return tree_.refuse(tree_.nodes[node_].place, PolygonTriangulator::kTooConcave,
                                    PolygonTriangulator::kTooConcaveRemedy);
            }
            face_ends_.push_back(surface_.triangles.size());
        }
        return {};
    }

    // Returns the colour index of each corner or face; empty if an index refers to no colour.
    std::vector<std::uint32_t> colour_numbers(std::size_t wanted, bool per_vertex, std::size_t colours) {
        std::vector<std::uint32_t> out;
        const VrmlValue* list = tree_.find(node_, "colorIndex");
        const auto given = list ? tree_.numbers_of(*list) : std::span<const double>{};
        out.reserve(wanted);
        for (std::size_t i = 0; i < wanted; ++i) {
            const bool is_end = per_vertex && corners_[i] == kFaceEnd;
            double number = 0;
            if (!given.empty()) {
                const bool is_last_end = is_end && i == given.size();  // the last -1 may be missing
                number = i < given.size() ? given[i] : is_last_end ? -1.0 : -2.0;
                if (is_end) number = number == -1 ? 0 : -2;
            } else if (!is_end) {
                number = static_cast<double>(per_vertex ? corners_[i] : i);
            }
            if (!(number >= 0 && number < static_cast<double>(colours))) return {};
            out.push_back(static_cast<std::uint32_t>(number));
        }
        return out;
    }

    Result<void> read_colours() {
        const auto colours = read_vrml_colours(tree_, node_, "color");
        bool per_vertex = true;
        if (auto ok = fields_.read_flag("colorPerVertex", per_vertex); !ok) return ok;
        if (colours.empty()) return {};
        const auto numbers =
            colour_numbers(per_vertex ? corners_.size() : face_ends_.size(), per_vertex, colours.size());
        if (numbers.empty()) {
            tree_.warn_once(tree_.nodes[node_].place,
                            "the colours of an IndexedFaceSet do not fit its faces and were left out");
            return {};
        }
        surface_.colours.reserve(surface_.triangles.size());
        std::size_t face = 0;
        for (std::size_t i = 0; i < surface_.triangles.size(); ++i) {
            while (face_ends_[face] <= i) ++face;
            if (!per_vertex) {
                surface_.colours.push_back(colours[numbers[face]]);
                continue;
            }
            Rgb8 mean{};
            for (std::size_t k = 0; k < 3; ++k) {
                int sum = 1;
                for (const std::uint32_t corner : surface_.triangles[i]) sum += colours[numbers[corner]][k];
                mean[k] = static_cast<std::uint8_t>(sum / 3);
            }
            surface_.colours.push_back(mean);
        }
        return {};
    }

    // Replaces corners by their points. Only used points stay, numbered in order of use.
    void keep_used_points(std::span<const double> xyz) {
        std::vector<std::uint32_t> used;
        used.reserve(corners_.size());
        for (const std::uint32_t corner : corners_) {
            if (corner != kFaceEnd) used.push_back(corner);
        }
        sort_unique(used);
        surface_.points.reserve(used.size());
        for (const std::size_t i : used)
            surface_.points.push_back({xyz[3 * i], xyz[3 * i + 1], xyz[3 * i + 2]});
        for (std::uint32_t& corner : corners_) {
            if (corner == kFaceEnd) continue;
            corner =
                static_cast<std::uint32_t>(std::lower_bound(used.begin(), used.end(), corner) - used.begin());
        }
        for (Triangle& t : surface_.triangles) {
            for (std::uint32_t& corner : t) corner = corners_[corner];
        }
    }

    VrmlTree& tree_;
    VrmlNodeId node_;
    VrmlFields fields_;
    PolygonTriangulator& triangulator_;
    VrmlSurface surface_;
    std::vector<std::uint32_t> corners_;  // point of each corner; each face ends with kFaceEnd
    std::vector<std::size_t> face_ends_;  // number of triangles up to the end of each face
};

}  // namespace

std::uint64_t count_face_set_triangles(const VrmlTree& tree, VrmlNodeId face_set) {
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

Result<VrmlSurface> read_vrml_face_set(VrmlTree& tree, VrmlNodeId face_set,
                                       PolygonTriangulator& triangulator) {
    return FaceSetReader(tree, face_set, triangulator).read();
}

}  // namespace tribo::readers
