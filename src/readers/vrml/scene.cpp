// SPDX-License-Identifier: MIT
#include "readers/vrml/scene.hpp"

#include <cmath>

#include "readers/mesh/model_mesh.hpp"
#include "readers/vrml/fields.hpp"
#include "readers/vrml/shape/affine.hpp"
#include "readers/vrml/shape/surface.hpp"

namespace tribo::readers {
namespace {

// Largest number of nodes visited by the walk, with DEF and USE unfolded: about a second.
constexpr std::uint64_t kMaxVisits = 4'000'000;
// Largest number of children of all visible nodes; nodes may share one list of them (Inline, prototypes).
constexpr std::uint64_t kMaxLinks = 20'000'000;
// Largest numbers of indices and of colours of all face sets, which may share one list of them.
constexpr std::uint64_t kMaxIndices = 50'000'000, kMaxColours = 60'000'000;
// Default diffuseColor of a Material.
constexpr Rgb8 kGrey{204, 204, 204};

class SceneReader {
  public:
    SceneReader(VrmlTree& tree, const ModelOptions& options) : tree_(tree), options_(options) {
        model_.format = ModelFormat::vrml;
    }

    Result<Model> read() {
        if (auto ok = check(); !ok) return std::unexpected(ok.error());
        surface_of_.assign(tree_.nodes.size(), kNone);
        for (const VrmlNodeId root : tree_.roots) {
            if (!emit(root, {}, nullptr)) return std::unexpected(*error_);
        }
        if (triangulator_.crossing_faces() > 0) {
            const std::uint64_t faces = triangulator_.crossing_faces();
            tree_.warn_once(crossing_at_, faces == 1
                                              ? "a face crosses itself or has no area"
                                              : std::to_string(faces) +
                                                    " faces cross themselves or have no area, the first "
                                                    "in the node of this line");
        }
        model_.warnings = std::move(tree_.warnings);
        return finish_model(std::move(model_), options_, Weld::no);
    }

  private:
    static constexpr std::uint32_t kNone = 0xFFFFFFFF;

    // Contents at and below a node, counted before anything is made.
    struct Summary {
        std::uint64_t triangles = 0, visits = 1;
        int depth = 1;
        VrmlNodeId refused = kNone;  // a node that would be visible but is not read
    };

    const VrmlNode& node(VrmlNodeId id) const { return tree_.nodes[id]; }
    VrmlRole role(VrmlNodeId id) const { return node(id).type->role; }

