// SPDX-License-Identifier: Apache-2.0
// All streams: which feeds there are, when each is due, who listens to it. Of the door's thread.

#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "serve/api/api.h"
#include "serve/boards/board.h"
#include "serve/door/house.h"
#include "serve/stream/feed.h"
#include "serve/stream/words.h"

namespace indurop::serve {

class Follower;

// What Foxglove is shown.
struct FoxgloveSettings {
  std::vector<std::string> names;  // globs and parts; none: all variables
  double rate_hz = 50;
};

// Why there is no stream.
struct Refusal {
  std::string error;  // for programs
  std::string message;
};

class Hub {
 public:
  // `boards` is borrowed. `wake_at` is told when feeds are due next, in ns from now.
  Hub(Boards& boards, std::string version, FoxgloveSettings foxglove, std::function<void(std::int64_t)> wake_at)
      : boards_(&boards), version_(std::move(version)), foxglove_(std::move(foxglove)), wake_at_(std::move(wake_at)) {}

  std::unique_ptr<Visitor> receive(const Request& request, Line& line);
  // Samples what is due.
  void run(std::int64_t now_ns);
  // Looks for boards that came, went or changed, and tells all.
  void look_around();
  // The same word to all clients.
  void tell_all(const std::string& word);
  [[nodiscard]] std::vector<ClientFigures> clients() const;

  // For clients.
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
  std::map<std::string, std::weak_ptr<Feed>, std::less<>> feeds_;  // by what is looked at
  std::vector<Follower*> clients_;
  std::string boards_word_;
  std::uint32_t last_feed_ = 0;
  std::uint64_t last_client_ = 0;
};

}  // namespace indurop::serve
