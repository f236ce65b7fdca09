// SPDX-License-Identifier: Apache-2.0
#include "network/mirror/frames/mirror.h"

#include <fmt/format.h>

#include <algorithm>
#include <mutex>
#include <optional>
#include <utility>

#include "core/rt/clock.h"
#include "core/rt/signal_word.h"
#include "core/rt/thread.h"
#include "network/dds/joining.h"
#include "network/dds/log.h"
#include "network/dds/other_releases.h"
#include "network/mirror/frames/anticipation.h"
#include "network/mirror/frames/dds_plane.h"
#include "network/mirror/frames/exchange.h"
#include "network/mirror/frames/plane_topics.h"

namespace indurop::mirror {
namespace {

constexpr std::size_t kStackBytes = std::size_t{256} * 1024;
constexpr std::int64_t kUntilUpNs = 10'000'000;  // between two checks whether the network is available
constexpr std::int64_t kOthersNs = 500'000'000;

constexpr std::int64_t kForgetNs = 10'000'000'000;

// Beacons say which board is silent, so that DDS need not forget it then.
dds::NetworkSettings network_of(const Settings& settings) {
  dds::NetworkSettings network = settings.network;
  network.forget_ns = std::max(kForgetNs, 2 * network.lease_ns);
  network.unicast_topics = kFramesTopics;
  return network;
}

// Waits for `wake`, spinning in the window. Returns false if the time passed without it.
bool wait(rt::SignalWord& wake, std::int64_t deadline_ns, const Anticipation::Window& window) noexcept {
  if (!window.empty()) {
    if (wake.wait_until(rt::mono_time(window.begin))) {
      return true;
    }
    while (rt::now_ns() < window.end) {
      if (wake.try_wait()) {
        return true;
      }
    }
  }
  return wake.wait_until(rt::mono_time(deadline_ns));
}

}  // namespace

struct Mirror::Impl {
  explicit Impl(std::unique_ptr<Exchange> with)
      : exchange(std::move(with)),
        settings(exchange->settings()),
        block(exchange->block()),
        plane(settings),
        joining(
            network_of(settings), [this](dds::Handle participant) { return open(participant); }, [this] { close(); }) {}

  Status run();
  Status launch(const char* name, int fifo_priority, rt::Thread& into, void (Impl::*body)());
  Status start_senders();
  void take_routes();
  void end() noexcept;
  void manage();
  Result<void, base::Problem> open(dds::Handle participant);
  void close() noexcept;
  void take_catalogues() noexcept;
  void check_other_releases();
  void send_prompt() { send_loop(false); }
  void send_bulk() { send_loop(true); }
  void send_loop(bool bulk) noexcept;
  std::int64_t send(bool bulk) noexcept;
  [[nodiscard]] bool stopping() const noexcept { return stop.load(std::memory_order_acquire); }

