// SPDX-License-Identifier: Apache-2.0
#include "network/mirror/external/external.h"

#include <algorithm>
#include <cstring>
#include <map>
#include <vector>

#include "core/rt/clock.h"
#include "core/rt/signal_word.h"
#include "core/rt/thread.h"
#include "core/schema/ros_name.h"
#include "network/dds/joining.h"
#include "network/dds/wanted_topics.h"
#include "network/mirror/external/external_block.h"
#include "network/mirror/external/external_directory.h"
#include "network/mirror/external/external_topic.h"
#include "network/mirror/external/external_type.h"
#include "store/vars/custody.h"
#include "store/vars/shm_file.h"

namespace indurop::mirror {
namespace {

constexpr std::int64_t kReadersPollNs = 10'000'000;  // for new readers
constexpr std::int64_t kExternalLeaseNs = 2'000'000'000;
constexpr std::int64_t kLaterNs = 500'000'000;  // by then everything that is not silent is due
constexpr std::size_t kEagerTopics = 500;       // beyond this, topics are announced on request: discovery has its cost

dds::NetworkSettings network_of(const ExternalSettings& external) {
  dds::NetworkSettings settings = external.network;
  settings.peers.emplace_back("127.0.0.1");  // tools on this board
  settings.known_ports = true;
  if (external.network.one_host) {
    // Not as between boards: third-party tools find us by multicast.
    settings.interface_name = "lo";
    settings.multicast = true;
    settings.one_host = false;
  }
  settings.lease_ns = kExternalLeaseNs;
  return settings;
}

std::vector<ExternalDirectory::Content::Mirrored> mirrored_in(const vars::Store& store, const MirrorBlock* plant) {
  std::vector<ExternalDirectory::Content::Mirrored> all;
  for (std::uint32_t i = 0; plant != nullptr && i < plant->incoming; ++i) {
    const IncomingRecord& record = plant->variables()[i];
    const auto* entry = store.find(record.name_hash);
    if (entry != nullptr && record.peer < plant->peer_count) {
      const char* owner = plant->peers()[record.peer].name;
      all.push_back({store.schema().variables[entry->schema_index].name, {owner, ::strnlen(owner, kBoardName)}});
    }
  }
  return all;
}

}  // namespace

struct External::Impl {
  Impl(const ExternalSettings& wanted, const std::string& node, vars::Store& store, const MirrorBlock* plant,
       vars::ShmFile&& memory);
  Status run();
  void end() noexcept;
  void work();
  Result<void, base::Problem> open(dds::Handle participant);
  void close() noexcept;
  void describe();
  void update_lead(std::int64_t now_ns);
  void discover_readers() noexcept;
  [[nodiscard]] std::string topic_name(const std::string& variable) const {
    return settings.ros2 ? schema::ros_topic(variable) : external_topic(variable);
  }
  std::int64_t serve(std::int64_t now_ns);
  [[nodiscard]] bool stopping() const noexcept { return stop.load(std::memory_order_acquire); }

