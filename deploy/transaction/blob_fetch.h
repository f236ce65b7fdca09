// SPDX-License-Identifier: Apache-2.0
// Tracks which pieces of one file were requested and have arrived: in order, one window ahead, requested again if
// nothing arrives.

#pragma once

#include <chrono>
#include <cstdint>
#include <optional>

#include "core/rt/clock.h"

namespace indurop::deploy {

class BlobFetch {
 public:
  static constexpr std::uint64_t kWindow = 2U << 20U;
  static constexpr std::chrono::nanoseconds kPatience = std::chrono::milliseconds(500);

  struct Range {
    std::uint64_t offset = 0;
    std::uint64_t length = 0;
    bool restart = false;  // earlier requests are void
  };

  // The first `have` of `size` bytes are stored already; at most `window` bytes are under way.
  BlobFetch(std::uint64_t size, std::uint64_t have, std::uint64_t window = kWindow)
      : size_(size), have_(have), window_(window), asked_(have) {}

  // Returns what to request now, if anything.
  std::optional<Range> ask(rt::MonoTime now) {
    if (complete()) {
      return std::nullopt;
    }
    const bool restart = !begun_ || now - moved_ > kPatience;
    if (restart) {
      asked_ = have_;
    } else if (asked_ == size_ || asked_ - have_ > window_ / 2) {
      return std::nullopt;
    }
    begun_ = true;
    moved_ = now;
    const std::uint64_t until = size_ - have_ > window_ ? have_ + window_ : size_;
    const Range range{asked_, until - asked_, restart};
    asked_ = until;
    return range;
  }

  // Returns true if these bytes come next and must be kept; other bytes are to be discarded.
  bool take(std::uint64_t offset, std::uint64_t length, rt::MonoTime now) {
    if (offset != have_ || length == 0 || length > size_ - have_) {
      return false;
    }
    have_ += length;
    moved_ = now;
    return true;
  }

  [[nodiscard]] std::uint64_t have() const noexcept { return have_; }
  [[nodiscard]] bool complete() const noexcept { return have_ == size_; }

 private:
  std::uint64_t size_;
  std::uint64_t have_;
  std::uint64_t window_;
  std::uint64_t asked_;
  bool begun_ = false;
  rt::MonoTime moved_;
};

}  // namespace indurop::deploy
