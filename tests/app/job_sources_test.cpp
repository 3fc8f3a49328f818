// SPDX-License-Identifier: MIT
// Every example, loaded from the disk as the program does and from memory as the page does: the same job, the
// same run, the same words.
#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <sstream>

#include "files/disk_source.hpp"
#include "job/memory_source.hpp"
#include "places.hpp"
#include "session/cut/job_stock.hpp"
#include "session/cut/mill_setup.hpp"

namespace tribo::test {
namespace {

namespace fs = std::filesystem;

struct Prepared {
    job::LoadedJob loaded;
    session::MillSetup setup;
    std::vector<std::string> warnings;
};

Prepared prepared(const job::FileSource& files, const std::string& name) {
    Prepared p;
    auto loaded = job::load_job(files, name);
    EXPECT_TRUE(loaded) << loaded.error().text();
    if (!loaded) return p;
    p.loaded = *std::move(loaded);
    Warnings warnings = p.loaded.warnings;
    auto setup = session::prepare_mill(p.loaded, {}, warnings);
    EXPECT_TRUE(setup) << setup.error().text();
    if (setup) p.setup = *std::move(setup);
    for (const Warning& w : warnings) p.warnings.push_back(w.message());
    return p;
}

job::MemorySource all_files_of(const fs::path& folder) {
    job::MemorySource files;
    for (const fs::directory_entry& entry : fs::directory_iterator(folder)) {
        std::ostringstream text;
        text << std::ifstream(entry.path(), std::ios::binary).rdbuf();
        files.put(entry.path().string(), text.str());
    }
    return files;
}

void expect_same(const Prepared& a, const Prepared& b) {
    EXPECT_EQ(a.warnings, b.warnings);
    ASSERT_EQ(a.loaded.program.moves.size(), b.loaded.program.moves.size());
    for (std::size_t n = 0; n < a.loaded.program.moves.size(); ++n) {
        const motion::Move &one = a.loaded.program.moves[n], &other = b.loaded.program.moves[n];
        EXPECT_EQ(one.end, other.end);
        EXPECT_EQ(one.line, other.line);
        EXPECT_EQ(one.feed_mm_per_min, other.feed_mm_per_min);
    }
    EXPECT_EQ(a.loaded.earlier.size(), b.loaded.earlier.size());
    EXPECT_EQ(a.loaded.fixtures.size(), b.loaded.fixtures.size());
    EXPECT_EQ(a.loaded.part.has_value(), b.loaded.part.has_value());
    if (a.loaded.part && b.loaded.part) {
        EXPECT_EQ(a.loaded.part->mesh.positions, b.loaded.part->mesh.positions);
        EXPECT_EQ(a.loaded.part->mesh.triangles, b.loaded.part->mesh.triangles);
    }
    // Hashes of the stock with all earlier cuts, of the cutters and of the moves.
    const job::StockRecord one = session::stock_record(a.setup), other = session::stock_record(b.setup);
    EXPECT_EQ(one.stock, other.stock);
    EXPECT_EQ(one.cutters, other.cutters);
    EXPECT_EQ(one.moves, other.moves);
    EXPECT_EQ(a.setup.cutter_of_move, b.setup.cutter_of_move);
    EXPECT_EQ(a.setup.rpm_of_move, b.setup.rpm_of_move);
    EXPECT_EQ(a.setup.cell_mm, b.setup.cell_mm);
    EXPECT_EQ(a.setup.schedule->duration_s, b.setup.schedule->duration_s);
}

TEST(JobSources, give_every_example_alike) {
    int jobs = 0, chains = 0, parts = 0;
    for (const fs::directory_entry& folder : fs::directory_iterator(TRIBO_SOURCE_DIR "/examples")) {
        if (!folder.is_directory()) continue;
        const job::MemorySource memory = all_files_of(folder.path());
        for (const fs::directory_entry& file : fs::directory_iterator(folder.path())) {
            // A sweep names a job of another folder.
            if (file.path().extension() != ".toml" || file.path().filename() == "sweep.toml") continue;
            SCOPED_TRACE(file.path().string());
            const Prepared disk = prepared(files::DiskSource(), file.path().string());
            expect_same(disk, prepared(memory, file.path().string()));
            ++jobs;
            chains += disk.loaded.earlier.empty() ? 0 : 1;
            parts += disk.loaded.part ? 1 : 0;
        }
    }
    EXPECT_GE(jobs, 8);
    EXPECT_GE(chains, 1);
    EXPECT_GE(parts, 2);
}

}  // namespace
}  // namespace tribo::test
