// SPDX-License-Identifier: MIT
// Jobs with all their files, out of memory: what is read, in which order, and what is refused.
#include "job/loader.hpp"

#include <gtest/gtest.h>

#include "job/memory_source.hpp"
#include "motion/path/program.hpp"

namespace tribo::job {
namespace {

constexpr const char* kBox = "[stock]\nbox_mm = [[0, 0, -10], [40, 30, 0]]\n";
constexpr const char* kRest =
    "[cutter]\nkind = \"flat\"\ndiameter_mm = 6\nflutes = 2\nlength_mm = 20\n"
    "[material]\nname = \"al7075-t6\"\n[process]\nspindle_rpm = 6000\n"
    "[path]\ngcode = \"slot.nc\"\n";
constexpr const char* kSlot = "G21 G90 M3 F600\nG0 X-10 Y5 Z-2\nG1 X50\nM30\n";

// `from` stands at 3:8.
std::string after(const std::string& what) {
    return "# set-up\n[stock]\nfrom = \"" + what + "\"\n" + kRest;
}

// A folder of renders besides, and a second name for each file.
class Shelf final : public FileSource {
  public:
    Shelf() { memory.put("slot.nc", kSlot); }

    FileResult<std::string> read(const std::string& path, std::uint64_t limit_bytes) const override {
        return memory.read(path, limit_bytes);
    }
    FileResult<readers::Model> read_model(const readers::ModelFile& file) const override {
        return memory.read_model(file);
    }
    FileResult<StockSource> stock_source(const std::string& path) const override {
        if (path == "out") return StockSource{"a.toml", StockRecord{}, "/renders/out"};
        if (path == "broken")
            return std::unexpected(FileFailure({"", 0, 0, "is broken", "mend it"}, FileFault::system));
        return memory.stock_source(path);
    }
    std::string identity(const std::string& path) const override {
        return path.starts_with("./") ? path.substr(2) : path;
    }
    std::string refusal_of(const std::string& name) const {
        const auto loaded = load_job(*this, name);
        return loaded ? "" : loaded.error().text();
    }

