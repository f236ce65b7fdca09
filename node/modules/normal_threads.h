// SPDX-License-Identifier: Apache-2.0
// Non-real-time thread modules: run() once, or every period as exactly as a normal thread can. One thread per module.
// In a simulation the periodic ones run in virtual time, below everything else; the others run freely.

#pragma once

#include <atomic>
#include <cstdint>
#include <memory>
#include <vector>

#include "config/model/config.h"
#include "node/modules/module_library.h"
#include "scheduler/runner.h"

namespace indurop::node {

class NormalThreads {
 public:
  NormalThreads(const config::Config& config, scheduler::RunBlock& run, const std::vector<ModuleLibrary>& libraries,
                const scheduler::Hooks& hooks, scheduler::Kernel& kernel);
  ~NormalThreads();
  NormalThreads(const NormalThreads&) = delete;
  NormalThreads& operator=(const NormalThreads&) = delete;

  void start();
  // Waits at most 2 s for the runs in progress: a run that has not returned by then is ended like an overdue run().
  void stop();

  // For a single module. launch() returns false if there is no thread for it. halt() only requests the end; a run that
  // does not return within the same time is ended by has_ended(), which also returns true for a module without a
  // thread.
  bool launch(std::uint32_t module);
  void halt(std::uint32_t module, rt::MonoTime now);
  bool has_ended(std::uint32_t module, rt::MonoTime now);
  // For an exchange: true as well when the thread has ended, but a run that does not return is not ended.
  bool has_left(std::uint32_t module);
  // Takes halt() back. Returns false if the thread is ending all the same.
  bool go_on(std::uint32_t module) noexcept;

 private:
  struct Normal;
  Normal* find(std::uint32_t module) noexcept;
  void remove(Normal& normal);
  void loop(Normal& normal) noexcept;

  const config::Config& config_;
  scheduler::RunBlock& run_;
  const std::vector<ModuleLibrary>& libraries_;
  scheduler::Hooks hooks_;
  scheduler::Kernel& kernel_;
  scheduler::SystemKernel system_;  // for modules that run freely: a simulation cannot make them wait
  scheduler::CoreTrace trace_;
  std::vector<std::unique_ptr<Normal>> normals_;
  std::atomic<bool> stop_{false};
};

}  // namespace indurop::node
