// SPDX-License-Identifier: Apache-2.0
// The loop that serves all connections in one thread. This folder limits sizes, times and numbers; requests are
// answered by the House.

#pragma once

#include <indurop/result.h>

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>

#include "core/base/problem.h"
#include "tools/serve/door/house.h"

namespace indurop::serve {

struct DoorSettings {
  std::string bind = "127.0.0.1";
  int port = 8080;  // 0: any free port
  std::filesystem::path cert;
  std::filesystem::path key;  // with `cert`: enables TLS
  std::filesystem::path client_ca;
  std::size_t most_streams = 64;
  bool reserve_streams = false;  // some streams are reserved for clients with a token or certificate
};

inline constexpr std::size_t kMostBody = 256U << 10;
inline constexpr std::size_t kMostMessage = 64U << 10;

class Door {
 public:
  // `house` is borrowed. Errors: why it cannot listen.
  static Result<std::unique_ptr<Door>, base::Problem> open(const DoorSettings& settings, House& house);
  Door(const Door&) = delete;
  Door& operator=(const Door&) = delete;
  ~Door();

  [[nodiscard]] int port() const;
  // Serves until `ended` returns true; it is called after each event, a signal included.
  void serve(const std::function<bool()>& ended);
  // Sends the reply to a request; may be called by any thread. Does nothing if the client has gone.
  void reply(Ticket ticket, Reply reply);

  // Calls a function after a time, once for each set().
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
