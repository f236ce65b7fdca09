// SPDX-License-Identifier: Apache-2.0
// The mirror of one board: the values that its modules write appear on the boards that read them, and the reverse. It
// runs in parallel to the schedule and never in it: the network may be absent, broken or slow, the control loop is not
// affected.

#pragma once

#include <indurop/result.h>

#include <atomic>
#include <cstdint>
#include <memory>
#include <string>

#include "network/mirror/frames/mirror_block.h"
#include "network/mirror/frames/schedule.h"
#include "network/mirror/frames/settings.h"
#include "store/vars/store.h"

namespace indurop::mirror {

class Mirror {
 public:
  // Creates the shared-memory file for tools and starts the mirror's threads, which try to join the network until they
  // succeed. `store` and `tick` (number of the current basic period) are borrowed until the end. Not real-time safe.
  // Errors: NoSpace, PermissionDenied, System.
  static Result<Mirror> start(Settings settings, const std::string& node, vars::Store& store,
                              const std::atomic<std::uint64_t>& tick);
  Mirror(Mirror&&) noexcept;
  Mirror& operator=(Mirror&&) noexcept;
  Mirror(const Mirror&) = delete;
  Mirror& operator=(const Mirror&) = delete;
  ~Mirror();  // calls stop()

  // Reports that something may have changed in the store: the mirror checks and sends soon. Real-time safe, any thread.
  void notify() noexcept;

  // The status for tools; valid as long as the mirror. Any thread.
  [[nodiscard]] const MirrorBlock& block() const noexcept;

  // Lets the mirror exchange what these say, as Exchange::follow(), soon. Not real-time safe.
  void follow(const Routes& routes);

  // Reports that the schedule has begun, for comparison with other boards.
  void announce(const Schedule& schedule) noexcept;

  // Leaves the plant: other boards see this one as silent at once. Not real-time safe.
  void stop() noexcept;

 private:
  struct Impl;
  explicit Mirror(std::unique_ptr<Impl> impl) noexcept;
  std::unique_ptr<Impl> impl_;
};

}  // namespace indurop::mirror
