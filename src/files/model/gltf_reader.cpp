// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <limits>
#include <tiny_gltf.h>

#include "files/model/gltf.hpp"
#include "files/model/gltf_document.hpp"
#include "readers/mesh/model_mesh.hpp"

namespace tribo::files {
namespace {

// Column-major, as in glTF.
using Matrix = std::array<double, 16>;
constexpr Matrix kIdentity{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
constexpr int kMostNodes = 100'000;  // visited nodes; ends the walk of a graph that is not a tree
// Visited primitives: a mesh of many empty ones may be shown by every node.
constexpr int kMostPrimitives = 1'000'000;

Matrix product(const Matrix& a, const Matrix& b) {
    Matrix c{};
    for (std::size_t column = 0; column < 4; ++column) {
        for (std::size_t row = 0; row < 4; ++row) {
            for (std::size_t k = 0; k < 4; ++k) c[4 * column + row] += a[4 * k + row] * b[4 * column + k];
        }
    }
    return c;
}

double determinant(const Matrix& m) {
    return m[0] * (m[5] * m[10] - m[6] * m[9]) - m[4] * (m[1] * m[10] - m[2] * m[9]) +
           m[8] * (m[1] * m[6] - m[2] * m[5]);
}

Matrix node_matrix(const tinygltf::Node& node) {
    if (node.matrix.size() == 16) {
        Matrix m;
        std::copy(node.matrix.begin(), node.matrix.end(), m.begin());
        return m;
    }
    Matrix m = kIdentity;
    if (node.rotation.size() == 4) {
        const double x = node.rotation[0], y = node.rotation[1], z = node.rotation[2], w = node.rotation[3];
        m = {1 - 2 * (y * y + z * z),
             2 * (x * y + z * w),
             2 * (x * z - y * w),
             0,
             2 * (x * y - z * w),
             1 - 2 * (x * x + z * z),
             2 * (y * z + x * w),
             0,
             2 * (x * z + y * w),
             2 * (y * z - x * w),
             1 - 2 * (x * x + y * y),
             0,
             0,
             0,
             0,
             1};
    }
    for (std::size_t k = 0; k < 3; ++k) {
        if (node.scale.size() == 3) {
            for (std::size_t row = 0; row < 3; ++row) m[4 * k + row] *= node.scale[k];
        }
        if (node.translation.size() == 3) m[12 + k] = node.translation[k];
    }
    return m;
}

std::unexpected<Error> refused(const std::string& file, std::string cause, const char* remedy) {
    return fail_at(file, 0, 0, std::move(cause), remedy);
}

// The bytes of the elements of an accessor, checked against its view and buffer.
struct Elements {
    const unsigned char* first = nullptr;
    std::size_t stride = 0, count = 0;
    int component = 0;
};

Result<Elements> elements(const tinygltf::Model& model, int index, int type, const std::string& file) {
    const auto bad = [&](const char* what) {
        return refused(file, "glTF accessor " + std::to_string(index) + " " + what,
                       "export the model again, as plain triangles");
    };
    const auto within = [](int i, const auto& list) {
        return i >= 0 && static_cast<std::size_t>(i) < list.size();
    };
    if (!within(index, model.accessors)) return bad("does not exist");
    const tinygltf::Accessor& a = model.accessors[static_cast<std::size_t>(index)];
    if (a.sparse.isSparse) return bad("is sparse, which is not read");
    if (a.type != type) return bad("has another type than its use asks for");
    if (!within(a.bufferView, model.bufferViews)) return bad("has no buffer view");
    const tinygltf::BufferView& view = model.bufferViews[static_cast<std::size_t>(a.bufferView)];
    if (!within(view.buffer, model.buffers)) return bad("has no buffer");
    const std::vector<unsigned char>& data = model.buffers[static_cast<std::size_t>(view.buffer)].data;
    const int step = a.ByteStride(view);
    const int bytes = tinygltf::GetComponentSizeInBytes(static_cast<std::uint32_t>(a.componentType)) *
                      tinygltf::GetNumComponentsInType(static_cast<std::uint32_t>(a.type));
    if (step <= 0 || bytes <= 0) return bad("has no size");
    const auto stride = static_cast<std::size_t>(step), size = static_cast<std::size_t>(bytes);
    if (view.byteOffset > data.size() || view.byteLength > data.size() - view.byteOffset) {
        return bad("reaches beyond its buffer");
    }
    if (a.count == 0) return Elements{data.data(), stride, 0, a.componentType};
    if (a.byteOffset > view.byteLength || size > view.byteLength - a.byteOffset ||
        a.count - 1 > (view.byteLength - a.byteOffset - size) / stride) {
        return bad("reaches beyond its buffer view");
    }
    return Elements{data.data() + view.byteOffset + a.byteOffset, stride, a.count, a.componentType};
}

std::uint32_t index_at(const Elements& e, std::size_t n) {
    const unsigned char* p = e.first + n * e.stride;
    if (e.component == TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE) return *p;
    if (e.component == TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT) {
        std::uint16_t v;
        std::memcpy(&v, p, sizeof v);
        return v;
    }
    std::uint32_t v;
    std::memcpy(&v, p, sizeof v);
    return v;
}

// Positions and optional indices of one primitive.
struct Primitive {
    Elements points, indices;
    bool indexed = false;

    std::size_t triangles() const { return (indexed ? indices.count : points.count) / 3; }
};

// Walks the nodes of a scene twice: first to count, then to copy.
class GltfReader {
  public:
    GltfReader(const tinygltf::Model& model, const readers::ModelOptions& options, double unit_mm)
        : model_(model), options_(options), file_(options.source_name), unit_mm_(unit_mm) {}

    // Mesh and, in a file of Tribo, what of it is untouched.
    Result<readers::Model> read(const std::vector<int>& roots) {
        for (const bool copying : {false, true}) {
            copying_ = copying;
            visited_ = primitives_ = 0;
            if (copying) {
                found_.mesh.positions.reserve(positions_);
                found_.mesh.triangles.reserve(triangles_);
            }
            for (const int root : roots) {
                if (auto ok = node(root, kIdentity, 0); !ok) return std::unexpected(ok.error());
            }
        }
        return std::move(found_);
    }

  private:
    Result<void> node(int index, const Matrix& parent, int depth) {
        constexpr int kDeepest = 256;
        if (index < 0 || index >= static_cast<int>(model_.nodes.size()) || depth > kDeepest ||
            ++visited_ > kMostNodes) {
            return refused(file_, "glTF nodes do not form a tree", "export the model again");
        }
        const tinygltf::Node& n = model_.nodes[static_cast<std::size_t>(index)];
        const Matrix here = product(parent, node_matrix(n));
        if (n.mesh >= static_cast<int>(model_.meshes.size())) {
            return refused(file_, "a glTF node shows a mesh that does not exist", "export the model again");
        }
        if (n.mesh >= 0) {
            int copied = -1;  // primitives may share their positions
            for (const tinygltf::Primitive& p : model_.meshes[static_cast<std::size_t>(n.mesh)].primitives) {
                if (auto ok = primitive(p, here, copied); !ok) return ok;
            }
        }
        for (const int child : n.children) {
            if (auto ok = node(child, here, depth + 1); !ok) return ok;
        }
        return {};
    }

    Result<void> primitive(const tinygltf::Primitive& p, const Matrix& here, int& copied) {
        if (++primitives_ > kMostPrimitives) {
            return refused(file_, "the glTF scene shows more than a million primitives",
                           "join the primitives of each mesh, or simplify the scene");
        }
        if (p.mode != TINYGLTF_MODE_TRIANGLES && p.mode != -1) {
            return refused(file_, "a glTF mesh is not made of plain triangles",
                           "export it as triangles, without strips, fans or compression");
        }
        const auto position = p.attributes.find("POSITION");
        if (position == p.attributes.end()) return {};
        Primitive found;
        auto points = elements(model_, position->second, TINYGLTF_TYPE_VEC3, file_);
        if (!points) return std::unexpected(points.error());
        found.points = *points;
        if (points->component != TINYGLTF_COMPONENT_TYPE_FLOAT) {
            return refused(file_, "glTF positions are not floats", "export without quantisation");
        }
        if (p.indices >= 0) {
            auto indices = elements(model_, p.indices, TINYGLTF_TYPE_SCALAR, file_);
            if (!indices) return std::unexpected(indices.error());
            found.indices = *indices;
            found.indexed = true;
            if (indices->component != TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE &&
                indices->component != TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT &&
                indices->component != TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT) {
                return refused(file_, "glTF indices are not unsigned integers", "export the model again");
            }
        }
        if (found.triangles() == 0) return {};
        const bool again = copied == position->second;
        copied = position->second;
        if (!copying_) return count(found, again);
        if (auto ok = copy(found, here, again); !ok) return ok;
        if (model_.asset.generator == kOwnGenerator)
            found_.untouched.resize(found_.mesh.triangles.size(), is_stock(p.material) ? 1 : 0);
        return {};
    }

    bool is_stock(int material) const {
        return material >= 0 && material < static_cast<int>(model_.materials.size()) &&
               model_.materials[static_cast<std::size_t>(material)].name == kStockMaterial;
    }

    Result<void> count(const Primitive& p, bool again) {
        triangles_ += p.triangles();
        if (!again) positions_ += p.points.count;
        if (triangles_ > options_.max_triangles || positions_ > 3 * options_.max_triangles) {
            return fail_at(file_, 0, 0, "the glTF scene shows " + readers::too_many_triangles(options_),
                           readers::fewer_triangles(options_));
        }
        return {};
    }

    Result<void> copy(const Primitive& p, const Matrix& here, bool again) {
        const std::size_t first = found_.mesh.positions.size() - (again ? p.points.count : 0);
        for (std::size_t n = 0; !again && n < p.points.count; ++n) {
            float v[3];
            std::memcpy(v, p.points.first + n * p.points.stride, sizeof v);
            Vec3 q;
            for (int row = 0; row < 3; ++row) {
                const auto r = static_cast<std::size_t>(row);
                q[row] = here[r] * static_cast<double>(v[0]) + here[4 + r] * static_cast<double>(v[1]) +
                         here[8 + r] * static_cast<double>(v[2]) + here[12 + r];
            }
            const auto point = readers::to_position(q.x, -q.z, q.y, unit_mm_);  // y up to z up
            if (!point) {
                return refused(file_, "a glTF position is not a number, or beyond single precision",
                               "check the model's scale and unit_mm");
            }
            found_.mesh.positions.push_back(*point);
        }
        const bool mirrored = determinant(here) < 0;  // a mirror reverses triangles (glTF 2.0, 3.7.4)
        for (std::size_t n = 0; n < p.triangles(); ++n) {
            Triangle t;
            for (std::size_t k = 0; k < 3; ++k) {
                const std::size_t i = p.indexed ? index_at(p.indices, 3 * n + k) : 3 * n + k;
                if (i >= p.points.count) {
                    return refused(file_, "a glTF index points beyond the positions",
                                   "export the model again");
                }
                t[k] = static_cast<std::uint32_t>(first + i);
            }
            if (mirrored) std::swap(t[1], t[2]);
            found_.mesh.triangles.push_back(t);
        }
        return {};
    }

    const tinygltf::Model& model_;
    const readers::ModelOptions& options_;
    const std::string& file_;
    double unit_mm_;
    bool copying_ = false;
    int visited_ = 0, primitives_ = 0;
    std::size_t positions_ = 0, triangles_ = 0;
    readers::Model found_;
};

// Returns the length of one unit stated in the file, mm; none if it states none.
Result<std::optional<double>> unit_inside(const tinygltf::Model& model, const std::string& file) {
    const tinygltf::Value& extras = model.asset.extras;
    if (!extras.IsObject() || !extras.Has("unit_mm")) return std::nullopt;
    const tinygltf::Value& unit = extras.Get("unit_mm");
    const double mm = unit.IsNumber() ? unit.GetNumberAsDouble() : 0;
    if (!(mm > 0 && std::isfinite(mm))) {
        return refused(file, "asset.extras.unit_mm is not a length above 0", "set unit_mm in the job file");
    }
    return mm;
}

// Refuses to open any other file.
bool no_file(const std::string&, void*) {
    return false;
}
bool no_read(std::vector<unsigned char>*, std::string* error, const std::string& path, void*) {
    if (error) *error += "data in another file is not read: " + path + "; ";
    return false;
}
bool no_write(std::string*, const std::string&, const std::vector<unsigned char>&, void*) {
    return false;
}
std::string same_path(const std::string& path, void*) {
    return path;
}
bool skip_image(tinygltf::Image*, const int, std::string*, std::string*, int, int, const unsigned char*, int,
                void*) {
    return true;
}

// A file may name no scene: then all that it holds is there.
std::vector<int> nodes_without_parent(const tinygltf::Model& model) {
    std::vector<bool> has_parent(model.nodes.size());
    for (const tinygltf::Node& node : model.nodes) {
        for (const int child : node.children) {
            if (child >= 0 && static_cast<std::size_t>(child) < has_parent.size())
                has_parent[static_cast<std::size_t>(child)] = true;
        }
    }
    std::vector<int> roots;
    for (std::size_t n = 0; n < has_parent.size(); ++n) {
        if (!has_parent[n]) roots.push_back(static_cast<int>(n));
    }
    return roots;
}

}  // namespace

Result<readers::Model> read_gltf(std::string_view bytes, const readers::ModelOptions& options) {
    const std::string& file = options.source_name;
    if (bytes.size() > std::numeric_limits<unsigned int>::max()) {
        return refused(file, "the glTF file is larger than 4 GB", "simplify the model");
    }
    if (auto ok = check_gltf_document(bytes, file); !ok) return std::unexpected(ok.error());
    tinygltf::TinyGLTF loader;
    loader.SetFsCallbacks({no_file, same_path, no_read, no_write, nullptr});
    loader.SetImageLoader(skip_image, nullptr);
    tinygltf::Model model;
    std::string error, warning;
    bool loaded = false;
    const auto size = static_cast<unsigned int>(bytes.size());
    try {
        loaded = bytes.starts_with("glTF")
                     ? loader.LoadBinaryFromMemory(&model, &error, &warning,
                                                   reinterpret_cast<const unsigned char*>(bytes.data()), size)
                     : loader.LoadASCIIFromString(&model, &error, &warning, bytes.data(), size, "");
    } catch (const std::exception& failure) {
        error = failure.what();
    }
    if (!loaded) {
        std::replace(error.begin(), error.end(), '\n', ' ');
        return refused(file, "glTF: " + error, "export the model again as one .glb file");
    }
    const auto inside = unit_inside(model, file);
    if (!inside && !options.unit_mm) return std::unexpected(inside.error());
    const std::optional<double> unit_mm = options.unit_mm ? options.unit_mm : *inside;

    std::vector<int> roots;
    if (!model.scenes.empty()) {
        const int scene = std::clamp(model.defaultScene, 0, static_cast<int>(model.scenes.size()) - 1);
        roots = model.scenes[static_cast<std::size_t>(scene)].nodes;
    } else {
        roots = nodes_without_parent(model);
    }
    auto found = GltfReader(model, options, unit_mm.value_or(1)).read(roots);
    if (!found) return found;
    found->format = readers::ModelFormat::gltf;
    if (!unit_mm) {
        found->warnings.push_back(
            {file, 0,
             "one unit of the glTF file is taken as 1 mm; where it keeps to the "
             "standard's metre, give the unit: unit_mm = 1000 in a job, --unit-mm 1000 of "
             "a verb"});
    }
    model = {};
    return readers::finish_model(*std::move(found), options, readers::Weld::exact);
}

}  // namespace tribo::files
