// SPDX-License-Identifier: Apache-2.0
// Forces that end with their client: held as long as it says so again within a lease's time. The node's table of forces
// ends them by itself, so they end, too, if this server dies.

#pragma once

#include <cstdint>
#include <map>
#include <mutex>
#include <string>
#include <vector>

#include "operate/hold.h"
#include "operate/who.h"
#include "serve/api/audit.h"
#include "vars/store.h"

namespace indurop::serve {

class LeaseDesk {
 public:
  // How long it holds after it was renewed last: browsers let pages behind others speak once a second.
  static constexpr std::int64_t kLeaseNs = 5'000'000'000;

  explicit LeaseDesk(const Audit& audit) : audit_(&audit) {}

  // Any thread. Returns the name to renew it by, which cannot be guessed. `store`: of the board, as it is now.
  std::string take(const std::string& board, const operate::Who& who, const std::string& what, const vars::Store& store,
                   operate::Lease lease);
  // False: there is no such lease of this client, or it has ended.
  bool renew(const std::string& board, const std::string& name, const std::string& who);
  bool end(const std::string& board, const std::string& name, const std::string& who);
  // Forgets those that were not renewed in time, and notes so.
  void look();

 private:
  struct Held {
    std::string board;
    operate::Who who;
    std::string what;                  // for the audit log
    std::vector<std::uint64_t> names;  // hashes of the variables, in the order of lease.values
    std::uint64_t layout_hash = 0;
    std::uint64_t generation = 0;  // of the node's run
    operate::Lease lease;
    std::int64_t until_ns = 0;  // CLOCK_MONOTONIC
  };
  void note(const Held& held, const char* outcome) const;

  const Audit* audit_;
  std::mutex mutex_;
  std::map<std::string, Held> all_;
};

}  // namespace indurop::serve
