// SPDX-License-Identifier: MIT
#include <algorithm>
#include <bit>
#include <cstring>
#include <limits>
#include <vector>

#include "files/json/json.hpp"
#include "files/model/gltf.hpp"
#include "files/model/gltf_document.hpp"

namespace tribo::files {
namespace {

static_assert(std::endian::native == std::endian::little,
              "glTF is little-endian, and memory is written as it is");

// Constants of the standard (glTF 2.0, 3.6.2 and 3.7.2).
constexpr int kFloat = 5126, kUnsignedInt = 5125, kArrayBuffer = 34962, kElementArrayBuffer = 34963,
              kTriangles = 4;
constexpr double kUnitMm = 1000;  // the unit of glTF is the metre

// The bytes of an array, as in memory.
template <class T>
std::string_view raw(const std::vector<T>& values) {
    return {reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T)};
}

Json material(const char* name, double red, double green, double blue) {
    Json m;
    m["name"] = name;
    m["pbrMetallicRoughness"]["baseColorFactor"] = Json::array({red, green, blue, 1});
    m["pbrMetallicRoughness"]["metallicFactor"] = 0.3;
    m["pbrMetallicRoughness"]["roughnessFactor"] = 0.5;
    return m;
}

Json view(std::size_t offset, std::size_t length, int target) {
    Json v;
    v["buffer"] = 0;
    v["byteOffset"] = offset;
    v["byteLength"] = length;
    v["target"] = target;
    return v;
}

Json accessor(std::size_t view, std::size_t offset, int component, std::size_t count, const char* type) {
    Json a;
    a["bufferView"] = view;
    a["byteOffset"] = offset;
    a["componentType"] = component;
    a["count"] = count;
    a["type"] = type;
    return a;
}

// The data of the mesh: positions, then the indices of machined triangles, then those of the others.
Json document(const TriangleMesh& mesh, std::size_t machined) {
    Json json;
    json["asset"]["version"] = "2.0";
    json["asset"]["generator"] = kOwnGenerator;
    json["asset"]["extras"]["unit_mm"] = kUnitMm;
    json["scene"] = 0;
    json["scenes"] = Json::array({{{"nodes", Json::array({0})}}});
    Json node;
    node["name"] = "part";
    constexpr double k = 1 / kUnitMm;
    node["matrix"] = Json::array({k, 0, 0, 0, 0, 0, -k, 0, 0, k, 0, 0, 0, 0, 0, 1});
    const std::size_t triangles = mesh.triangles.size();
    if (triangles > 0) {
        node["mesh"] = 0;
        const std::size_t points = raw(mesh.positions).size(), indices = raw(mesh.triangles).size();
        json["buffers"] = Json::array({{{"byteLength", points + indices}}});
        json["bufferViews"] =
            Json::array({view(0, points, kArrayBuffer), view(points, indices, kElementArrayBuffer)});
        Json position = accessor(0, 0, kFloat, mesh.positions.size(), "VEC3");
        const Box3 box = bounds(mesh);
        position["min"] = triple(box.min);
        position["max"] = triple(box.max);
        json["accessors"].push_back(position);
        json["materials"] =
            Json::array({material("machined", 0.16, 0.36, 0.72), material(kStockMaterial, 0.62, 0.64, 0.67)});
        const auto draw = [&](int which, std::size_t first, std::size_t count) {
            if (count == 0) return;
            Json primitive;
            primitive["attributes"]["POSITION"] = 0;
            primitive["indices"] = json["accessors"].size();
            primitive["material"] = which;
            primitive["mode"] = kTriangles;
            json["accessors"].push_back(
                accessor(1, first * sizeof(Triangle), kUnsignedInt, 3 * count, "SCALAR"));
            json["meshes"][0]["primitives"].push_back(primitive);
        };
        json["meshes"][0]["name"] = "machined part";
        draw(0, 0, machined);
        draw(1, machined, triangles - machined);
    }
    json["nodes"] = Json::array({node});
    return json;
}

// Appends four bytes of the header of a chunk or file.
void put(FileWriter& file, std::uint64_t value) {
    const auto bytes = std::bit_cast<std::array<char, 4>>(static_cast<std::uint32_t>(value));
    file.write({bytes.data(), bytes.size()});
}

}  // namespace

FileResult<void> write_glb(const std::string& path, const TriangleMesh& mesh,
                           std::span<const std::uint8_t> untouched) {
    const auto is_stock = [&](std::size_t n) { return !untouched.empty() && untouched[n] != 0; };
    const std::size_t machined =
        mesh.triangles.size() -
        static_cast<std::size_t>(std::ranges::count_if(untouched, [](auto stock) { return stock != 0; }));
    std::string text = dump(document(mesh, machined));
    text.resize((text.size() + 3) / 4 * 4, ' ');
    const std::uint64_t binary =
        mesh.triangles.empty() ? 0 : raw(mesh.positions).size() + raw(mesh.triangles).size();
    constexpr std::uint64_t kHeader = 12, kChunkHeader = 8;
    const std::uint64_t length =
        kHeader + kChunkHeader + text.size() + (binary > 0 ? kChunkHeader + binary : 0);
    if (length > std::numeric_limits<std::uint32_t>::max()) {
        return std::unexpected(
            FileFailure({path, 0, 0, "the mesh is larger than the 4 GB that a .glb file holds",
                         "try a coarser --resolution, or leave the mesh out with --only"}));
    }
    auto file = FileWriter::create(path);
    if (!file) return std::unexpected(file.error());
    file->write("glTF");
    put(*file, 2);
    put(*file, length);
    put(*file, text.size());
    file->write("JSON");
    file->write(text);
    if (binary > 0) {
        put(*file, binary);
        file->write({"BIN\0", 4});
        file->write(raw(mesh.positions));
        for (const bool stock : {false, true}) {
            for (std::size_t n = 0; n < mesh.triangles.size(); ++n) {
                if (is_stock(n) != stock) continue;
                file->write({reinterpret_cast<const char*>(&mesh.triangles[n]), sizeof(Triangle)});
            }
        }
    }
    return file->finish();
}

}  // namespace tribo::files
