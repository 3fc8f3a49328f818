// SPDX-License-Identifier: MIT
// What write_glb writes, read_gltf reads back; what it must not read, it refuses.
#include "files/model/gltf.hpp"

#include <algorithm>
#include <cstring>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "files/model/model_file.hpp"
#include "files/scratch.hpp"

namespace tribo::files {
namespace {

using Json = nlohmann::json;

TriangleMesh tetrahedron() {
    TriangleMesh mesh;
    mesh.positions = {{0, 0, 0}, {10, 0, 0}, {0, 20, 0}, {0, 0, 30}};
    mesh.triangles = {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}};
    return mesh;
}

std::string written(const TriangleMesh& mesh, std::span<const std::uint8_t> untouched = {}) {
    const test::Scratch scratch;
    EXPECT_TRUE(write_glb(scratch / "part.glb", mesh, untouched).has_value());
    return scratch.get("part.glb");
}

// A file of its own making: glTF text beside the bytes of a buffer, as the standard lays them out.
std::string glb(Json json, const std::string& binary) {
    const auto number = [](std::size_t value) {
        std::string bytes;
        for (int k = 0; k < 4; ++k) bytes += static_cast<char>(value >> 8 * k & 255);
        return bytes;
    };
    std::string text = json.dump();
    text.resize((text.size() + 3) / 4 * 4, ' ');
    const std::string chunks =
        number(text.size()) + "JSON" + text + number(binary.size()) + std::string("BIN\0", 4) + binary;
    return "glTF" + number(2) + number(12 + chunks.size()) + chunks;
}

template <class T>
std::string bytes_of(const std::vector<T>& values) {
    return {reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T)};
}

// One triangle over three corners, 36 bytes, shown by one node.
Json one_triangle() {
    return Json::parse(R"({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}],
        "nodes": [{"mesh": 0}], "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}],
        "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3"}],
        "bufferViews": [{"buffer": 0, "byteLength": 36}], "buffers": [{"byteLength": 36}]})");
}
const std::vector<float> kCorners{0, 0, 0, 1, 0, 0, 0, 1, 0};

std::string why(const std::string& file) {
    const auto model = read_gltf(file, {.source_name = "a.glb"});
    return model ? "read" : model.error().cause;
}

TEST(Gltf, comes_back_in_millimetres_without_being_told_its_unit) {
    const std::string bytes = written(tetrahedron());
    EXPECT_TRUE(bytes.starts_with("glTF"));
    const auto model = read_gltf(bytes, {.source_name = "part.glb"});
    ASSERT_TRUE(model.has_value()) << model.error().text();
    EXPECT_TRUE(model->warnings.empty());
    ASSERT_EQ(model->mesh.triangles.size(), 4u);
    EXPECT_TRUE(is_closed(model->mesh));
    EXPECT_NEAR(volume_mm3(model->mesh), 1000, 1e-2);
    const Box3 box = bounds(model->mesh);
    EXPECT_NEAR(box.max.z, 30, 1e-4);
    EXPECT_NEAR(box.max.y, 20, 1e-4);
    // Who says a unit means it: the file's numbers are metres.
    const auto metres = read_gltf(bytes, {.source_name = "part.glb", .unit_mm = 1});
    ASSERT_TRUE(metres.has_value());
    EXPECT_NEAR(bounds(metres->mesh).max.z, 0.03, 1e-7);
}

TEST(Gltf, shows_all_of_a_file_without_scenes) {
    Json json = one_triangle();
    json.erase("scene");
    json.erase("scenes");
    // A parent moves its child; a second node stands alone.
    json["nodes"] = Json::parse(R"([{"mesh": 0}, {"children": [0], "translation": [0, 0, 5]}, {"mesh": 0}])");
    const auto model = read_gltf(glb(json, bytes_of(kCorners)), {.source_name = "a.glb"});
    ASSERT_TRUE(model.has_value()) << model.error().text();
    EXPECT_EQ(model->mesh.triangles.size(), 2u);
    const Box3 box = bounds(model->mesh);
    EXPECT_EQ(box.size(), (Vec3{1, 5, 1}));
}

