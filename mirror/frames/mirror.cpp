// SPDX-License-Identifier: Apache-2.0
#include "mirror/frames/mirror.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <mutex>
#include <vector>

#include "dds/joining.h"
#include "dds/log.h"
#include "dds/other_releases.h"
#include "mirror/frames/anticipation.h"
#include "mirror/frames/beacons.h"
#include "mirror/frames/landing.h"
#include "mirror/frames/mirror_block.h"
#include "mirror/frames/plane_topics.h"
#include "mirror/frames/receiver.h"
#include "mirror/frames/sender.h"
#include "rt/clock.h"
#include "rt/signal_word.h"
#include "rt/thread.h"
#include "vars/shm_file.h"

namespace indurop::mirror {
namespace {

constexpr std::size_t kStackBytes = std::size_t{256} * 1024;
constexpr std::int64_t kLookNs = 10'000'000;  // without a notification: somebody else may have written
constexpr std::int64_t kOthersNs = 500'000'000;
constexpr std::int64_t kBulkLookNs = 20'000'000;
constexpr std::int64_t kLookAgainNs = 100'000;  // for the end of a run that nobody tells

// Until `wake`, awake in the window. False if the time passed without.
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

void copy_name(char (&to)[kBoardName], const std::string& from) noexcept {
  const std::size_t length = std::min(from.size(), sizeof to - 1);
  std::memcpy(to, from.data(), length);
  to[length] = '\0';
}

}  // namespace

struct Mirror::Impl {
  Impl(Settings wanted, vars::Store& values, const std::atomic<std::uint64_t>& ticks, vars::ShmFile&& memory)
      : settings(std::move(wanted)),
        store(values),
        tick(ticks),
        file(std::move(memory)),
        block(*reinterpret_cast<MirrorBlock*>(file.data())),
        session(static_cast<std::uint64_t>(rt::wall_ns())),
        joining(
            settings.network, [this](dds::Handle participant) { return open(participant); }, [this] { close(); }) {}

  void make_receivers();
  Status run();
  void end() noexcept;
  void manage();
  Result<void, base::Problem> open(dds::Handle participant);
  void close() noexcept;
  void take_catalogues() noexcept;
  void look_for_other_releases();
  void send_loop(bool bulk) noexcept;
  [[nodiscard]] bool stopping() const noexcept { return stop.load(std::memory_order_acquire); }

  Settings settings;
  vars::Store& store;
  const std::atomic<std::uint64_t>& tick;
  vars::ShmFile file;
  MirrorBlock& block;
  std::uint64_t session;
  std::string refused;  // what was said last about keys

  Landing* landing_of(const std::string& variable);

