// SPDX-License-Identifier: Apache-2.0
// All streams: which feeds exist, when each is due, and its clients. Used by the door's thread only.

#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "tools/serve/api/api.h"
#include "tools/serve/boards/boards.h"
#include "tools/serve/door/house.h"
#include "tools/serve/stream/feed.h"
#include "tools/serve/stream/words.h"

namespace indurop::serve {

class Follower;

// The variables that Foxglove gets, and their rate.
struct FoxgloveSettings {
  std::vector<std::string> names;  // globs and exact parts; none: all variables
  double rate_hz = 50;
};

// Why a stream is refused.
struct Refusal {
  std::string error;  // for programs
  std::string message;
};

class Hub {
 public:
  // `boards` is borrowed. `wake_at` is called with the time until the next feed is due, in ns from now.
  Hub(Boards& boards, std::string version, FoxgloveSettings foxglove, std::function<void(std::int64_t)> wake_at)
      : boards_(&boards), version_(std::move(version)), foxglove_(std::move(foxglove)), wake_at_(std::move(wake_at)) {}

  std::unique_ptr<Visitor> receive(const Request& request, Line& line);
  // Samples the feeds that are due.
  void run(std::int64_t now_ns);
  // Checks for boards that came, went or changed, and notifies all clients.
  void update_boards();
  // Sends the same message to all clients.
  void send_to_all(const std::string& word);
  [[nodiscard]] std::vector<ClientFigures> clients() const;

  // The following functions are for clients.
  Result<std::shared_ptr<Feed>, Refusal> feed_for(const ClientWord& word);
  void leave(Follower& client);
  [[nodiscard]] const std::string& boards_word() const noexcept { return boards_word_; }
  [[nodiscard]] std::string hello() const;
  [[nodiscard]] Boards& boards() const noexcept { return *boards_; }
  [[nodiscard]] const std::string& version() const noexcept { return version_; }

 private:
  void end(const Feed& feed);
  void wake();

  Boards* boards_;
  std::string version_;
  FoxgloveSettings foxglove_;
  std::function<void(std::int64_t)> wake_at_;
  std::map<std::string, std::weak_ptr<Feed>, std::less<>> feeds_;  // by board, names and rate
  std::vector<Follower*> clients_;
  std::string boards_word_;
  std::uint32_t last_feed_ = 0;
  std::uint64_t last_client_ = 0;
};

}  // namespace indurop::serve