TEST(Gltf, is_in_metres_with_y_up_for_those_who_keep_to_the_standard) {
    const std::string bytes = written(tetrahedron());
    std::uint32_t length = 0;
    std::memcpy(&length, bytes.data() + 12, 4);
    const Json json = Json::parse(bytes.substr(20, length));
    EXPECT_EQ(json["asset"]["version"], "2.0");
    EXPECT_EQ(json["asset"]["extras"]["unit_mm"], 1000);
    const Json& m = json["nodes"][0]["matrix"];
    // Column-major: up (stock z) becomes y, mm become m.
    const double up[3] = {m[8], m[9], m[10]};
    EXPECT_EQ(up[0], 0);
    EXPECT_EQ(up[1], 0.001);
    EXPECT_EQ(up[2], 0);
    std::uint32_t total = 0;
    std::memcpy(&total, bytes.data() + 8, 4);
    EXPECT_EQ(total, bytes.size());
}

TEST(Gltf, keeps_machined_and_untouched_surface_apart_and_reads_both) {
    const TriangleMesh mesh = tetrahedron();
    std::vector<std::uint8_t> base;
    for (const Triangle& t : mesh.triangles)
        base.push_back(std::ranges::all_of(t, [&](std::uint32_t n) { return mesh.position(n).z == 0; }));
    const std::string bytes = written(mesh, base);
    std::uint32_t length = 0;
    std::memcpy(&length, bytes.data() + 12, 4);
    const Json json = Json::parse(bytes.substr(20, length));
    const Json& primitives = json["meshes"][0]["primitives"];
    ASSERT_EQ(primitives.size(), 2u);
    EXPECT_EQ(json["accessors"][primitives[0]["indices"].get<std::size_t>()]["count"], 9);
    EXPECT_EQ(json["accessors"][primitives[1]["indices"].get<std::size_t>()]["count"], 3);
    const auto name = [&](std::size_t n) {
        return json["materials"][primitives[n]["material"].get<std::size_t>()]["name"];
    };
    EXPECT_EQ(name(0), "machined");
    EXPECT_EQ(name(1), "stock");
    const auto model = read_gltf(bytes, {.source_name = "part.glb"});
    ASSERT_TRUE(model.has_value()) << model.error().text();
    EXPECT_TRUE(is_closed(model->mesh));
    EXPECT_EQ(model->mesh.positions.size(), 4u);
    EXPECT_NEAR(volume_mm3(model->mesh), 1000, 1e-2);
    ASSERT_EQ(model->untouched.size(), 4u);
    for (std::size_t n = 0; n < 4; ++n) {
        const auto& t = model->mesh.triangles[n];
        const bool low = std::ranges::all_of(t, [&](auto k) { return model->mesh.position(k).z == 0; });
        EXPECT_EQ(model->untouched[n] != 0, low);
    }
}

TEST(Gltf, of_a_foreign_file_is_millimetres_with_a_warning_unless_the_job_says) {
    const std::string file = glb(one_triangle(), bytes_of(kCorners));
    const auto plain = read_gltf(file, {.source_name = "a.glb"});
    ASSERT_TRUE(plain.has_value()) << plain.error().text();
    EXPECT_NEAR(area_mm2(plain->mesh), 0.5, 1e-6);
    EXPECT_TRUE(plain->untouched.empty());
    ASSERT_EQ(plain->warnings.size(), 1u);
    EXPECT_NE(plain->warnings[0].message().find("unit_mm = 1000"), std::string::npos);
    const auto told = read_gltf(file, {.source_name = "a.glb", .unit_mm = 1000});
    ASSERT_TRUE(told.has_value());
    EXPECT_NEAR(area_mm2(told->mesh), 0.5e6, 1);
    EXPECT_TRUE(told->warnings.empty());
    // y up: what lies in the file's xy plane stands upright.
    EXPECT_NEAR(bounds(plain->mesh).max.z, 1, 1e-6);
}

