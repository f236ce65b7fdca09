// SPDX-License-Identifier: Apache-2.0
// Sends and receives pools of a node: waits for the node and the network, then runs a thread for each pool.

#pragma once

#include <indurop/result.h>

#include <atomic>
#include <cstdint>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include "core/base/log.h"
#include "core/base/stop_signal.h"
#include "doors/pools/options.h"
#include "doors/pools/receiver.h"
#include "doors/pools/sender.h"
#include "network/dds/setup.h"
#include "tools/client/failure.h"

namespace indurop::pool_door {

class PoolDoor {
 public:
  explicit PoolDoor(DoorOptions options);
  PoolDoor(const PoolDoor&) = delete;
  PoolDoor& operator=(const PoolDoor&) = delete;
  ~PoolDoor() { end_threads(); }

  // Runs until a signal. Errors: a name that means no pool of the node, keys, a topic that DDS refuses.
  Result<void, tools::Failure> run(base::StopSignal& stop);

 private:
  Result<void, tools::Failure> find_node(base::StopSignal& stop);
  Result<void, tools::Failure> find_pools();
  // Returns false after a signal.
  bool wait_for(base::StopSignal& stop, const std::string& what);
  bool join(base::StopSignal& stop, const dds::NetworkSettings& network);
  Result<void, tools::Failure> open(const std::string& plant);
  void start_threads();
  void end_threads() noexcept;
  void report() const;

  DoorOptions options_;
  std::string node_;
  std::vector<SentPool> sent_;
  base::Log log_;
  std::string waited_for_;
  std::atomic<bool> stop_{false};
  dds::Participant participant_;
  std::vector<std::unique_ptr<Sender>> senders_;
  std::vector<std::unique_ptr<Receiver>> receivers_;
  std::vector<std::thread> threads_;
};

}  // namespace indurop::pool_door
