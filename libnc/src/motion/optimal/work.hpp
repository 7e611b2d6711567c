// SPDX-License-Identifier: Apache-2.0
// Planning in slices. A law may take millions of instructions, and whoever calls the planner wants to have the processor back after some
// thousand. So the functions that take long are coroutines (C++20): each says what it has done (spend()), and at places that lie near
// enough to one another it lets itself be interrupted (pause()). Their frames, which hold all that they need to go on, lie in the fixed
// memory of a Work, one on top of the other as on a stack. There is no heap, no thread and no other stack.
#pragma once

#include <coroutine>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <new>

namespace nc::optimal {

class Work;

/// What all frames have in common.
struct TaskPromise {
  Work* work = nullptr;
  std::coroutine_handle<> caller;  ///< waits for this one; none: it was begun by Work

  std::suspend_always initial_suspend() const noexcept { return {}; }
  struct Ended {
    bool await_ready() const noexcept { return false; }
    template <class Promise>
    void await_suspend(std::coroutine_handle<Promise> self) const noexcept;
    void await_resume() const noexcept {}
  };
  Ended final_suspend() const noexcept { return {}; }
  void unhandled_exception() const noexcept {}  // there are none

  // The first argument behind the object says in which work the frame lies.
  template <class Self, class... Rest>
  static void* operator new(size_t size, Self&, Work& work, Rest&...) noexcept;
  template <class... Rest>
  static void* operator new(size_t size, Work& work, Rest&...) noexcept;
  static void operator delete(void* frame) noexcept;
};

/// A function that may be interrupted. Its caller awaits it at once: `const bool found = co_await law(work, ...)`. It takes the Work as its
/// first argument, and its locals need no destructor, because work that is given up is forgotten as it stands.
template <class T>
class Task {
 public:
  struct promise_type : TaskPromise {
    T result{};
    Task get_return_object() noexcept { return Task(std::coroutine_handle<promise_type>::from_promise(*this)); }
    static Task get_return_object_on_allocation_failure() noexcept { return Task(nullptr); }
    void return_value(T value) noexcept { result = value; }
  };

  bool await_ready() const noexcept { return !handle_; }
  template <class Promise>
  void await_suspend(std::coroutine_handle<Promise> caller) const noexcept;
  /// T{} (nothing is found) where its frame had no room. Work::kFrames is so large that this does not happen, and a test looks at it.
  T await_resume() const noexcept {
    if (!handle_) return T{};
    const T result = handle_.promise().result;
    handle_.destroy();
    return result;
  }

 private:
  friend class Work;
  explicit Task(std::coroutine_handle<promise_type> handle) noexcept : handle_(handle) {}
  std::coroutine_handle<promise_type> handle_;
};

class Work {
 public:
  Work() = default;
  Work(const Work&) = delete;
  Work& operator=(const Work&) = delete;

  /// So much has been done, in instructions of a processor. What is said is counted twice: beside the inner loops, which it was measured of,
  /// there is as much again in the worst of programs (tests/motion/feed_slices_test.py).
  void spend(int64_t instructions) { left_ -= 2 * instructions; }
  bool spent() const { return left_ <= 0; }
  struct Pause {
    const Work& work;
    bool await_ready() const noexcept { return work.left_ > 0; }
    void await_suspend(std::coroutine_handle<>) const noexcept {}
    void await_resume() const noexcept {}
  };
  /// `co_await work.pause()`: here others get their turn when the slice is spent.
  Pause pause() const { return {*this}; }
  Pause pause(int64_t instructions) {
    spend(instructions);
    return {*this};
  }

  /// Begins with a task. Nothing of it is done yet.
  void begin(Task<bool> task) {
    root_ = task.handle_;
    newest_ = root_;
    if (root_) root_.promise().work = this;
  }
  bool open() const { return newest_ != nullptr; }
  /// Goes on until all is done or `instructions` are spent. @return what is left of them, negative when they were not enough
  int64_t go_on(int64_t instructions) {
    left_ = instructions;
    while (newest_ && left_ > 0) newest_.resume();
    if (!newest_ && root_) {
      root_.destroy();
      root_ = nullptr;
    }
    return left_;
  }
  /// Forgets what is under way.
  void give_up() {
    newest_ = root_ = nullptr;
    top_ = 0;
  }
  /// A task from its beginning to its end, for who has the time. Nothing else may be open.
  template <class T>
  T now(Task<T> task) {
    if (!task.handle_) return T{};
    task.handle_.promise().work = this;
    newest_ = task.handle_;
    left_ = std::numeric_limits<int64_t>::max();
    while (newest_) newest_.resume();
    return task.await_resume();
  }

  static constexpr size_t kFrames = 32768;  ///< bytes
  size_t most_used() const { return most_; }  ///< of them, so far
  bool ran_out() const { return ran_out_; }   ///< once there was no room for a frame

 private:
  friend struct TaskPromise;
  template <class T>
  friend class Task;
  /// In front of each frame.
  struct Header {
    Work* work;
    size_t top;  ///< where it begins
  };
  static constexpr size_t kAlign = alignof(std::max_align_t) > 32 ? alignof(std::max_align_t) : 32, kHeader = kAlign;
  static_assert(sizeof(Header) <= kHeader);

  void* place(size_t size) {
    const size_t end = top_ + kHeader + (size + kAlign - 1) / kAlign * kAlign;
    if (end > kFrames) {
      ran_out_ = true;
      return nullptr;
    }
    unsigned char* const at = frames_ + top_;
    new (at) Header{this, top_};
    top_ = end;
    if (end > most_) most_ = end;
    return at + kHeader;
  }
  static void remove(void* frame) {
    const Header& header = *reinterpret_cast<Header*>(static_cast<unsigned char*>(frame) - kHeader);
    header.work->top_ = header.top;  // what was made last goes first
  }

  int64_t left_ = 0;
  std::coroutine_handle<> newest_;  ///< the frame that goes on
  std::coroutine_handle<Task<bool>::promise_type> root_;
  size_t top_ = 0, most_ = 0;
  bool ran_out_ = false;
  alignas(kAlign) unsigned char frames_[kFrames];
};

template <class Promise>
void TaskPromise::Ended::await_suspend(std::coroutine_handle<Promise> self) const noexcept {
  TaskPromise& promise = self.promise();
  promise.work->newest_ = promise.caller;
}

template <class Self, class... Rest>
void* TaskPromise::operator new(size_t size, Self&, Work& work, Rest&...) noexcept {
  return work.place(size);
}

template <class... Rest>
void* TaskPromise::operator new(size_t size, Work& work, Rest&...) noexcept {
  return work.place(size);
}

inline void TaskPromise::operator delete(void* frame) noexcept {
  Work::remove(frame);
}

template <class T>
template <class Promise>
void Task<T>::await_suspend(std::coroutine_handle<Promise> caller) const noexcept {
  TaskPromise& promise = handle_.promise();
  promise.work = caller.promise().work;
  promise.caller = caller;
  promise.work->newest_ = handle_;
}

}  // namespace nc::optimal
