// SPDX-License-Identifier: Apache-2.0
// How a plane of the mirror gets into the network and out of it again: tried until it succeeds, all or nothing.

#pragma once

#include <indurop/result.h>

#include <atomic>
#include <functional>
#include <string>
#include <utility>

#include "base/problem.h"
#include "base/shared_text.h"
#include "dds/network_settings.h"
#include "dds/setup.h"
#include "rt/signal_word.h"

namespace indurop::dds {

class Joining {
 public:
  // Makes everything a plane has in the network, or says why it cannot.
  using Open = std::function<Result<void, base::Problem>(Handle participant)>;
  // Deletes all of it, also after an Open that went half way.
  using Close = std::function<void()>;
  Joining(NetworkSettings settings, Open open, Close close)
      : settings_(std::move(settings)), open_(std::move(open)), close_(std::move(close)) {}
  Joining(const Joining&) = delete;
  Joining& operator=(const Joining&) = delete;
  ~Joining() { leave(); }

  // Tries twice a second; `problem` shows why it still has not succeeded. DDS's own threads will run where the calling
  // thread may. False if `stop` was set meanwhile, which `wake` tells.
  bool join(const std::atomic<bool>& stop, rt::SignalWord& wake, base::SharedText& problem);
  // Out of the network, if in it. Waits for listeners that are running.
  void leave() noexcept;
  [[nodiscard]] Handle participant() const noexcept { return participant_.get(); }

 private:
  // What the user should know although it succeeded.
  Result<std::string, base::Problem> try_once();

  NetworkSettings settings_;
  Open open_;
  Close close_;
  Participant participant_;
};

}  // namespace indurop::dds
