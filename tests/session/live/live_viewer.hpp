// SPDX-License-Identifier: MIT
// A job of five grooves, and a viewer that takes the frames of its live mill.
#pragma once

#include <gtest/gtest.h>
#include <map>
#include <memory>
#include <set>
#include <vector>

#include "motion/path/path.hpp"
#include "session/block_setup.hpp"
#include "session/live/frame_cache.hpp"
#include "session/live/live_mill.hpp"

namespace tribo::session::test {

inline constexpr Box3 kBlank{{0, 0, -8}, {40, 20, 0}};

inline Result<MillSetup> slot() {
    MillSetup s =
        block_setup(kBlank, {.kind = milling::CutterKind::ball, .diameter_mm = 6, .length_mm = 20}, 0.5);
    for (const double y : {4.0, 7.0, 10.0, 13.0, 16.0}) {
        motion::Move cut = straight_cut({-5, y, -2}, {45, y, -2}, 1200);
        cut.line = 7;
        add_cut_in_pieces(s, cut, LiveMill::kPieceMm, 9000);
    }
    return s;
}

// Reads frames as a viewer does, from their bytes alone.
class Viewer {
  public:
    protocol::FrameSink sink() {
        return [this](std::span<const std::uint8_t> frame) { take(frame); };
    }
    double part_volume_mm3() const {
        TriangleMesh whole;
        for (const auto& [at, mesh] : chunks_) {
            const auto first = static_cast<std::uint32_t>(whole.positions.size());
            whole.positions.insert(whole.positions.end(), mesh.positions.begin(), mesh.positions.end());
            for (const Triangle& t : mesh.triangles)
                whole.triangles.push_back({t[0] + first, t[1] + first, t[2] + first});
        }
        return volume_mm3(whole);
    }

    // Some chunks are not exact yet.
    bool is_rough() const { return !rough_.empty(); }

    int jobs = 0;
    double duration_s = 0;
    protocol::LiveState state;
    std::size_t path_points = 0;
    std::vector<double> row_times, row_forces, sound_times;
    Vec3 listener;

  private:
    template <class Frame>
    static Frame read(std::span<const std::uint8_t> bytes) {
        Frame frame;
        EXPECT_TRUE(protocol::read_frame(bytes, frame));
        return frame;
    }
    void take(std::span<const std::uint8_t> frame) {
        EXPECT_EQ(frame.size() % 4, 0u);
        const auto kind = protocol::frame_kind(frame);
        ASSERT_TRUE(kind);
        switch (*kind) {
            case protocol::LiveFrame::job:
                job(read<protocol::LiveJob>(frame));
                break;
            case protocol::LiveFrame::path:
                path_points = read<protocol::LivePath>(frame).points.size();
                break;
            case protocol::LiveFrame::chunk: {
                auto chunk = read<protocol::LiveChunk>(frame);
                if (chunk.rough) {
                    rough_.insert(chunk.at);
                } else {
                    rough_.erase(chunk.at);
                }
                chunks_[chunk.at] = std::move(chunk.mesh);
                break;
            }
            case protocol::LiveFrame::state:
                state = read<protocol::LiveState>(frame);
                break;
            case protocol::LiveFrame::rows:
                rows(read<protocol::LiveRows>(frame));
                break;
            case protocol::LiveFrame::collision:
                (void)read<protocol::LiveCollision>(frame);
                break;
            case protocol::LiveFrame::sound:
                sound(read<protocol::LiveSoundPieces>(frame));
                break;
            case protocol::LiveFrame::listening:
                listener = read<job::Listening>(frame).listener_mm;
                break;
            default:
                ADD_FAILURE() << "not the mill's";
        }
    }
    void job(const protocol::LiveJob& job) {
        ++jobs;
        chunks_.clear();
        rough_.clear();
        row_times.clear();
        row_forces.clear();
        sound_times.clear();
        duration_s = job.duration_s;
        EXPECT_EQ(job.blank_mm.min, kBlank.min);
        EXPECT_EQ(job.blank_mm.max, kBlank.max);
    }
    void rows(const protocol::LiveRows& told) {
        if (told.anew) {
            row_times.clear();
            row_forces.clear();
        }
        for (const protocol::LiveRow& row : told.rows) {
            row_times.push_back(row.t_s);
            row_forces.push_back(row.mean_force_n);
        }
    }
    void sound(const protocol::LiveSoundPieces& told) {
        for (const protocol::LiveSoundPiece& piece : told.pieces) {
            sound_times.push_back(piece.t_s);
            EXPECT_EQ(piece.order_step, 2);          // two flutes alike
            EXPECT_EQ(piece.harmonics.size(), 17u);  // the mean and 16
            EXPECT_EQ(piece.edges, 2);
            EXPECT_GT(piece.mean_torque_nmm, 0);
        }
    }

    std::map<protocol::LiveChunkPlace, TriangleMesh> chunks_;
    std::set<protocol::LiveChunkPlace> rough_;
};

// Ticks until the part has reached the clock and its picture is exact.
inline void settle(LiveMill& live, Viewer& viewer) {
    const auto all_the_time = [] { return true; };
    for (int n = 0; n < 2 || viewer.is_rough(); ++n) live.tick(0, all_the_time, viewer.sink());
}

inline bool always() {
    return true;
}

inline FrameCache::Frame shared(std::span<const std::uint8_t> frame) {
    return std::make_shared<const std::vector<std::uint8_t>>(frame.begin(), frame.end());
}

}  // namespace tribo::session::test
