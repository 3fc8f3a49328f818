// SPDX-License-Identifier: MIT
// The picture of a part whose clock goes back and forth, and what it keeps.
#include "session/live/part_picture.hpp"

#include <gtest/gtest.h>
#include <map>
#include <set>
#include <string>

#include "base/noise_hash.hpp"
#include "session/live/live_viewer.hpp"

namespace tribo::session {
namespace {

using namespace test;
using Chunk = std::tuple<int, int, int>;

// What a viewer has of the part.
class Shown {
  public:
    void follow(PartPicture& picture, bool jumped = false) {
        picture.update(
            always,
            [&](ChunkCoord c, PartPicture::Piece piece) {
                const Chunk at{c.i, c.j, c.k};
                rough_.erase(at);
                if (piece.rough) rough_.insert(at);
                chunks_[at] = std::move(piece.mesh);
            },
            jumped);
    }
    std::size_t rough() const { return rough_.size(); }
    // Empty chunks are as good as none.
    std::map<Chunk, TriangleMesh> seen() const {
        std::map<Chunk, TriangleMesh> all = chunks_;
        std::erase_if(all, [](const auto& chunk) { return chunk.second.triangles.empty(); });
        return all;
    }

  private:
    std::map<Chunk, TriangleMesh> chunks_;
    std::set<Chunk> rough_;
};

void expect_same(const Shown& one, const Shown& other) {
    const auto a = one.seen(), b = other.seen();
    ASSERT_EQ(a.size(), b.size());
    for (const auto& [chunk, mesh] : a) {
        ASSERT_TRUE(b.contains(chunk));
        EXPECT_EQ(mesh.positions, b.at(chunk).positions);
        EXPECT_EQ(mesh.triangles, b.at(chunk).triangles);
    }
}

// As a picture that saw nothing before.
void expect_as_fresh(const Shown& shown, const MillSession& session) {
    PartPicture fresh(session.stock());
    Shown other;
    fresh.mark(fresh.all());
    other.follow(fresh);
    expect_same(shown, other);
}

TEST(PartPicture, finds_again_what_stood_for_a_while) {
    MillSession session(*slot(), serial_for);
    session.keep_states(0);
    PartPicture picture(session.stock());
    Shown shown;
    const auto stand_at = [&](double t_s) {
        if (t_s < session.milled_s()) session.set_back(0);
        ASSERT_TRUE(session.run_to(t_s, {}));
        picture.mark(picture.all());
        for (int n = 0; n < 60; ++n) shown.follow(picture);
    };
    const double end_s = session.duration_s();
    const double times[] = {0.2 * end_s, 0.7 * end_s, end_s};
    for (const double t_s : times) stand_at(t_s);
    const std::size_t made = picture.contours();
    EXPECT_GT(made, 8u);
    for (const std::size_t n : {1u, 0u, 2u, 0u, 1u, 2u}) {
        stand_at(times[n]);
        expect_as_fresh(shown, session);
    }
    EXPECT_EQ(picture.contours(), made);
}

// Jumps to and fro, without the time to draw exactly.
TEST(PartPicture, finds_again_what_it_drew_roughly) {
    MillSession session(*slot(), serial_for);
    session.keep_states(0);
    PartPicture picture(session.stock());
    Shown shown;
    const auto jump_to = [&](double t_s) {
        if (t_s < session.milled_s()) session.set_back(0);
        ASSERT_TRUE(session.run_to(t_s, {}));
        picture.mark(picture.all());
        shown.follow(picture, true);
    };
    const double end_s = session.duration_s();
    const double times[] = {0.2 * end_s, 0.7 * end_s, end_s};
    for (const double t_s : times) jump_to(t_s);
    const std::size_t made = picture.contours();
    EXPECT_GT(made, 8u);
    for (const std::size_t n : {1u, 0u, 2u, 0u, 1u, 2u}) jump_to(times[n]);
    EXPECT_EQ(picture.contours(), made);
    // In the end all is exact, also what was kept roughly.
    while (shown.rough() > 0) shown.follow(picture);
    expect_as_fresh(shown, session);
}

TEST(PartPicture, keeps_nothing_that_was_under_the_tool) {
    MillSession session(*slot(), serial_for);
    session.keep_states(0);
    PartPicture picture(session.stock());
    Shown shown;
    for (double t_s = 0; t_s < session.duration_s(); t_s += 0.05) {
        ASSERT_TRUE(session.run_to(t_s, {}));
        picture.mark(picture.all());
        shown.follow(picture);
    }
    EXPECT_GT(picture.contours(), 100u);
    const std::size_t made = picture.contours();
    session.set_back(0);
    ASSERT_TRUE(session.run_to(0.5 * session.duration_s(), {}));
    picture.mark(picture.all());
    shown.follow(picture);
    expect_as_fresh(shown, session);
    // Of the changed chunks some are made again.
    EXPECT_GT(picture.contours(), made);
}

// After a jump all is seen at once, and in the end as without a jump.
TEST(PartPicture, is_rough_after_a_jump_and_exact_soon_after) {
    MillSession session(*slot(), serial_for);
    session.keep_states(std::size_t{1} << 20);
    PartPicture picture(session.stock());
    const CounterNoise noise(9);
    Shown shown;
    std::size_t rough = 0;
    for (std::uint64_t n = 0; n < 10; ++n) {
        const double t_s = noise.uniform(n) * session.duration_s();
        if (t_s < session.milled_s()) session.set_back(t_s);
        ASSERT_TRUE(session.run_to(t_s, {}));
        picture.mark(picture.all());
        shown.follow(picture, true);
        ASSERT_FALSE(picture.is_behind());
        rough += shown.rough();
        // Without a mark they are drawn again. The next jump may come before all are.
        for (std::uint64_t k = 0; k < n % 4; ++k) {
            const std::size_t before = shown.rough();
            shown.follow(picture);
            EXPECT_TRUE(shown.rough() < before || before == 0);
        }
    }
    EXPECT_GT(rough, 20u);
    while (shown.rough() > 0) shown.follow(picture);
    expect_as_fresh(shown, session);
}

// Against a list of all that was put, the newest use last.
TEST(KeptPieces, are_those_that_were_used_last_within_the_bound) {
    using Kept = KeptPieces<std::string>;
    Kept kept;
    std::vector<std::pair<Kept::Key, std::size_t>> expected;
    const CounterNoise noise(4);
    std::uint64_t draw = 0;
    const auto below = [&](std::uint64_t count) { return noise.bits(draw++) % count; };
    const auto take_out = [&](const Kept::Key& key) {
        return std::erase_if(expected, [&](const auto& entry) { return entry.first == key; }) > 0;
    };
    for (int n = 0; n < 3000; ++n) {
        const Kept::Key key{below(6), below(5)};
        const auto bytes = static_cast<std::size_t>(below(Kept::kMostBytes / 4));
        switch (below(3)) {
            case 0: {
                kept.put(key, std::to_string(bytes), bytes);
                take_out(key);
                expected.emplace_back(key, bytes);
                const auto sum = [&] {
                    std::size_t all = 0;
                    for (const auto& entry : expected) all += entry.second;
                    return all;
                };
                while (sum() > Kept::kMostBytes) expected.erase(expected.begin());
                break;
            }
            case 1: {
                const std::string* found = kept.find(key);
                const auto known = std::ranges::find(expected, key, [](const auto& e) { return e.first; });
                ASSERT_EQ(found != nullptr, known != expected.end());
                if (found == nullptr) break;
                ASSERT_EQ(*found, std::to_string(known->second));
                std::rotate(known, known + 1, expected.end());
                break;
            }
            default:
                kept.drop(key);
                take_out(key);
        }
        ASSERT_EQ(kept.count(), expected.size());
        ASSERT_LE(kept.bytes(), Kept::kMostBytes);
    }
}

}  // namespace
}  // namespace tribo::session
