// SPDX-License-Identifier: Apache-2.0
// Limits how many refusals are logged one by one: beyond that they are counted, and the next entry has their number.

#pragma once

#include <cstdint>
#include <utility>

namespace indurop::base {

class NoteLimit {
 public:
  static constexpr std::int64_t kWindowNs = 60'000'000'000;
  static constexpr std::uint64_t kMostNotes = 30;  // in a window

  // Returns true if one more entry may be logged now, and counts it.
  bool take(std::int64_t now_ns) noexcept {
    if (notes_ == 0 || now_ns - since_ns_ > kWindowNs) {
      since_ns_ = now_ns;
      notes_ = 0;
    }
    if (notes_ == kMostNotes) {
      return false;
    }
    ++notes_;
    return true;
  }
  // Returns the number of refusals to log now, this one included; 0: log nothing.
  std::uint64_t count(std::int64_t now_ns) noexcept {
    ++not_noted_;
    return take(now_ns) ? std::exchange(not_noted_, 0) : 0;
  }

 private:
  std::int64_t since_ns_ = 0;
  std::uint64_t notes_ = 0;
  std::uint64_t not_noted_ = 0;
};

}  // namespace indurop::base
