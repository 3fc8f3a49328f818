// SPDX-License-Identifier: MIT
// A shared library of a vendor, loaded at run time: Tribo builds without it.
#pragma once

#include <initializer_list>
#include <string>
#include <utility>

#include "base/result.hpp"

namespace tribo::devices {

class SharedLibrary {
  public:
    // Opens the first name that the loader finds. A name with a slash is a path. The error lists all names
    // and the messages of the loader.
    static Result<SharedLibrary> open(std::initializer_list<std::string> names);
    SharedLibrary(SharedLibrary&& other) noexcept;
    SharedLibrary& operator=(SharedLibrary&& other) noexcept;
    ~SharedLibrary();

    const std::string& name() const { return name_; }
    // False if the symbol is missing; missing() then keeps the first such symbol.
    template <class Function>
    bool find(const char* symbol, Function*& function) {
        function = reinterpret_cast<Function*>(address(symbol));
        if (function == nullptr && missing_.empty()) missing_ = symbol;
        return function != nullptr;
    }
    // The first symbol that find() did not find.
    const std::string& missing() const { return missing_; }

  private:
    SharedLibrary(void* handle, std::string name) : handle_(handle), name_(std::move(name)) {}
    void* address(const char* symbol) const;

    void* handle_ = nullptr;
    std::string name_, missing_;
};

}  // namespace tribo::devices
