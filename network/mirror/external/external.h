// SPDX-License-Identifier: Apache-2.0
// The external plane of one board: each of its variables as a typed DDS topic that any DDS tool can read, and can write
// if the variable is marked as writable. It has its own DDS participant and a thread without real-time priority.

#pragma once

#include <indurop/result.h>

#include <memory>
#include <string>

#include "network/mirror/external/external_settings.h"
#include "network/mirror/frames/mirror_block.h"
#include "store/vars/store.h"

namespace indurop::mirror {

class External {
 public:
  // Creates the shared-memory file for tools and starts the thread, which tries to join the network until it succeeds.
  // `store` and `plant` (null: the board belongs to no plant) are borrowed until the end. Variables that the store does
  // not hold are left out. Not real-time safe.
  // Errors: NoSpace, PermissionDenied, System.
  static Result<External> start(const ExternalSettings& settings, const std::string& node, vars::Store& store,
                                const MirrorBlock* plant);
  External(External&&) noexcept;
  External& operator=(External&&) noexcept;
  External(const External&) = delete;
  External& operator=(const External&) = delete;
  ~External();  // calls stop()

  // Publishes the last values, then ends. Not real-time safe.
  void stop() noexcept;

 private:
  struct Impl;
  explicit External(std::unique_ptr<Impl> impl) noexcept;
  std::unique_ptr<Impl> impl_;
};

}  // namespace indurop::mirror
