// SPDX-License-Identifier: Apache-2.0
#include "tools/serve/leases/lease_desk.h"

#include <algorithm>
#include <utility>

#include "core/base/name_patterns.h"

namespace indurop::serve {

// Finds the variables again in a store that was reopened. Returns false if the board has changed meanwhile.
bool LeaseDesk::Held::bind(const vars::Store& store) {
  if (store.layout_hash() != layout_hash || store.header().generation.load() != generation) {
    return false;
  }
  for (std::size_t i = 0; i < names.size(); ++i) {
    lease.values[i].variable = store.find(names[i]);
  }
  return true;
}

LeaseDesk::Held LeaseDesk::held_of(const std::string& board, Taken taken) {
  Held held;
  held.board = board;
  held.who = std::move(taken.who);
  held.what = std::move(taken.what);
  held.variables = std::move(taken.variables);
  return held;
}

std::string LeaseDesk::take(const std::string& board, Taken taken, const vars::Store& store, operate::Lease lease) {
  Held held = held_of(board, std::move(taken));
  held.layout_hash = store.layout_hash();
  held.generation = store.header().generation.load();
  held.lease = std::move(lease);
  for (const vars::HeldValue& value : held.lease.values) {
    held.names.push_back(value.variable->name_hash);
  }
  return desk_.add(std::move(held));
}

Result<std::string, tools::Failure> LeaseDesk::take(const deploy::BoardReport& board, Taken taken,
                                                    const tools::PlantWatch::RemoteOrder& order) {
  if (keeper_ == nullptr) {
    auto opened = tools::LeaseKeeper::open(link_);
    if (!opened) {
      return std::move(opened).error();
    }
    keeper_ = std::move(opened).value();
    (void)renewing_.add([this] { keeper_->run(); });
  }
  const auto number = keeper_->take(board, order);
  if (!number) {
    return number.error();
  }
  Held held = held_of(board.board, std::move(taken));
  held.remote = *number;
  return desk_.add(std::move(held));
}

LeaseDesk::~LeaseDesk() {
  if (keeper_ != nullptr) {
    keeper_->stop();
  }
}

const char* LeaseDesk::renew(Held& held) {
  if (held.remote) {
    return keeper_->holds(*held.remote)
               ? nullptr
               : "lost: the board has ended it (another user released or re-forced one of the values, or its node was "
                 "started again), or does not answer";
  }
  auto store = vars::Store::attach(held.board, vars::Mode::ReadWrite);
  return store && held.bind(*store) && operate::renew(held.lease, *store, kLeaseNs)
             ? nullptr
             : "lost: another user released or re-forced one of the values, or the node was started again";
}

void LeaseDesk::release(Held& held) {
  if (held.remote) {
    keeper_->end(*held.remote);
    return;
  }
  auto store = vars::Store::attach(held.board, vars::Mode::ReadWrite);
  if (store && held.bind(*store)) {
    operate::end(held.board, *store, held.lease, held.who);
  }
}

bool LeaseDesk::renew(const std::string& board, const std::string& name, const Client& client) {
  end_overdue();
  return desk_.keep(board, name, client.name, [&](Held& held) -> const char* {
    const bool may = std::all_of(held.variables.begin(), held.variables.end(), [&client](const std::string& variable) {
      return base::matches_any_variable(client.variables, variable);
    });
    if (!may) {
      release(held);
      return "ended: its user may no longer change the variables";
    }
    return renew(held);
  });
}

bool LeaseDesk::end(const std::string& board, const std::string& name, const std::string& who) {
  return desk_.end(board, name, who, [this](Held& held) { release(held); });
}

void LeaseDesk::end_overdue() {
  // A node of this host releases it on its own.
  const auto end_remote = [this](Held& held) {
    if (held.remote) {
      keeper_->end(*held.remote);
    }
  };
  desk_.expire(end_remote, "ended: its client did not renew it in time");
}

}  // namespace indurop::serve
