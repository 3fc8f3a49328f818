// SPDX-License-Identifier: MIT
// A libusb-1.0 with one Falcon: an FTDI chip with two bytes of line state before each packet, a loader that
// sends back what it gets, and a firmware that answers each packet with one.
#include <algorithm>
#include <cstdint>
#include <cstring>
#include <deque>
#include <sys/types.h>
#include <unistd.h>

#include "fake_falcon.hpp"

namespace {

tribo::test::FakeFalcon falcon;
// Of the chip and the loader; one thread at a time.
enum class Mode { closed, asked, loading, running } mode = Mode::closed;
int baud = 0;
std::deque<unsigned char> waiting;
std::deque<std::size_t> transfers;  // sizes of the next transfers; then all
int answers = 0;
int device, handle, context;

constexpr int kNoDevice = -4, kTimeout = -7;

void answer(const std::string& bytes) {
    const int split = falcon.split_at;
    if (split > 0 && static_cast<std::size_t>(split) < bytes.size()) {
        transfers.push_back(static_cast<std::size_t>(split));
        transfers.push_back(bytes.size() - static_cast<std::size_t>(split));
    } else {
        transfers.push_back(bytes.size());
    }
    waiting.insert(waiting.end(), bytes.begin(), bytes.end());
}

std::string letters(int value) {
    std::string text;
    for (int n = 0; n < 4; ++n) text += static_cast<char>('A' + ((value >> (4 * n)) & 15));
    return text;
}

void take_packet(const unsigned char* bytes) {
    if (bytes[0] != '<' || bytes[15] != '>' || !falcon.has_firmware || falcon.mute) return;
    ++falcon.packets;
    for (int motor = 0; motor < 3; ++motor) {
        int value = 0;
        for (int n = 0; n < 4; ++n) value |= (bytes[1 + 4 * motor + n] - 'A') << (4 * n);
        falcon.motors[motor] = static_cast<std::int16_t>(value);
    }
    falcon.status = bytes[13] - 'A';
    if ((falcon.status & 1) != 0 && falcon.homing_packets > 0) --falcon.homing_packets;
    const int homed = falcon.homing_packets == 0 ? 7 : 3;
    std::string text = "<";
    for (auto& count : falcon.counts) text += letters(count += falcon.turn);
    text += static_cast<char>('A' + (homed << 4 | falcon.buttons));
    text += "A>";
    const int every = falcon.cut_every;
    if (every > 0 && ++answers % every == 0) text = text.substr(0, 13) + ">";
    answer(text);
}

void take(const unsigned char* bytes, int count) {
    if (falcon.mute) return;
    if (baud == 0x4138 && count == 3 && std::memcmp(bytes, "\x0a\x43\x0d", 3) == 0) {
        if (falcon.silent_questions > 0) {
            --falcon.silent_questions;
            return;
        }
        mode = Mode::asked;
        answer(std::string("\0\x0a\x44\x2c\x0d", 5));
    } else if (baud == 0x15 && mode == Mode::asked && count == 1 && bytes[0] == 0x41) {
        mode = Mode::loading;
        falcon.forget_firmware();
        answer("A");
    } else if (baud == 0x15 && mode == Mode::loading) {
        std::string back(reinterpret_cast<const char*>(bytes), static_cast<std::size_t>(count));
        if (falcon.failing_loads > 0) {
            --falcon.failing_loads;
            back[0] = static_cast<char>(back[0] ^ 1);
            mode = Mode::closed;
        } else {
            falcon.take_firmware(bytes, count);
        }
        answer(back);
    } else if (baud == 0x2 && count == 16) {
        take_packet(bytes);
    }
}

std::string hex(int value) {
    const char* digits = "0123456789abcdef";
    std::string text;
    for (; value > 0 || text.empty(); value /= 16) text.insert(text.begin(), digits[value % 16]);
    return text;
}

}  // namespace

extern "C" {

tribo::test::FakeFalcon* fake_falcon() {
    return &falcon;
}

int libusb_init(void** out) {
    *out = &context;
    falcon.said("init");
    mode = Mode::closed;
    waiting.clear();
    transfers.clear();
    answers = 0;
    return 0;
}
void libusb_exit(void*) {
    falcon.said("exit");
}
ssize_t libusb_get_device_list(void*, void*** list) {
    static void* all[2] = {&device, nullptr};
    *list = all;
    return falcon.plugged ? 1 : 0;
}
void libusb_free_device_list(void**, int) {}
int libusb_get_device_descriptor(void*, std::uint8_t* descriptor) {
    const std::uint8_t bytes[18] = {18, 1, 0, 2, 0, 0, 0, 8, 0x03, 0x04, 0x48, 0xcb, 0, 4, 1, 2, 3, 1};
    std::memcpy(descriptor, bytes, sizeof bytes);
    return 0;
}
int libusb_open(void*, void** out) {
    *out = &handle;
    return falcon.open_code;
}
void libusb_close(void*) {
    falcon.said("close");
}
int libusb_set_auto_detach_kernel_driver(void*, int) {
    return 0;
}
int libusb_claim_interface(void*, int) {
    falcon.said("claim");
    return falcon.claim_code;
}
int libusb_release_interface(void*, int) {
    falcon.said("release");
    return 0;
}
int libusb_control_transfer(void*, std::uint8_t type, std::uint8_t request, std::uint16_t value,
                            std::uint16_t, std::uint8_t*, std::uint16_t, unsigned) {
    if (!falcon.plugged) return kNoDevice;
    const char* const names[] = {"purge", "line", "flow", "baud", "data", "", "", "", "", "latency"};
    if (type == 0x40 && request < 10) falcon.said(std::string(names[request]) + " " + hex(value));
    if (request == 3) {
        baud = value;
        // The firmware begins when the loader is left with all of it.
        if (value == 0x2 && mode == Mode::loading && !falcon.firmware().empty()) {
            falcon.has_firmware = true;
            mode = Mode::running;
        }
    }
    if (request == 0) {
        waiting.clear();
        transfers.clear();
    }
    return 0;
}
#ifndef FAKE_OLD
int libusb_bulk_transfer(void*, std::uint8_t endpoint, std::uint8_t* data, int length, int* count, unsigned) {
    *count = 0;
    if (!falcon.plugged) return kNoDevice;
    if (endpoint == 0x02) {
        if (baud != 0x2) falcon.said("out " + std::to_string(length));
        *count = length;
        take(data, length);
        return 0;
    }
    if (endpoint != 0x81 || length < 64) return kTimeout;
    data[0] = 0x01;
    data[1] = 0x60;
    std::size_t size = 0;
    if (!transfers.empty()) {
        size = std::min<std::size_t>(transfers.front(), 62);
        if (size < transfers.front()) {
            transfers.front() -= size;
        } else {
            transfers.pop_front();
        }
    }
    if (size == 0) usleep(200);  // the chip waits for its latency timer
    std::copy_n(waiting.begin(), size, data + 2);
    waiting.erase(waiting.begin(), waiting.begin() + static_cast<std::ptrdiff_t>(size));
    *count = static_cast<int>(size) + 2;
    return 0;
}
#endif
const char* libusb_error_name(int) {
    return "LIBUSB_ERROR_OTHER";
}
}
