// SPDX-License-Identifier: Apache-2.0
// Logarithmic histogram of durations with fixed buckets: 16 per power of two, so a quantile is exact to 6 %.
// No allocation; one writer, any number of readers.

#pragma once

#include <array>
#include <atomic>
#include <bit>
#include <cstddef>
#include <cstdint>

namespace indurop::scheduler {

class Histogram {
 public:
  static constexpr unsigned kSubBits = 4;
  static constexpr std::size_t kSub = 1U << kSubBits;
  static constexpr unsigned kMaxBits = 36;  // 2^36 ns = 68 s; longer goes into the last bucket
  static constexpr std::size_t kBuckets = (kMaxBits - kSubBits + 1) * kSub;

  static constexpr std::size_t bucket_of(std::uint64_t value) noexcept {
    if (value < kSub) {
      return static_cast<std::size_t>(value);
    }
    const auto top = static_cast<unsigned>(std::bit_width(value)) - 1;
    if (top >= kMaxBits) {
      return kBuckets - 1;
    }
    return (top - kSubBits + 1) * kSub + static_cast<std::size_t>((value >> (top - kSubBits)) & (kSub - 1));
  }
  static constexpr std::uint64_t lower_bound(std::size_t bucket) noexcept {
    if (bucket < kSub) {
      return bucket;
    }
    const auto octave = static_cast<unsigned>(bucket / kSub) - 1;
    return (kSub + bucket % kSub) << octave;
  }
  static constexpr std::uint64_t upper_bound(std::size_t bucket) noexcept { return lower_bound(bucket + 1); }

  // Real-time safe. One writer only.
  void add(std::uint64_t value) noexcept {
    auto& bucket = buckets_[bucket_of(value)];
    bucket.store(bucket.load(std::memory_order_relaxed) + 1, std::memory_order_relaxed);
  }
  [[nodiscard]] std::uint64_t count(std::size_t bucket) const noexcept {
    return buckets_[bucket].load(std::memory_order_relaxed);
  }
  void clear() noexcept {
    for (auto& bucket : buckets_) {
      bucket.store(0, std::memory_order_relaxed);
    }
  }

 private:
  std::array<std::atomic<std::uint64_t>, kBuckets> buckets_{};
};

}  // namespace indurop::scheduler