    MemorySource memory;
};

TEST(Loader, reads_a_job_with_all_that_it_names) {
    Shelf shelf;
    shelf.memory.put("tetra.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n");
    shelf.memory.put("part.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    shelf.memory.put("a.toml", std::string(kBox) + kRest +
                                   "[[fixture]]\nbox_mm = [[50, 0, 0], [60, 10, 10]]\n"
                                   "[[fixture]]\nmesh = \"tetra.obj\"\nunit_mm = 3\n"
                                   "[part]\nsurface = \"part.obj\"\n");
    const auto loaded = load_job(shelf, "a.toml");
    ASSERT_TRUE(loaded) << loaded.error().text();
    EXPECT_EQ(loaded->job.file, "a.toml");
    EXPECT_EQ(loaded->program.source, "slot.nc");
    EXPECT_EQ(loaded->blank.volume_mm3, 40 * 30 * 10);
    EXPECT_TRUE(loaded->earlier.empty());
    ASSERT_EQ(loaded->fixtures.size(), 2u);
    EXPECT_EQ(loaded->fixtures[0].box_mm.max.x, 60);
    EXPECT_NEAR(loaded->fixtures[1].volume_mm3, 27.0 / 6, 1e-6);
    // Each run of the same load takes shapes of its own.
    const auto one = shape_of(loaded->fixtures[1]), other_run = shape_of(loaded->fixtures[1]);
    EXPECT_NE(one.get(), other_run.get());
    EXPECT_EQ(one->distance_mm({5, 1, 1}), other_run->distance_mm({5, 1, 1}));
    ASSERT_TRUE(loaded->part);
    EXPECT_EQ(loaded->part->mesh.triangles.size(), 1u);
    // A surface that is named besides stands in for the job's.
    const auto other = load_job(shelf, "a.toml", {"tetra.obj"});
    ASSERT_TRUE(other) << other.error().text();
    EXPECT_EQ(other->part->mesh.triangles.size(), 4u);
}

TEST(Loader, tells_jobs_and_programs_apart_by_name_and_content) {
    Shelf shelf;
    const std::string job = std::string(kBox) + kRest;
    shelf.memory.put("job", job);
    shelf.memory.put("slot.dat", kSlot);
    shelf.memory.put("keys", "x,y,z,i,j,k\n0,0,-1,0,0,1\n9,0,-1,0,0,1\n");
    shelf.memory.put("tool.path", "PARTNO/A\nUNITS/MM\nFEDRAT/100,MMPM\nGOTO/0,0,-1\nGOTO/9,0,-1\n");
    shelf.memory.put("O0001", "0 BEGIN PGM A MM\n1 L X+0 Y+0 Z-1 R0 FMAX\n2 L X+9 F100 M3\n3 END PGM A MM\n");
    const std::pair<const char*, bool> cases[] = {{"job", false}, {"slot.nc", true}, {"slot.dat", true},
                                                  {"keys", true}, {"O0001", true},   {"tool.path", true}};
    for (const auto& [name, is_program] : cases) {
        const auto loaded = load_job(shelf, name);
        ASSERT_TRUE(loaded) << loaded.error().text();
        EXPECT_EQ(loaded->is_program, is_program) << name;
        EXPECT_EQ(loaded->assumptions.empty(), !is_program) << name;
        EXPECT_GT(loaded->blank.volume_mm3, 0) << name;
        EXPECT_EQ(loaded->job.cutters.size(), 1u) << name;
    }
}

TEST(Loader, refuses_other_files_with_what_they_look_like) {
    using namespace std::string_literals;
    Shelf shelf;
    const std::pair<std::string, const char*> cases[] = {
        {"buy milk\n", "looks like a text without blocks of a program"},
        {" \n", "is empty"},
        {"solid a\nfacet normal 0 0 1\nouter loop\n", "looks like a model (STL)"},
        {"\x89PNG\r\n\x1a\n", "looks like a picture"},
        {"RIFF....WAVEfmt ", "looks like a recording"},
        {"PK\x03\x04....", "is packed (zip)"},
        {"{\"schema\": \"tribo.material/1\"}", "looks like JSON"},
        {"<html>", "looks like XML or HTML"},
        {"a\0b"s, "is no text"},
    };
    for (const auto& [bytes, likeness] : cases) {
        shelf.memory.put("file", bytes);
        EXPECT_EQ(shelf.refusal_of("file"),
                  "file: error: is neither a job nor a program: it "s + likeness +
                      "; give a job (.toml), or a program: G-code, Heidenhain, Siemens, APT or keyframes "
                      "(x,y,z,i,j,k)");
    }
}

TEST(Loader, reads_earlier_jobs_back_to_the_first) {
    Shelf shelf;
    shelf.memory.put("a.toml", std::string(kBox) + kRest);
    shelf.memory.put("b.toml", after("out"));
    shelf.memory.put("c.toml", after("b.toml"));
    const auto loaded = load_job(shelf, "c.toml");
    ASSERT_TRUE(loaded) << loaded.error().text();
    ASSERT_EQ(loaded->earlier.size(), 2u);
    EXPECT_EQ(loaded->earlier[0].job.file, "b.toml");
    EXPECT_FALSE(loaded->earlier[0].source.record);
    EXPECT_EQ(loaded->earlier[1].job.file, "a.toml");
    EXPECT_EQ(loaded->earlier[1].source.folder, "/renders/out");
    EXPECT_TRUE(loaded->earlier[1].source.record);
    EXPECT_EQ(loaded->earlier[1].program.moves.size(), loaded->program.moves.size());
    EXPECT_EQ(loaded->blank.volume_mm3, 40 * 30 * 10);
}

TEST(Loader, refuses_jobs_that_begin_with_each_others_stock) {
    Shelf shelf;
    shelf.memory.put("self.toml", after("./self.toml"));
    EXPECT_EQ(
        shelf.refusal_of("self.toml"),
        "self.toml:3:8: error: the job begins with the stock that it leaves itself: self.toml -> self.toml; "
        "let the first of the jobs begin with box_mm or mesh");
    shelf.memory.put("x.toml", after("a.toml"));
    shelf.memory.put("a.toml", after("b.toml"));
    shelf.memory.put("b.toml", after("c.toml"));
    shelf.memory.put("c.toml", after("out"));
    EXPECT_EQ(shelf.refusal_of("x.toml"),
              "c.toml:3:8: error: the job begins with the stock that it leaves itself: "
              "a.toml -> b.toml -> c.toml -> a.toml; let the first of the jobs begin with box_mm or mesh");
}

TEST(Loader, refuses_at_the_place_that_names_what_is_not_there) {
    Shelf shelf;
    shelf.memory.put("b.toml", after("broken"));
    EXPECT_EQ(shelf.refusal_of("b.toml"), "b.toml:3:8: error: is broken; mend it");
    EXPECT_EQ(load_job(shelf, "b.toml").error().fault, FileFault::system);
    const std::string drop =
        ": error: the file is not here; drop it into the window together with the file "
        "that names it";
    shelf.memory.put("b.toml", after("gone.toml"));
    EXPECT_EQ(shelf.refusal_of("b.toml"), "gone.toml" + drop);
    EXPECT_EQ(shelf.refusal_of("nobody.toml"), "nobody.toml" + drop);
    const std::string job = kRest;
    shelf.memory.put("a.toml", kBox + job + "[[fixture]]\nmesh = \"clamp.stl\"\n");
    EXPECT_EQ(shelf.refusal_of("a.toml"), "clamp.stl" + drop);
    shelf.memory.put("a.toml", kBox + job + "[part]\nsurface = \"bowl.wrl\"\n");
    EXPECT_EQ(shelf.refusal_of("a.toml"), "bowl.wrl" + drop);
    shelf.memory.put("a.toml", "[stock]\nmesh = \"blank.stl\"\n" + job);
    EXPECT_EQ(shelf.refusal_of("a.toml"), "blank.stl" + drop);
    shelf.memory.clear();
    shelf.memory.put("a.toml", kBox + job);
    EXPECT_EQ(shelf.refusal_of("a.toml"), "slot.nc" + drop);
}

TEST(Loader, reads_a_hundred_earlier_jobs_and_no_more) {
    Shelf shelf;
    shelf.memory.put("0.toml", std::string(kBox) + kRest);
    for (int n = 1; n <= 101; ++n)
        shelf.memory.put(std::to_string(n) + ".toml", after(std::to_string(n - 1) + ".toml"));
    const auto loaded = load_job(shelf, "100.toml");
    ASSERT_TRUE(loaded) << loaded.error().text();
    EXPECT_EQ(loaded->earlier.size(), 100u);
    EXPECT_EQ(shelf.refusal_of("101.toml").substr(0, 44), "1.toml:3:8: error: more than 100 jobs begin ");
}

constexpr const char* kTetrahedron =
    "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n";

// Counts the models that are read.
class CountingShelf final : public FileSource {
  public:
    FileResult<std::string> read(const std::string& path, std::uint64_t limit_bytes) const override {
        return shelf.read(path, limit_bytes);
    }
    FileResult<readers::Model> read_model(const readers::ModelFile& file) const override {
        ++models;
        return shelf.read_model(file);
    }
    FileResult<StockSource> stock_source(const std::string& path) const override {
        return shelf.stock_source(path);
    }
    std::string identity(const std::string& path) const override { return shelf.identity(path); }

