// SPDX-License-Identifier: Apache-2.0
// The writing end of a process module: it records its own runs, on the track that the node created for it.

#pragma once

#include <indurop/result.h>

#include <cstdint>
#include <memory>
#include <span>
#include <string>

#include "store/tape/track.h"
#include "store/vars/shm_file.h"
#include "store/vars/store.h"

namespace indurop::tape {

class Member {
 public:
  // The store is borrowed. Errors: NotFound (no tape, or none of this module), PermissionDenied, VersionMismatch,
  // Corrupt, System. Not real-time safe.
  static Result<Member> open(const std::string& node, std::uint32_t module, const vars::Store& store);

  [[nodiscard]] Track& track() const noexcept { return *track_; }
  // Returns true if the node's store has variables that it did not have when the tape was made.
  [[nodiscard]] bool has_later_variables() const noexcept;
  // Those of `uses` that are such variables are recorded, too. Before the first run; not real-time safe.
  void add_later(std::span<const VariableUse> uses, const vars::Store& store);

 private:
  Member(vars::ShmFile&& file, std::unique_ptr<Track> track) : file_(std::move(file)), track_(std::move(track)) {}
  vars::ShmFile file_;
  std::unique_ptr<Track> track_;
};

}  // namespace indurop::tape
