// SPDX-License-Identifier: MIT
#include "formats/vrml.hpp"

#include <cmath>

#include "base/math.hpp"
#include "formats/model_mesh.hpp"
#include "formats/model_text.hpp"
#include "formats/vrml_faces.hpp"

namespace tribo::formats {
namespace {

constexpr std::size_t kMaxText = 64 * 1024 * 1024;
// Nodes that the walk may pass, DEF and USE unfolded: about a second.
constexpr std::uint64_t kMaxVisits = 4'000'000;

// x -> linear x + offset, the linear part by its columns.
struct Affine {
    Vec3 column[3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    Vec3 offset;

    Vec3 turn(Vec3 p) const { return p.x * column[0] + p.y * column[1] + p.z * column[2]; }
    Vec3 operator()(Vec3 p) const { return turn(p) + offset; }
    Affine operator*(const Affine& inner) const {
        return {{turn(inner.column[0]), turn(inner.column[1]), turn(inner.column[2])}, (*this)(inner.offset)};
    }
    bool mirrors() const { return dot(cross(column[0], column[1]), column[2]) < 0; }
};

// About an axis through the origin (Rodrigues); an axis without direction turns nothing.
Affine rotation(Vec3 axis, double angle_rad) {
    const Vec3 u = normalized(axis, {});
    if (u == Vec3{}) return {};
    double s = 0, c = 1;
    math::sincos(angle_rad, s, c);
    const auto turned = [&](Vec3 p) { return c * p + s * cross(u, p) + (1 - c) * dot(u, p) * u; };
    return {{turned({1, 0, 0}), turned({0, 1, 0}), turned({0, 0, 1})}, {}};
}

class SceneReader {
  public:
    SceneReader(const VrmlTree& tree, std::string_view text, const ModelOptions& options)
        : tree_(tree), text_(text), options_(options) {
        model_.format = ModelFormat::vrml;
        model_.warnings = tree.warnings;
    }

    Result<Model> read() {
        if (auto ok = check(); !ok) return std::unexpected(ok.error());
        faces_of_.assign(tree_.nodes.size(), kNoFaces);
        for (const VrmlNodeId root : tree_.roots) {
            if (!emit(root, {})) return std::unexpected(*error_);
        }
        if (triangulator_.crossing_faces() > 0) {
            model_.warnings.push_back(
                {options_.source_name, 0,
                 std::to_string(triangulator_.crossing_faces()) + " faces cross themselves or have no area"});
        }
        return finish_model(std::move(model_), options_, Weld::no);
    }

  private:
    static constexpr std::uint32_t kNoFaces = 0xFFFFFFFF;

    // What lies at and below a node, counted before anything is made of it.
    struct Summary {
        std::uint64_t triangles = 0, visits = 1;
        int depth = 1;
        VrmlNodeId refused = kNoFaces;  // a node that would be seen and is not read
    };

    const VrmlNode& node(VrmlNodeId id) const { return tree_.nodes[id]; }

    std::unexpected<Error> fail_node(VrmlNodeId id, std::string cause, std::string remedy) const {
        return fail_at(options_.source_name, node(id).line, node(id).column, std::move(cause),
                       std::move(remedy));
    }

    // The children that are seen.
    Result<std::span<const VrmlNodeId>> seen(VrmlNodeId id) const {
        std::string_view field;
        switch (node(id).type->role) {
            case VrmlRole::group:
            case VrmlRole::transform:
                field = "children";
                break;
            case VrmlRole::choice:
                field = "choice";
                break;
            case VrmlRole::level:
                field = "level";
                break;
            case VrmlRole::shape:
                field = "geometry";
                break;
            default:
                return std::span<const VrmlNodeId>{};
        }
        const VrmlValue* value = tree_.find(id, field);
        if (!value || value->kind == VrmlValue::Kind::null) return std::span<const VrmlNodeId>{};
        const auto nodes = tree_.nodes_of(*value);
        if (nodes.empty()) {
            return fail_at(options_.source_name, value->start.line, value->start.column,
                           quoted(field) + " must hold nodes", "export the model again");
        }
        switch (node(id).type->role) {
            case VrmlRole::choice:
                return chosen(id, nodes);
            case VrmlRole::level:
            case VrmlRole::shape:
                return nodes.first(1);
            default:
                return nodes;
        }
    }

    std::span<const VrmlNodeId> chosen(VrmlNodeId id, std::span<const VrmlNodeId> choice) const {
        const VrmlValue* which = tree_.find(id, "whichChoice");
        const auto numbers = which ? tree_.numbers_of(*which) : std::span<const double>{};
        if (numbers.size() != 1 || !(numbers[0] >= 0 && numbers[0] < static_cast<double>(choice.size())))
            return {};
        return choice.subspan(static_cast<std::size_t>(numbers[0]), 1);
    }