  std::unique_ptr<Sender> sender;
  std::unique_ptr<Beacons> beacons;
  std::mutex schedule_mutex;
  Schedule schedule;
  std::mutex landings_mutex;
  std::vector<std::unique_ptr<Landing>> landings;
  std::vector<std::unique_ptr<Receiver>> receivers;
  dds::Endpoint catalogues;
  dds::OtherReleases others;
  dds::Joining joining;
  std::atomic<bool> up{false};
  std::atomic<bool> stop{false};
  rt::SignalWord wake_manager{};
  rt::SignalWord wake_sender{};
  rt::SignalWord wake_bulk{};
  rt::Thread manager;
  rt::Thread prompt;
  rt::Thread bulk;
};

// Null if the store does not hold it.
Landing* Mirror::Impl::landing_of(const std::string& variable) {
  const auto* entry = store.find(abi::fnv1a64(variable.data(), variable.size()));
  if (entry == nullptr) {
    return nullptr;
  }
  const auto found = std::find_if(landings.begin(), landings.end(),
                                  [entry](const auto& landing) { return &landing->entry() == entry; });
  if (found != landings.end()) {
    return found->get();
  }
  landings.push_back(std::make_unique<Landing>(store, *entry, rt::now_ns() + settings.network.lease_ns));
  return landings.back().get();
}

// One per board, with what is read from it.
void Mirror::Impl::make_receivers() {
  for (std::size_t i = 0; i < settings.boards.size(); ++i) {
    std::vector<Landing*> from_it;
    for (const Incoming& in : settings.incoming) {
      if (in.owner != settings.boards[i]) {
        continue;
      }
      if (Landing* landing = landing_of(in.variable); landing != nullptr) {
        from_it.push_back(landing);
        block.variables()[block.incoming++] = {abi::fnv1a64(in.variable.data(), in.variable.size()),
                                               static_cast<std::uint32_t>(i), 0};
      }
    }
    receivers.push_back(std::make_unique<Receiver>(settings.boards[i], from_it, landings_mutex, block.peers()[i]));
  }
}

Status Mirror::Impl::run() {
  wake_manager.init(false);
  wake_sender.init(false);
  wake_bulk.init(false);
  block.abi = kMirrorAbi;
  block.peer_count = static_cast<std::uint32_t>(settings.boards.size());
  copy_name(block.plant, settings.plant);
  copy_name(block.board, settings.network.board);
  block.domain = settings.network.domain;
  block.session.store(session, std::memory_order_relaxed);
  for (std::size_t i = 0; i < settings.boards.size(); ++i) {
    copy_name(block.peers()[i].name, settings.boards[i]);
  }
  sender = std::make_unique<Sender>(store, settings, session, block);
  beacons = std::make_unique<Beacons>(settings, session, block);
  make_receivers();
  block.magic.store(kMirrorMagic, std::memory_order_release);
  if (Status published = file.publish(); !published) {
    return published;
  }
  rt::ThreadSettings thread;
  thread.fifo_priority = settings.network.fifo_priority;
  thread.stack_bytes = kStackBytes;
  const auto launch = [&](const char* name, rt::Thread& into, auto body) -> Status {
    thread.name = name;
    auto started = rt::Thread::start(thread, [this, body] {
      // The threads of DDS inherit where they may run from the manager.
      if (!settings.cores.empty()) {
        (void)rt::pin_to_cores(settings.cores);
      }
      body();
    });
    if (!started) {
      return started.error();
    }
    into = std::move(started).value();
    return {};
  };
  if (Status started = launch("irp-mirror-mgr", manager, [this] { manage(); }); !started) {
    return started;
  }
  if (!sender->empty()) {
    if (Status started = launch("irp-mirror", prompt, [this] { send_loop(false); }); !started) {
      return started;
    }
  }
  if (sender->has_bulk()) {
    thread.fifo_priority = 0;
    return launch("irp-mirror-bulk", bulk, [this] { send_loop(true); });
  }
  return {};
}

Result<void, base::Problem> Mirror::Impl::open(dds::Handle participant) {
  if (auto opened = sender->open(participant, settings); !opened) {
    return opened;
  }
  if (auto opened = beacons->open(participant, settings); !opened) {
    return opened;
  }
  catalogues = dds::make_reader(participant, indurop_wire_Catalogue_desc, catalogue_topic(settings.plant),
                                plane_qos(settings, Stream::Prompt), dds::wake_listener(wake_manager));
  if (!catalogues.ok()) {
    return base::Problem{"cannot receive catalogues: " + catalogues.why()};
  }
  return others.open(participant);
}

void Mirror::Impl::close() noexcept {
  for (const auto& receiver : receivers) {
    receiver->close();
  }
  beacons->close();
  sender->close();
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
    take_catalogues();
    const std::int64_t now = rt::now_ns();
    if (now >= others_due) {
      others_due = now + kOthersNs;
      look_for_other_releases();
    }
    Schedule current;
    {
      const std::lock_guard<std::mutex> guard(schedule_mutex);
      current = schedule;
    }
    std::int64_t next = rt::to_ns(beacons->cycle(rt::mono_time(now), current));
    {
      const std::lock_guard<std::mutex> guard(landings_mutex);
      for (const auto& landing : landings) {
        next = std::min(next, landing->expire(now));
      }
    }
    block.dds_messages.store(dds::dds_message_count(), std::memory_order_relaxed);
    // Why boards do not come that are expected, or who knocks.
    if (const std::string now_refused = dds::last_refusal(); now_refused != refused) {
      refused = now_refused;
      block.problem.set("keys of somebody in the network do not match: " + refused);
    }
    wake_manager.wait_until(rt::mono_time(next));
  }
}

