// SPDX-License-Identifier: Apache-2.0
// The variables of a board elsewhere, as its agent says them, in a private store like that of a node here: one thread
// fills it, a few others read it alike. Leaves nothing behind in /dev/shm.

#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>

#include "base/json.h"
#include "vars/store.h"

namespace indurop::tools {

// What stores of this process are called as long as they have a name: not nodes.
std::string remote_store_prefix();

class RemoteBoard {
 public:
  static constexpr std::size_t kReaders = 2;

  explicit RemoteBoard(std::string name) : name_(std::move(name)) {}
  RemoteBoard(const RemoteBoard&) = delete;
  RemoteBoard& operator=(const RemoteBoard&) = delete;

  // Of the thread that hears the board. What makes no sense changes nothing and is false.
  [[nodiscard]] bool knows_variables() const;
  bool take_variables(std::string_view text);
  enum class Taken : std::uint8_t { Yes, OtherVariables, Nonsense };
  Taken take_values(std::string_view text, std::int64_t now_ns);
  // `row`: what `indurop boards` says of it; "heard" and "state" are looked at.
  void look_at(const base::Json& row);
  // Its values are not what it has now.
  void silent();
  // It is time to ask for values again: soon if somebody wants them and they are not too many bytes, else now and then.
  [[nodiscard]] bool due(std::int64_t now_ns) const;

  // Of any thread.
  void want(std::int64_t now_ns) noexcept { wanted_ns_.store(now_ns, std::memory_order_relaxed); }
  [[nodiscard]] const std::string& name() const noexcept { return name_; }
  // Another one than when it was attached: attach again. Each reader once for each.
  [[nodiscard]] std::uint64_t generation() const noexcept { return generation_.load(std::memory_order_acquire); }
  // Errors: NotFound (nothing has come yet), Busy (this reader has it).
  Result<vars::Store> attach(std::size_t reader);
  struct Said {
    base::Json row;
    base::Json forces = base::Json::array();  // as json_of(ForceView) has them
    base::Json lock;
    base::Json alarms;  // how many, as json_of(AlarmCounts) has them; none: it does not say
    std::string state;  // "running", "not heard, last 3.2 s ago"
    std::string layout;
    bool heard = false;
    bool running = false;  // its node, and it is heard
    bool values = false;   // they are being said
  };
  [[nodiscard]] Said said() const;

 private:
  void hold(const base::Json& forces);
  void write(std::string_view bytes, std::int64_t now_ns);

  std::string name_;
  std::atomic<std::int64_t> wanted_ns_{0};
  std::atomic<std::uint64_t> generation_{0};

  mutable std::mutex mutex_;  // all below
  Said said_;
  std::optional<vars::Store> store_;  // filled
  std::array<std::optional<vars::Store>, kReaders> views_;
  bool node_runs_ = false;  // by its values
  std::string forced_;      // by what it was said
  std::int64_t next_ns_ = 0;
};

}  // namespace indurop::tools
