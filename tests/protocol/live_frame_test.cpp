// SPDX-License-Identifier: MIT
// Frames against the bytes stored in tests/protocol/frames: NAME.bin, and what it means in NAME.json. The
// page's decoder is held to the same files (web/protocol/test/stored.test.ts). A new kind of frame: run this
// test with TRIBO_STORE_FRAMES=1, then read what it has stored.
#include "protocol/live_frame.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <gtest/gtest.h>
#include <random>
#include <sstream>

#include "files/json/json.hpp"
#include "places.hpp"
#include "protocol/live_fields.hpp"

namespace tribo::protocol {
namespace {

using files::Json;
using Bytes = std::vector<std::uint8_t>;

std::string path_of(const std::string& name) {
    return std::string(TRIBO_SOURCE_DIR) + "/tests/protocol/frames/" + name;
}

std::string stored(const std::string& name) {
    std::ifstream file(path_of(name), std::ios::binary);
    std::stringstream text;
    text << file.rdbuf();
    return text.str();
}

void store(const std::string& name, const std::string& bytes) {
    std::ofstream(path_of(name), std::ios::binary) << bytes;
}

std::string text_of(const Bytes& bytes) {
    return {bytes.begin(), bytes.end()};
}

Bytes bytes_of(const std::string& text) {
    return {text.begin(), text.end()};
}

// Tells a frame by the names of its fields.
class Teller {
  public:
    static constexpr bool kReads = false;

    template <class Number>
    void u32(const char* name, Number v) {
        told[name] = static_cast<std::uint32_t>(v);
    }
    void i32(const char* name, std::int32_t v) { told[name] = v; }
    void f32(const char* name, double v) { told[name] = v; }
    void f64(const char* name, double v) { told[name] = v; }
    void vec3(const char* name, Vec3 v) { told[name] = files::triple(v); }
    void point(const char* name, const Point3f& p) { told[name] = p; }
    void complex(const char* name, std::complex<float> v) { told[name] = {v.real(), v.imag()}; }
    void quantiles(const char* name, const std::array<double, 4>& values) { told[name] = values; }
    void span_s(double start_s, double end_s) {
        told["t_s"] = start_s;
        told["duration_s"] = end_s - start_s;
    }
    template <class... Flags>
    void flags(Flags... flags) {
        ((told[flags.name] = flags.value), ...);
    }
    void header_flag(const char* name, bool on) { told[name] = on; }
    void time(const char* name, double t_s) { told[name] = t_s; }
    template <class Item>
    void time_of_first(const std::vector<Item>&) {}
    void added() {}
    template <class Item>
    void list(const char* name, const std::vector<Item>& items) {
        each(name, items, [](Teller& of, const Item& item) { fields(of, item); });
    }
    template <class Item>
    void rest(const char* name, const std::vector<Item>& items, std::size_t) {
        list(name, items);
    }
    template <class Item, class Visit>
    void each(const char* name, const std::vector<Item>& items, const Visit& visit) {
        told[name] = Json::array();
        for (const Item& item : items) {
            Teller of;
            visit(of, item);
            told[name].push_back(std::move(of.told));
        }
    }
    void mesh(const TriangleMesh& mesh, double = 0) {
        told["positions_mm"] = mesh.positions;
        told["triangles"] = mesh.triangles;
    }

    template <class Number>
    void numbers(const char* name, const std::vector<Number>& values) {
        told[name] = Json::array();
        for (const Number v : values) told[name].push_back(std::isnan(v) ? Json() : Json(v));
    }
    void text(const char* name, const std::string& text) { told[name] = text; }
    template <class Item>
    void last_item(const char* name, const std::optional<Item>& item) {
        if (!item) return;
        Teller of;
        fields(of, *item);
        told[name] = std::move(of.told);
    }
    template <class Item, class Has, class Visit>
    void last_each(const char* name, const std::vector<Item>& items, const Has& has, const Visit& visit) {
        if (std::any_of(items.begin(), items.end(), has)) each(name, items, visit);
    }

