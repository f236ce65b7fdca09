// SPDX-License-Identifier: Apache-2.0
// How a plane of the mirror gets into the network and out of it again: tried until it succeeds, all or nothing.

#pragma once

#include <atomic>
#include <functional>
#include <string>

#include "mirror/dds_setup.h"
#include "mirror/mirror_block.h"
#include "mirror/settings.h"
#include "rt/signal_word.h"

namespace indurop::mirror {

class Joining {
 public:
  // Makes everything a plane has in the network. False: `problem` says why.
  using Open = std::function<bool(dds_entity_t participant, std::string& problem)>;
  // Deletes all of it, also after an Open that went half way.
  using Close = std::function<void()>;
  Joining(Settings settings, Open open, Close close)
      : settings_(std::move(settings)), open_(std::move(open)), close_(std::move(close)) {}
  Joining(const Joining&) = delete;
  Joining& operator=(const Joining&) = delete;
  ~Joining() { leave(); }

  // Tries twice a second; `problem` shows why it still has not succeeded. DDS's own threads will run where the calling
  // thread may. False if `stop` was set meanwhile, which `wake` tells.
  bool join(const std::atomic<bool>& stop, rt::SignalWord& wake, SharedText& problem);
  // Out of the network, if in it. Waits for listeners that are running.
  void leave() noexcept;
  [[nodiscard]] dds_entity_t participant() const noexcept { return joined_.participant.get(); }

 private:
  bool try_once(std::string& problem);

  Settings settings_;
  Open open_;
  Close close_;
  Participant joined_;
};

}  // namespace indurop::mirror
