// SPDX-License-Identifier: Apache-2.0
// Containers of fixed capacity: trivially copyable, no heap.
#pragma once

#include <cstddef>
#include <cstdint>

namespace nc {

/// Vector of at most N elements, which lie in the object itself. push_back() returns false when it is full.
template <class T, unsigned N>
class FixedVector {
 public:
  bool push_back(const T& value) {
    if (size_ == N) return false;
    data_[size_++] = value;
    return true;
  }
  void pop_back() { --size_; }
  void clear() { size_ = 0; }
  void resize(unsigned n) { size_ = n; }
  bool full() const { return size_ == N; }
  bool empty() const { return size_ == 0; }
  unsigned size() const { return size_; }
  static constexpr unsigned capacity() { return N; }
  T& operator[](unsigned i) { return data_[i]; }
  const T& operator[](unsigned i) const { return data_[i]; }
  T& back() { return data_[size_ - 1]; }
  const T& back() const { return data_[size_ - 1]; }
  T* begin() { return data_; }
  T* end() { return data_ + size_; }
  const T* begin() const { return data_; }
  const T* end() const { return data_ + size_; }

 private:
  T data_[N];
  unsigned size_ = 0;
};

/// First-in first-out queue of at most N elements.
template <class T, unsigned N>
class FixedQueue {
 public:
  bool push(const T& value) {
    if (size_ == N) return false;
    data_[(head_ + size_++) % N] = value;
    return true;
  }
  const T& front() const { return data_[head_]; }
  T& front() { return data_[head_]; }
  void pop() {
    head_ = (head_ + 1) % N;
    --size_;
  }
  T& at(unsigned i) { return data_[(head_ + i) % N]; }
  const T& at(unsigned i) const { return data_[(head_ + i) % N]; }
  bool full() const { return size_ == N; }
  bool empty() const { return size_ == 0; }
  unsigned size() const { return size_; }
  void clear() { head_ = size_ = 0; }

 private:
  T data_[N];
  unsigned head_ = 0;
  unsigned size_ = 0;
};

}  // namespace nc
