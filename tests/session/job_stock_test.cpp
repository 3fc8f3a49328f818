// SPDX-License-Identifier: MIT
// Jobs that begin with the stock of others, without any file: which jobs are read, what they leave, and what
// is refused.
#include "session/cut/job_stock.hpp"

#include <cmath>
#include <gtest/gtest.h>
#include <map>

#include "session/cut/mill_setup.hpp"

namespace tribo::session {
namespace {

constexpr Box3 kBlank{{0, 0, -10}, {40, 30, 0}};

// Jobs and folders by name; each job cuts one slot along x.
struct Shelf {
    std::map<std::string, job::Job> jobs;
    std::map<std::string, motion::Program> programs;  // by job file
    std::map<std::string, job::StockSource> folders;

    job::LoadedJob loaded(const std::string& file) {
        job::LoadedJob loaded;
        loaded.job = jobs[file];
        loaded.program = programs[file];
        const job::Job* job = &loaded.job;
        while (job->stock_from) {
            const auto folder = folders.find(job->stock_from->path);
            const job::StockSource source =
                folder != folders.end() ? folder->second : job::StockSource{job->stock_from->path, {}, {}};
            loaded.earlier.push_back({jobs[source.job], programs[source.job], source});
            job = &loaded.earlier.back().job;
        }
        loaded.blank = job::box_solid(job->stock.box_mm);
        return loaded;
    }

