// SPDX-License-Identifier: MIT
// Which files a model may name, and packed models.
#include "files/model/model_file.hpp"

#include <filesystem>
#include <gtest/gtest.h>
#include <zlib.h>

#include "files/gzip.hpp"
#include "scratch.hpp"

namespace tribo::files {
namespace {

const std::string kHeader = "#VRML V2.0 utf8\n";
const std::string kBox = kHeader + "Shape { geometry Box { } }\n";

std::string packed(const std::string& bytes) {
    z_stream z = {};
    EXPECT_EQ(deflateInit2(&z, 9, Z_DEFLATED, 16 + MAX_WBITS, 9, Z_DEFAULT_STRATEGY), Z_OK);
    std::string in = bytes, out(deflateBound(&z, static_cast<uLong>(bytes.size())) + 64, '\0');
    z.next_in = reinterpret_cast<Bytef*>(in.data());
    z.avail_in = static_cast<uInt>(in.size());
    z.next_out = reinterpret_cast<Bytef*>(out.data());
    z.avail_out = static_cast<uInt>(out.size());
    EXPECT_EQ(deflate(&z, Z_FINISH), Z_STREAM_END);
    out.resize(z.total_out);
    deflateEnd(&z);
    return out;
}

TEST(Gzip, UnpacksAllMembersUpToALimit) {
    const std::string text = "some text, some text, some text";
    EXPECT_TRUE(is_gzip(packed(text)));
    EXPECT_FALSE(is_gzip(text));
    EXPECT_EQ(gunzip(packed(text), 31, "f").value(), text);
    EXPECT_EQ(gunzip(packed(text) + packed("!"), 100, "f").value(), text + "!");
    EXPECT_EQ(gunzip(packed(text) + std::string(8, '\0'), 100, "f").value(), text);
    const auto large = gunzip(packed(text), 30, "f");
    ASSERT_FALSE(large.has_value());
    EXPECT_NE(large.error().cause.find("more than"), std::string::npos);
    for (std::size_t n = 2; n < packed(text).size(); ++n) {
        const auto cut = gunzip(packed(text).substr(0, n), 100, "f");
        ASSERT_FALSE(cut.has_value()) << n;
        EXPECT_NE(cut.error().cause.find("cut short"), std::string::npos) << n;
    }
    std::string bad = packed(text);
    bad[bad.size() - 6] = static_cast<char>(bad[bad.size() - 6] ^ 1);
    EXPECT_NE(gunzip(bad, 100, "f").error().cause.find("damaged"), std::string::npos);
}

TEST(Gzip, ABombIsRefusedBeforeItFillsTheMemory) {
    const std::string bomb = packed(std::string(80 * 1024 * 1024, ' '));
    EXPECT_LT(bomb.size(), 100'000U);
    const test::Scratch scratch;
    scratch.put("bomb.wrl", bomb);
    const auto model = read_model_file({scratch / "bomb.wrl", 1});
    ASSERT_FALSE(model.has_value());
    EXPECT_NE(model.error().cause.find("unpacks to more than 64 MB"), std::string::npos);
}

class ModelFolder : public testing::Test {
  protected:
    void SetUp() override {
        std::filesystem::create_directories(scratch_ / "model/parts");
        scratch_.put("outside.wrl", kBox);
        scratch_.put("model/beside.wrl", kBox);
        scratch_.put("model/packed.wrl", packed(kBox));
        scratch_.put("model/parts/below.wrl", kHeader + "Inline { url \"sibling.wrl\" }");
        scratch_.put("model/parts/sibling.wrl", kBox);
        std::filesystem::create_symlink("beside.wrl", scratch_ / "model/link.wrl");
        std::filesystem::create_symlink("../outside.wrl", scratch_ / "model/out.wrl");
        std::filesystem::create_directory_symlink("..", scratch_ / "model/up");
    }
    FileResult<readers::Model> read(const std::string& url) {
        scratch_.put("model/main.wrl", kHeader + "Inline { url \"" + url + "\" }");
        return read_model_file({scratch_ / "model/main.wrl", 1});
    }
    std::string cause(const std::string& url) {
        const auto model = read(url);
        EXPECT_FALSE(model.has_value()) << url;
        return model ? "" : model.error().cause;
    }
    test::Scratch scratch_;
};

TEST_F(ModelFolder, FilesOfTheFolderAndBelowAreRead) {
    for (const char* url : {"beside.wrl", "./beside.wrl", "packed.wrl", "parts/below.wrl", "link.wrl"}) {
        const auto model = read(url);
        ASSERT_TRUE(model.has_value()) << url << model.error().text();
        EXPECT_EQ(model->mesh.triangles.size(), 12U);
    }
}

TEST_F(ModelFolder, NothingElseIs) {
    for (const std::string& url : {scratch_ / "model/beside.wrl", std::string("http://x.org/beside.wrl"),
                                   std::string("file:beside.wrl"), std::string("")}) {
        EXPECT_NE(cause(url).find("not a file in the model's folder"), std::string::npos) << cause(url);
    }
    EXPECT_NE(cause("../outside.wrl").find("'..'"), std::string::npos);
    EXPECT_NE(cause("parts/../beside.wrl").find("'..'"), std::string::npos);
    EXPECT_NE(cause("out.wrl").find("outside of the model's folder"), std::string::npos);
    EXPECT_NE(cause("up/outside.wrl").find("outside of the model's folder"), std::string::npos);
    EXPECT_NE(cause("gone.wrl").find("no such file"), std::string::npos);
    EXPECT_NE(cause("parts").find("not a file"), std::string::npos);
    EXPECT_NE(cause("main.wrl").find("names itself"), std::string::npos);
    EXPECT_NE(cause("./main.wrl").find("names itself"), std::string::npos);
}

TEST_F(ModelFolder, AFileBelowIsNamedByItsWayFromTheModel) {
    scratch_.put("model/parts/sibling.wrl", kHeader + "\nGroup { children 1 }");
    const auto model = read("parts/below.wrl");
    ASSERT_FALSE(model.has_value());
    EXPECT_EQ(model.error().file, scratch_ / "model/parts/sibling.wrl");
    EXPECT_EQ(model.error().line, 3);
}

}  // namespace
}  // namespace tribo::files
