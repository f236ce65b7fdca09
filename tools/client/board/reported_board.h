// SPDX-License-Identifier: Apache-2.0
// The variables of a remote board, as its agent reports them, in a private store like that of a local node: one thread
// writes it, a few others read it. Leaves nothing in /dev/shm.

#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>

#include "core/base/json.h"
#include "store/vars/store.h"

namespace indurop::tools {

// Prefix of the names of this process's stores, as long as they have one, and of its replays: they are not nodes.
std::string remote_store_prefix();

class ReportedBoard {
 public:
  static constexpr std::size_t kReaders = 3;

  explicit ReportedBoard(std::string name) : name_(std::move(name)) {}
  ReportedBoard(const ReportedBoard&) = delete;
  ReportedBoard& operator=(const ReportedBoard&) = delete;

  // For the thread that receives from the board. Invalid input changes nothing and returns false.
  [[nodiscard]] bool knows_variables() const;
  bool take_variables(std::string_view text);
  enum class Taken : std::uint8_t { Yes, OtherVariables, Nonsense };
  Taken take_values(std::string_view text, std::int64_t now_ns);
  // `row`: the board's entry in the output of `indurop boards`; "heard" and "state" are evaluated.
  void update(const base::Json& row);
  // Marks its values as not current.
  void silent();
  // Returns true if it is time to request values again: soon if a client requests them and they are not too many bytes,
  // else now and then.
  [[nodiscard]] bool due(std::int64_t now_ns) const;

  // For any thread.
  void want(std::int64_t now_ns) noexcept { wanted_ns_.store(now_ns, std::memory_order_relaxed); }
  [[nodiscard]] const std::string& name() const noexcept { return name_; }
  // If it differs from the one when it was attached: attach again. Each reader may attach once to each.
  [[nodiscard]] std::uint64_t generation() const noexcept { return generation_.load(std::memory_order_acquire); }
  // Errors: NotFound (nothing was received yet), Busy (this reader has it already).
  Result<vars::Store> attach(std::size_t reader);
  struct Report {
    base::Json row;
    base::Json forces = base::Json::array();  // format of json_of(ForceView)
    base::Json lock;
    base::Json alarms;  // their number, format of json_of(AlarmCounts); null: not reported
    std::string state;  // "running", "not heard, last 3.2 s ago"
    std::string layout;
    bool heard = false;
    bool running = false;  // the node runs and the board is received
    bool values = false;   // values are being received
  };
  [[nodiscard]] Report report() const;

 private:
  void hold(const base::Json& forces);
  void write(std::string_view bytes, std::int64_t now_ns);

  std::string name_;
  std::atomic<std::int64_t> wanted_ns_{0};
  std::atomic<std::uint64_t> generation_{0};

  mutable std::mutex mutex_;  // protects all members below
  Report report_;
  std::optional<vars::Store> store_;  // the one that is written
  std::array<std::optional<vars::Store>, kReaders> views_;
  bool node_runs_ = false;  // as received with its values
  std::string forced_;      // forces as received last
  std::int64_t next_ns_ = 0;
};

}  // namespace indurop::tools
