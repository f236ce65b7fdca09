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
    return module < by_module_.size() ? by_module_[module] : nullptr;
  }
  // Of what no module of the schedule knows; null: there is nothing of that kind. Real-time safe.
  [[nodiscard]] Track* others() const noexcept { return others_; }

  // The process of this module is gone: what it was in the middle of is a run that ended by a fault. Not real-time
  // safe.
  void end_of_dead(std::uint32_t module, const RunTail& times);

  void prefault() const noexcept { file_.prefault(); }
  [[nodiscard]] std::uint64_t bytes() const noexcept { return file_.size(); }

 private:
  Tape(vars::ShmFile&& file, const vars::Store& store) : file_(std::move(file)), store_(store) {}
  vars::ShmFile file_;
  const vars::Store& store_;
  std::vector<std::unique_ptr<Track>> tracks_;
  std::vector<Track*> by_module_;
  Track* others_ = nullptr;
};

}  // namespace indurop::tape
