// SPDX-License-Identifier: Apache-2.0
// Puts the parts of chunks together, in place: a chunk of the local pool is taken for the first part and published with
// the last one. Parts may be lost, repeated, in any order within a chunk, and mixed with those of other senders. Knows
// neither DDS nor shared memory. Used by one thread.

#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "doors/pools/part.h"

namespace indurop::pool_door {

// Where chunks are assembled.
class ChunkPlaces {
 public:
  struct Place {
    std::uint32_t chunk = 0;
    std::byte* data = nullptr;
  };
  ChunkPlaces() = default;
  ChunkPlaces(const ChunkPlaces&) = delete;
  ChunkPlaces& operator=(const ChunkPlaces&) = delete;
  virtual ~ChunkPlaces() = default;

  // Returns nothing if there is no free chunk.
  virtual std::optional<Place> take() = 0;
  virtual void publish(const Place& place, std::int64_t published_ns) = 0;
  virtual void discard(const Place& place) = 0;
};

struct AssemblyCounts {
  std::uint64_t complete = 0;    // chunks published
  std::uint64_t incomplete = 0;  // chunks given up, because parts were missing
  std::uint64_t no_place = 0;    // chunks not assembled, because no chunk was free
  std::uint64_t repeated = 0;    // parts that had been received before
  std::uint64_t late = 0;        // parts of a chunk before the one being assembled
  std::uint64_t malformed = 0;   // parts that cannot belong to a chunk of this size
};

class Assembler {
 public:
  using Time = std::chrono::nanoseconds;          // monotonic
  static constexpr std::size_t kMostSenders = 8;  // at a time; of more, the one silent for longest is dropped
  static constexpr Time kPatience = std::chrono::seconds(2);  // for the next part of a chunk

  // `places` is borrowed. Chunks have `chunk_bytes` bytes, not 0.
  Assembler(ChunkPlaces& places, std::uint64_t chunk_bytes) noexcept : places_(&places), chunk_bytes_(chunk_bytes) {}
  Assembler(const Assembler&) = delete;
  Assembler& operator=(const Assembler&) = delete;
  ~Assembler() { give_up_all(); }

  void add(const Part& part, Time now);
  // Gives up chunks of which no part has come for kPatience: their sender has ended.
  void give_up_silent(Time now);
  // Gives up everything: the pool is about to be left.
  void give_up_all();

  [[nodiscard]] const AssemblyCounts& counts() const noexcept { return counts_; }

 private:
  enum class State { Filling, Published, GivenUp };
  struct Sender {
    std::uint64_t session = 0;
    std::uint64_t number = 0;  // of its newest chunk
    Time heard{};
    State state = State::GivenUp;
    ChunkPlaces::Place place;
    std::uint64_t missing = 0;  // parts
    std::vector<bool> has;      // the parts, by their order in the chunk
  };
  Sender& sender_of(std::uint64_t session, Time now);
  void begin(Sender& sender, std::uint64_t number);
  void give_up(Sender& sender);

  ChunkPlaces* places_;
  std::uint64_t chunk_bytes_;
  std::vector<Sender> senders_;
  AssemblyCounts counts_;
};

}  // namespace indurop::pool_door
