// SPDX-License-Identifier: MIT
// What write_glb writes, read_gltf reads back; what it must not read, it refuses.
#include "io/gltf.hpp"

#include <filesystem>
#include <gtest/gtest.h>
#include <unistd.h>

#include "io/files.hpp"

namespace tribo::io {
namespace {

TriangleMesh tetrahedron() {
    TriangleMesh mesh;
    mesh.positions = {{0, 0, 0}, {10, 0, 0}, {0, 20, 0}, {0, 0, 30}};
    mesh.triangles = {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}};
    return mesh;
}

std::string written(const TriangleMesh& mesh) {
    const auto path =
        std::filesystem::temp_directory_path() / ("tribo_gltf_test_" + std::to_string(::getpid()) + ".glb");
    EXPECT_TRUE(write_glb(path.string(), mesh).has_value());
    const auto bytes = read_file(path.string());
    std::filesystem::remove(path);
    return bytes.value();
}

TEST(Gltf, comes_back_as_it_was_written) {
    const std::string bytes = written(tetrahedron());
    EXPECT_TRUE(bytes.starts_with("glTF"));
    // The file is in metres: 1000 mm to the unit.
    const auto model = read_gltf(bytes, {"part.glb", 1000});
    ASSERT_TRUE(model.has_value()) << model.error().text();
    ASSERT_EQ(model->mesh.triangles.size(), 4u);
    EXPECT_TRUE(is_closed(model->mesh));
    EXPECT_NEAR(volume_mm3(model->mesh), 1000, 1e-2);
    const Box3 box = bounds(model->mesh);
    EXPECT_NEAR(box.max.z, 30, 1e-4);
    EXPECT_NEAR(box.max.y, 20, 1e-4);
}

TEST(Gltf, of_an_empty_mesh_is_a_valid_file_without_triangles) {
    const auto model = read_gltf(written({}), {"none.glb", 1});
    ASSERT_FALSE(model.has_value());
    EXPECT_NE(model.error().cause.find("no triangles"), std::string::npos);
}

TEST(Gltf, refuses_what_it_cannot_trust) {
    const std::string good = written(tetrahedron());
    for (const std::size_t length : {std::size_t{5}, std::size_t{20}, good.size() / 2, good.size() - 1}) {
        EXPECT_FALSE(read_gltf(std::string_view(good).substr(0, length), {"cut.glb", 1}).has_value())
            << length;
    }
    EXPECT_FALSE(read_gltf("{\"asset\":{\"version\":\"2.0\"}}", {"empty.gltf", 1}).has_value());
    EXPECT_FALSE(read_gltf("{nonsense", {"bad.gltf", 1}).has_value());
    const auto other =
        read_gltf(R"({"asset":{"version":"2.0"},"buffers":[{"byteLength":12,"uri":"/etc/hostname"}]})",
                  {"link.gltf", 1});
    ASSERT_FALSE(other.has_value());
}

}  // namespace
}  // namespace tribo::io
