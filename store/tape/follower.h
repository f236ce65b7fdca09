// SPDX-License-Identifier: Apache-2.0
// The reading end: runs of a node's tape, from a mapping that cannot disturb the node. No content of the memory is
// trusted before it was checked against its size. Not real-time safe; one thread at a time.

#pragma once

#include <indurop/result.h>

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "store/tape/check.h"
#include "store/tape/layout.h"
#include "store/tape/track_reader.h"
#include "store/tape/versions.h"
#include "store/vars/shm_file.h"
#include "store/vars/store.h"

namespace indurop::tape {

class Follower {
 public:
  // `from_start`: begins with the oldest run still available; else with the next one.
  // Errors: NotFound (no such node, or it has no tape), PermissionDenied, VersionMismatch, Corrupt, System.
  static Result<Follower> open(const std::string& node, bool from_start);

  [[nodiscard]] const TapeHeader& header() const noexcept;
  [[nodiscard]] std::span<const TapeVariable> variables() const noexcept {
    return std::span(index_.variables).first(shows_later_ ? index_.variables.size() : header_variables_);
  }
  // Shows variables that appear while the node runs, too: variables() and the values of runs then have more of them
  // from any next() on.
  void show_later_variables() noexcept { shows_later_ = true; }
  // Returns true if its variables are those that the store had when its node started.
  [[nodiscard]] bool is_of(const vars::Store& store) const noexcept;
  // The value before any module was started; empty: the variable appeared later.
  [[nodiscard]] std::span<const std::uint8_t> first_value(std::uint32_t variable) const noexcept;
  [[nodiscard]] std::size_t tracks() const noexcept { return tracks_.size(); }
  [[nodiscard]] std::uint32_t module_of(std::size_t track) const noexcept { return tracks_[track].module(); }

  // The variables on a track: those that its module only reads, and those it writes.
  struct Items {
    std::span<const std::uint32_t> only_read;
    std::span<const std::uint32_t> written;
  };
  [[nodiscard]] Items items_of(std::size_t track) const noexcept;

  // Returns the version of this number (versions.h); nothing: its place was taken by a later one.
  [[nodiscard]] std::optional<Version> version(std::uint32_t number) const;

  // Reads the next run of a track; `run` is reused. Returns false if there is none yet.
  bool next(std::size_t track, Run& run) { return next(track, run, end_of(track)); }
  // The same of the runs that had ended when end_of() returned `end`.
  bool next(std::size_t track, Run& run, std::uint64_t end) {
    take_later_variables();  // those of all runs before `end`
    return tracks_[track].next(run, end);
  }
  // Position behind the last run of the track that has ended.
  [[nodiscard]] std::uint64_t end_of(std::size_t track) const noexcept { return tracks_[track].written(); }
  // Runs that were written on the track so far.
  [[nodiscard]] std::uint64_t runs(std::size_t track) const noexcept { return tracks_[track].runs(); }
  // Runs of the track that were overwritten before they were read.
  [[nodiscard]] std::uint64_t lost(std::size_t track) const noexcept { return tracks_[track].lost(); }

 private:
  Follower(vars::ShmFile&& file, TapeIndex&& index)
      : file_(std::move(file)), index_(std::move(index)), header_variables_(index_.variables.size()) {}
  void take_later_variables();
  void find_tracks(bool from_start);

  vars::ShmFile file_;
  TapeIndex index_;
  std::size_t header_variables_;  // those of the start
  bool shows_later_ = false;
  bool shown_later_ = false;  // to the readers
  std::vector<TrackReader> tracks_;
};

}  // namespace indurop::tape
