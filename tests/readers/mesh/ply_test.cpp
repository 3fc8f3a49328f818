// SPDX-License-Identifier: MIT
// PLY: the three encodings give the same model, any types and extra properties pass, lies are told.
#include "readers/mesh/ply.hpp"

#include "readers/mesh/model_samples.hpp"

namespace tribo::readers {
namespace {

using namespace test;

// The tetrahedron with properties before, between and after those that matter, and an element in between.
std::string header(const char* format) {
    return std::string("ply\nformat ") + format +
           " 1.0\ncomment by hand\nobj_info none\nelement vertex 4\nproperty uchar red\nproperty double x\n"
           "property float y\nproperty list uchar short near\nproperty short z\nelement edge 1\nproperty int "
           "a\n"
           "property int b\nelement face 4\nproperty float quality\nproperty list uchar int vertex_indices\n"
           "property list int float weights\nend_header\n";
}

template <class Put>
std::string binary(const char* format, Put put_value) {
    std::string bytes = header(format);
    const TriangleMesh mesh = tetrahedron();
    for (const Point3f& p : mesh.positions) {
        put_value(bytes, std::uint8_t{200});
        put_value(bytes, static_cast<double>(p[0]));
        put_value(bytes, p[1]);
        put_value(bytes, std::uint8_t{2});
        put_value(bytes, std::int16_t{-1});
        put_value(bytes, std::int16_t{7});
        put_value(bytes, static_cast<std::int16_t>(p[2]));
    }
    put_value(bytes, std::int32_t{0});
    put_value(bytes, std::int32_t{1});
    for (const Triangle& t : mesh.triangles) {
        put_value(bytes, 0.5F);
        put_value(bytes, std::uint8_t{3});
        for (const std::uint32_t corner : t) put_value(bytes, static_cast<std::int32_t>(corner));
        put_value(bytes, std::int32_t{1});
        put_value(bytes, 9.0F);
    }
    return bytes;
}

std::string little() {
    return binary("binary_little_endian", [](std::string& b, auto v) { put(b, v); });
}
std::string big() {
    return binary("binary_big_endian", [](std::string& b, auto v) { put_big_endian(b, v); });
}
std::string text() {
    return header("ascii") +
           "1 0 0 0 0\n1 1 0 1 5 0\n1 0 1. 2 5 6 0\n1 0 0 0 1\n0 1\n.5 3 0 2 1 0\n.5 3 0 1 3 1 9\n"
           ".5 3 0 3 2 0\n.5 3 1 2 3 0\n";
}

TEST(Ply, all_three_encodings_give_the_same_closed_mesh) {
    for (const std::string& bytes : {text(), little(), big()}) {
        const auto model = read_model(bytes);
        ASSERT_TRUE(is_read(model));
        EXPECT_EQ(model->format, ModelFormat::ply);
        EXPECT_TRUE(is_closed(model->mesh));
        EXPECT_DOUBLE_EQ(volume_mm3(model->mesh), 1.0 / 6);
        EXPECT_EQ(bounds(model->mesh).max, (Vec3{1, 1, 1}));
        EXPECT_TRUE(model->warnings.empty());
    }
}

TEST(Ply, crlf_and_the_older_name_of_the_list_are_read) {
    const auto model = read_model(
        "ply\r\nformat ascii 1.0\r\nelement vertex 4\r\nproperty float32 x\r\nproperty float32 y\r\n"
        "property float32 z\r\nelement face 1\r\nproperty list uint8 int32 vertex_index\r\nend_header\r\n"
        "0 0 0\r\n2 0 0\r\n2 2 0\r\n0 2 0\r\n4 0 1 2 3\r\n");
    ASSERT_TRUE(is_read(model));
    EXPECT_EQ(model->mesh.triangles.size(), 2U);
    EXPECT_DOUBLE_EQ(area_mm2(model->mesh), 4);
}

TEST(Ply, refuses_lies_and_strangers_and_says_where) {
    const auto plain = [](const char* vertices, const char* faces, const char* body) {
        return std::string("ply\nformat ascii 1.0\nelement vertex ") + vertices +
               "\nproperty float x\nproperty float y\nproperty float z\nelement face " + faces +
               "\nproperty list uchar int vertex_indices\nend_header\n" + body;
    };
    std::string long_list = header("binary_little_endian");
    long_list.resize(long_list.size() + 13, '\0');
    long_list += '\xFF';  // 255 shorts follow, it says
    const BadInput table[] = {
        {"not PLY", "plywood\n", 1, "starts with the line 'ply'"},
        {"only a header's start", "ply\nformat ascii 1.0\nelement vertex 3\n", 3,
         "ends inside its PLY header"},
        {"no format", "ply\nelement vertex 1\nproperty float x\nend_header\n0\n", 4, "no format line"},
        {"unknown format", "ply\nformat middle_endian 1.0\nend_header\n", 2, "'middle_endian' is not known"},
        {"unknown version", "ply\nformat ascii 2.0\nend_header\n", 2, "'2.0' is not known"},
        {"unknown word", "ply\nformat ascii 1.0\nelephant 3\nend_header\n", 3,
         "'elephant' is not a PLY header word"},
        {"unknown type", "ply\nformat ascii 1.0\nelement vertex 1\nproperty quad x\nend_header\n", 4,
         "'quad'"},
        {"property of nothing", "ply\nformat ascii 1.0\nproperty float x\nend_header\n", 3,
         "before the first element"},
        {"negative count", plain("-3", "1", "0 0 0"), 3, "expected a number of elements, found '-3'"},
        {"lying count", plain("4000000000", "1", "0 0 0\n"), 3,
         "says 4000000000 of 'vertex', but the file has"},
        {"lying count, binary", little().substr(0, header("binary_little_endian").size() + 20), 5,
         "says 4 of 'vertex', but the file has bytes for 1"},
        {"lying list", long_list, 5, "says 4 of 'vertex', but the file has bytes for 0"},
        {"cut short", plain("3", "1", "0 0 0\n1 0 0\n0 1 0\n3 0     "), 13, "face 0: the file ends here"},
        {"index out of range", plain("3", "1", "0 0 0\n1 0 0\n0 1 0\n3 0 1 3\n"), 13,
         "not one of the 3 vertices"},
        {"negative index", plain("3", "1", "0 0 0\n1 0 0\n0 1 0\n3 0 1 -1\n"), 13,
         "not one of the 3 vertices"},
        {"broken index", plain("3", "1", "0 0 0\n1 0 0\n0 1 0\n3 0 1 1.5\n"), 13,
         "expected a number, found '1.5'"},
        {"two corners", plain("3", "1", "0 0 0\n1 0 0\n0 1 0\n2 0 1\n"), 13, "three corners"},
        {"negative length", plain("3", "1", "0 0 0\n1 0 0\n0 1 0\n-3 0 1 2\n"), 13, "length does not fit"},
        {"long list", plain("3", "1", "0 0 0\n1 0 0\n0 1 0\n9999 0 1 2\n"), 13, "length does not fit"},
        {"no number", plain("3", "1", "0 0 0\n1 zero 0\n0 1 0\n3 0 1 2\n"), 11,
         "expected a number, found 'zero'"},
        {"infinite", plain("3", "1", "0 0 0\n1 1e60 0\n0 1 0\n3 0 1 2\n"), 11,
         "vertex 1: the position is not finite"},
        {"no z",
         "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\nend_header\n0 0\n", 3,
         "x, y and z"},
        {"a cloud",
         "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\nproperty float "
         "z\nend_header\n0 0 0\n",
         0, "point cloud"},
        {"strips",
         "ply\nformat ascii 1.0\nelement vertex 0\nproperty float x\nproperty float y\nproperty float z\n"
         "element tristrips 1\nproperty list int int vertex_indices\nend_header\n3 0 1 2\n",
         7, "triangle strips are not read"},
        {"faces first",
         "ply\nformat ascii 1.0\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n3 0 1 "
         "2\n",
         3, "faces before the vertices"},
        {"faces without corners",
         "ply\nformat ascii 1.0\nelement vertex 0\nproperty float x\nproperty float y\n"
         "property float z\nelement face 1\nproperty int material\nend_header\n1\n",
         7, "vertex_indices"},
    };
    for (const BadInput& bad : table) expect_refused(bad, ModelFormat::ply);
}

}  // namespace
}  // namespace tribo::readers