  ExternalSettings settings;
  vars::ShmFile file;
  ExternalBlock& block;
  const Result<vars::Custody> custody;
  std::vector<std::unique_ptr<ExternalTopic>> topics;
  std::map<std::string, ExternalTopic*, std::less<>> unopened;  // by topic name
  dds::WantedTopics wanted_topics;                              // only if there are unopened topics
  ExternalDirectory directory;
  ExternalDirectory::Content shown;
  dds::Joining joining;
  std::atomic<bool> stop{false};
  rt::SignalWord wake{};
  rt::Thread thread;
};

External::Impl::Impl(const ExternalSettings& wanted, const std::string& node, vars::Store& store,
                     const MirrorBlock* plant, vars::ShmFile&& memory)
    : settings(wanted),
      file(std::move(memory)),
      block(*reinterpret_cast<ExternalBlock*>(file.data())),
      custody(vars::Custody::open(node, vars::Mode::ReadOnly)),
      joining(
          network_of(wanted), [this](dds::Handle participant) { return open(participant); }, [this] { close(); }) {
  wake.init(false);
  shown.plant = settings.plant;
  shown.board = settings.network.board;
  shown.boards = settings.boards;
  shown.mirrored = mirrored_in(store, plant);
  for (const Exported& exported : settings.variables) {
    const auto* entry = store.find(abi::fnv1a64(exported.variable.data(), exported.variable.size()));
    if (entry == nullptr || exported.type == nullptr ||
        !descriptor_problem(exported.type, store.schema().variables[entry->schema_index]).empty()) {
      continue;
    }
    topics.push_back(std::make_unique<ExternalTopic>(store, *entry, exported, settings.ros2, block, wake, plant,
                                                     custody ? &*custody : nullptr));
    block.writable += exported.writable ? 1U : 0U;
  }
  block.abi = kExternalAbi;
  block.domain = settings.network.domain;
  block.topics = static_cast<std::uint32_t>(topics.size());
  block.magic.store(kExternalMagic, std::memory_order_release);
}

// The content of the directory: the variables for which this board's value counts.
void External::Impl::describe() {
  schema::Schema types;
  shown.writable.clear();
  for (const auto& topic : topics) {
    if (topic->leads()) {
      types.variables.push_back(topic->variable());
      types.variables.back().initial.clear();
      if (topic->is_writable()) {
        shown.writable.push_back(topic->variable().name);
      }
    }
  }
  shown.schema = schema::to_json(types);
}

Status External::Impl::run() {
  if (Status published = file.publish(); !published) {
    return published;
  }
  rt::ThreadSettings how;
  how.name = "irp-external";
  auto started = rt::Thread::start(how, [this] { work(); });
  if (!started) {
    return started.error();
  }
  thread = std::move(started).value();
  return {};
}

Result<void, base::Problem> External::Impl::open(dds::Handle participant) {
  const bool eager = topics.size() <= kEagerTopics;
  for (const auto& topic : topics) {
    if (auto opened = eager ? topic->open(participant) : topic->open_reader(participant); !opened) {
      return opened;
    }
    if (!eager) {
      unopened.emplace(topic->topic_name(), topic.get());
    }
  }
  if (!eager) {
    if (auto opened = wanted_topics.open(participant); !opened) {
      return base::Problem{"cannot discover readers: " + opened.error().text};
    }
  }
  describe();
  return directory.open(participant, shown, !eager);
}

void External::Impl::close() noexcept {
  directory.close();
  for (const auto& topic : topics) {
    topic->close();
  }
  unopened.clear();
  wanted_topics.close();
}

// Opens the topics that a participant in the network requests to read.
void External::Impl::discover_readers() noexcept {
  if (unopened.empty()) {
    return;
  }
  const auto open = [this](const std::string& topic) {
    const auto found = unopened.find(topic);
    if (found == unopened.end()) {
      return;
    }
    if (const auto opened = found->second->open(joining.participant()); opened) {
      unopened.erase(found);
    } else {
      block.problem.set(opened.error().text);
    }
  };
  for (const std::string& variable : directory.take_requests()) {
    open(topic_name(variable));
  }
  wanted_topics.take(open);
}

void External::Impl::update_lead(std::int64_t now_ns) {
  bool changed = false;
  for (const auto& topic : topics) {
    changed = topic->update_lead(now_ns) || changed;
  }
  if (changed) {
    describe();
    if (const auto published = directory.publish(shown); !published) {
      block.problem.set(published.error().text);
    }
  }
}

// Checks everything once; returns when the next check is due.
std::int64_t External::Impl::serve(std::int64_t now_ns) {
  update_lead(now_ns);
  discover_readers();
  std::int64_t next = now_ns + kReadersPollNs;
  std::uint32_t read = 0;
  for (const auto& topic : topics) {
    topic->receive();
    if (topic->is_open()) {
      next = std::min(next, topic->publish(now_ns));
      read += topic->is_read() ? 1U : 0U;
    }
    if (const std::string complaint = topic->complaint(); !complaint.empty()) {
      block.problem.set(complaint);
    }
  }
  block.read.store(read, std::memory_order_relaxed);
  const std::int64_t took = rt::now_ns() - now_ns;
  if (took > block.cycle_max_ns.load(std::memory_order_relaxed)) {
    block.cycle_max_ns.store(took, std::memory_order_relaxed);
  }
  return next;
}

void External::Impl::work() {
  // DDS threads inherit their cores from the thread that creates the participant.
  if (!settings.cores.empty()) {
    (void)rt::pin_to_cores(settings.cores);
  }
  if (!joining.join(stop, wake, block.problem)) {
    return;
  }
  block.network.store(Network::Up, std::memory_order_release);
  while (!stopping()) {
    const std::int64_t next = serve(rt::now_ns());
    wake.wait_until(rt::mono_time(std::max(next, rt::now_ns() + kExternalFastestNs / 2)));
    while (wake.try_wait()) {
    }
  }
  (void)serve(rt::now_ns() + kLaterNs);  // publishes the last values, whenever they would be due
}

void External::Impl::end() noexcept {
  stop.store(true, std::memory_order_release);
  wake.wake();
  thread.join();
  joining.leave();
}

Result<External> External::start(const ExternalSettings& settings, const std::string& node, vars::Store& store,
                                 const MirrorBlock* plant) {
  auto file = vars::ShmFile::create(vars::external_file(node), sizeof(ExternalBlock));
  if (!file) {
    return file.error();
  }
  auto impl = std::make_unique<Impl>(settings, node, store, plant, std::move(file).value());
  if (Status running = impl->run(); !running) {
    impl->end();
    return running.error();
  }
  return External(std::move(impl));
}

External::External(std::unique_ptr<Impl> impl) noexcept : impl_(std::move(impl)) {}
External::External(External&&) noexcept = default;
External& External::operator=(External&& other) noexcept {
  std::swap(impl_, other.impl_);
  return *this;
}
External::~External() {
  stop();
}

void External::stop() noexcept {
  if (impl_ != nullptr) {
    impl_->end();
    impl_.reset();
  }
}

}  // namespace indurop::mirror
