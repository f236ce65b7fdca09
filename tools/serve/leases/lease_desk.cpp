// SPDX-License-Identifier: Apache-2.0
#include "tools/serve/leases/lease_desk.h"

#include <utility>

namespace indurop::serve {

// Finds the variables again in a store that was reopened. Returns false if the board has changed meanwhile.
bool LeaseDesk::Held::bind(const vars::Store& store) {
  const vars::BlockHeader& header = store.header();
  if (header.layout_hash != layout_hash || header.generation.load() != generation) {
    return false;
  }
  for (std::size_t i = 0; i < names.size(); ++i) {
    lease.values[i].variable = store.find(names[i]);
  }
  return true;
}

std::string LeaseDesk::take(const std::string& board, const operate::Who& who, const std::string& what,
                            const vars::Store& store, operate::Lease lease) {
  Held held;
  held.board = board;
  held.who = who;
  held.what = what;
  held.layout_hash = store.header().layout_hash;
  held.generation = store.header().generation.load();
  held.lease = std::move(lease);
  for (const vars::HeldValue& value : held.lease.values) {
    held.names.push_back(value.variable->name_hash);
  }
  return desk_.add(std::move(held));
}

bool LeaseDesk::renew(const std::string& board, const std::string& name, const std::string& who) {
  end_overdue();
  return desk_.keep(board, name, who, [&board](Held& held) -> const char* {
    auto store = vars::Store::attach(board, vars::Mode::ReadWrite);
    return store && held.bind(*store) && operate::renew(held.lease, *store, kLeaseNs)
               ? nullptr
               : "lost: another user released or re-forced one of the values, or the node was started again";
  });
}

bool LeaseDesk::end(const std::string& board, const std::string& name, const std::string& who) {
  return desk_.end(board, name, who, [&board](Held& held) {
    auto store = vars::Store::attach(board, vars::Mode::ReadWrite);
    if (store && held.bind(*store)) {
      operate::end(board, *store, held.lease, held.who);
    }
  });
}

void LeaseDesk::end_overdue() {
  desk_.expire([](Held& /*held*/) {}, "ended: its client did not renew it in time");
}

}  // namespace indurop::serve
