// SPDX-License-Identifier: Apache-2.0
// The tape of a running node: created before the first module starts, written by the threads that run modules.

#pragma once

#include <indurop/result.h>

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "store/tape/plan.h"
#include "store/tape/track.h"
#include "store/tape/versions.h"
#include "store/vars/shm_file.h"
#include "store/vars/store.h"

namespace indurop::tape {

class Tape {
 public:
  // Replaces an older tape of the node; the first values are the present ones. `modules`: number of modules in the run
  // block. The store is borrowed. Not real-time safe. Errors: NoSpace, PermissionDenied (the older file is another
  // user's), System. On error no file is left.
  static Result<std::unique_ptr<Tape>> create(const std::string& node, const vars::Store& store, const TapePlan& plan,
                                              std::size_t modules);

  // Returns the track of a module; null if nothing of it is taped. Real-time safe.
  [[nodiscard]] Track* of(std::uint32_t module) noexcept {
    return module < by_module_.size() ? by_module_[module].track : nullptr;
  }
  // Announces that the module runs soon: prefetches the needed parts of the tape into the cache. On the thread that
  // runs it. Real-time safe.
  void soon(std::uint32_t module) const noexcept;
  // Track::end() of a taped module. Real-time safe.
  bool end(std::uint32_t module, const RunTail& times, std::uint32_t flags) noexcept;
  // The next version of a module's code uses these variables; those that appeared after the start are on the module's
  // track from its next Track::note_exchange() on. Returns those whose values are too long for it. Not real-time safe.
  std::vector<std::uint32_t> offer(std::uint32_t module, std::span<const VariableUse> uses);

  // The versions of modules' code, which runs on the tracks carry. Not real-time safe.
  [[nodiscard]] VersionTable& versions() noexcept { return versions_; }

  // The track of variables that no module of the schedule uses; null if there are none. Real-time safe.
  [[nodiscard]] Track* others() const noexcept { return others_; }

  // Ends the open run of a module whose process is gone as a run that ended by a fault. Not real-time safe.
  void end_of_dead(std::uint32_t module, const RunTail& times);

  void prefault() const noexcept { file_.prefault(); }
  [[nodiscard]] std::uint64_t bytes() const noexcept { return file_.size(); }

 private:
  Tape(vars::ShmFile&& file, const vars::Store& store) : file_(std::move(file)), store_(store) {}
  // Entries of modules that run one after the other are adjacent; the data they point to is not.
  struct Place {
    Track* track = nullptr;
    const void* shared = nullptr;
    const void* next = nullptr;  // position of its next run
  };
  vars::ShmFile file_;
  const vars::Store& store_;
  std::vector<std::unique_ptr<Track>> tracks_;
  std::vector<Place> by_module_;
  Track* others_ = nullptr;
  VersionTable versions_;
};

}  // namespace indurop::tape
