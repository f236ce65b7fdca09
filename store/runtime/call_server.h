// SPDX-License-Identifier: Apache-2.0
// The implementing side of shared functions: one thread for each loaded file that implements some, which serves all
// their calls one after the other.

#pragma once

#include <indurop/detail/call.h>
#include <indurop/result.h>

#include <atomic>
#include <cstdint>
#include <memory>
#include <mutex>
#include <vector>

#include "core/rt/thread.h"

namespace indurop::runtime {

// Runs an implementation; returns Failed if it throws, which is reported. Uses the calling thread's own stack.
Errc invoke_contained(const detail::FunctionOffer& offer, const void* arguments, void* result) noexcept;

// Returns the offer of that function if the calling thread is the one that serves it, else null.
const detail::FunctionOffer* offer_of_this_server(std::uint64_t name_hash) noexcept;

class FunctionServers {
 public:
  FunctionServers();
  ~FunctionServers();
  FunctionServers(const FunctionServers&) = delete;
  FunctionServers& operator=(const FunctionServers&) = delete;

  // Called at load and unload of a module.
  void offer(detail::FunctionOffer& offer);
  void withdraw(const detail::FunctionOffer& offer);

  // See host.h. Servers that already run continue.
  Status start(int fifo_priority, int core);
  void stop();

 private:
  class Server;
  struct Offered {
    detail::FunctionOffer* offer;
    const void* owner;     // the loaded file that offers it
    std::uint32_t module;  // the module that was current when it was loaded
  };
  std::mutex mutex_;
  std::vector<Offered> offers_;
  std::vector<std::unique_ptr<Server>> servers_;
};

}  // namespace indurop::runtime
