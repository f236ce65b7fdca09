// SPDX-License-Identifier: Apache-2.0
#include "tools/serve/leases/lease_desk.h"

#include <utility>

#include "core/rt/clock.h"
#include "tools/serve/random_word.h"

namespace indurop::serve {
namespace {

// Finds the variables again in a store that was reopened. Returns false if the board has changed meanwhile.
template <class Held>
bool bind(Held& held, const vars::Store& store) {
  const vars::BlockHeader& header = store.header();
  if (header.layout_hash != held.layout_hash || header.generation.load() != held.generation) {
    return false;
  }
  for (std::size_t i = 0; i < held.names.size(); ++i) {
    held.lease.values[i].variable = store.find(held.names[i]);
  }
  return true;
}

}  // namespace

std::string LeaseDesk::take(const std::string& board, const operate::Who& who, const std::string& what,
                            const vars::Store& store, operate::Lease lease) {
  Held held{board,
            who,
            what,
            {},
            store.header().layout_hash,
            store.header().generation.load(),
            std::move(lease),
            rt::now_ns() + kLeaseNs};
  for (const vars::HeldValue& value : held.lease.values) {
    held.names.push_back(value.variable->name_hash);
  }
  const std::lock_guard guard(mutex_);
  return all_.emplace(random_word(), std::move(held)).first->first;
}

bool LeaseDesk::renew(const std::string& board, const std::string& name, const std::string& who) {
  look();
  const std::lock_guard guard(mutex_);
  const auto found = all_.find(name);
  if (found == all_.end() || found->second.board != board || found->second.who.name != who) {
    return false;
  }
  Held& held = found->second;
  auto store = vars::Store::attach(board, vars::Mode::ReadWrite);
  if (!store || !bind(held, *store) || !operate::renew(held.lease, *store, kLeaseNs)) {
    note(held, "lost: another user released or re-forced one of the values, or the node was started again");
    all_.erase(found);
    return false;
  }
  held.until_ns = rt::now_ns() + kLeaseNs;
  return true;
}

bool LeaseDesk::end(const std::string& board, const std::string& name, const std::string& who) {
  const std::lock_guard guard(mutex_);
  const auto found = all_.find(name);
  if (found == all_.end() || found->second.board != board || found->second.who.name != who) {
    return false;
  }
  Held& held = found->second;
  auto store = vars::Store::attach(board, vars::Mode::ReadWrite);
  if (store && bind(held, *store)) {
    operate::end(board, *store, held.lease, held.who);
  }
  note(held, "done");
  all_.erase(found);
  return true;
}

void LeaseDesk::look() {
  const std::int64_t now = rt::now_ns();
  const std::lock_guard guard(mutex_);
  std::erase_if(all_, [&](const auto& one) {
    if (one.second.until_ns > now) {
      return false;
    }
    note(one.second, "ended: its client was not heard any more");
    return true;
  });
}

void LeaseDesk::note(const Held& held, const char* outcome) const {
  AuditEntry entry;
  entry.who = held.who.name;
  entry.from = held.who.from;
  entry.board = held.board;
  entry.action = "release";
  entry.what = held.what;
  entry.outcome = outcome;
  (void)audit_->note(entry);
}

}  // namespace indurop::serve