TEST(Gltf, of_an_empty_mesh_is_a_valid_file_without_triangles) {
    EXPECT_NE(why(written({})).find("no triangles"), std::string::npos);
}

TEST(Gltf, has_split_vertices_made_one_and_mirrored_nodes_turned_right) {
    // A box drawn face by face, as exporters write it for its normals; the node mirrors x.
    const auto mesh = tetrahedron();
    std::vector<float> soup;
    for (const Triangle& t : mesh.triangles) {
        for (const std::uint32_t i : t)
            soup.insert(soup.end(), mesh.positions[i].begin(), mesh.positions[i].end());
    }
    Json json = one_triangle();
    json["accessors"][0]["count"] = 12;
    json["bufferViews"][0]["byteLength"] = json["buffers"][0]["byteLength"] = 144;
    json["nodes"][0]["scale"] = {-1, 1, 1};
    const auto model = read_gltf(glb(json, bytes_of(soup)), {.source_name = "a.glb"});
    ASSERT_TRUE(model.has_value()) << model.error().text();
    EXPECT_EQ(model->mesh.positions.size(), 4u);
    EXPECT_TRUE(is_closed(model->mesh));
    EXPECT_NEAR(volume_mm3(model->mesh), 1000, 1e-2);
}

TEST(Gltf, counts_a_mesh_once_for_every_node_before_it_is_copied) {
    // 60 kB of triangles shown by 20,000 nodes would be 100 million of them.
    const std::size_t triangles = 5000;
    Json json = one_triangle();
    json["accessors"].push_back(
        {{"bufferView", 1}, {"componentType", 5121}, {"count", 3 * triangles}, {"type", "SCALAR"}});
    json["bufferViews"].push_back({{"buffer", 0}, {"byteOffset", 36}, {"byteLength", 3 * triangles}});
    json["buffers"][0]["byteLength"] = 36 + 3 * triangles;
    json["meshes"][0]["primitives"][0]["indices"] = 1;
    for (int n = 1; n < 20000; ++n) {
        json["nodes"].push_back({{"mesh", 0}});
        json["scenes"][0]["nodes"].push_back(n);
    }
    std::string binary = bytes_of(kCorners);
    for (std::size_t n = 0; n < triangles; ++n) binary += std::string("\0\1\2", 3);
    EXPECT_NE(why(glb(json, binary)).find("more than 20000000 triangles"), std::string::npos);
}

TEST(Gltf, counts_the_primitives_that_its_nodes_show) {
    // 200 kB: a thousand empty primitives, shown by two thousand nodes.
    Json json = one_triangle();
    for (int n = 0; n < 1000; ++n)
        json["meshes"][0]["primitives"].push_back({{"attributes", Json::object()}});
    for (int n = 1; n < 2000; ++n) {
        json["nodes"].push_back({{"mesh", 0}});
        json["scenes"][0]["nodes"].push_back(n);
    }
    EXPECT_NE(why(glb(json, bytes_of(kCorners))).find("more than a million primitives"), std::string::npos);
}

struct Bad {
    const char* name;
    void (*spoil)(Json&);
    const char* cause;
};

