// SPDX-License-Identifier: Apache-2.0
// Joins a plane of the mirror to the network and leaves it again: joining is retried until it succeeds completely.

#pragma once

#include <indurop/result.h>

#include <atomic>
#include <functional>
#include <string>
#include <utility>

#include "core/base/problem.h"
#include "core/base/shared_text.h"
#include "core/rt/signal_word.h"
#include "network/dds/network_settings.h"
#include "network/dds/setup.h"

namespace indurop::dds {

class Joining {
 public:
  // Creates all entities of a plane in the network, or returns why it cannot.
  using Open = std::function<Result<void, base::Problem>(Handle participant)>;
  // Deletes all of them, also after an Open that failed halfway.
  using Close = std::function<void()>;
  Joining(NetworkSettings settings, Open open, Close close)
      : settings_(std::move(settings)), open_(std::move(open)), close_(std::move(close)) {}
  Joining(const Joining&) = delete;
  Joining& operator=(const Joining&) = delete;
  ~Joining() { leave(); }

  // Tries twice a second; `problem` shows why it has not succeeded yet. DDS's own threads will run on the cores of the
  // calling thread. Returns false if `stop` was set meanwhile, which `wake` signals.
  bool join(const std::atomic<bool>& stop, rt::SignalWord& wake, base::SharedText& problem);
  // Leaves the network, if joined. Waits for running listener calls.
  void leave() noexcept;
  [[nodiscard]] Handle participant() const noexcept { return participant_.get(); }

 private:
  // Returns a message for the user, if any, although it succeeded.
  Result<std::string, base::Problem> try_once();

  NetworkSettings settings_;
  Open open_;
  Close close_;
  Participant participant_;
};

}  // namespace indurop::dds
