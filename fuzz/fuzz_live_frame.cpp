// SPDX-License-Identifier: MIT
// Any bytes as a frame of the live view: what is read as one survives being written and read.
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <span>
#include <vector>

#include "protocol/live_frame.hpp"

namespace {

using namespace tribo;

// What is written again are the numbers that were read, rounded as the frame rounds them.
template <class Frame>
void check(std::span<const std::uint8_t> bytes) {
    Frame frame, again;
    if (!protocol::read_frame(bytes, frame)) return;
    std::vector<std::uint8_t> written, twice;
    protocol::write_frame(frame, written);
    if (!protocol::read_frame<Frame>(written, again)) std::abort();
    protocol::write_frame(again, twice);
    if (written.size() != twice.size()) std::abort();
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    constexpr std::size_t largest = 1 << 16;
    if (size > largest) return 0;
    const std::span<const std::uint8_t> bytes{data, size};
    (void)protocol::frame_kind(bytes);
    (void)protocol::header_flag(bytes);
    check<protocol::LiveJob>(bytes);
    check<protocol::LiveState>(bytes);
    check<protocol::LiveRows>(bytes);
    check<protocol::LiveCollision>(bytes);
    check<protocol::LiveSoundPieces>(bytes);
    check<protocol::LiveTouch>(bytes);
    check<protocol::LiveServo>(bytes);
    check<protocol::LiveTexture>(bytes);
    check<protocol::LivePath>(bytes);
    check<protocol::LiveProgram>(bytes);
    check<protocol::LiveBending>(bytes);
    check<protocol::LiveMultipliers>(bytes);
    check<protocol::LiveChart>(bytes);
    return 0;
}