TEST(Gltf, refuses_what_it_cannot_trust_and_says_why) {
    const Bad cases[] = {
        {"no such accessor", [](Json& j) { j["meshes"][0]["primitives"][0]["attributes"]["POSITION"] = 7; },
         "does not exist"},
        {"no such view", [](Json& j) { j["accessors"][0]["bufferView"] = 3; }, "no buffer view"},
        {"no such buffer", [](Json& j) { j["bufferViews"][0]["buffer"] = 1; }, "no buffer"},
        {"beyond the view", [](Json& j) { j["accessors"][0]["count"] = 4; }, "beyond its buffer view"},
        {"huge count", [](Json& j) { j["accessors"][0]["count"] = 4'000'000'000'000'000'000; },
         "beyond its buffer view"},
        {"huge offset", [](Json& j) { j["bufferViews"][0]["byteOffset"] = 18'000'000'000'000'000'000ULL; },
         "beyond its buffer"},
        {"view too long", [](Json& j) { j["bufferViews"][0]["byteLength"] = 40; }, "beyond its buffer"},
        {"doubles", [](Json& j) { j["accessors"][0]["componentType"] = 5130; }, "beyond its buffer view"},
        {"quantised", [](Json& j) { j["accessors"][0]["componentType"] = 5122; }, "not floats"},
        {"strips", [](Json& j) { j["meshes"][0]["primitives"][0]["mode"] = 5; }, "plain triangles"},
        {"float indices",
         [](Json& j) {
             j["accessors"].push_back(
                 {{"bufferView", 0}, {"componentType", 5126}, {"count", 3}, {"type", "SCALAR"}});
             j["meshes"][0]["primitives"][0]["indices"] = 1;
         },
         "not unsigned"},
        {"index beyond",
         [](Json& j) {
             j["accessors"].push_back(
                 {{"bufferView", 0}, {"componentType", 5125}, {"count", 6}, {"type", "SCALAR"}});
             j["meshes"][0]["primitives"][0]["indices"] = 1;
         },
         "beyond the positions"},
        {"sparse",
         [](Json& j) {
             j["accessors"][0]["sparse"] = {{"count", 1},
                                            {"indices", {{"bufferView", 0}, {"componentType", 5125}}},
                                            {"values", {{"bufferView", 0}}}};
         },
         "sparse"},
        {"a ring of nodes", [](Json& j) { j["nodes"][0]["children"] = {0}; }, "tree"},
        {"no such mesh", [](Json& j) { j["nodes"][0]["mesh"] = 4; }, "does not exist"},
        {"too large for floats", [](Json& j) { j["nodes"][0]["scale"] = {1e30, 1e30, 1e30}; }, "read"},
        {"beyond floats", [](Json& j) { j["nodes"][0]["scale"] = {1e39, 1e39, 1e39}; },
         "beyond single precision"},
        {"no length", [](Json& j) { j["asset"]["extras"]["unit_mm"] = -1; }, "not a length"},
        {"two binary chunks", [](Json& j) { j["buffers"].push_back({{"byteLength", 36}}); }, "more buffers"},
        {"another file", [](Json& j) { j["buffers"][0]["uri"] = "/etc/hostname"; },
         "another file, /etc/hostname"},
        {"Draco", [](Json& j) { j["extensionsRequired"] = {"KHR_draco_mesh_compression"}; },
         "packed by KHR_draco_mesh_compression"},
        {"meshopt", [](Json& j) { j["extensionsRequired"] = {"KHR_x", "EXT_meshopt_compression"}; },
         "packed by EXT_meshopt_compression"},
        {"old", [](Json& j) { j["asset"]["version"] = "1.0"; }, "glTF 1.0"},
    };
    EXPECT_EQ(why(glb(one_triangle(), bytes_of(kCorners))), "read");
    for (const Bad& bad : cases) {
        Json json = one_triangle();
        bad.spoil(json);
        const std::string said = why(glb(json, bytes_of(kCorners)));
        EXPECT_NE(said.find(bad.cause), std::string::npos) << bad.name << ": " << said;
    }
    EXPECT_NE(why("{nonsense").find("not the JSON"), std::string::npos);
    EXPECT_NE(why("glTF").find("cut off"), std::string::npos);
    EXPECT_NE(why("").find("cut off"), std::string::npos);
    const std::string deep(100'000, '[');
    EXPECT_NE(why("{\"extras\":" + deep).find("too deeply"), std::string::npos);
    const std::string good = written(tetrahedron());
    for (std::size_t length = 0; length < good.size(); length += 7) {
        EXPECT_NE(why(good.substr(0, length)), "read") << length;
    }
}

}  // namespace
}  // namespace tribo::files
