// SPDX-License-Identifier: MIT
#include "devices/arm/shared_library.hpp"

#include <dlfcn.h>

namespace tribo::devices {

Result<SharedLibrary> SharedLibrary::open(std::initializer_list<std::string> names) {
    std::string tried;
    for (const std::string& name : names) {
        if (void* handle = ::dlopen(name.c_str(), RTLD_NOW | RTLD_LOCAL)) return SharedLibrary(handle, name);
        const char* said = ::dlerror();
        tried += (tried.empty() ? "" : "; ") + (said != nullptr ? std::string(said) : name);
    }
    return fail(tried, "install the vendor's driver, or name the folder of the library in LD_LIBRARY_PATH");
}

SharedLibrary::SharedLibrary(SharedLibrary&& other) noexcept
    : handle_(std::exchange(other.handle_, nullptr)),
      name_(std::move(other.name_)),
      missing_(std::move(other.missing_)) {}

SharedLibrary& SharedLibrary::operator=(SharedLibrary&& other) noexcept {
    std::swap(handle_, other.handle_);
    name_ = std::move(other.name_);
    missing_ = std::move(other.missing_);
    return *this;
}

SharedLibrary::~SharedLibrary() {
    if (handle_ != nullptr) ::dlclose(handle_);
}

void* SharedLibrary::address(const char* symbol) const {
    return ::dlsym(handle_, symbol);
}

}  // namespace tribo::devices
