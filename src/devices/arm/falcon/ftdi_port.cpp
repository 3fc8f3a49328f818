// SPDX-License-Identifier: MIT
#include "devices/arm/falcon/ftdi_port.hpp"

#include <array>
#include <sys/types.h>
#include <utility>

#include "devices/arm/shared_library.hpp"

namespace tribo::devices {
namespace {

// Names and values of libusb.h.
constexpr int LIBUSB_ERROR_ACCESS = -3, LIBUSB_ERROR_NO_DEVICE = -4, LIBUSB_ERROR_BUSY = -6;
constexpr std::uint8_t kToVendor = 0x40;  // a vendor's request to the device
// Endpoints of the chip, its largest packet, and the bytes of line state in front of each.
constexpr std::uint8_t kOut = 0x02, kIn = 0x81;
constexpr std::size_t kPacket = 64, kLineState = 2;
constexpr unsigned kRequestMs = 1000;
// Requests of the chip (FT232 family).
constexpr std::uint8_t kReset = 0, kModem = 1, kFlow = 2, kBaud = 3, kData = 4, kLatency = 9;
constexpr std::uint16_t kPurgeReceived = 1, kPurgeToSend = 2, k8N1 = 8, kDtr = 1, kRts = 2;

// The device descriptor of the USB specification, table 9-8.
struct DeviceDescriptor {
    std::uint8_t length, type;
    std::uint16_t usb;
    std::uint8_t device_class, subclass, protocol, packet;
    std::uint16_t vendor, product, release;
    std::uint8_t manufacturer_text, product_text, serial_text, configurations;
};
static_assert(sizeof(DeviceDescriptor) == 18);

struct Context;
struct Device;
struct Handle;

struct Api {
    int (*init)(Context**);
    void (*exit)(Context*);
    ssize_t (*device_list)(Context*, Device***);
    void (*free_device_list)(Device**, int);
    int (*descriptor)(Device*, DeviceDescriptor*);
    int (*open)(Device*, Handle**);
    void (*close)(Handle*);
    int (*detach_kernel_driver)(Handle*, int);
    int (*claim)(Handle*, int);
    int (*release)(Handle*, int);
    int (*control)(Handle*, std::uint8_t, std::uint8_t, std::uint16_t, std::uint16_t, std::uint8_t*,
                   std::uint16_t, unsigned);
    int (*bulk)(Handle*, std::uint8_t, std::uint8_t*, int, int*, unsigned);
    const char* (*error_name)(int);
};

bool bind(SharedLibrary& library, Api& api) {
    bool all = library.find("libusb_init", api.init);
    all &= library.find("libusb_exit", api.exit);
    all &= library.find("libusb_get_device_list", api.device_list);
    all &= library.find("libusb_free_device_list", api.free_device_list);
    all &= library.find("libusb_get_device_descriptor", api.descriptor);
    all &= library.find("libusb_open", api.open);
    all &= library.find("libusb_close", api.close);
    all &= library.find("libusb_set_auto_detach_kernel_driver", api.detach_kernel_driver);
    all &= library.find("libusb_claim_interface", api.claim);
    all &= library.find("libusb_release_interface", api.release);
    all &= library.find("libusb_control_transfer", api.control);
    all &= library.find("libusb_bulk_transfer", api.bulk);
    all &= library.find("libusb_error_name", api.error_name);
    return all;
}

}  // namespace

struct FtdiPort::Usb {
    Usb(SharedLibrary loaded, const Api& functions) : library(std::move(loaded)), api(functions) {}
    Usb(const Usb&) = delete;
    Usb& operator=(const Usb&) = delete;
    ~Usb() {
        if (claimed) api.release(handle, 0);
        if (handle != nullptr) api.close(handle);
        if (context != nullptr) api.exit(context);
    }

    // Opens the first such device. Returns libusb's code; NO_DEVICE if there is none.
    int open(std::uint16_t vendor, std::uint16_t product) {
        Device** list = nullptr;
        const ssize_t count = api.device_list(context, &list);
        if (count < 0) return static_cast<int>(count);
        int code = LIBUSB_ERROR_NO_DEVICE;
        for (ssize_t n = 0; n < count; ++n) {
            DeviceDescriptor descriptor{};
            if (api.descriptor(list[n], &descriptor) < 0) continue;
            if (descriptor.vendor != vendor || descriptor.product != product) continue;
            code = api.open(list[n], &handle);
            if (code == 0) break;
            handle = nullptr;
        }
        api.free_device_list(list, 1);
        return code;
    }

