// SPDX-License-Identifier: Apache-2.0
// The shared memory of a node can be truncated by any process that may write it, and its names can be removed. The
// first ends the run at once, because values are missing; the second is only reported.

#pragma once

#include <atomic>
#include <string>

#include "node/run/console.h"
#include "node/run/prepared.h"
#include "scheduler/engine.h"

namespace indurop::node {

class MemoryWatch {
 public:
  // All references are borrowed. From here on the engine enters no module once a page is missing.
  MemoryWatch(const std::string& node, Prepared& prepared, scheduler::Engine& engine, Console& console);
  ~MemoryWatch();
  MemoryWatch(const MemoryWatch&) = delete;
  MemoryWatch& operator=(const MemoryWatch&) = delete;

  // Called repeatedly on one normal thread. Returns why the run has to end, also reported on the console; empty if all
  // is present.
  std::string check(rt::MonoTime now);
  [[nodiscard]] bool lost() const noexcept { return !why_.empty(); }

 private:
  static void on_lost_page(void* context, const char* name) noexcept;
  void check_names(rt::MonoTime now);
  void lose(const std::string& file);

  std::string node_;
  Prepared& prepared_;
  scheduler::Engine& engine_;
  Console& console_;
  std::atomic<const char*> missing_{nullptr};  // file whose page was missing
  std::string why_;
  rt::MonoTime next_names_{};
  bool unnamed_ = false;  // already reported
};

}  // namespace indurop::node
