// SPDX-License-Identifier: Apache-2.0
// The loop that serves all connections: one thread. Limits of size, time and number are kept in this folder; what is
// asked and answered is the house's business.

#pragma once

#include <indurop/result.h>

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>

#include "base/problem.h"
#include "serve/door/house.h"

namespace indurop::serve {

struct DoorSettings {
  std::string bind = "127.0.0.1";
  int port = 8080;  // 0: any
  std::filesystem::path cert;
  std::filesystem::path key;  // with cert: TLS
  std::filesystem::path client_ca;
  std::size_t most_streams = 64;
  bool reserve_streams = false;  // some of them are kept for clients with a token or certificate
};

inline constexpr std::size_t kMostBody = 256U << 10;
inline constexpr std::size_t kMostMessage = 64U << 10;

class Door {
 public:
  // `house` is borrowed. Says why it cannot listen.
  static Result<std::unique_ptr<Door>, base::Problem> open(const DoorSettings& settings, House& house);
  Door(const Door&) = delete;
  Door& operator=(const Door&) = delete;
  ~Door();

  [[nodiscard]] int port() const;
  // Serves until `ended` says so; it is asked after each event, and a signal is one.
  void serve(const std::function<bool()>& ended);
  // The reply to a request; any thread may call it. Nothing happens if the client has gone.
  void reply(Ticket ticket, Reply reply);

  // Calls something after a time, again after each set().
  class Alarm {
   public:
    Alarm(Door& door, std::function<void()> ring);
    Alarm(const Alarm&) = delete;
    Alarm& operator=(const Alarm&) = delete;
    ~Alarm();
    void set(std::int64_t after_ns);
    void stop();
    struct State;

   private:
    std::unique_ptr<State> state_;
  };

  struct Impl;

 private:
  explicit Door(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

}  // namespace indurop::serve
