// SPDX-License-Identifier: Apache-2.0
// Data that all answers share: the boards, the gate that decides who may write, and facts about the server.

#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "core/base/json.h"
#include "history/alarms/alarm_book.h"
#include "tools/client/history/value_history.h"
#include "tools/client/node/known_uses.h"
#include "tools/serve/api/call_pace.h"
#include "tools/serve/audit.h"
#include "tools/serve/door/access_gate.h"

namespace indurop::serve {

inline constexpr const char* kApiVersion = "1.0.0";
inline constexpr double kMostRateHz = 100;

// One client of the stream, as /api/v1/status reports it.
struct ClientFigures {
  std::uint64_t id = 0;
  std::string address;
  std::int64_t since_ns = 0;  // CLOCK_MONOTONIC
  std::uint64_t streams = 0;
  std::uint64_t sent = 0;
  std::uint64_t dropped = 0;
  std::uint64_t sent_bytes = 0;
};

struct ServerFacts {
  std::string version;
  std::size_t most_clients = 0;
  bool web = false;
  std::filesystem::path recordings;  // folder of recordings; empty: black boxes only
  bool plant = false;                // remote boards are served too
  bool plc = false;                  // a PLC program is served too
  std::vector<std::string> metrics;  // patterns of variables whose values are metrics
  std::vector<std::string> calls;    // patterns of shared functions that clients may call
  std::int64_t started_wall_ns = 0;
  std::int64_t started_ns = 0;
  std::function<std::vector<ClientFigures>()> clients;
  std::function<alarms::AlarmCounts(const std::string& board)> alarms;
  // Returns the refusal of a request by the rights of now, and sets its client. May be called by any thread.
  std::function<std::optional<Reply>(Request& request)> refuse;
};

class Board;
class JogDesk;
class LeaseDesk;
class UserBook;

class Api {
 public:
  Api(const AccessGate& gate, UserBook& users, Audit& audit, LeaseDesk& leases, JogDesk& jogs, ServerFacts facts)
      : gate_(&gate),
        users_(&users),
        audit_(&audit),
        leases_(&leases),
        jogs_(&jogs),
        facts_(std::move(facts)),
        history_(facts_.recordings) {}

  [[nodiscard]] const AccessGate& gate() const noexcept { return *gate_; }
  [[nodiscard]] UserBook& users() const noexcept { return *users_; }
  [[nodiscard]] const ServerFacts& facts() const noexcept { return facts_; }
  [[nodiscard]] Audit& audit() const noexcept { return *audit_; }
  [[nodiscard]] LeaseDesk& leases() const noexcept { return *leases_; }
  [[nodiscard]] JogDesk& jogs() const noexcept { return *jogs_; }
  // Returns the writers and readers of each variable, read once per run of the board; none for boards of other hosts.
  // Called by the thread that reads files.
  const tools::KnownUses& uses_of(const Board& board);
  // Called by the thread that reads histories.
  [[nodiscard]] tools::ValueHistory& history() noexcept { return history_; }
  // Called by the thread that calls shared functions.
  [[nodiscard]] CallPace& calls() noexcept { return calls_; }

 private:
  struct Cached {
    std::int64_t started_wall_ns = 0;
    tools::KnownUses uses;
  };

  const AccessGate* gate_;
  UserBook* users_;
  Audit* audit_;
  LeaseDesk* leases_;
  JogDesk* jogs_;
  ServerFacts facts_;
  tools::ValueHistory history_;
  CallPace calls_;
  std::map<std::string, Cached, std::less<>> uses_;
};

// The OpenAPI description that is compiled in.
std::string_view api_description() noexcept;

}  // namespace indurop::serve
