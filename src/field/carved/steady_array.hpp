// SPDX-License-Identifier: MIT
// An array that grows at its end without moving its elements. While one thread appends, other threads may
// read the elements that they were told of.
#pragma once

#include <array>
#include <cassert>
#include <cstddef>
#include <memory>

namespace tribo::field {

// Pages of kPage elements; a book has 1024 pages. Elements are default-initialised: plain data has no defined
// value before it is written.
template <class T, std::size_t kPage>
class SteadyArray {
  public:
    std::size_t size() const { return size_; }
    std::size_t bytes() const { return pages_ * kPage * sizeof(T); }
    T& operator[](std::size_t n) { return (*books_[n / (kPage * kBook)])[n / kPage % kBook][n % kPage]; }
    const T& operator[](std::size_t n) const {
        return (*books_[n / (kPage * kBook)])[n / kPage % kBook][n % kPage];
    }
    // Appends `count` elements; returns the number of the first one.
    std::size_t grow(std::size_t count) {
        const std::size_t first = size_;
        size_ += count;
        for (; pages_ * kPage < size_; ++pages_) {
            assert(pages_ < kBook * kBooks);
            std::unique_ptr<Book>& book = books_[pages_ / kBook];
            if (!book) book = std::make_unique<Book>();
            (*book)[pages_ % kBook] = std::make_unique_for_overwrite<T[]>(kPage);
        }
        return first;
    }
    void push_back(T value) { (*this)[grow(1)] = std::move(value); }

  private:
    static constexpr std::size_t kBook = 1024, kBooks = 1024;
    using Book = std::array<std::unique_ptr<T[]>, kBook>;
    std::array<std::unique_ptr<Book>, kBooks> books_;
    std::size_t size_ = 0, pages_ = 0;
};

}  // namespace tribo::field
