// SPDX-License-Identifier: Apache-2.0
// The implementing side of shared functions: one thread for each loaded file that implements some, which serves the
// calls of all of them one after the other.

#pragma once

#include <indurop/detail/call.h>
#include <indurop/result.h>

#include <atomic>
#include <cstdint>
#include <memory>
#include <mutex>
#include <vector>

#include "rt/thread.h"

namespace indurop::runtime {

// Runs an implementation; Failed if it throws, which is reported. The calling thread's own stack.
Errc invoke_contained(const detail::FunctionOffer& offer, const void* arguments, void* result) noexcept;

// The offer of that function if the calling thread is the one that serves it, else null.
const detail::FunctionOffer* offer_of_this_server(std::uint64_t name_hash) noexcept;

class FunctionServers {
 public:
  FunctionServers();
  ~FunctionServers();
  FunctionServers(const FunctionServers&) = delete;
  FunctionServers& operator=(const FunctionServers&) = delete;

  // At load and unload of a module.
  void offer(detail::FunctionOffer& offer);
  void withdraw(const detail::FunctionOffer& offer);

  // See host.h. Servers that run already go on.
  Status start(int fifo_priority, int core);
  void stop();

 private:
  class Server;
  struct Offered {
    detail::FunctionOffer* offer;
    const void* owner;     // the loaded file it came from
    std::uint32_t module;  // that was current when it was loaded
  };
  std::mutex mutex_;
  std::vector<Offered> offers_;
  std::vector<std::unique_ptr<Server>> servers_;
};

}  // namespace indurop::runtime
