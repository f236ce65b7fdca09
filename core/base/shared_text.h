// SPDX-License-Identifier: Apache-2.0
// A line of text in shared memory.

#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <string>

namespace indurop::base {

inline constexpr std::size_t kSharedText = 240;  // bytes with the final 0; longer text is cut

// A line of text that its one writer may change while others read it.
class SharedText {
 public:
  void set(const std::string& text) noexcept {
    const std::uint32_t now = version_.load(std::memory_order_relaxed);
    version_.store(now + 1, std::memory_order_relaxed);
    std::atomic_thread_fence(std::memory_order_release);
    const std::size_t length = text.size() < kSharedText ? text.size() : kSharedText - 1;
    for (std::size_t i = 0; i <= length; ++i) {
      text_[i].store(i < length ? text[i] : '\0', std::memory_order_relaxed);
    }
    version_.store(now + 2, std::memory_order_release);
  }
  // Returns an empty text if it is changed again and again meanwhile.
  [[nodiscard]] std::string get() const {
    constexpr int kTries = 100;
    std::string text;
    for (int i = 0; i < kTries; ++i) {
      if (try_get(text)) {
        return text;
      }
    }
    return {};
  }
  // Returns false if it was changed meanwhile.
  bool try_get(std::string& text) const {
    const std::uint32_t before = version_.load(std::memory_order_acquire);
    text.clear();
    for (const std::atomic<char>& letter : text_) {
      const char c = letter.load(std::memory_order_relaxed);
      if (c == '\0') {
        break;
      }
      text += c;
    }
    std::atomic_thread_fence(std::memory_order_acquire);
    return before % 2 == 0 && version_.load(std::memory_order_relaxed) == before;
  }

 private:
  std::atomic<std::uint32_t> version_;
  std::atomic<char> text_[kSharedText];
};

}  // namespace indurop::base
