// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cassert>
#include <cstddef>

namespace penumbra {

/// A vector of at most `Capacity` elements, held in place: frames make many, and allocate none of them.
template <typename T, std::size_t Capacity>
class InlineVector {
  public:
    InlineVector() = default;
    InlineVector(std::initializer_list<T> values) {
        for (const T& value : values) push_back(value);
    }
    void push_back(const T& value) {
        assert(size_ < Capacity);
        values_[size_++] = value;
    }
    std::size_t size() const { return size_; }
    bool empty() const { return size_ == 0; }
    T* data() { return values_.data(); }
    const T* data() const { return values_.data(); }
    T* begin() { return data(); }
    T* end() { return data() + size_; }
    const T* begin() const { return data(); }
    const T* end() const { return data() + size_; }
    T& operator[](std::size_t i) { return values_[i]; }
    const T& operator[](std::size_t i) const { return values_[i]; }

  private:
    std::array<T, Capacity> values_;
    std::size_t size_ = 0;
};

}  // namespace penumbra