    Result<void> check_place(VrmlNodeId id, bool in_shape) const {
        const VrmlRole role = node(id).type->role;
        const bool geometry = role == VrmlRole::face_set || role == VrmlRole::coordinate;
        const bool grouping = role == VrmlRole::group || role == VrmlRole::transform ||
                              role == VrmlRole::choice || role == VrmlRole::level || role == VrmlRole::shape;
        if (in_shape ? !grouping && role != VrmlRole::coordinate : !geometry) return {};
        return fail_node(id, std::string(node(id).type->name) + " cannot stand here",
                         in_shape ? "a Shape's geometry must be IndexedFaceSet"
                                  : "geometry belongs into the geometry field of a Shape");
    }

    // Sums up every node (children stand before their parents) and holds what is seen against the limits.
    Result<void> check() {
        summary_.resize(tree_.nodes.size());
        for (VrmlNodeId id = 0; id < tree_.nodes.size(); ++id) {
            Summary& s = summary_[id];
            if (node(id).type->role == VrmlRole::face_set) s.triangles = count_triangles(tree_, id);
            if (node(id).type->role == VrmlRole::other_surface) s.refused = id;
            const auto children = seen(id);
            if (!children) return std::unexpected(children.error());
            for (const VrmlNodeId child : *children) {
                const bool in_shape = node(id).type->role == VrmlRole::shape;
                if (auto ok = check_place(child, in_shape); !ok) return ok;
                add(s, summary_[child]);
            }
            if (s.depth > kMaxVrmlNesting) {
                return fail_node(id, "nodes are nested more than 256 deep through USE",
                                 "flatten the model's groups");
            }
        }
        Summary all;
        for (const VrmlNodeId root : tree_.roots) {
            if (auto ok = check_place(root, false); !ok) return ok;
            add(all, summary_[root]);
            if (all.triangles > kMaxTriangles) {
                return fail_node(root, "the model unfolds to more than 20 million triangles",
                                 "simplify the model");
            }
            if (all.visits > kMaxVisits) {
                return fail_node(root, "the model unfolds to more than 4 million nodes",
                                 "simplify the model");
            }
        }
        if (all.refused == kNoFaces) return {};
        return fail_node(all.refused, std::string(node(all.refused).type->name) + " is not read",
                         "export the model as IndexedFaceSet");
    }

    static void add(Summary& s, const Summary& child) {
        constexpr std::uint64_t enough = std::uint64_t{1} << 60;  // more is all the same, and must not wrap
        if (s.refused == kNoFaces) s.refused = child.refused;
        if (child.triangles == 0) return;  // the walk passes it by
        s.triangles = std::min(enough, s.triangles + child.triangles);
        s.visits = std::min(enough, s.visits + child.visits);
        s.depth = std::max(s.depth, 1 + child.depth);
    }

    bool failed(Error error) {
        error.file = options_.source_name;
        error_ = std::move(error);
        return false;
    }

    // Depth first, at most kMaxVrmlNesting deep; false with error_ set where it ends.
    bool emit(VrmlNodeId id, const Affine& to_world) {
        if (summary_[id].triangles == 0) return true;
        if (node(id).type->role == VrmlRole::face_set) return emit_faces(id, to_world);
        const bool moves = node(id).type->role == VrmlRole::transform;
        Affine inside = to_world;
        if (moves && !place(id, inside)) return false;
        const std::span<const VrmlNodeId> children = *seen(id);
        for (const VrmlNodeId child : children) {
            if (!emit(child, inside)) return false;
        }
        return true;
    }

    // Multiplies a Transform's own place onto `to_world` (ISO 14772-1, 6.52): T C R SR S -SR -C.
    bool place(VrmlNodeId id, Affine& to_world) {
        double t[3] = {0, 0, 0}, c[3] = {0, 0, 0}, s[3] = {1, 1, 1}, r[4] = {0, 0, 1, 0}, o[4] = {0, 0, 1, 0};
        if (!read_numbers(id, "translation", t) || !read_numbers(id, "center", c) ||
            !read_numbers(id, "scale", s) || !read_numbers(id, "rotation", r) ||
            !read_numbers(id, "scaleOrientation", o)) {
            return false;
        }
        const Affine turn = rotation({r[0], r[1], r[2]}, r[3]);
        const Affine stretch{{{s[0], 0, 0}, {0, s[1], 0}, {0, 0, s[2]}}, {}};
        Affine own =
            turn * rotation({o[0], o[1], o[2]}, o[3]) * stretch * rotation({o[0], o[1], o[2]}, -o[3]);
        const Vec3 centre{c[0], c[1], c[2]};
        own.offset = Vec3{t[0], t[1], t[2]} + centre - own.turn(centre);
        to_world = to_world * own;
        return true;
    }

