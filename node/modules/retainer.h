// SPDX-License-Identifier: Apache-2.0
// Saves retained variables once a second if they changed, on a thread of its own: a slow disk delays no other thread.
// What cannot be saved is reported when it begins and ends, and in between by RunBlock::unsaved.

#pragma once

#include <atomic>
#include <string>

#include "core/rt/thread.h"
#include "node/run/console.h"
#include "scheduler/run_block.h"
#include "store/vars/retain.h"
#include "store/vars/store.h"

namespace indurop::node {

class Retainer {
 public:
  Retainer(vars::Store& store, const std::string& node);
  ~Retainer();
  Retainer(const Retainer&) = delete;
  Retainer& operator=(const Retainer&) = delete;

  // Loads values from the disk into a new store, or into one with older values only those whose type has changed;
  // reports what was damaged and what is lost.
  void load(Console& console, bool only_changed);
  // Borrows both until stop().
  void start(scheduler::RunBlock& run, const Console& console);
  // Saves a last time. Returns false if that failed, which is reported on the console.
  [[nodiscard]] bool stop(const Console& console);

 private:
  void loop(scheduler::RunBlock& run, const Console& console);
  vars::Store& store_;
  vars::RetainFile file_;
  bool any_ = false;
  std::atomic<bool> stop_{false};
  rt::Thread thread_;
};

}  // namespace indurop::node
