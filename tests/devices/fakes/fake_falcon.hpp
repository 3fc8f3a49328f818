// SPDX-License-Identifier: MIT
// What the fake libusb does, set and looked at by the tests: one Falcon behind an FTDI chip. It exports
// `fake_falcon()`.
#pragma once

#include <atomic>
#include <mutex>
#include <string>
#include <vector>

namespace tribo::test {

struct FakeFalcon {
    std::atomic<bool> plugged{true};
    std::atomic<int> open_code{0};   // of libusb_open
    std::atomic<int> claim_code{0};  // of libusb_claim_interface
    std::atomic<bool> has_firmware{false};
    std::atomic<int> failing_loads{0};     // so many next blocks of firmware come back damaged
    std::atomic<int> silent_questions{0};  // so many next questions get no answer
    std::atomic<bool> mute{false};         // answers nothing any more
    std::atomic<int> homing_packets{3};    // so many packets with the homing bit until it is homed
    std::atomic<int> counts[3] = {0, 0, 0};
    std::atomic<int> turn{0};  // added to the counts with each packet
    std::atomic<int> buttons{0};
    std::atomic<int> cut_every{0};           // each so-many-th answer is two bytes short
    std::atomic<int> split_at{0};            // answers come in two transfers, the first of so many bytes
    std::atomic<int> motors[3] = {0, 0, 0};  // of the last packet
    std::atomic<int> status{0};              // of the last packet: lights and homing
    std::atomic<long> packets{0};

    // Requests of the chip ("baud 4138") and bytes ("out 3"), in their order; what repeats at once is written
    // once.
    void said(const std::string& what) {
        const std::lock_guard lock(mutex_);
        if (!said_.empty() && said_.back() == what) return;
        said_.push_back(what);
    }
    std::string transcript() {
        const std::lock_guard lock(mutex_);
        std::string all;
        for (const std::string& one : said_) all += (all.empty() ? "" : ", ") + one;
        return all;
    }
    void take_firmware(const unsigned char* bytes, int count) {
        const std::lock_guard lock(mutex_);
        firmware_.insert(firmware_.end(), bytes, bytes + count);
    }
    std::vector<unsigned char> firmware() {
        const std::lock_guard lock(mutex_);
        return firmware_;
    }
    void forget_firmware() {
        const std::lock_guard lock(mutex_);
        firmware_.clear();
    }
    void reset() {
        plugged = true;
        open_code = claim_code = failing_loads = silent_questions = buttons = turn = cut_every = split_at =
            status = 0;
        has_firmware = mute = false;
        homing_packets = 3;
        packets = 0;
        for (int n = 0; n < 3; ++n) counts[n] = motors[n] = 0;
        const std::lock_guard lock(mutex_);
        said_.clear();
        firmware_.clear();
    }

  private:
    std::mutex mutex_;
    std::vector<std::string> said_;
    std::vector<unsigned char> firmware_;
};

}  // namespace tribo::test