    job::Job& put(const std::string& file, double y, double z, double diameter = 6) {
        job::Job& job = jobs[file];
        job = {};
        job.file = file;
        job.cutters.resize(1);
        job.cutters[0].diameter_mm = diameter;
        job.material.name = "al7075-t6";
        job.process.spindle_rpm = 6000;
        job.stock.box_mm = kBlank;
        motion::Move slot;
        slot.start.tip_mm = {-10, y, z};
        slot.end.tip_mm = {50, y, z};
        slot.feed_mm_per_min = 600;  // 10 mm/s: six seconds
        slot.line = 1;
        programs[file].source = file + ".nc";
        programs[file].moves = {slot};
        return job;
    }
    job::Job& put_after(const std::string& file, const std::string& from, double y, double z,
                        double diameter = 6) {
        job::Job& job = put(file, y, z, diameter);
        job.stock = {};
        job.stock_from = job::JobStockFrom{from, 3, 8};
        return job;
    }
    Result<JobStock> stock_of(const std::string& file) {
        Warnings warnings;
        return session::stock_of(loaded(file), warnings);
    }
    Result<MillSetup> setup_of(const std::string& file, std::optional<double> until_s = {}) {
        Warnings warnings;
        return prepare_mill(loaded(file), {0.25, until_s}, warnings);
    }
    MillTotals totals_of(const std::string& file) {
        auto setup = setup_of(file);
        EXPECT_TRUE(setup) << setup.error().text();
        if (!setup) return {};
        MillSession session(*std::move(setup), serial_for);
        session.run({});
        return session.totals();
    }
    std::string refusal_of(const std::string& file) {
        const auto stock = stock_of(file);
        return stock ? "" : stock.error().text();
    }
};

// Slots of a flat cutter, 40 mm long.
double slot_mm3(double width, double depth) {
    return width * depth * 40;
}

TEST(JobStock, is_what_every_job_before_left) {
    Shelf shelf;
    shelf.put("a.toml", 5, -2);
    shelf.put_after("b.toml", "a.toml", 15, -3, 4);
    shelf.put_after("c.toml", "b.toml", 25, -1, 8);
    const MillTotals b = shelf.totals_of("b.toml"), c = shelf.totals_of("c.toml");
    EXPECT_NEAR(b.removed_mm3, slot_mm3(4, 3), 0.5);
    EXPECT_NEAR(b.remaining_mm3, kBlank.volume() - slot_mm3(6, 2) - slot_mm3(4, 3), 1);
    EXPECT_NEAR(c.removed_mm3, slot_mm3(8, 1), 0.5);
    EXPECT_NEAR(c.remaining_mm3, kBlank.volume() - slot_mm3(6, 2) - slot_mm3(4, 3) - slot_mm3(8, 1), 1);
    // The same slot again finds nothing.
    shelf.put_after("again.toml", "a.toml", 5, -2);
    EXPECT_EQ(shelf.totals_of("again.toml").removed_mm3, 0);
}

TEST(JobStock, is_turned_by_the_frame_of_each_job_in_between) {
    Shelf shelf;
    shelf.put("a.toml", 5, -2);
    // Turned over about x: the first job's bottom is the new top, its y runs backwards.
    motion::WorkFrame over{{0, 30, -10}, {1, 0, 0}, {0, -1, 0}, {0, 0, -1}};
    shelf.put_after("b.toml", "a.toml", 15, -3).setup = over;
    shelf.put_after("c.toml", "b.toml", 5, -2).setup = over;
    EXPECT_NEAR(shelf.totals_of("b.toml").removed_mm3, slot_mm3(6, 3), 0.5);
    // Twice over is as before: the first slot again.
    EXPECT_EQ(shelf.totals_of("c.toml").removed_mm3, 0);
    const auto b = shelf.stock_of("b.toml");
    ASSERT_TRUE(b);
    EXPECT_EQ(b->blank->bounds_mm().min, kBlank.min);
    EXPECT_EQ(b->blank->bounds_mm().max, kBlank.max);
    EXPECT_EQ(b->earlier[0].moves[0].start.tip_mm, (Vec3{-10, 25, -8}));
    EXPECT_EQ(b->earlier[0].moves[0].start.axis, (Vec3{0, 0, -1}));
}

TEST(JobStock, may_be_turned_by_any_angle_of_a_box_or_a_mesh) {
    Shelf shelf;
    shelf.put("a.toml", 5, -2);
    const double c = std::cos(0.3), s = std::sin(0.3);
    shelf.put_after("b.toml", "a.toml", 100, -2).setup =
        motion::WorkFrame{{}, {c, s, 0}, {-s, c, 0}, {0, 0, 1}};
    const auto stock = shelf.stock_of("b.toml");
    ASSERT_TRUE(stock);
    const Box3 box = stock->blank->bounds_mm();
    EXPECT_NEAR(box.max.x, 40 * c + 30 * s, 1e-12);
    EXPECT_NEAR(box.min.y, -40 * s, 1e-12);
    EXPECT_EQ(box.max.z, 0);
    // The middle of the blank's face at y = 30, and the way out of it.
    const Vec3 face{20 * c + 30 * s, -20 * s + 30 * c, -5};
    EXPECT_NEAR(stock->blank->distance_mm(face), 0, 1e-12);
    EXPECT_NEAR(distance(stock->blank->gradient(face + Vec3{1e-3 * s, 1e-3 * c, 0}), {s, c, 0}), 0, 1e-12);
    std::vector<float> nodes(field::kLatticeNodes);
    const field::Lattice lattice{box.min, 0.7, 3, 4, 5};
    stock->blank->sample(lattice, nodes.data());
    EXPECT_EQ(nodes[1 + 8 * 2 + 64 * 3],
              static_cast<float>(stock->blank->distance_mm(lattice.node(1, 2, 3))));
}

TEST(JobStock, of_a_render_that_ended_early_has_the_cuts_made_by_then) {
    Shelf shelf;
    shelf.put("a.toml", 5, -2);
    shelf.put_after("b.toml", "out", 25, -2);
    // The tip is 25 mm along its 60 mm, 15 mm into the blank, by 2.5 s.
    auto ended = shelf.setup_of("a.toml", 2.5);
    ASSERT_TRUE(ended);
    MillSession session(*std::move(ended), serial_for);
    session.run({});
    shelf.folders["out"] = {"a.toml", stock_record(session.setup()), {}};
    EXPECT_EQ(shelf.folders["out"].record->until_s, 2.5);
    const MillTotals b = shelf.totals_of("b.toml");
    EXPECT_NEAR(b.removed_mm3 + session.totals().removed_mm3 + b.remaining_mm3, kBlank.volume(), 1e-9);
    EXPECT_NEAR(session.totals().removed_mm3, 2 * (6 * 15 + 0.5 * 3.14159265 * 9), 1);
}

TEST(JobStock, of_a_folder_is_refused_once_its_job_has_changed) {
    Shelf shelf;
    shelf.put("z.toml", 25, -1);
    shelf.put_after("a.toml", "z.toml", 5, -2);
    shelf.put_after("b.toml", "out", 25, -2);
    auto setup = shelf.setup_of("a.toml");
    job::StockRecord record = stock_record(*setup);
    record.version = "0.9";
    shelf.folders["out"] = {"a.toml", record, {}};
    EXPECT_EQ(shelf.refusal_of("b.toml"), "");
    const auto says = [&](const std::string& what) {
        EXPECT_EQ(shelf.refusal_of("b.toml"),
                  "b.toml:3:8: error: 'out' does not show what a.toml (rendered by tribo 0.9) leaves now: "
                  "changed since: " +
                      what + "; render it again, or name the job itself");
    };
    shelf.programs["a.toml"].moves[0].end.tip_mm.x += 1e-9;
    says("its path");
    shelf.put_after("a.toml", "z.toml", 5, -2, 6.1);
    says("its cutters");
    shelf.put_after("a.toml", "z.toml", 5, -2).setup = motion::WorkFrame{{0, 0, 1e-9}};
    says("the stock that it began with");
    shelf.put_after("a.toml", "z.toml", 5, -2);
    shelf.jobs["z.toml"].stock.box_mm.max.x += 1;
    says("the stock that it began with");
    shelf.put("z.toml", 24, -1);
    shelf.put_after("a.toml", "z.toml", 4, -2, 6.1);
    says("the stock that it began with, its cutters, its path");
    // Feeds and speeds change no stock.
    shelf.put("z.toml", 25, -1).process.spindle_rpm = 1000;
    shelf.put_after("a.toml", "z.toml", 5, -2);
    shelf.programs["a.toml"].moves[0].feed_mm_per_min = 10;
    EXPECT_EQ(shelf.refusal_of("b.toml"), "");
}

TEST(JobStock, is_refused_where_an_earlier_job_cannot_run) {
    Shelf shelf;
    shelf.put("a.toml", 5, -2).process.spindle_rpm = 0;
    shelf.put_after("b.toml", "a.toml", 5, -2);
    EXPECT_EQ(shelf.refusal_of("b.toml").substr(0, 46), "a.toml.nc:1: error: the spindle has no speed h");
}

TEST(JobStock, may_come_from_a_hundred_jobs) {
    Shelf shelf;
    shelf.put("0.toml", 5, -1);
    for (int n = 1; n <= 100; ++n)
        shelf.put_after(std::to_string(n) + ".toml", std::to_string(n - 1) + ".toml", 5, -1);
    const auto stock = shelf.stock_of("100.toml");
    ASSERT_TRUE(stock) << stock.error().text();
    EXPECT_EQ(stock->earlier.size(), 100u);
    EXPECT_EQ(shelf.totals_of("10.toml").removed_mm3, 0);
}

}  // namespace
}  // namespace tribo::session
