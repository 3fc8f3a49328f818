// SPDX-License-Identifier: MIT
#include "io/gltf.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <fstream>
#include <limits>
#include <tiny_gltf.h>

namespace tribo::io {
namespace {

// Column-major, as glTF has it.
using Matrix = std::array<double, 16>;
constexpr Matrix kIdentity{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
constexpr int kMostNodes = 100'000;  // visited, so that a graph that is no tree ends

Matrix product(const Matrix& a, const Matrix& b) {
    Matrix c{};
    for (std::size_t column = 0; column < 4; ++column) {
        for (std::size_t row = 0; row < 4; ++row) {
            for (std::size_t k = 0; k < 4; ++k) c[4 * column + row] += a[4 * k + row] * b[4 * column + k];
        }
    }
    return c;
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

// The bytes of an accessor's elements, checked against its view and buffer.
struct Elements {
    const unsigned char* first = nullptr;
    std::size_t stride = 0, count = 0;
    int component = 0;
};

Result<Elements> elements(const tinygltf::Model& model, int index, int type, const std::string& file) {
    const auto bad = [&](const char* what) {
        return fail_at(file, 0, 0, std::string("glTF accessor ") + std::to_string(index) + " " + what,
                       "export the model again, as plain triangles");
    };
    if (index < 0 || index >= static_cast<int>(model.accessors.size())) return bad("does not exist");
    const tinygltf::Accessor& a = model.accessors[static_cast<std::size_t>(index)];
    if (a.sparse.isSparse) return bad("is sparse, which is not read");
    if (a.type != type) return bad("has another type than its use asks for");
    if (a.bufferView < 0 || a.bufferView >= static_cast<int>(model.bufferViews.size()))
        return bad("has no buffer view");
    const tinygltf::BufferView& view = model.bufferViews[static_cast<std::size_t>(a.bufferView)];
    if (view.buffer < 0 || view.buffer >= static_cast<int>(model.buffers.size())) return bad("has no buffer");
    const std::vector<unsigned char>& data = model.buffers[static_cast<std::size_t>(view.buffer)].data;
    const int stride = a.ByteStride(view);
    const int size = tinygltf::GetComponentSizeInBytes(static_cast<std::uint32_t>(a.componentType)) *
                     tinygltf::GetNumComponentsInType(static_cast<std::uint32_t>(a.type));
    if (stride <= 0 || size <= 0) return bad("has no size");
    const std::size_t begin = view.byteOffset + a.byteOffset;
    if (a.count == 0) return Elements{data.data(), static_cast<std::size_t>(stride), 0, a.componentType};
    if (begin > data.size() || a.count - 1 > (data.size() - begin) / static_cast<std::size_t>(stride)) {
        return bad("reaches beyond its buffer");
    }
    if (begin + (a.count - 1) * static_cast<std::size_t>(stride) + static_cast<std::size_t>(size) >
        data.size()) {
        return bad("reaches beyond its buffer");
    }
    return Elements{data.data() + begin, static_cast<std::size_t>(stride), a.count, a.componentType};
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

class SceneReader {
  public:
    SceneReader(const tinygltf::Model& model, const formats::ModelOptions& options)
        : model_(model), options_(options) {}

    Result<void> node(int index, const Matrix& parent, int depth) {
        constexpr int kDeepest = 256;
        if (index < 0 || index >= static_cast<int>(model_.nodes.size()) || depth > kDeepest ||
            ++visited_ > kMostNodes) {
            return fail_at(options_.source_name, 0, 0, "glTF nodes do not form a tree",
                           "export the model again");
        }
        const tinygltf::Node& n = model_.nodes[static_cast<std::size_t>(index)];
        const Matrix here = product(parent, node_matrix(n));
        if (n.mesh >= 0 && n.mesh < static_cast<int>(model_.meshes.size())) {
            for (const tinygltf::Primitive& p : model_.meshes[static_cast<std::size_t>(n.mesh)].primitives) {
                if (auto ok = primitive(p, here); !ok) return ok;
            }
        }
        for (const int child : n.children) {
            if (auto ok = node(child, here, depth + 1); !ok) return ok;
        }
        return {};
    }

    TriangleMesh mesh;

  private:
    Result<void> primitive(const tinygltf::Primitive& p, const Matrix& here) {
        if (p.mode != TINYGLTF_MODE_TRIANGLES && p.mode != -1) {
            return fail_at(options_.source_name, 0, 0, "a glTF mesh is not made of plain triangles",
                           "export it as triangles, without strips, fans or compression");
        }
        const auto position = p.attributes.find("POSITION");
        if (position == p.attributes.end()) return {};
        auto points = elements(model_, position->second, TINYGLTF_TYPE_VEC3, options_.source_name);
        if (!points) return std::unexpected(points.error());
        if (points->component != TINYGLTF_COMPONENT_TYPE_FLOAT) {
            return fail_at(options_.source_name, 0, 0, "glTF positions are not floats",
                           "export without quantisation");
        }
        const auto first = static_cast<std::uint32_t>(mesh.positions.size());
        for (std::size_t n = 0; n < points->count; ++n) {
            float v[3];
            std::memcpy(v, points->first + n * points->stride, sizeof v);
            Vec3 q;
            for (int row = 0; row < 3; ++row) {
                const auto r = static_cast<std::size_t>(row);
                q[row] = here[r] * static_cast<double>(v[0]) + here[4 + r] * static_cast<double>(v[1]) +
                         here[8 + r] * static_cast<double>(v[2]) + here[12 + r];
            }
            if (!is_finite(q)) {
                return fail_at(options_.source_name, 0, 0, "a glTF position is not a finite number",
                               "export the model again");
            }
            // y up to z up.
            const Vec3 up = options_.unit_mm * Vec3{q.x, -q.z, q.y};
            mesh.positions.push_back(
                {static_cast<float>(up.x), static_cast<float>(up.y), static_cast<float>(up.z)});
        }
        return triangles(p, first, points->count);
    }

    Result<void> triangles(const tinygltf::Primitive& p, std::uint32_t first, std::size_t points) {
        Elements indices;
        std::size_t count = points;
        if (p.indices >= 0) {
            auto found = elements(model_, p.indices, TINYGLTF_TYPE_SCALAR, options_.source_name);
            if (!found) return std::unexpected(found.error());
            indices = *found;
            count = indices.count;
        }
        if (mesh.triangles.size() + count / 3 > formats::kMaxTriangles) {
            return fail_at(options_.source_name, 0, 0, "the glTF model has more triangles than are read",
                           "simplify it");
        }
        for (std::size_t n = 0; n + 3 <= count; n += 3) {
            Triangle t;
            for (std::size_t k = 0; k < 3; ++k) {
                const std::uint32_t i =
                    p.indices >= 0 ? index_at(indices, n + k) : static_cast<std::uint32_t>(n + k);
                if (i >= points) {
                    return fail_at(options_.source_name, 0, 0, "a glTF index points beyond the positions",
                                   "export the model again");
                }
                t[k] = first + i;
            }
            if (t[0] != t[1] && t[1] != t[2] && t[2] != t[0]) mesh.triangles.push_back(t);
        }
        return {};
    }

    const tinygltf::Model& model_;
    const formats::ModelOptions& options_;
    int visited_ = 0;
};

// Nothing outside the bytes is ever opened.
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

}  // namespace

FileResult<void> write_glb(const std::string& path, const TriangleMesh& mesh) {
    tinygltf::Model model;
    model.asset.version = "2.0";
    model.asset.generator = "Tribo";
    const std::size_t points = mesh.positions.size() * sizeof(Point3f),
                      indices = mesh.triangles.size() * sizeof(Triangle);
    tinygltf::Buffer& buffer = model.buffers.emplace_back();
    buffer.data.resize(points + indices);
    if (points > 0) std::memcpy(buffer.data.data(), mesh.positions.data(), points);
    if (indices > 0) std::memcpy(buffer.data.data() + points, mesh.triangles.data(), indices);

    const auto view = [&](std::size_t offset, std::size_t length, int target) {
        tinygltf::BufferView& v = model.bufferViews.emplace_back();
        v.buffer = 0;
        v.byteOffset = offset;
        v.byteLength = length;
        v.target = target;
        return static_cast<int>(model.bufferViews.size()) - 1;
    };
    tinygltf::Accessor position;
    position.bufferView = view(0, points, TINYGLTF_TARGET_ARRAY_BUFFER);
    position.componentType = TINYGLTF_COMPONENT_TYPE_FLOAT;
    position.type = TINYGLTF_TYPE_VEC3;
    position.count = mesh.positions.size();
    const Box3 box = bounds(mesh);
    position.minValues = {box.min.x, box.min.y, box.min.z};
    position.maxValues = {box.max.x, box.max.y, box.max.z};
    tinygltf::Accessor index;
    index.bufferView = view(points, indices, TINYGLTF_TARGET_ELEMENT_ARRAY_BUFFER);
    index.componentType = TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT;
    index.type = TINYGLTF_TYPE_SCALAR;
    index.count = 3 * mesh.triangles.size();
    model.accessors = {position, index};

    tinygltf::Material steel;
    steel.name = "machined";
    steel.pbrMetallicRoughness.baseColorFactor = {0.75, 0.77, 0.8, 1};
    steel.pbrMetallicRoughness.metallicFactor = 0.6;
    steel.pbrMetallicRoughness.roughnessFactor = 0.45;
    model.materials.push_back(steel);
    tinygltf::Node node;
    node.name = "part";
    constexpr double kMetres = 0.001;
    node.matrix = {kMetres, 0, 0, 0, 0, 0, -kMetres, 0, 0, kMetres, 0, 0, 0, 0, 0, 1};
    tinygltf::Scene scene;
    if (!mesh.triangles.empty()) {
        tinygltf::Primitive primitive;
        primitive.attributes["POSITION"] = 0;
        primitive.indices = 1;
        primitive.material = 0;
        primitive.mode = TINYGLTF_MODE_TRIANGLES;
        tinygltf::Mesh part;
        part.name = "machined part";
        part.primitives.push_back(primitive);
        model.meshes.push_back(part);
        node.mesh = 0;
    } else {
        model.accessors.clear();
        model.bufferViews.clear();
        model.buffers.clear();
    }
    model.nodes.push_back(node);
    scene.nodes.push_back(0);
    model.scenes.push_back(scene);
    model.defaultScene = 0;

    std::ofstream out(path, std::ios::binary);
    if (!out) return system_failure(path, "create", errno);
    tinygltf::TinyGLTF writer;
    if (!writer.WriteGltfSceneToStream(&model, out, false, true) || !out.flush())
        return system_failure(path, "write", errno);
    return {};
}

Result<formats::Model> read_gltf(std::string_view bytes, const formats::ModelOptions& options) {
    tinygltf::TinyGLTF loader;
    loader.SetFsCallbacks({no_file, same_path, no_read, no_write, nullptr});
    loader.SetImageLoader(skip_image, nullptr);
    tinygltf::Model model;
    std::string error, warning;
    bool loaded = false;
    if (bytes.size() > std::numeric_limits<unsigned int>::max()) {
        return fail_at(options.source_name, 0, 0, "the glTF file is larger than 4 GB", "simplify the model");
    }
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
        return fail_at(options.source_name, 0, 0, "glTF: " + error,
                       "export the model again as one .glb file");
    }
    SceneReader reader(model, options);
    std::vector<int> roots;
    if (!model.scenes.empty()) {
        const int scene = std::clamp(model.defaultScene, 0, static_cast<int>(model.scenes.size()) - 1);
        roots = model.scenes[static_cast<std::size_t>(scene)].nodes;
    }
    for (const int root : roots) {
        if (auto ok = reader.node(root, kIdentity, 0); !ok) return std::unexpected(ok.error());
    }
    if (reader.mesh.triangles.empty()) {
        return fail_at(options.source_name, 0, 0, "the glTF scene has no triangles",
                       "export the mesh with the scene");
    }
    formats::Model found;
    found.mesh = std::move(reader.mesh);
    found.format = formats::ModelFormat::gltf;
    return found;
}

}  // namespace tribo::io
