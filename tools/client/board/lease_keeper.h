// SPDX-License-Identifier: Apache-2.0
// Forces on boards that hold as long as this process renews them. One thread renews all of them and waits for no single
// answer, so that a board that does not answer delays no other one.

#pragma once

#include <indurop/result.h>

#include <atomic>
#include <condition_variable>
#include <cstdint>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>

#include "deploy/link/command_link.h"
#include "deploy/link/deploy_link.h"
#include "deploy/words/deployment_words.h"
#include "tools/client/board/command_exchange.h"
#include "tools/client/board/plant_watch.h"
#include "tools/client/failure.h"

namespace indurop::tools {

class LeaseKeeper {
 public:
  // A board ends a lease that is not renewed for this time.
  static constexpr std::int64_t kLeaseNs = 5'000'000'000;
  // An agent remembers 64 commanders at a time, and each lease has a commander of its own.
  static constexpr std::size_t kMaxOfBoard = 32;

  // Never null.
  static Result<std::unique_ptr<LeaseKeeper>, Failure> open(deploy::LinkSettings settings);
  LeaseKeeper(const LeaseKeeper&) = delete;
  LeaseKeeper& operator=(const LeaseKeeper&) = delete;
  ~LeaseKeeper() = default;

  // Sends and receives until stop() is called. Then the boards end the leases: they are not renewed.
  void run();
  void stop();

  // For other threads while run() is running. Sends a force (`order`: a PlantWatch::RemoteOrder) with a lease, and
  // waits until the board has answered, a few seconds at most. Returns the number of the lease, which is renewed from
  // now on.
  Result<std::uint64_t, Failure> take(const deploy::BoardReport& board, const PlantWatch::RemoteOrder& order);
  // Returns false if the board no longer has the lease, or has not answered in time.
  [[nodiscard]] bool holds(std::uint64_t lease) const;
  // Does not wait for the board.
  void end(std::uint64_t lease);

 private:
  enum class Stage : std::uint8_t { Taking, Held, Ending };
  struct Lease {
    deploy::Command command;                       // the last one; without its number
    std::optional<CommandExchange> exchange{};     // the one whose answer is awaited
    std::optional<deploy::CommandReply> answer{};  // to the force, for take()
    Stage stage = Stage::Taking;
    std::int64_t begun_ns = 0;  // when the last command was begun
    std::int64_t until_ns = 0;  // when the board ends the lease, if it has not done so
  };
  LeaseKeeper(std::unique_ptr<deploy::DeployLink> link, std::unique_ptr<deploy::CommandLink> commands, CommandKey key)
      : link_(std::move(link)), commands_(std::move(commands)), key_(std::move(key)) {}

  void begin(Lease& lease, std::string target, std::int64_t now_ns) const;
  // Returns the time of its next step, nothing if it has ended.
  std::optional<std::int64_t> step(Lease& lease, std::int64_t now_ns) const;
  void receive(Lease& lease, const deploy::CommandReply& reply);

  std::unique_ptr<deploy::DeployLink> link_;  // used by run(), except for its wake word
  std::unique_ptr<deploy::CommandLink> commands_;
  CommandKey key_;
  std::atomic<bool> stopped_{false};
  mutable std::mutex mutex_;  // of what follows
  std::condition_variable answered_;
  std::map<std::uint64_t, Lease> leases_;  // by commander
};

}  // namespace indurop::tools
