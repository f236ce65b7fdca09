// SPDX-License-Identifier: Apache-2.0
// Versions of modules that run no more: their stop() is called on a normal thread, where it changes nothing of the
// plant, and they are unloaded. Not real-time safe.

#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "node/modules/module_library.h"
#include "node/run/phases.h"

namespace indurop::node {

class Retired {
 public:
  // All references are borrowed.
  Retired(scheduler::RunBlock& run, Phases& phases, const Console& console)
      : run_(run), phases_(phases), console_(console) {}

  // Takes over a version that is not entered any more.
  void add(std::uint32_t module, ModuleLibrary&& library);
  // The same for one whose code was left in the middle: it stays in memory, since it may hold anything.
  void abandon(std::uint32_t module, ModuleLibrary&& library);
  void poll(rt::MonoTime now);
  // Waits for all of them.
  void end();

 private:
  struct One {
    std::uint32_t module = 0;
    ModuleLibrary library;
    Phases::CallPointer call;
  };
  void unload(One& one);
  void count(std::uint32_t module, const std::string& why);

  scheduler::RunBlock& run_;
  Phases& phases_;
  const Console& console_;
  std::vector<One> all_;
};

}  // namespace indurop::node