    Shelf shelf;
    mutable int models = 0;
};

TEST(Loader, reads_a_model_once_for_all_fixtures_that_name_it) {
    CountingShelf files;
    files.shelf.memory.put("tetra.obj", kTetrahedron);
    std::string text = std::string(kBox) + kRest;
    for (int n = 0; n < 500; ++n)
        text += std::string("[[fixture]]\nmesh = \"") + (n % 2 != 0 ? "./" : "") + "tetra.obj\"\n";
    files.shelf.memory.put("a.toml", text + "[[fixture]]\nmesh = \"tetra.obj\"\nunit_mm = 2\n");
    files.shelf.memory.put("./tetra.obj", kTetrahedron);
    const auto loaded = load_job(files, "a.toml");
    ASSERT_TRUE(loaded) << loaded.error().text();
    ASSERT_EQ(loaded->fixtures.size(), 501u);
    EXPECT_EQ(files.models, 2);
    EXPECT_EQ(&loaded->fixtures[0].mesh->mesh(), &loaded->fixtures[499].mesh->mesh());
    EXPECT_NEAR(loaded->fixtures[500].volume_mm3, 8.0 / 6, 1e-6);
    // 170 bytes a triangle, of two meshes.
    EXPECT_EQ(loaded->solid_bytes, 8u * 170);
}

TEST(Loader, keeps_to_the_memory_that_it_may_take) {
    Shelf shelf;
    shelf.memory.put("tetra.obj", kTetrahedron);
    std::string moves = kSlot;
    moves.resize(moves.size() - 4);  // without M30
    for (int n = 0; n < 2000; ++n) moves += n % 2 != 0 ? "X0\n" : "X1\n";
    shelf.memory.put("long.nc", moves);
    std::string loop = kSlot;
    loop.resize(loop.size() - 4);
    shelf.memory.put("loop.nc", loop + "o1 while [1]\nX1\nX2\no1 endwhile\n");
    std::string keyframes = "x,y,z,i,j,k\n";
    for (int n = 0; n < 2000; ++n) keyframes += std::to_string(n) + ",0,0,0,0,1\n";
    shelf.memory.put("keys.csv", keyframes);
    const auto fault = [&](const std::string& text, std::uint64_t bytes, const std::string& name = "a.toml") {
        shelf.memory.put("a.toml", text);
        LoadOptions options;
        options.memory_bytes = bytes;
        const auto loaded = load_job(shelf, name, options);
        return loaded ? "" : loaded.error().text();
    };
    const std::string rest = kRest;
    const auto path = [&](const std::string& line) {
        return rest.substr(0, rest.find("gcode =")) + line + "\n";
    };
    const std::uint64_t thousand_moves = 1000 * 3 * sizeof(motion::Move);
    for (const char* file : {"long.nc", "loop.nc"}) {
        const std::string message =
            fault(kBox + path(std::string("gcode = \"") + file + "\""), thousand_moves);
        EXPECT_TRUE(message.starts_with(std::string(file) + ":")) << message;
        EXPECT_NE(message.find("the program has more than 1000 moves; split it, or allow more memory"),
                  std::string::npos)
            << message;
    }
    EXPECT_EQ(fault(kBox + path("gcode = \"long.nc\""), 3 * thousand_moves), "");
    EXPECT_NE(fault(kBox + path("keyframes = \"keys.csv\"\ninterpolation = \"linear\""), thousand_moves)
                  .find("keys.csv:1003:1: error: more than 1001 keyframes"),
              std::string::npos);
    EXPECT_NE(fault("", thousand_moves, "long.nc").find("more than 1000 moves"), std::string::npos);
    // Fixtures, stock and part together.
    const std::string solids = std::string("[stock]\nmesh = \"tetra.obj\"\n") + kRest +
                               "[part]\nsurface = \"tetra.obj\"\n[[fixture]]\nmesh = \"tetra.obj\"\n";
    EXPECT_EQ(fault(solids, 3 * sizeof(motion::Move) + 12 * 170), "");
    EXPECT_EQ(fault(solids, 3 * sizeof(motion::Move) + 12 * 170 - 1),
              "tetra.obj:8:8: error: more than 3 triangles; simplify the model, or allow more memory");
}

TEST(Loader, takes_as_many_different_tools_as_a_magazine_holds) {
    Shelf shelf;
    std::string text = "G21 G90 M3 F600\nG0 X-10 Y5 Z-2\n";
    for (int n = 1; n <= 1001; ++n)
        text += "T" + std::to_string(n) + " M6\nG1 X" + std::to_string(n % 2) + "\n";
    shelf.memory.put("tools.nc", text + "M30\n");
    const auto loaded = load_job(shelf, "tools.nc");
    ASSERT_FALSE(loaded);
    EXPECT_EQ(loaded.error().text(),
              "tools.nc:2004: error: the program calls more than 1000 different tools; split it, or number "
              "tools of one kind alike");
}

// The clock is the caller's.
TEST(Loader, ends_loops_of_programs_by_the_clock) {
    Shelf shelf;
    shelf.memory.put("loop.nc", "G21 G90 M3 F600\nG0 X-10 Y5 Z-2\nG1\no1 while [1]\nX1\nX2\no1 endwhile\n");
    LoadOptions options;
    double now_s = 0;
    options.clock_s = [&] { return now_s += 1; };
    const auto loaded = load_job(shelf, "loop.nc", options);
    ASSERT_FALSE(loaded);
    EXPECT_NE(loaded.error().cause.find("have run for 3 s"), std::string::npos) << loaded.error().text();
}

}  // namespace
}  // namespace tribo::job
