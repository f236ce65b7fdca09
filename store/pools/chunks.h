// SPDX-License-Identifier: Apache-2.0
// Taking, publishing and reading the chunks of a pool in shared memory. Every function is bounded, whatever other
// processes do: no lock, no system call, no allocation; all are real-time safe and may be called by any thread.

#pragma once

#include <cstdint>
#include <optional>

#include "core/rt/clock.h"
#include "store/pools/layout.h"

namespace indurop::pools {

// A published chunk in the hand of a seat.
struct Held {
  std::uint32_t chunk = 0;
  std::uint64_t number = 0;
};

// The seats are below kSeats, the chunks below `count`; both come from the caller, not from the memory.
class Chunks {
 public:
  Chunks(PoolHeader& header, std::uint32_t count) noexcept : header_(&header), count_(count) {}
  [[nodiscard]] std::uint32_t count() const noexcept { return count_; }

  // Returns a chunk to fill: a free one, else the oldest published one that no seat holds. The newest one is never
  // taken, so readers always find one. Nothing if there is none, which is counted.
  [[nodiscard]] std::optional<std::uint32_t> take(std::uint32_t seat) noexcept;
  // Returns its number; 0 if the chunk is not the seat's, because its process was taken for dead.
  std::uint64_t publish(std::uint32_t seat, std::uint32_t chunk, rt::MonoTime now) noexcept;
  void discard(std::uint32_t seat, std::uint32_t chunk) noexcept;

  // Returns the published chunk with the highest number. Nothing if none was published yet.
  [[nodiscard]] std::optional<Held> latest(std::uint32_t seat) noexcept;
  // Returns the first one that the seat has not seen, beginning with the latest. Those that were used again before are
  // counted as missed, and so is a number whose writer died between taking and using it.
  [[nodiscard]] std::optional<Held> next(std::uint32_t seat) noexcept;
  void release(std::uint32_t seat, std::uint32_t chunk) noexcept;
  [[nodiscard]] rt::MonoTime time_of(std::uint32_t chunk) const noexcept;

  // Frees all that a seat has in its hand, to read or to fill, when its user cannot do it any more. Returns how many
  // chunks these were. May be repeated, after a call that was interrupted too.
  std::uint32_t release_all(std::uint32_t seat) noexcept;

  // Returns true if the seat has something in its hand.
  [[nodiscard]] bool has_any(std::uint32_t seat) const noexcept;
  [[nodiscard]] bool is_held(std::uint32_t chunk) const noexcept;
  // Returns how many chunks take() could return now.
  [[nodiscard]] std::uint32_t free() const noexcept;

 private:
  struct Found {
    std::uint32_t chunk = 0;
    std::uint64_t state = kFree;
  };
  [[nodiscard]] std::optional<Found> newest() const noexcept;
  [[nodiscard]] std::optional<Found> first_after(std::uint64_t number) const noexcept;
  [[nodiscard]] std::optional<Found> to_fill(std::uint64_t tried) const noexcept;
  template <class Search>
  std::optional<Found> hold(std::uint32_t seat, Search search) noexcept;

  PoolHeader* header_;
  std::uint32_t count_;
};

}  // namespace indurop::pools
