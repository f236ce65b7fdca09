// SPDX-License-Identifier: Apache-2.0
// Saves retained variables once a second if they changed, on a thread of its own: a slow disk delays no other thread.

#pragma once

#include <atomic>
#include <string>

#include "core/rt/thread.h"
#include "node/run/console.h"
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
  void start();
  // Saves a last time. Returns false if that failed, which is reported on the console.
  [[nodiscard]] bool stop(Console& console);

 private:
  void loop();
  vars::Store& store_;
  vars::RetainFile file_;
  bool any_ = false;
  std::atomic<bool> stop_{false};
  std::atomic<int> failed_{0};  // Errc of the last save
  rt::Thread thread_;
};

}  // namespace indurop::node
