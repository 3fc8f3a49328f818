// SPDX-License-Identifier: MIT
// A list with room for a fixed number of elements in itself, for code that must not allocate. What is not in
// use is not touched: a large one costs as little to make as a small one.
#pragma once

#include <cassert>
#include <cstddef>
#include <memory>
#include <type_traits>

namespace tribo {

template <class T, std::size_t kMost>
class FixedList {
    static_assert(std::is_trivially_copyable_v<T>);

  public:
    FixedList() {}  // not "= default": the elements have no value yet
    FixedList(const FixedList&) = delete;
    FixedList& operator=(const FixedList&) = delete;

    std::size_t size() const { return size_; }
    bool is_full() const { return size_ == kMost; }
    void clear() { size_ = 0; }
    // Only where it is not full.
    T& put(const T& value) {
        assert(!is_full());
        return *std::construct_at(all_ + size_++, value);
    }
    // Takes an element out; the last one takes its place.
    T take(T& one) {
        const T taken = one;
        one = all_[--size_];
        return taken;
    }
    T& operator[](std::size_t n) { return all_[n]; }
    const T& operator[](std::size_t n) const { return all_[n]; }
    T* begin() { return all_; }
    T* end() { return all_ + size_; }
    const T* begin() const { return all_; }
    const T* end() const { return all_ + size_; }

  private:
    union {
        T all_[kMost];
    };
    std::size_t size_ = 0;
};

}  // namespace tribo