    template <std::size_t N>
    bool read_numbers(VrmlNodeId id, std::string_view field, double (&out)[N]) {
        const VrmlValue* value = tree_.find(id, field);
        if (!value) return true;
        const auto numbers = tree_.numbers_of(*value);
        if (numbers.size() != N) {
            return failed({{},
                           value->start.line,
                           value->start.column,
                           quoted(field) + " must have " + std::to_string(N) + " numbers",
                           "export the model again"});
        }
        for (std::size_t i = 0; i < N; ++i) out[i] = numbers[i];
        return true;
    }

    bool emit_faces(VrmlNodeId id, const Affine& to_world) {
        if (faces_of_[id] == kNoFaces) {
            auto faces = read_vrml_faces(tree_, id, text_, triangulator_);
            if (!faces) return failed(faces.error());
            faces_of_[id] = static_cast<std::uint32_t>(face_sets_.size());
            face_sets_.push_back(std::move(*faces));
        }
        const VrmlFaces& faces = face_sets_[faces_of_[id]];
        TriangleMesh& mesh = model_.mesh;
        const auto base = static_cast<std::uint32_t>(mesh.positions.size());
        for (const Vec3 p : faces.points) {
            const Vec3 q = to_world(p);
            const auto position = to_position(q.x, q.y, q.z, options_.unit_mm);
            if (!position) {
                return failed({{},
                               node(id).line,
                               node(id).column,
                               "a point is not finite where it is placed",
                               "repair the model, or check its unit"});
            }
            mesh.positions.push_back(*position);
        }
        const bool mirrors = to_world.mirrors();
        model_.parts.push_back({static_cast<std::uint32_t>(mesh.triangles.size()),
                                static_cast<std::uint32_t>(faces.triangles.size()), faces.crease_angle_rad,
                                faces.solid});
        for (const Triangle& t : faces.triangles) {
            mesh.triangles.push_back({base + t[0], base + t[mirrors ? 2 : 1], base + t[mirrors ? 1 : 2]});
        }
        return true;
    }

    const VrmlTree& tree_;
    std::string_view text_;
    const ModelOptions& options_;
    Model model_;
    std::vector<Summary> summary_;
    std::vector<std::uint32_t> faces_of_;  // node to face_sets_
    std::vector<VrmlFaces> face_sets_;
    PolygonTriangulator triangulator_;
    std::optional<Error> error_;
};

bool is_x3d(std::string_view text) {
    return text.starts_with("#X3D") || text.starts_with("<X3D") ||
           (text.starts_with("<?xml") && text.substr(0, 4096).find("X3D") != std::string_view::npos);
}

Result<void> check_header(std::string_view text, const std::string& file) {
    const auto refuse = [&](std::string what, std::string remedy) {
        return fail_at(file, 1, 1, std::move(what), std::move(remedy));
    };
    if (text.starts_with("\x1f\x8b"))
        return refuse("a gzip file; compressed VRML is not read", "unpack it with gunzip");
    if (text.starts_with("#VRML V1.0")) return refuse("a VRML 1.0 file", "convert it to VRML 2.0");
    if (text.starts_with("#Inventor")) return refuse("an Open Inventor file", "convert it to VRML 2.0");
    if (is_x3d(text)) return refuse("an X3D file", "convert it to VRML 2.0");
    if (!text.starts_with("#VRML V2.0 utf8")) {
        return refuse("no '#VRML V2.0 utf8' at the start", "check that this is a VRML 2.0 file");
    }
    if (text.size() > kMaxText)
        return refuse("more than 64 MB of VRML", "simplify the model, or export it as STL");
    return {};
}

}  // namespace

bool looks_like_vrml(std::string_view bytes) {
    const std::string_view text = without_byte_order_mark(bytes);
    return text.starts_with("#VRML") || text.starts_with("#Inventor") || is_x3d(text);
}

Result<Model> read_vrml(std::string_view bytes, const ModelOptions& options) {
    const std::string_view text = without_byte_order_mark(bytes);
    if (auto ok = check_header(text, options.source_name); !ok) return std::unexpected(ok.error());
    const auto tree = read_vrml_tree(text, options.source_name);
    if (!tree) return std::unexpected(tree.error());
    return SceneReader(*tree, text, options).read();
}

}  // namespace tribo::formats
