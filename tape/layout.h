// SPDX-License-Identifier: Apache-2.0
// Bytes of the tape: header, variables, their first values, and one track for each module. A track is a ring of 64-bit
// words that one thread writes and never waits for anybody; who reads too slowly loses the oldest runs and sees that.
//
// A run on its track: the values it began with that differ from what the track said last, those that changed while it
// ran although it does not write them, those it wrote, one more in turn whether it changed or not, and Run at the end.
// Any change here is a new kTapeAbi.

#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <type_traits>

namespace indurop::tape {

inline constexpr std::uint64_t kTapeMagic = 0x3145504154444e49ULL;  // "INDTAPE1"
inline constexpr std::uint32_t kTapeAbi = 5;

enum class EntryKind : std::uint32_t {
  Before = 1,  // value a run begins with
  During,      // value of something it reads, changed by somebody else while it ran
  After,       // value it left
  Again,       // unchanged value, so that a reader who comes late learns all of them in time
  Run,         // the end of a run; kRunWords words
  Clock,       // what irp::now_ns() said to it; one word
  Told,  // what a call of a shared function, the reading of a channel or the age of a value gave it: a code, then the
         // bytes
};

// First word of an entry. Behind it: the value's bytes, in whole words, or what Run says.
struct EntryHead {
  EntryKind kind{};
  std::uint32_t which = 0;  // index of a variable; of Run: RunFlags; of Told: how many bytes
};
static_assert(sizeof(EntryHead) == sizeof(std::uint64_t) && std::is_trivially_copyable_v<EntryHead>);

enum RunFlags : std::uint32_t {
  kFaulted = 1,  // it ended by a fault
  kAnew = 2,     // its module was started anew since its run before
};

// More of one run are not told: it waits for something, or measures.
inline constexpr int kMostReadings = 64;
// Likewise, of what it was told. What is longer than the track can hold beside runs is there without its bytes.
inline constexpr int kMostTold = 1024;
inline constexpr std::uint64_t kToldShare = 16;            // of a track's words, one run may use for that
inline constexpr std::int64_t kTooLongToTell = INT64_MIN;  // as code

// The words behind the head of Run.
struct RunTail {
  std::uint64_t number = 0;  // of the runs on this track, from 0
  std::uint64_t order = 0;   // of its begin among the runs of all tracks
  std::uint64_t tick = 0;
  std::int64_t release_ns = 0;  // the node's time, as the others
  std::int64_t start_ns = 0;
  std::int64_t end_ns = 0;
};
inline constexpr std::uint64_t kRunWords = sizeof(RunTail) / sizeof(std::uint64_t);

constexpr std::uint64_t words_of(std::uint64_t bytes) noexcept {
  return (bytes + sizeof(std::uint64_t) - 1) / sizeof(std::uint64_t);
}

// Entry i is that of the store's directory.
struct TapeVariable {
  std::uint64_t name_hash;
  std::uint64_t first_offset;  // of its first value, from the begin of the tape
  std::uint32_t size;
  std::uint32_t taped;  // 0: no track tells it, it is too large
};

inline constexpr std::size_t kLine = 64;  // bytes of a cache line
inline constexpr std::size_t kMarks = 16;
struct TapeTrack {
  std::uint64_t data_offset;  // of its words, from the begin of the tape
  std::uint64_t words;        // a power of two
  std::uint32_t module;       // index in the run block; kOthers: what no module of the schedule reads or writes
  // Its variables: so many indices, only read, read and written, only written.
  std::uint32_t only_read;
  std::uint32_t both;
  std::uint32_t only_written;
  std::uint64_t items_offset;  // of the indices, from the begin of the tape
  // One cache line has all that each run changes.
  alignas(kLine) std::atomic<std::uint64_t> head;  // words written so far, whole runs only
  std::atomic<std::uint64_t> claimed;              // words up to this one, less the ring's size, may be overwritten
  std::atomic<std::uint64_t> runs;                 // written so far: the number of the next one
  // Of the run of a process module that has begun and not ended: words up to this one are its, those behind `head`;
  // none if `open` is not larger than that. With them who died in it is known.
  std::atomic<std::uint64_t> open;
  std::atomic<std::uint64_t> open_order;  // of its begin
  std::atomic<std::uint64_t> open_flags;
  // Where runs begin, about one for each part of the ring: whoever was overtaken goes on there.
  alignas(kLine) std::atomic<std::uint64_t> marks[kMarks];
};
inline constexpr std::uint32_t kOthers = 0xffffffff;

struct TapeHeader {
  std::atomic<std::uint64_t> magic;  // stored last
  std::uint32_t abi;
  std::uint32_t track_count;
  std::uint64_t total_size;
  std::uint64_t layout_hash;  // of the store whose variables it tells
  std::int32_t node_pid;
  std::uint32_t variable_count;
  std::uint64_t node_start_time;  // field 22 of /proc/PID/stat
  std::uint64_t variables_offset;
  std::uint64_t tracks_offset;
  std::atomic<std::uint64_t> order;  // begins of runs so far
};

}  // namespace indurop::tape
