// SPDX-License-Identifier: Apache-2.0
// Forces that end with their client: they hold as long as it renews within the time of a lease. They are leases in the
// node's table of forces, so they end too if this server dies.

#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "store/operate/hold.h"
#include "store/operate/who.h"
#include "store/vars/store.h"
#include "tools/serve/audit.h"
#include "tools/serve/desk.h"

namespace indurop::serve {

class LeaseDesk {
 public:
  // Time after the last renewal: browsers let pages in the background send once a second only.
  static constexpr std::int64_t kLeaseNs = 5'000'000'000;

  explicit LeaseDesk(const Audit& audit) : desk_(audit, "release", kLeaseNs) {}

  // Starts a lease; may be called by any thread. Returns the name to renew it by, which cannot be guessed. `store`: the
  // current one of the board.
  std::string take(const std::string& board, const operate::Who& who, const std::string& what, const vars::Store& store,
                   operate::Lease lease);
  // Returns false if there is no such lease of this client, or it has ended.
  bool renew(const std::string& board, const std::string& name, const std::string& who);
  bool end(const std::string& board, const std::string& name, const std::string& who);
  // Removes leases that were not renewed in time, and logs it.
  void end_overdue();

 private:
  struct Held : HeldBase {
    std::vector<std::uint64_t> names;  // hashes of the variables, in the order of lease.values
    std::uint64_t layout_hash = 0;
    std::uint64_t generation = 0;  // identifies the node's run
    operate::Lease lease;
    bool bind(const vars::Store& store);
  };

  Desk<Held> desk_;
};

}  // namespace indurop::serve
