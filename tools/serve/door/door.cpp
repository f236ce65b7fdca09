// SPDX-License-Identifier: Apache-2.0
#include "tools/serve/door/door.h"

#include <poll.h>
#include <sys/eventfd.h>
#include <sys/resource.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <limits>
#include <map>
#include <mutex>
#include <utility>
#include <vector>

#include "tools/serve/door/connection.h"
#include "tools/serve/door/listener.h"

namespace indurop::serve {
namespace {

// Connections in addition to those of streams, and the maximum for one address.
constexpr std::size_t kMostRequests = 192;
constexpr std::size_t kMostOfOne = 64;
constexpr std::size_t kSpareFiles = 64;
constexpr int kAcceptedAtOnce = 16;
constexpr std::int64_t kNsPerMs = 1'000'000;
constexpr std::int64_t kNoFilesNs = 100 * kNsPerMs;  // time until the next attempt

std::int64_t now() {
  return std::chrono::duration_cast<std::chrono::nanoseconds>(std::chrono::steady_clock::now().time_since_epoch())
      .count();
}

// Raises the limit of open files for this many connections, as far as this process may.
void want_files(std::size_t most) {
  rlimit limit{};
  if (getrlimit(RLIMIT_NOFILE, &limit) == 0 && limit.rlim_cur < most + kSpareFiles) {
    limit.rlim_cur = std::min<rlim_t>(limit.rlim_max, most + kSpareFiles);
    (void)setrlimit(RLIMIT_NOFILE, &limit);
  }
}

}  // namespace

struct Door::Alarm::State {
  Door::Impl* door = nullptr;
  std::function<void()> ring;
};

struct Door::Impl {
  Impl(DoorSettings settings, House& house, Listener own_listener, TlsContext own_tls)
      : common{std::move(settings), &house, ConnectionLimits(0, 0), {}, {}},
        listener(std::move(own_listener)),
        tls(std::move(own_tls)),
        wake(eventfd(0, EFD_CLOEXEC | EFD_NONBLOCK)) {
    const std::size_t most = common.settings.most_streams + kMostRequests;
    common.limits = ConnectionLimits(most, std::min(most, kMostOfOne));
    want_files(most);
  }

  void turn();
  [[nodiscard]] int patience_ms() const;
  void let_in();
  void send_replies();
  void ring_alarms();
  void end_late();

