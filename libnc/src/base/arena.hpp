// SPDX-License-Identifier: Apache-2.0
// Memory of a control: one block given by the caller, handed out once at creation and never given back.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <new>
#include <type_traits>

namespace nc {

/// Bump allocator over caller-owned memory. Constructed without memory it only measures, so that the code that lays a control
/// out in memory and the code that says how much it needs are the same code.
class Arena {
 public:
  Arena() = default;                                               ///< measure only
  Arena(void* memory, size_t size) : begin_(static_cast<char*>(memory)), size_(size) {}

  /// `count` value-initialised objects, or nullptr (when measuring, or when the memory is too small).
  template <class T>
  T* make(size_t count = 1) {
    static_assert(std::is_trivially_destructible_v<T>);
    used_ = (used_ + kAlign - 1) / kAlign * kAlign;
    const size_t at = used_;
    used_ += sizeof(T) * count;
    if (begin_ == nullptr || used_ > size_) return nullptr;
    T* first = reinterpret_cast<T*>(begin_ + at);
    if constexpr (std::is_integral_v<T>) {
      std::memset(first, 0, sizeof(T) * count);
    } else {
      for (size_t i = 0; i < count; ++i) new (first + i) T();
    }
    return first;
  }

  /// The same without a value: each is written before it is read. A large table costs nothing as long as it is not used.
  template <class T>
  T* make_blank(size_t count) {
    static_assert(std::is_trivially_destructible_v<T> && std::is_trivially_copyable_v<T>);
    used_ = (used_ + kAlign - 1) / kAlign * kAlign;
    const size_t at = used_;
    used_ += sizeof(T) * count;
    return begin_ == nullptr || used_ > size_ ? nullptr : reinterpret_cast<T*>(begin_ + at);
  }

  size_t used() const { return used_; }
  bool measuring() const { return begin_ == nullptr; }
  bool overflowed() const { return begin_ != nullptr && used_ > size_; }

 private:
  static constexpr size_t kAlign = 64;  // a cache line: neighbours owned by different threads never share one
  char* begin_ = nullptr;
  size_t size_ = 0;
  size_t used_ = 0;
};

}  // namespace nc