    // Returns the visible children.
    Result<std::span<const VrmlNodeId>> seen(VrmlNodeId id) const {
        std::string_view field;
        switch (role(id)) {
            case VrmlRole::group:
            case VrmlRole::transform:
            case VrmlRole::inline_file:
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
            return tree_.refuse(value->start, quoted(field) + " must hold nodes", "export the model again");
        }
        switch (role(id)) {
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
        const VrmlRole r = role(id);
        const bool part = r == VrmlRole::coordinate || r == VrmlRole::colour || r == VrmlRole::appearance ||
                          r == VrmlRole::material;
        const bool grouping = r <= VrmlRole::shape;
        if (in_shape ? !grouping && !part : !is_surface(r) && !part) return {};
        return tree_.refuse(node(id).place, std::string(node(id).type->name) + " cannot stand here",
                            in_shape ? "a Shape's geometry must be IndexedFaceSet or a like node"
                                     : "geometry belongs into the geometry field of a Shape");
    }

    std::unexpected<Error> refuse_unfolding(VrmlNodeId id, std::uint64_t most, const char* what) const {
        return tree_.refuse(node(id).place,
                            "the model unfolds to more than " + std::to_string(most) + " " + what,
                            "simplify the model");
    }

    // Returns how many numbers the fields of a node hold.
    std::uint64_t count_numbers(VrmlNodeId id) const {
        const VrmlNode& n = node(id);
        std::uint64_t count = 0;
        for (std::uint32_t i = n.first_field; i < n.first_field + n.fields; ++i)
            count += tree_.numbers_of(tree_.fields[i].value).size();
        return count;
    }

    std::uint64_t count_colours(VrmlNodeId surface) const {
        const VrmlValue* colour = tree_.find(surface, "color");
        const auto nodes = colour ? tree_.nodes_of(*colour) : std::span<const VrmlNodeId>{};
        return nodes.empty() ? 0 : count_numbers(nodes[0]) / 3;
    }

    // Returns for each node whether it can be visible. Goes down from the roots: parents are stored after
    // their children.
    Result<std::vector<bool>> reach() const {
        std::vector<bool> reached(tree_.nodes.size());
        std::uint64_t links = 0;
        for (const VrmlNodeId root : tree_.roots) reached[root] = true;
        for (VrmlNodeId id = static_cast<VrmlNodeId>(reached.size()); id-- > 0;) {
            if (!reached[id]) continue;
            const auto children = seen(id);
            if (!children) return std::unexpected(children.error());
            links += children->size();
            if (links > kMaxLinks) return refuse_unfolding(id, kMaxLinks, "children of nodes");
            for (const VrmlNodeId child : *children) {
                if (auto ok = check_place(child, role(id) == VrmlRole::shape); !ok)
                    return std::unexpected(ok.error());
                reached[child] = true;
            }
        }
        return reached;
    }

    // Sums up the visible content, from the children up, and checks the limits.
    Result<void> check() {
        for (const VrmlNodeId root : tree_.roots) {
            if (auto ok = check_place(root, false); !ok) return ok;
        }
        const auto reached = reach();
        if (!reached) return std::unexpected(reached.error());
        summary_.resize(tree_.nodes.size());
        std::uint64_t indices = 0, colours = 0;
        for (VrmlNodeId id = 0; id < tree_.nodes.size(); ++id) {
            if (!(*reached)[id]) continue;
            Summary& s = summary_[id];
            if (is_surface(role(id))) {
                indices += count_numbers(id);
                if (indices > kMaxIndices) return refuse_unfolding(id, kMaxIndices, "indices");
                colours += count_colours(id);
                if (colours > kMaxColours) return refuse_unfolding(id, kMaxColours, "colours");
                s.triangles = count_triangles(tree_, id);
                // The walk skips nodes without triangles; therefore errors in them are reported here.
                if (s.triangles == 0) {
                    if (auto empty = read_vrml_surface(tree_, id, triangulator_); !empty)
                        return std::unexpected(empty.error());
                }
            }
            if (role(id) == VrmlRole::inline_file && node(id).number > 0) s.refused = id;
            const auto children = seen(id);
            for (const VrmlNodeId child : *children) add(s, summary_[child]);
            if (s.depth > kMaxVrmlNesting) {
                return tree_.refuse(node(id).place, "nodes are nested more than 256 deep through USE",
                                    "flatten the model's groups");
            }
        }
        Summary all;
        for (const VrmlNodeId root : tree_.roots) {
            add(all, summary_[root]);
            if (all.triangles > options_.max_triangles) {
                return tree_.refuse(node(root).place, "the model unfolds to " + too_many_triangles(options_),
                                    fewer_triangles(options_));
            }
            if (all.visits > kMaxVisits) {
                return tree_.refuse(node(root).place, "the model unfolds to more than 4 million nodes",
                                    "simplify the model");
            }
        }
        if (all.refused == kNone) return {};
        return std::unexpected(tree_.refusals[node(all.refused).number - 1]);
    }

    static void add(Summary& s, const Summary& child) {
        constexpr std::uint64_t enough = std::uint64_t{1} << 60;  // upper limit of the sum, against overflow
        if (s.refused == kNone) s.refused = child.refused;
        if (child.triangles == 0) {  // the walk looks no further
            s.visits = std::min(enough, s.visits + 1);
            return;
        }
        s.triangles = std::min(enough, s.triangles + child.triangles);
        s.visits = std::min(enough, s.visits + child.visits);
        s.depth = std::max(s.depth, 1 + child.depth);
    }

    bool failed(Error error) {
        error_ = std::move(error);
        return false;
    }

    // Depth first, at most kMaxVrmlNesting deep. Returns false with error_ set on failure. `paint` is the
    // colour of the enclosing shape, if it has one.
    bool emit(VrmlNodeId id, const Affine& to_world, const Rgb8* paint) {
        if (summary_[id].triangles == 0) return true;
        if (is_surface(role(id))) return emit_surface(id, to_world, paint);
        Affine inside = to_world;
        if (role(id) == VrmlRole::transform && !place(id, inside)) return false;
        const std::vector<Rgb8> own = role(id) == VrmlRole::shape ? material_of(id) : std::vector<Rgb8>{};
        const std::span<const VrmlNodeId> children = *seen(id);
        for (const VrmlNodeId child : children) {
            if (!emit(child, inside, own.empty() ? nullptr : own.data())) return false;
        }
        return true;
    }

    std::vector<Rgb8> material_of(VrmlNodeId shape) const {
        const VrmlValue* appearance = tree_.find(shape, "appearance");
        const auto nodes = appearance ? tree_.nodes_of(*appearance) : std::span<const VrmlNodeId>{};
        if (nodes.size() != 1 || role(nodes[0]) != VrmlRole::appearance) return {};
        return read_vrml_colours(tree_, nodes[0], "material");
    }

    // Multiplies the placement of a Transform onto `to_world` (ISO 14772-1, 6.52): T C R SR S -SR -C.
    bool place(VrmlNodeId id, Affine& to_world) {
        double t[3] = {0, 0, 0}, c[3] = {0, 0, 0}, s[3] = {1, 1, 1}, r[4] = {0, 0, 1, 0}, o[4] = {0, 0, 1, 0};
        const VrmlFields fields(tree_, id);
        for (const Result<void>& ok :
             {fields.read("translation", t), fields.read("center", c), fields.read("scale", s),
              fields.read("rotation", r), fields.read("scaleOrientation", o)}) {
            if (!ok) return failed(ok.error());
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

    bool emit_surface(VrmlNodeId id, const Affine& to_world, const Rgb8* paint) {
        if (surface_of_[id] == kNone) {
            auto surface = read_vrml_surface(tree_, id, triangulator_);
            if (!surface) return failed(surface.error());
            if (crossing_at_.line == 0 && triangulator_.crossing_faces() > 0) crossing_at_ = node(id).place;
            surface_of_[id] = static_cast<std::uint32_t>(surfaces_.size());
            surfaces_.push_back(std::move(*surface));
        }
        const VrmlSurface& surface = surfaces_[surface_of_[id]];
        TriangleMesh& mesh = model_.mesh;
        const auto base = static_cast<std::uint32_t>(mesh.positions.size());
        for (const Vec3 p : surface.points) {
            const Vec3 q = to_world(p);
            const auto position = to_position(q.x, q.y, q.z, options_.unit());
            if (!position) {
                return failed(tree_
                                  .refuse(node(id).place, "a point is not finite where it is placed",
                                          "repair the model, or check its unit")
                                  .error());
            }
            mesh.positions.push_back(*position);
        }
        const bool mirrors = to_world.mirrors();
        model_.parts.push_back({static_cast<std::uint32_t>(mesh.triangles.size()),
                                static_cast<std::uint32_t>(surface.triangles.size()),
                                surface.crease_angle_rad, surface.solid});
        add_colours(surface, paint);
        for (const Triangle& t : surface.triangles) {
            mesh.triangles.push_back({base + t[0], base + t[mirrors ? 2 : 1], base + t[mirrors ? 1 : 2]});
        }
        return true;
    }

    // Adds colours. At the first colour of a model, all triangles before it get the default colour.
    void add_colours(const VrmlSurface& surface, const Rgb8* paint) {
        std::vector<Rgb8>& colours = model_.colours;
        if (colours.empty() && surface.colours.empty() && !paint) return;
        colours.resize(model_.mesh.triangles.size(), kGrey);
        if (surface.colours.empty()) {
            colours.resize(colours.size() + surface.triangles.size(), paint ? *paint : kGrey);
        } else {
            colours.insert(colours.end(), surface.colours.begin(), surface.colours.end());
        }
    }

    VrmlTree& tree_;
    const ModelOptions& options_;
    Model model_;
    std::vector<Summary> summary_;
    std::vector<std::uint32_t> surface_of_;  // index into surfaces_, by node
    std::vector<VrmlSurface> surfaces_;
    PolygonTriangulator triangulator_;
    VrmlPlace crossing_at_;  // the first node with a face that intersects itself
    std::optional<Error> error_;
};

}  // namespace

Result<Model> read_vrml_scene(VrmlTree& tree, const ModelOptions& options) {
    return SceneReader(tree, options).read();
}

}  // namespace tribo::readers