  Common common;
  Listener listener;
  TlsContext tls;
  base::Descriptor wake;
  std::map<ConnectionLimits::Id, std::unique_ptr<Connection>> connections;
  std::multimap<std::int64_t, Alarm::State*> alarms;
  std::int64_t listens_again_ns = 0;
  std::mutex lock;
  std::vector<std::pair<Ticket, Reply>> replies;  // from other threads
};

Door::Alarm::Alarm(Door& door, std::function<void()> ring) : state_(std::make_unique<State>()) {
  *state_ = {door.impl_.get(), std::move(ring)};
}

Door::Alarm::~Alarm() {
  stop();
}

void Door::Alarm::set(std::int64_t after_ns) {
  stop();
  state_->door->alarms.emplace(now() + std::max<std::int64_t>(after_ns, 1), state_.get());
}

void Door::Alarm::stop() {
  std::erase_if(state_->door->alarms, [this](const auto& one) { return one.second == state_.get(); });
}

Door::Door(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
Door::~Door() = default;

Result<std::unique_ptr<Door>, base::Problem> Door::open(const DoorSettings& settings, House& house) {
  auto listener = Listener::open(settings.bind, settings.port);
  if (!listener) {
    return std::move(listener).error();
  }
  TlsContext tls;
  if (!settings.cert.empty()) {
    auto opened = open_tls(settings.cert, settings.key, settings.client_ca);
    if (!opened) {
      return std::move(opened).error();
    }
    tls = std::move(opened).value();
  }
  std::signal(SIGPIPE, SIG_IGN);  // libssl writes to clients that have gone
  return std::unique_ptr<Door>(
      new Door(std::make_unique<Impl>(settings, house, std::move(listener).value(), std::move(tls))));
}

int Door::port() const {
  return impl_->listener.port();
}

void Door::serve(const std::function<bool()>& ended) {
  while (!ended()) {
    impl_->turn();
  }
}

void Door::reply(Ticket ticket, Reply reply) {
  {
    const std::lock_guard guard(impl_->lock);
    impl_->replies.emplace_back(ticket, std::move(reply));
  }
  const std::uint64_t one = 1;
  (void)!::write(impl_->wake.get(), &one, sizeof one);
}

// Returns the time until the first alarm or the first deadline of a connection.
int Door::Impl::patience_ms() const {
  std::int64_t first = alarms.empty() ? std::numeric_limits<std::int64_t>::max() : alarms.begin()->first;
  for (const auto& [id, connection] : connections) {
    if (connection->holds_input()) {
      return 0;
    }
    first = std::min(first, connection->deadline_ns());
  }
  if (listens_again_ns != 0) {
    first = std::min(first, listens_again_ns);
  }
  constexpr std::int64_t kMaxWaitMs = 60'000;
  const std::int64_t left = first - now();
  return static_cast<int>(std::clamp<std::int64_t>((left + kNsPerMs - 1) / kNsPerMs, 0, kMaxWaitMs));
}

void Door::Impl::turn() {
  std::vector<pollfd> files{{wake.get(), POLLIN, 0}, {listens_again_ns == 0 ? listener.file() : -1, POLLIN, 0}};
  const std::size_t first = files.size();
  std::vector<ConnectionLimits::Id> whose;
  for (const auto& [id, connection] : connections) {
    files.push_back({connection->file(), connection->events(), 0});
    whose.push_back(id);
  }
  if (::poll(files.data(), files.size(), patience_ms()) < 0) {
    return;  // a signal
  }
  std::uint64_t ignored = 0;
  (void)!::read(wake.get(), &ignored, sizeof ignored);
  send_replies();
  for (std::size_t i = 0; i < whose.size(); ++i) {
    const auto found = connections.find(whose[i]);
    if (found != connections.end() && (files[first + i].revents != 0 || found->second->holds_input()) &&
        !found->second->ready(files[first + i].revents, now())) {
      connections.erase(found);
    }
  }
  end_late();
  ring_alarms();
  if (files[1].revents != 0) {
    let_in();
  }
  if (listens_again_ns != 0 && listens_again_ns <= now()) {
    listens_again_ns = 0;
  }
}

void Door::Impl::end_late() {
  const std::int64_t at = now();
  std::erase_if(connections,
                [at](const auto& one) { return one.second->deadline_ns() <= at && !one.second->on_time(at); });
}

// Calls the alarms that are due now; those that they set again are called in a later round.
void Door::Impl::ring_alarms() {
  const std::int64_t at = now();
  std::vector<Alarm::State*> due;
  for (auto one = alarms.begin(); one != alarms.end() && one->first <= at; ++one) {
    due.push_back(one->second);
  }
  for (Alarm::State* const state : due) {
    const auto still =
        std::find_if(alarms.begin(), alarms.end(), [state](const auto& one) { return one.second == state; });
    if (still != alarms.end()) {
      alarms.erase(still);
      state->ring();
    }
  }
}

void Door::Impl::let_in() {
  for (int i = 0; i < kAcceptedAtOnce; ++i) {
    auto taken = listener.take();
    if (!taken) {
      // Without this the loop would spin while a connection cannot be accepted.
      listens_again_ns = taken.error().sys_errno != 0 ? now() + kNoFilesNs : 0;
      return;
    }
    const ConnectionLimits::Admission admission = common.limits.admit(taken->address, taken->loopback);
    if (admission.instead) {
      connections.erase(*admission.instead);
    }
    if (admission.id != 0) {
      auto& made = connections[admission.id];
      made =
          std::make_unique<Connection>(common, admission.id, Wire(std::move(taken->file), tls.get()), taken->address);
      made->begin_at(now());
    }
  }
}

void Door::Impl::send_replies() {
  std::vector<std::pair<Ticket, Reply>> given;
  {
    const std::lock_guard guard(lock);
    given.swap(replies);
  }
  for (auto& [ticket, reply] : given) {
    const auto found = std::find_if(connections.begin(), connections.end(),
                                    [ticket = ticket](const auto& one) { return one.second->waits_for(ticket); });
    if (found != connections.end() && !found->second->reply(std::move(reply), now())) {
      connections.erase(found);
    }
  }
}

}  // namespace indurop::serve
