// SPDX-License-Identifier: Apache-2.0
// The word in the store that shows readers whether the variables of one sending board are all of one of its updates
// (include/indurop/snapshot.h). Changed under the mutex of the landings, read by any process.

#pragma once

#include <indurop/detail/abi.h>

#include <atomic>
#include <cstdint>

namespace indurop::mirror {

class UpdateWord {
 public:
  UpdateWord() = default;
  // `word` is in the store; null: there is none, the variables are sent on their own.
  explicit UpdateWord(std::atomic<std::uint64_t>* word) noexcept : word_(word) {
    begin();
    end(false);
  }

  // Marks the start of a change: until end() readers know that values are changing.
  void begin() noexcept {
    if (word_ != nullptr) {
      word_->store(word_->load(std::memory_order_relaxed) | abi::kUpdating, std::memory_order_relaxed);
      std::atomic_thread_fence(std::memory_order_release);
    }
  }
  // `whole`: all values are of one update now.
  void end(bool whole) noexcept {
    whole_ = whole;
    if (word_ != nullptr) {
      const std::uint64_t count = word_->load(std::memory_order_relaxed) / abi::kUpdateStep + 1;
      word_->store(count * abi::kUpdateStep | (whole ? 0 : abi::kPartial), std::memory_order_release);
    }
  }
  [[nodiscard]] bool whole() const noexcept { return whole_; }

  // Returns the value to store in the entry of a variable that changes with this word.
  [[nodiscard]] std::int64_t offset_from(const void* entry) const noexcept {
    return word_ == nullptr ? abi::kAlone : reinterpret_cast<const char*>(word_) - static_cast<const char*>(entry);
  }

 private:
  std::atomic<std::uint64_t>* word_ = nullptr;
  bool whole_ = false;
};

}  // namespace indurop::mirror
