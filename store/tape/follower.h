// SPDX-License-Identifier: Apache-2.0
// The reading end: runs of a node's tape, from a mapping that cannot disturb the node. No content of the memory is
// trusted before it was checked against its size. Not real-time safe; one thread at a time.

#pragma once

#include <indurop/result.h>

#include <cstdint>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "store/tape/check.h"
#include "store/tape/layout.h"
#include "store/vars/shm_file.h"

namespace indurop::tape {

struct Value {
  EntryKind kind{};
  std::uint32_t variable = 0;  // index in the store's directory
  std::span<const std::uint8_t> bytes;
};

// The answer of a call or a channel to a run.
struct Answer {
  std::int64_t code = 0;  // kTooLongToTell: the rest was not recorded
  std::span<const std::uint8_t> bytes;
};

struct Run {
  std::uint32_t module = 0;  // index in the run block, or kOthers
  std::uint32_t flags = 0;
  RunTail tail;
  std::vector<Value> values;         // in the order of the track
  std::vector<std::int64_t> clock;   // results of irp::now_ns()
  std::vector<Answer> answers;       // in the order of its calls
  std::vector<std::uint64_t> words;  // the data that the values point into
};

class Follower {
 public:
  // `from_start`: begins with the oldest run still available; else with the next one.
  // Errors: NotFound (no such node, or it has no tape), PermissionDenied, VersionMismatch, Corrupt, System.
  static Result<Follower> open(const std::string& node, bool from_start);

  [[nodiscard]] const TapeHeader& header() const noexcept;
  [[nodiscard]] std::span<const TapeVariable> variables() const noexcept { return index_.variables; }
  // The value before any module was started.
  [[nodiscard]] std::span<const std::uint8_t> first_value(std::uint32_t variable) const noexcept;
  [[nodiscard]] std::size_t tracks() const noexcept { return places_.size(); }
  [[nodiscard]] std::uint32_t module_of(std::size_t track) const noexcept { return places_[track].module; }

  // The variables on a track: those that its module only reads, and those it writes.
  struct Items {
    std::span<const std::uint32_t> only_read;
    std::span<const std::uint32_t> written;
  };
  [[nodiscard]] Items items_of(std::size_t track) const noexcept;

  // Reads the next run of a track; `run` is reused. Returns false if there is none yet.
  bool next(std::size_t track, Run& run);
  // Runs of the track that were overwritten before they were read.
  [[nodiscard]] std::uint64_t lost(std::size_t track) const noexcept { return places_[track].lost; }

 private:
  struct Place {
    const TapeTrack* shared = nullptr;
    const std::uint64_t* words = nullptr;
    std::uint64_t mask = 0;
    std::uint32_t module = 0;
    std::uint64_t at = 0;
    std::uint64_t next_number = 0;
    std::uint64_t lost = 0;
    bool any = false;  // a run was read, so the numbers show what is lost
  };
  enum class Reading { Whole, Overtaken, Corrupt };

  Follower(vars::ShmFile&& file, TapeIndex&& index) : file_(std::move(file)), index_(std::move(index)) {}
  void find_tracks();
  void point_to(const std::vector<std::pair<EntryHead, std::size_t>>& found, Run& run) const;
  Reading read_run(const Place& place, std::uint64_t head, Run& run, std::uint64_t& length) const;
  [[nodiscard]] static std::uint64_t oldest(const Place& place, std::uint64_t head) noexcept;
  // Returns false if the words at this place in the track have been overwritten.
  static bool copy(const Place& place, std::uint64_t from, std::uint64_t count, std::vector<std::uint64_t>& to);

  vars::ShmFile file_;
  TapeIndex index_;
  std::vector<Place> places_;
};

}  // namespace indurop::tape
