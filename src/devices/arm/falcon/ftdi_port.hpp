// SPDX-License-Identifier: MIT
// Serial port of an FTDI chip through libusb-1.0, loaded at run time. For chips that the system does not show
// as a serial port.
#pragma once

#include <chrono>
#include <cstdint>
#include <memory>
#include <span>
#include <string>

#include "base/result.hpp"

namespace tribo::devices {

// One thread at a time. Calls wait for at most the given time.
class FtdiPort {
  public:
    struct Usb;  // libusb's functions and handles

    // Opens the first chip with this USB vendor and product. `driver`: path of libusb; empty: in the loader
    // path. Errors give a remedy: no libusb, not plugged in, no rights, in use.
    static Result<FtdiPort> open(const std::string& driver, std::uint16_t vendor, std::uint16_t product);
    FtdiPort(FtdiPort&& other) noexcept;
    FtdiPort& operator=(FtdiPort&& other) noexcept;
    ~FtdiPort();

    // Requests to the chip; false: refused, or the device is gone.
    bool purge();
    bool set_latency_ms(int milliseconds);
    // Baud rate as a code of the chip: 3,000,000 by the divisor in the lowest 14 bits.
    bool set_baud_code(std::uint16_t code);
    bool set_8n1_without_flow_control();
    bool set_dtr(bool high);
    bool set_rts(bool high);

    // False if not all bytes were sent in time, or the device is gone.
    bool write(std::span<const std::uint8_t> bytes, std::chrono::milliseconds most);
    // Reads what the chip sends next, without its two bytes of line state; empty: nothing came. The bytes
    // stay until the next call.
    std::span<const std::uint8_t> read(std::chrono::milliseconds most);
    // False after the device was unplugged.
    bool is_connected() const;

  private:
    explicit FtdiPort(std::unique_ptr<Usb> usb);
    bool request(std::uint8_t what, std::uint16_t value);
    std::unique_ptr<Usb> usb_;
};

}  // namespace tribo::devices
