// SPDX-License-Identifier: Apache-2.0
#include "doors/pools/local_pool.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "tools/client/node/node_choice.h"

namespace indurop::pool_door {

bool LocalPool::is_current() const {
  return pool_ && pool_->is_current();
}

bool LocalPool::fail(std::string problem) {
  leave();
  problem_ = std::move(problem);
  return false;
}

bool LocalPool::enter(const base::Log& log) {
  const bool entered = try_enter();
  if (!entered && problem_ != reported_) {
    log.info("waits: {}", problem_);
  }
  reported_ = problem_;
  return entered;
}

bool LocalPool::try_enter() {
  auto store = vars::Store::attach(node_, vars::Mode::ReadOnly);
  if (!store) {
    return fail(tools::explain_open_error(store.error(), node_, false));
  }
  const auto& declared = store->schema().pools;
  const auto found = std::ranges::find(declared, name_, &schema::Pool::name);
  if (found == declared.end()) {
    return fail(fmt::format("node '{}' has no pool {} now: one of its modules must declare it", node_, name_));
  }
  type_ = found->type.name;
  auto pool = pools::Pool::open(node_, name_, found->type_hash, vars::Mode::ReadWrite);
  if (!pool) {
    return fail(pool.error().code == Errc::PermissionDenied
                    ? fmt::format("no permission for pool {} of node '{}': run as the user it belongs to "
                                  "(ls -l /dev/shm/indurop.{}*)",
                                  name_, node_, node_)
                    : fmt::format("pool {} of node '{}' is not there: {}", name_, node_, to_string(pool.error().code)));
  }
  const auto seat = pool->take_seat("indurop-pools");
  if (!seat) {
    return fail(seat.error().code == Errc::NoSpace
                    ? fmt::format("{} modules and programs use pool {} already (indurop status): end one of them",
                                  pools::kSeats, name_)
                    : fmt::format("pool {} of node '{}': {}", name_, node_, to_string(seat.error().code)));
  }
  store_.emplace(std::move(store).value());
  pool_.emplace(std::move(pool).value());
  shape_ = pool_->shape();
  seat_ = *seat;
  problem_.clear();
  return true;
}

void LocalPool::leave() noexcept {
  if (seat_) {
    pool_->leave_seat(*seat_);
  }
  seat_.reset();
  pool_.reset();
  store_.reset();
}

rt::MonoTime LocalPool::now() const noexcept {
  return store_->lost() ? rt::MonoClock::now() : store_->now();
}

}  // namespace indurop::pool_door