    SharedLibrary library;
    Api api;
    Context* context = nullptr;
    Handle* handle = nullptr;
    bool claimed = false, connected = true;
    std::array<std::uint8_t, kPacket> received{};
};

Result<FtdiPort> FtdiPort::open(const std::string& driver, std::uint16_t vendor, std::uint16_t product) {
    auto library = driver.empty() ? SharedLibrary::open({"libusb-1.0.so.0", "libusb-1.0.so"})
                                  : SharedLibrary::open({driver});
    if (!library) {
        Error error = library.error();
        error.remedy = "install libusb 1.0 (Debian: libusb-1.0-0)";
        return std::unexpected(error);
    }
    Api api{};
    if (!bind(*library, api)) {
        return fail(library->name() + " has no " + library->missing() + ": it is another version",
                    "install libusb 1.0.16 or later");
    }
    auto usb = std::make_unique<Usb>(std::move(*library), api);
    if (const int code = api.init(&usb->context); code < 0)
        return fail(std::string("USB does not start: ") + api.error_name(code), "restart the computer");
    const int opened = usb->open(vendor, product);
    if (opened == LIBUSB_ERROR_NO_DEVICE)
        return fail("it is not plugged in", "plug in its USB and its power");
    if (opened == LIBUSB_ERROR_ACCESS) {
        return fail("no right to use it",
                    "add a udev rule: SUBSYSTEM==\"usb\", ATTR{idVendor}==\"0403\", "
                    "ATTR{idProduct}==\"cb48\", MODE=\"0666\"; then plug it in again");
    }
    if (opened < 0)
        return fail(std::string("it does not open: ") + api.error_name(opened), "plug it in again");
    // Not on every system; claim() then tells whether another driver has it.
    api.detach_kernel_driver(usb->handle, 1);
    const int claimed = api.claim(usb->handle, 0);
    if (claimed == LIBUSB_ERROR_BUSY) return fail("another program uses it", "close that program");
    if (claimed < 0)
        return fail(std::string("it does not open: ") + api.error_name(claimed), "plug it in again");
    usb->claimed = true;
    return FtdiPort(std::move(usb));
}

FtdiPort::FtdiPort(std::unique_ptr<Usb> usb) : usb_(std::move(usb)) {}
FtdiPort::FtdiPort(FtdiPort&& other) noexcept = default;
FtdiPort& FtdiPort::operator=(FtdiPort&& other) noexcept = default;
FtdiPort::~FtdiPort() = default;

bool FtdiPort::request(std::uint8_t what, std::uint16_t value) {
    const int code = usb_->api.control(usb_->handle, kToVendor, what, value, 0, nullptr, 0, kRequestMs);
    if (code == LIBUSB_ERROR_NO_DEVICE) usb_->connected = false;
    return code >= 0;
}

bool FtdiPort::purge() {
    return request(kReset, kPurgeReceived) && request(kReset, kPurgeToSend);
}
bool FtdiPort::set_latency_ms(int milliseconds) {
    return request(kLatency, static_cast<std::uint16_t>(milliseconds));
}
bool FtdiPort::set_baud_code(std::uint16_t code) {
    return request(kBaud, code);
}
bool FtdiPort::set_8n1_without_flow_control() {
    return request(kData, k8N1) && request(kFlow, 0);
}
// The high byte says which line is meant, the low one its level.
bool FtdiPort::set_dtr(bool high) {
    return request(kModem, static_cast<std::uint16_t>(kDtr << 8 | (high ? kDtr : 0)));
}
bool FtdiPort::set_rts(bool high) {
    return request(kModem, static_cast<std::uint16_t>(kRts << 8 | (high ? kRts : 0)));
}

bool FtdiPort::write(std::span<const std::uint8_t> bytes, std::chrono::milliseconds most) {
    int sent = 0;
    // libusb takes the bytes of both directions through one pointer; it does not write to these.
    const int code =
        usb_->api.bulk(usb_->handle, kOut, const_cast<std::uint8_t*>(bytes.data()),
                       static_cast<int>(bytes.size()), &sent, static_cast<unsigned>(most.count()));
    if (code == LIBUSB_ERROR_NO_DEVICE) usb_->connected = false;
    return code == 0 && sent == static_cast<int>(bytes.size());
}

std::span<const std::uint8_t> FtdiPort::read(std::chrono::milliseconds most) {
    int count = 0;
    const int code = usb_->api.bulk(usb_->handle, kIn, usb_->received.data(), static_cast<int>(kPacket),
                                    &count, static_cast<unsigned>(most.count()));
    if (code == LIBUSB_ERROR_NO_DEVICE) usb_->connected = false;
    if (code < 0 || count <= static_cast<int>(kLineState)) return {};
    return std::span(usb_->received).first(static_cast<std::size_t>(count)).subspan(kLineState);
}

bool FtdiPort::is_connected() const {
    return usb_->connected;
}

}  // namespace tribo::devices