  std::unique_ptr<Exchange> exchange;
  const Settings& settings;
  MirrorBlock& block;
  DdsPlane plane;
  std::string refused;    // last reported key problem
  std::mutex news_mutex;  // of what the node says
  Schedule schedule;
  std::optional<Routes> routes;  // not yet followed
  dds::Endpoint catalogues;
  dds::OtherReleases others;
  dds::Joining joining;
  std::atomic<bool> up{false};
  std::atomic<bool> stop{false};
  rt::SignalWord wake_manager{};
  rt::SignalWord wake_sender{};
  rt::SignalWord wake_bulk{};
  rt::Thread manager;
  bool has_prompt = false;
  bool has_bulk = false;
  rt::Thread prompt;
  rt::Thread bulk;
};

Status Mirror::Impl::run() {
  wake_manager.init(false);
  wake_sender.init(false);
  wake_bulk.init(false);
  if (Status started = start_senders(); !started) {
    return started;
  }
  return launch("irp-mirror-mgr", settings.network.fifo_priority, manager, &Impl::manage);
}

Status Mirror::Impl::launch(const char* name, int fifo_priority, rt::Thread& into, void (Impl::*body)()) {
  rt::ThreadSettings thread;
  thread.name = name;
  thread.fifo_priority = fifo_priority;
  thread.stack_bytes = kStackBytes;
  auto started = rt::Thread::start(thread, [this, body] {
    // DDS threads inherit their cores from the manager.
    if (!settings.cores.empty()) {
      (void)rt::pin_to_cores(settings.cores);
    }
    (this->*body)();
  });
  if (!started) {
    return started.error();
  }
  into = std::move(started).value();
  return {};
}

// Those that are needed and do not run yet.
Status Mirror::Impl::start_senders() {
  if (exchange->sends() && !std::exchange(has_prompt, true)) {
    if (Status started = launch("irp-mirror", settings.network.fifo_priority, prompt, &Impl::send_prompt); !started) {
      return started;
    }
  }
  return exchange->sends_bulk() && !std::exchange(has_bulk, true) ? launch("irp-mirror-bulk", 0, bulk, &Impl::send_bulk)
                                                                  : Status{};
}

void Mirror::Impl::take_routes() {
  std::optional<Routes> next;
  {
    const std::lock_guard<std::mutex> guard(news_mutex);
    next = std::exchange(routes, std::nullopt);
  }
  if (next) {
    exchange->follow(*next);
    if (const Status started = start_senders(); !started) {
      block.problem.set(std::string("cannot start a thread that sends: ") + started.error().where);
    }
  }
}

Result<void, base::Problem> Mirror::Impl::open(dds::Handle participant) {
  plane.enter(participant);
  if (auto opened = exchange->open(plane); !opened) {
    return opened;
  }
  catalogues = dds::make_reader(participant, indurop_wire_Catalogue_desc, catalogue_topic(settings.plant),
                                plane_qos(Stream::Prompt), dds::wake_listener(wake_manager));
  if (!catalogues.ok()) {
    return base::Problem{"cannot receive catalogues: " + catalogues.why()};
  }
  return others.open(participant);
}

void Mirror::Impl::close() noexcept {
  exchange->close();
  catalogues.reset();
  others.close();
}

void Mirror::Impl::manage() {
  if (!joining.join(stop, wake_manager, block.problem)) {
    return;
  }
  block.network.store(Network::Up, std::memory_order_release);
  up.store(true, std::memory_order_release);
  wake_sender.wake();
  wake_bulk.wake();
  std::int64_t others_due = 0;
  while (!stopping()) {
    take_routes();
    take_catalogues();
    const std::int64_t now = rt::now_ns();
    if (now >= others_due) {
      others_due = now + kOthersNs;
      check_other_releases();
    }
    Schedule current;
    {
      const std::lock_guard<std::mutex> guard(news_mutex);
      current = schedule;
    }
    const std::int64_t next = exchange->poll(now, current);
    block.dds_messages.store(dds::dds_message_count(), std::memory_order_relaxed);
    // Reports why expected boards do not come, or which participants were rejected.
    if (const std::string now_refused = dds::last_refusal(); now_refused != refused) {
      refused = now_refused;
      block.problem.set("keys of another participant in the network do not match: " + refused);
    }
    wake_manager.wait_until(rt::mono_time(next));
  }
}

void Mirror::Impl::take_catalogues() noexcept {
  dds::take_all<indurop_wire_Catalogue>(catalogues.get(), [this](const auto& catalogue, const dds::SampleInfo& info) {
    if (exchange->knows(catalogue.board)) {
      if (!info.alive) {
        exchange->gone(catalogue.board);
      } else if (info.valid) {
        exchange->announced(catalogue);
      }
    } else if (settings.network.board == catalogue.board) {  // not a sample of this board: own samples are left out
      block.problem.set(!info.alive ? ""
                                    : fmt::format("another node in the network runs as board {} of plant {}",
                                                  settings.network.board, settings.plant));
    }
  });
}

void Mirror::Impl::check_other_releases() {
  if (!others.poll()) {
    return;
  }
  const auto senders = others.senders();
  exchange->other_releases([&](const std::string& board) {
    const auto found = std::find_if(senders.begin(), senders.end(), [&](const auto& speaker) {
      return speaker.topic.plant == settings.plant && (speaker.topic.board == board || speaker.name == board);
    });
    return found == senders.end()
               ? std::string{}
               : fmt::format(
                     "it uses protocol {} of another release, this board uses {}: install the same release on both",
                     found->topic.protocol, schema::protocol());
  });
}

// Returns when to call again.
std::int64_t Mirror::Impl::send(bool of_bulk) noexcept {
  const std::int64_t now = rt::now_ns();
  if (!up.load(std::memory_order_acquire)) {
    return now + kUntilUpNs;
  }
  const std::int64_t next = exchange->send(now, of_bulk);
  if (!of_bulk) {
    const std::int64_t took = rt::now_ns() - now;
    block.cycle_ns.store(took, std::memory_order_relaxed);
    if (took > block.cycle_max_ns.load(std::memory_order_relaxed)) {
      block.cycle_max_ns.store(took, std::memory_order_relaxed);
    }
  }
  return next;
}

void Mirror::Impl::send_loop(bool of_bulk) noexcept {
  rt::SignalWord& wake = of_bulk ? wake_bulk : wake_sender;
  Anticipation anticipation;
  while (!stopping()) {
    const std::int64_t now = rt::now_ns();
    const std::int64_t next = send(of_bulk);
    const Anticipation::Window window = settings.spin && !of_bulk ? anticipation.next(now) : Anticipation::Window{};
    if (wait(wake, next, window)) {
      anticipation.reported(exchange->tick(), rt::now_ns());
    }
    while (wake.try_wait()) {
    }
  }
  if (up.load(std::memory_order_acquire)) {
    exchange->send_last(of_bulk);  // sends the last values
  }
}

void Mirror::Impl::end() noexcept {
  stop.store(true, std::memory_order_release);
  wake_manager.wake();
  wake_sender.wake();
  wake_bulk.wake();
  manager.join();  // it may start the others
  prompt.join();
  bulk.join();
  joining.leave();
}

Result<Mirror> Mirror::start(Settings settings, const std::string& node, vars::Store& store,
                             const std::atomic<std::uint64_t>& tick) {
  auto exchange = Exchange::make(std::move(settings), node, store, tick);
  if (!exchange) {
    return exchange.error();
  }
  auto impl = std::make_unique<Impl>(std::move(exchange).value());
  if (Status running = impl->run(); !running) {
    impl->end();
    return running.error();
  }
  return Mirror(std::move(impl));
}

Mirror::Mirror(std::unique_ptr<Impl> impl) noexcept : impl_(std::move(impl)) {}
Mirror::Mirror(Mirror&&) noexcept = default;
Mirror& Mirror::operator=(Mirror&& other) noexcept {
  std::swap(impl_, other.impl_);
  return *this;
}
Mirror::~Mirror() {
  stop();
}

void Mirror::notify() noexcept {
  impl_->wake_sender.wake();
}

const MirrorBlock& Mirror::block() const noexcept {
  return impl_->block;
}

void Mirror::follow(const Routes& routes) {
  {
    const std::lock_guard<std::mutex> guard(impl_->news_mutex);
    impl_->routes = routes;
  }
  impl_->wake_manager.wake();
}

void Mirror::announce(const Schedule& schedule) noexcept {
  const std::lock_guard<std::mutex> guard(impl_->news_mutex);
  impl_->schedule = schedule;
}

void Mirror::stop() noexcept {
  if (impl_ != nullptr) {
    impl_->end();
    impl_.reset();
  }
}

}  // namespace indurop::mirror
