// SPDX-License-Identifier: Apache-2.0
// What clients hold only as long as they renew it in time: the client gives it back, or the desk takes it back when the
// client does not renew. May be used by any thread.

#pragma once

#include <indurop/result.h>

#include <atomic>
#include <cstdint>
#include <map>
#include <mutex>
#include <optional>
#include <string>
#include <utility>

#include "core/base/problem.h"
#include "core/rt/clock.h"
#include "store/operate/who.h"
#include "tools/client/process/random_word.h"
#include "tools/serve/audit.h"

namespace indurop::serve {

// What each of them has; `Held` of a desk is derived from it.
struct HeldBase {
  std::string board;
  operate::Who who;
  std::string what;           // for the audit log
  std::int64_t keep_ns = 0;   // to renew within; 0: as usual at this desk
  std::int64_t until_ns = 0;  // CLOCK_MONOTONIC; set by the desk
};

template <class Held>
class Desk {
 public:
  // `action`: the end of one, in the audit log.
  Desk(const Audit& audit, const char* action, std::int64_t keep_ns)
      : audit_(&audit), action_(action), keep_ns_(keep_ns) {}

  // Returns the name to renew it by, which cannot be guessed.
  std::string add(Held held) {
    const std::lock_guard guard(mutex_);
    return insert(std::move(held));
  }
  // The same, unless `begin` returns why it cannot be: it gets all others and may change `held`.
  template <class Begin>
  Result<std::string, base::Problem> add(Held held, Begin begin) {
    const std::lock_guard guard(mutex_);
    if (std::optional<base::Problem> wrong = begin(held, std::as_const(all_))) {
      return std::move(*wrong);
    }
    return insert(std::move(held));
  }

  // Renews, if `renew` returns no outcome; else it has ended with this outcome. Returns false if this client does not
  // hold it (any more).
  template <class Renew>
  bool keep(const std::string& board, const std::string& name, const std::string& who, Renew renew) {
    const std::lock_guard guard(mutex_);
    const auto found = find(board, name, who);
    if (found == all_.end()) {
      return false;
    }
    if (const char* const lost = renew(found->second); lost != nullptr) {
      remove(found, lost);
      return false;
    }
    found->second.until_ns = end_of(found->second);
    return true;
  }

  template <class Release>
  bool end(const std::string& board, const std::string& name, const std::string& who, Release release) {
    const std::lock_guard guard(mutex_);
    const auto found = find(board, name, who);
    if (found == all_.end()) {
      return false;
    }
    release(found->second);
    remove(found, "done");
    return true;
  }

  // Releases those whose client did not renew in time; with `all` every one.
  template <class Release>
  void expire(Release release, const char* outcome, bool all = false) {
    const std::int64_t now = rt::now_ns();
    const std::lock_guard guard(mutex_);
    for (auto one = all_.begin(); one != all_.end();) {
      if (one->second.until_ns > now && !all) {
        ++one;
        continue;
      }
      release(one->second);
      note(one->second, outcome);
      one = all_.erase(one);
    }
    count_ = all_.size();
  }

  // Ends those for which `check` returns an outcome.
  template <class Check>
  void check_all(Check check) {
    const std::lock_guard guard(mutex_);
    for (auto one = all_.begin(); one != all_.end();) {
      const auto held = one++;
      if (const char* const lost = check(held->second); lost != nullptr) {
        remove(held, lost);
      }
    }
  }

  [[nodiscard]] bool is_empty() const noexcept { return count_.load() == 0; }

 private:
  using All = std::map<std::string, Held>;

  std::int64_t end_of(const Held& held) const { return rt::now_ns() + (held.keep_ns > 0 ? held.keep_ns : keep_ns_); }

  std::string insert(Held held) {
    held.until_ns = end_of(held);
    auto name = all_.emplace(tools::random_word(), std::move(held)).first->first;
    count_ = all_.size();
    return name;
  }

  typename All::iterator find(const std::string& board, const std::string& name, const std::string& who) {
    const auto found = all_.find(name);
    const bool own = found != all_.end() && found->second.board == board && found->second.who.name == who;
    return own ? found : all_.end();
  }

  void remove(typename All::iterator held, const char* outcome) {
    note(held->second, outcome);
    all_.erase(held);
    count_ = all_.size();
  }

  void note(const Held& held, const char* outcome) const {
    AuditEntry entry;
    entry.who = held.who.name;
    entry.from = held.who.from;
    entry.board = held.board;
    entry.action = action_;
    entry.what = held.what;
    entry.outcome = outcome;
    (void)audit_->note(entry);
  }

  const Audit* audit_;
  const char* action_;
  std::int64_t keep_ns_;
  std::mutex mutex_;
  All all_;
  std::atomic<std::size_t> count_ = 0;
};

}  // namespace indurop::serve
