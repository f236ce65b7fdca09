// SPDX-License-Identifier: Apache-2.0
// Forces that end with their client: they hold as long as it renews within the time of a lease. They are leases in the
// node's table of forces, so they end too if this server dies. Those of a board of another host are renewed in the
// background (tools/client/board/lease_keeper.h): no client waits for a board.

#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "store/operate/hold.h"
#include "store/operate/who.h"
#include "store/vars/store.h"
#include "tools/client/board/lease_keeper.h"
#include "tools/serve/audit.h"
#include "tools/serve/desk.h"
#include "tools/serve/door/request.h"
#include "tools/serve/worker.h"

namespace indurop::serve {

class LeaseDesk {
 public:
  // Time after the last renewal: browsers let pages in the background send once a second only.
  static constexpr std::int64_t kLeaseNs = tools::LeaseKeeper::kLeaseNs;

  // `link`: how boards of other hosts are reached; must outlive the desk.
  LeaseDesk(const Audit& audit, const deploy::LinkSettings& link) : link_(link), desk_(audit, "release", kLeaseNs) {}
  LeaseDesk(const LeaseDesk&) = delete;
  LeaseDesk& operator=(const LeaseDesk&) = delete;
  ~LeaseDesk();

  // A force that a client takes.
  struct Taken {
    operate::Who who;
    std::string what;                    // for the audit log
    std::vector<std::string> variables;  // full names
  };
  // Starts a lease; may be called by any thread. Returns the name to renew it by, which cannot be guessed. `store`: the
  // current one of the board.
  std::string take(const std::string& board, Taken taken, const vars::Store& store, operate::Lease lease);
  // The same for a board of another host: sends the force and waits until the board has answered, a few seconds at
  // most. Called by one thread.
  Result<std::string, tools::Failure> take(const deploy::BoardReport& board, Taken taken,
                                           const tools::PlantWatch::RemoteOrder& order);
  // Returns false if there is no such lease of this client, or it has ended: also if the client may no longer change
  // the variables.
  bool renew(const std::string& board, const std::string& name, const Client& client);
  // A board of another host releases the force shortly after.
  bool end(const std::string& board, const std::string& name, const std::string& who);
  // Removes leases that were not renewed in time, and logs it.
  void end_overdue();

 private:
  struct Held : HeldBase {
    std::vector<std::string> variables;   // full names
    std::optional<std::uint64_t> remote;  // the number of a lease of keeper_; the rest is for one of this host
    std::vector<std::uint64_t> names;     // hashes of the variables, in the order of lease.values
    std::uint64_t layout_hash = 0;
    std::uint64_t generation = 0;  // identifies the node's run
    operate::Lease lease;
    bool bind(const vars::Store& store);
  };

  static Held held_of(const std::string& board, Taken taken);
  // Returns the outcome if the lease has ended.
  const char* renew(Held& held);
  void release(Held& held);

  const deploy::LinkSettings& link_;
  std::unique_ptr<tools::LeaseKeeper> keeper_;  // null until the first lease of a board of another host
  Worker renewing_;                             // runs keeper_
  Desk<Held> desk_;
};

}  // namespace indurop::serve
