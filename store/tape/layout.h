// SPDX-License-Identifier: Apache-2.0
// Layout of the tape: header, variables, their first values, versions of modules, and one track for each module. A
// track is a ring of 64-bit words that one thread writes without ever waiting; a reader that is too slow loses the
// oldest runs and detects that. A run on its track: the values at its start that differ from the last ones on the
// track, the changes during the run of variables that it does not write, the values it wrote, one more of them in
// rotation whether it changed or not, and Run at the end. Any change here requires a new kTapeAbi.

#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <type_traits>

namespace indurop::tape {

inline constexpr std::uint64_t kTapeMagic = 0x3145504154444e49ULL;  // "INDTAPE1"
inline constexpr std::uint32_t kTapeAbi = 6;

enum class EntryKind : std::uint32_t {
  Before = 1,  // value at the start of a run
  During,      // value of a variable it reads, changed by another writer during the run
  After,       // value after the run
  Again,       // unchanged value, so that a late reader eventually gets all of them
  Run,         // the end of a run; kRunWords words
  Clock,       // result of irp::now_ns(); one word
  Answer,      // answer to a call of a shared function, a channel read or an age query: a code, then the bytes
};

// First word of an entry. It is followed by the value's bytes, in whole words, or by RunTail.
struct EntryHead {
  EntryKind kind{};
  std::uint32_t which = 0;  // index of a variable; for Run: RunFlags; for Answer: number of bytes
};
static_assert(sizeof(EntryHead) == sizeof(std::uint64_t) && std::is_trivially_copyable_v<EntryHead>);

enum RunFlags : std::uint32_t {
  kFaulted = 1,    // it ended by a fault
  kRestarted = 2,  // its module was restarted since its previous run
  kExchanged = 4,  // another version of its module's code runs since its previous run
};
// The flags above these bits: number of the TapeVersion that ran; 0: not known, as of processes.
inline constexpr std::uint32_t kVersionShift = 16;
inline constexpr std::uint32_t kMaxVersionNumber = 0xffff;

// Maximum clock readings recorded per run: a run with more of them waits for something, or measures.
inline constexpr int kMaxReadings = 64;
// Maximum answers recorded per run. An answer longer than the track can hold next to runs is recorded without its
// bytes.
inline constexpr int kMaxAnswers = 1024;
inline constexpr std::uint64_t kAnswerShare = 16;          // a run may use 1/kAnswerShare of a track's words for that
inline constexpr std::int64_t kTooLongToTell = INT64_MIN;  // as code

// The words after the head of Run.
struct RunTail {
  std::uint64_t number = 0;  // number of the run on this track, from 0
  std::uint64_t order = 0;   // number of its start among the runs of all tracks
  std::uint64_t tick = 0;
  std::int64_t release_ns = 0;  // in the node's time, like the others
  std::int64_t start_ns = 0;
  std::int64_t end_ns = 0;
};
inline constexpr std::uint64_t kRunWords = sizeof(RunTail) / sizeof(std::uint64_t);

constexpr std::uint64_t words_of(std::uint64_t bytes) noexcept {
  return (bytes + sizeof(std::uint64_t) - 1) / sizeof(std::uint64_t);
}

// Entry i belongs to entry i of the store's directory. Those of variables that appear while the node runs follow those
// of the start, in kLaterVariables more places; they have no first value.
inline constexpr std::uint32_t kLaterVariables = 1024;
struct TapeVariable {
  std::uint64_t name_hash;
  std::uint64_t first_offset;  // of its first value, from the start of the tape
  std::uint32_t size;
  std::uint32_t taped;  // 0: on no track, because it is too large
};

inline constexpr std::size_t kLine = 64;  // bytes of a cache line
inline constexpr std::size_t kMarks = 16;
struct TapeTrack {
  std::uint64_t data_offset;  // of its words, from the start of the tape
  std::uint64_t words;        // a power of two
  std::uint32_t module;       // index in the run block; kOthers: variables that no module of the schedule reads or
                              // index in the run block; kOthers: variables that no scheduled module uses
  std::uint32_t only_read;
  std::uint32_t both;
  std::uint32_t only_written;
  std::uint64_t items_offset;  // of the indices, from the start of the tape
  // One cache line has everything that each run changes.
  alignas(kLine) std::atomic<std::uint64_t> head;  // words written so far, whole runs only
  std::atomic<std::uint64_t> claimed;              // words up to this one, less the ring's size, may be overwritten
  std::atomic<std::uint64_t> runs;                 // runs written so far: the number of the next one
  // For the run of a process module that has begun and not ended: words after `head` up to this one belong to it; none
  // if `open` is not larger than `head`. They identify a run in which the process died.
  std::atomic<std::uint64_t> open;
  std::atomic<std::uint64_t> open_order;  // of its start
  std::atomic<std::uint64_t> open_flags;
  // Starts of runs, about one for each part of the ring: an overtaken reader continues there.
  alignas(kLine) std::atomic<std::uint64_t> marks[kMarks];
};
inline constexpr std::uint32_t kOthers = 0xffffffff;

// A version of a module's code that was loaded. Those with which the node started are the first ones; later ones share
// kLaterVersions places in rotation. Another load of the same file is another version.
struct TapeVersion {
  std::atomic<std::uint32_t> number;  // from 1; stored last; 0: none, or it is being written
  std::uint32_t module;               // index in the run block
  char digest[72];                    // SHA-256 of its file
  char file[432];                     // path with which it was loaded; empty: it is longer
};
inline constexpr std::uint32_t kLaterVersions = 64;

struct TapeHeader {
  std::atomic<std::uint64_t> magic;  // stored last
  std::uint32_t abi;
  std::uint32_t track_count;
  std::uint64_t total_size;
  std::uint64_t layout_hash;  // of the store that has the variables
  std::int32_t node_pid;
  std::uint32_t variable_count;
  std::uint64_t node_start_time;  // field 22 of /proc/PID/stat
  std::uint64_t variables_offset;
  std::uint64_t tracks_offset;
  std::uint64_t versions_offset;
  std::uint32_t start_versions;                // places for versions of the start: one for each module
  std::atomic<std::uint32_t> later_variables;  // number of them; stored after their entries
  std::atomic<std::uint64_t> order;            // number of runs started so far
};

}  // namespace indurop::tape
