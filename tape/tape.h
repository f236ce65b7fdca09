// SPDX-License-Identifier: Apache-2.0
// The tape of a node while it runs: made before the first module starts, written by the threads that run modules.

#pragma once

#include <indurop/result.h>

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "tape/plan.h"
#include "tape/track.h"
#include "vars/shm_file.h"
#include "vars/store.h"

namespace indurop::tape {

class Tape {
 public:
  // Takes the place of an older tape of the node; the first values are those of now. `modules`: of the run block.
  // The store is borrowed. Not real-time safe.
  // Errors: NoSpace, PermissionDenied (the older file is another user's), System. Nothing is left behind.
  static Result<std::unique_ptr<Tape>> create(const std::string& node, const vars::Store& store, const TapePlan& plan,
                                              std::size_t modules);

  // Null: nothing of this module is taped. Real-time safe.
  [[nodiscard]] Track* of(std::uint32_t module) noexcept {
    return module < by_module_.size() ? by_module_[module].track : nullptr;
  }
  // It runs soon: what the tape needs for that is fetched into the cache. On the thread that runs it. Real-time safe.
  void soon(std::uint32_t module) const noexcept;
  // Track::end(), of a module that is taped. Likewise.
  bool end(std::uint32_t module, const RunTail& times, std::uint32_t flags) noexcept;
  // Of what no module of the schedule knows; null: there is nothing of that kind. Real-time safe.
  [[nodiscard]] Track* others() const noexcept { return others_; }

  // The process of this module is gone: what it was in the middle of is a run that ended by a fault. Not real-time
  // safe.
  void end_of_dead(std::uint32_t module, const RunTail& times);

  void prefault() const noexcept { file_.prefault(); }
  [[nodiscard]] std::uint64_t bytes() const noexcept { return file_.size(); }

 private:
  Tape(vars::ShmFile&& file, const vars::Store& store) : file_(std::move(file)), store_(store) {}
  // Those of modules that run one after the other lie side by side; what they lead to does not.
  struct Place {
    Track* track = nullptr;
    const void* shared = nullptr;
    const void* next = nullptr;  // where its next run is written
  };
  vars::ShmFile file_;
  const vars::Store& store_;
  std::vector<std::unique_ptr<Track>> tracks_;
  std::vector<Place> by_module_;
  Track* others_ = nullptr;
};

}  // namespace indurop::tape