    Json told = Json::object();
};

template <class Frame>
Json meaning(const Frame& frame) {
    Teller teller;
    fields(teller, frame);
    return teller.told;
}

// `frame` is written as the stored bytes, which are read as what is stored of their meaning.
template <class Frame>
void expect_as_stored(const Frame& frame, const std::string& name) {
    SCOPED_TRACE(name);
    Bytes written;
    write_frame(frame, written);
    EXPECT_EQ(written.size() % 4, 0u);
    if (std::getenv("TRIBO_STORE_FRAMES") != nullptr) {
        store(name + ".bin", text_of(written));
        store(name + ".json", files::pretty(meaning(frame)));
    }
    const Bytes bytes = bytes_of(stored(name + ".bin"));
    EXPECT_EQ(written, bytes);
    Frame read;
    ASSERT_TRUE(read_frame(bytes, read));
    const Json expected = Json::parse(stored(name + ".json"), nullptr, false);
    EXPECT_EQ(meaning(read), expected);
    // Cut off anywhere it is none, unless what earlier versions wrote is whole.
    std::size_t whole = 0;
    for (std::size_t length = 0; length < bytes.size(); ++length) {
        Frame part;
        whole += read_frame(std::span(bytes).first(length), part) ? 1 : 0;
    }
    constexpr std::size_t header_bytes = 16;
    bool grew = std::is_same_v<Frame, LiveJob> || std::is_same_v<Frame, LiveSoundPieces> ||
                std::is_same_v<Frame, job::Listening> || std::is_same_v<Frame, LiveChunk> ||
                std::is_same_v<Frame, LiveRows> || std::is_same_v<Frame, LivePath>;
    if constexpr (std::is_same_v<Frame, LiveState>) grew = frame.chatter.has_value();
    const bool ends_anywhere = std::is_same_v<Frame, LiveTexture> && bytes.size() > header_bytes;
    EXPECT_EQ(whole > 0, grew || ends_anywhere) << whole;
    // Longer, it was written by a later version.
    Bytes longer = bytes;
    longer.insert(longer.end(), 4, 0xff);
    EXPECT_TRUE(read_frame(longer, read));
    EXPECT_EQ(meaning(read), expected);
    for (const std::size_t at : {0u, 1u}) {
        Bytes other = bytes;
        other[at] = 99;
        EXPECT_FALSE(read_frame(other, read));
    }
}

TriangleMesh mesh() {
    // Its longest edge is as long as the box has steps: positions are kept.
    TriangleMesh m;
    m.positions = {{10, 20, 30}, {11, 20, 30}, {10, 65555, 30}};
    m.triangles = {{0, 1, 2}};
    return m;
}

TEST(LiveFrames, AreTheStoredBytes) {
    expect_as_stored(LiveJob{12.5,
                             0.25,
                             {{0, 0, -10}, {40, 30, 0}},
                             {{7, 4, 6, 1, 40, {{10, 30}}}, {8, 2, 3, 3, 20, {}}},
                             0.015625,
                             0.03125,
                             {{{{0, 0}, {6, 4}}}, {}}},
                     "job");
    expect_as_stored(LiveChunk{3.5, {1, -2, 3}, mesh(), {}, 2}, "chunk");
    const float none = std::numeric_limits<float>::quiet_NaN();
    expect_as_stored(LiveChunk{3.5, {1, -2, 3}, mesh(), {0.25f, none, -0.5f}, 0, true}, "compared_chunk");
    expect_as_stored(LiveDesigned{mesh()}, "designed");
    LiveState state{1.25, {1, 2, 3}, {0, 0.5, 0.75}, {4, 5, 6}, 100, 2, 6000, 900, 0.5, 7, 1.5, 10,
                    42,   1,         true,           false,     true};
    expect_as_stored(state, "state");
    state.chatter = {{1.5f, 907.5f}, 0.75f};
    expect_as_stored(state, "chattering_state");
    LiveRow row{2.25, 2.75, {1, 2, 3}, 10, 20, 0.25, 1, 2, 5, 0.125, 9, 0.0625, 2, 6000, {0, 0.5, 0.75}, 1};
    const LiveRow next{2.75, 3, {4, 5, 6}, 1, 2, 3, 4, 5, 6, 7, 8, 0.25, 1, 9000, {0, 0, 1}, 0};
    expect_as_stored(LiveRows{true, {row, next}, 0.75, 1.5}, "rows");
    expect_as_stored(LiveRows{}, "no_rows");
    row.force_low_factor = 0.5;
    row.force_high_factor = 2;
    expect_as_stored(LiveRows{false, {row, next}, 0.75, 1.5}, "rows_in_cases");
    expect_as_stored(LiveCollision{4.5, 2, 17, {1, 2, 3}}, "collision");
    LiveSoundPiece piece{2.5, 0.5f, {1, 2, 3}, 0.25f, 628, 1.5f, 40, 2, {}, 3, 250, {}};
    piece.harmonics = {{1, 2, 3}, {std::complex{4.f, 5.f}, std::complex{6.f, 7.f}, std::complex{8.f, 9.f}}};
    expect_as_stored(LiveSoundPieces{{piece, {3, 0.25f, {}, 0, 100, 1, 0, 1, {}, 4, 0, {}}}}, "sound");
    LiveSoundPiece vibrates = piece;
    vibrates.teeth = {1,
                      {0, 1, 0},
                      {0.5f, 0, 0.25f},
                      {0, 0.5f, 0.75f},
                      0.125f,
                      0.25f,
                      0.5f,
                      -0.5f,
                      {{0, 1, 0.25f, 2}, {1, 2.5f, 0.5f, 1.5f}}};
    expect_as_stored(LiveSoundPieces{{vibrates, piece}}, "vibrating_sound");
    expect_as_stored(LiveTouch{1.5, {1, 2, 3}, {4, 5, 6}, {7, 8, 9}, 10, true, false, true, false, true},
                     "finger");
    expect_as_stored(LiveServo{1.5, 1000, 2, 4, 1000, 3, 1.5, {1, 2, 3, 4}, {5, 6, 7, 8}}, "servo");
    LiveTexture texture{2.5, {}};
    for (int n = 0; n < 8; ++n)
        texture.triangles.push_back({{{{n + 0.5, 0, 0}, {1, 0, 0}, {0, 1, 0}}}, {0, 0, 0.25 * n}});
    expect_as_stored(texture, "texture");
    expect_as_stored(LiveTexture{2.5, {}}, "no_texture");
    job::Listening listening;
    listening.listener_mm = {1, 2, 3};
    listening.distance_factor = 2;
    listening.gain_db = -6;
    listening.reference_distance_m = 0.5;
    listening.tool.modes[0] = {3000, 0.25};
    listening.tool.modes[1] = {4000, 0.125};
    listening.workshop = {1, 2, sound::ChipMaterial::titanium, 1, 2, 3, 4};
    expect_as_stored(listening, "listening");
    expect_as_stored(LivePath{{{0, {1, 2, 3}, true, 4}, {0.5, {4, 5, 6}, false, 7}}}, "path");
    expect_as_stored(LiveProgram{"a/b.nc", "G0 X1\r\nG1 Z-2\n"}, "program");
    LiveBending bending;
    const dynamics::Mode of_tool{{1, 0, 0}, 922.5, 0.0625, 1340, dynamics::ModeOn::tool},
        of_part{{0, 1, 0.5}, 1400, 0.125, 2000, dynamics::ModeOn::part};
    bending.coefficients = {600, 200, 100, 4, 3, 2};
    milling::Cutter bull;
    bull.kind = milling::CutterKind::bull;
    bull.corner_mm = 1.5;
    bull.runout_mm = 0.125;
    bull.runout_deg = 45;
    bull.pitch_deg = {175, 185};
    bending.cutters = {{bull, 24000, {of_tool, of_part}}, {milling::Cutter{}, 9000, {}}};
    expect_as_stored(bending, "bending");
    expect_as_stored(LiveMultipliers{7, {{0.5f, 930}, {1.25f, 907.5f}, {}}}, "multipliers");
    expect_as_stored(
        LiveChart{4000, 100, 0.25, 2, {0.375f, none, 0}, {0.5f, 1.25f, 0.25f, 0.75f, 0, 0}, {{4100, 0.5}}},
        "chart");
}

TEST(LiveFrames, KeepAMeshWithinAStepOfItsBox) {
    LiveChunk chunk;
    chunk.mesh.positions = {{0, 0, 0}, {3, 0.1f, 0}, {1, 2.9f, 0.7f}};
    chunk.mesh.triangles = {{0, 1, 2}};
    Bytes bytes;
    write_frame(chunk, bytes);
    LiveChunk read;
    ASSERT_TRUE(read_frame(bytes, read));
    for (std::uint32_t n = 0; n < 3; ++n)
        EXPECT_LT(length(read.mesh.position(n) - chunk.mesh.position(n)), 3.0 / 65535);
    // A triangle of a vertex that is not there.
    bytes[bytes.size() - 16] = 3;
    EXPECT_FALSE(read_frame(bytes, read));
    LiveChunkPlace place;
    EXPECT_TRUE(read_frame(bytes, place));
}

// Two chunks of one part have other boxes and the same border: it is told alike.
TEST(LiveFrames, TellABorderAlikeInBothChunks) {
    std::mt19937 random(7);
    const auto draw = [&](double least, double most) {
        return static_cast<float>(std::uniform_real_distribution<double>(least, most)(random));
    };
    for (int n = 0; n < 200; ++n) {
        const double edge = std::exp2(draw(-6, 8)), far = edge * std::exp2(draw(0, 12));
        const double step = step_of_chunks_mm(edge, far + edge);
        EXPECT_GE(65533 * step, edge);
        EXPECT_LE(step, 2 * std::max(edge / 65533, std::ldexp(far + edge, -24)));
        const Point3f shared{draw(-far, far), draw(-far, far), draw(-far, far)};
        Point3f told[2];
        for (Point3f& point : told) {
            LiveChunk chunk;
            chunk.step_mm = step;
            chunk.mesh.positions = {shared, shared, shared};
            for (std::size_t axis = 0; axis < 3; ++axis) {
                chunk.mesh.positions[1][axis] += draw(-0.5 * edge, 0);
                chunk.mesh.positions[2][axis] += draw(0, 0.5 * edge);
            }
            Bytes bytes;
            write_frame(chunk, bytes);
            LiveChunk read;
            ASSERT_TRUE(read_frame(bytes, read));
            point = read.mesh.positions[0];
            for (std::uint32_t v = 0; v < 3; ++v) {
                const Vec3 off = read.mesh.position(v) - chunk.mesh.position(v);
                for (int axis = 0; axis < 3; ++axis) EXPECT_LE(std::abs(off[axis]), 0.5 * step);
            }
        }
        EXPECT_EQ(told[0], told[1]);
    }
}

// Counts of what is not there must not be believed.
TEST(LiveFrames, ThatSayTooMuchAreRefused) {
    Bytes bytes;
    write_frame(LiveSoundPieces{std::vector<LiveSoundPiece>(3)}, bytes);
    for (std::size_t at = 16; at + 4 <= bytes.size(); at += 4) {
        Bytes damaged = bytes;
        std::fill_n(damaged.begin() + static_cast<std::ptrdiff_t>(at), 4, std::uint8_t{0xff});
        LiveSoundPieces read;
        (void)read_frame(damaged, read);
        EXPECT_LE(read.pieces.size(), 4u);
    }
    LiveSoundPieces vibrating{std::vector<LiveSoundPiece>(3)};
    for (LiveSoundPiece& piece : vibrating.pieces) piece.teeth.bands.resize(2);
    write_frame(vibrating, bytes);
    for (std::size_t at = 16; at + 4 <= bytes.size(); at += 4) {
        Bytes damaged = bytes;
        std::fill_n(damaged.begin() + static_cast<std::ptrdiff_t>(at), 4, std::uint8_t{0xff});
        LiveSoundPieces read;
        (void)read_frame(damaged, read);
        for (const LiveSoundPiece& piece : read.pieces) EXPECT_LE(piece.teeth.bands.size(), bytes.size());
    }
    write_frame(LiveChart{4000, 100, 0.25, 1, {1, 2}, {1, 2}, {}}, bytes);
    LiveChart damaged_chart;
    for (std::size_t at = 28; at + 4 <= bytes.size(); at += 4) {
        Bytes damaged = bytes;
        std::fill_n(damaged.begin() + static_cast<std::ptrdiff_t>(at), 4, std::uint8_t{0xff});
        (void)read_frame(damaged, damaged_chart);
        EXPECT_LE(damaged_chart.multipliers.size(), bytes.size());
    }
    write_frame(LiveProgram{"a.nc", "G0 X1"}, bytes);
    for (const std::ptrdiff_t at : {16, 24}) {
        Bytes damaged = bytes;
        std::fill_n(damaged.begin() + at, 4, std::uint8_t{0xff});
        LiveProgram program;
        EXPECT_FALSE(read_frame(damaged, program));
        EXPECT_LE(program.text.size() + program.name.size(), bytes.size());
    }
    write_frame(LiveDesigned{mesh()}, bytes);
    std::fill_n(bytes.begin() + 16, 8, std::uint8_t{0xff});
    LiveDesigned read;
    EXPECT_FALSE(read_frame(bytes, read));
    write_frame(LiveChunk{0, {}, mesh(), {1, 2, 3}, 3}, bytes);
    std::fill_n(bytes.end() - 24, 4, std::uint8_t{0xff});
    LiveChunk chunk;
    EXPECT_TRUE(read_frame(bytes, chunk));
    EXPECT_TRUE(chunk.deviations_mm.empty());
}

}  // namespace
}  // namespace tribo::protocol