void Mirror::Impl::take_catalogues() noexcept {
  dds::take_all<indurop_wire_Catalogue>(catalogues.get(), [this](const auto& catalogue, const dds::SampleInfo& info) {
    const auto found = std::find_if(receivers.begin(), receivers.end(),
                                    [&](const auto& receiver) { return receiver->board() == catalogue.board; });
    if (found != receivers.end()) {
      if (!info.alive) {
        (*found)->silent();
      } else if (info.valid) {
        (*found)->announced(catalogue, joining.participant(), settings);
      }
    } else if (settings.network.board == catalogue.board) {  // and not from here: own samples are left out
      block.problem.set(!info.alive ? ""
                                    : fmt::format("another node in the network calls itself board {} of plant {}",
                                                  settings.network.board, settings.plant));
    }
  });
}

void Mirror::Impl::look_for_other_releases() {
  if (!others.look()) {
    return;
  }
  const auto speakers = others.speakers();
  for (const auto& receiver : receivers) {
    const auto found = std::find_if(speakers.begin(), speakers.end(), [&](const auto& speaker) {
      return speaker.topic.plant == settings.plant &&
             (speaker.topic.board == receiver->board() || speaker.name == receiver->board());
    });
    receiver->other_release(
        found == speakers.end()
            ? std::string{}
            : fmt::format("it speaks protocol {} of another release, this board {}: install the same release on both",
                          found->topic.protocol, schema::protocol()));
  }
}

void Mirror::Impl::send_loop(bool of_bulk) noexcept {
  rt::SignalWord& wake = of_bulk ? wake_bulk : wake_sender;
  Anticipation anticipation;
  while (!stopping()) {
    const std::int64_t now = rt::now_ns();
    std::int64_t next = now + (of_bulk ? kBulkLookNs : kLookNs);
    if (up.load(std::memory_order_acquire)) {
      const std::uint64_t begun = tick.load(std::memory_order_acquire);
      if (sender->cycle(now, begun > 0 ? begun - 1 : 0, of_bulk)) {
        next = now + kLookAgainNs;
      }
      if (!of_bulk) {
        const std::int64_t took = rt::now_ns() - now;
        block.cycle_ns.store(took, std::memory_order_relaxed);
        if (took > block.cycle_max_ns.load(std::memory_order_relaxed)) {
          block.cycle_max_ns.store(took, std::memory_order_relaxed);
        }
      }
    }
    const Anticipation::Window window = settings.spin && !of_bulk ? anticipation.next(now) : Anticipation::Window{};
    if (wait(wake, next, window)) {
      anticipation.reported(tick.load(std::memory_order_acquire), rt::now_ns());
    }
    while (wake.try_wait()) {
    }
  }
  if (up.load(std::memory_order_acquire)) {
    (void)sender->cycle(rt::now_ns(), tick.load(std::memory_order_acquire), of_bulk);  // what was written last
  }
}

void Mirror::Impl::end() noexcept {
  stop.store(true, std::memory_order_release);
  wake_manager.wake();
  wake_sender.wake();
  wake_bulk.wake();
  prompt.join();
  bulk.join();
  manager.join();
  joining.leave();
}

Result<Mirror> Mirror::start(Settings settings, const std::string& node, vars::Store& store,
                             const std::atomic<std::uint64_t>& tick) {
  auto file = vars::ShmFile::create(vars::mirror_file(node),
                                    mirror_block_size(settings.boards.size(), settings.incoming.size()));
  if (!file) {
    return file.error();
  }
  auto impl = std::make_unique<Impl>(std::move(settings), store, tick, std::move(file).value());
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

void Mirror::announce(const Schedule& schedule) noexcept {
  const std::lock_guard<std::mutex> guard(impl_->schedule_mutex);
  impl_->schedule = schedule;
}

void Mirror::stop() noexcept {
  if (impl_ != nullptr) {
    impl_->end();
    impl_.reset();
  }
}

}  // namespace indurop::mirror
