// SPDX-License-Identifier: Apache-2.0
#include "network/mirror/remote/remote_plane.h"

#include <indurop/idl/wire.h>

#include <algorithm>
#include <map>
#include <set>
#include <tuple>
#include <utility>

#include "core/rt/signal_word.h"
#include "core/schema/ros_name.h"
#include "core/schema/topic_name.h"
#include "network/dds/endpoint.h"
#include "network/dds/publications.h"
#include "network/dds/remote_topic.h"
#include "network/dds/setup.h"
#include "network/mirror/external/external_type.h"
#include "network/mirror/remote/remote_sources.h"

namespace indurop::mirror {
namespace {

constexpr std::int64_t kRemoteLeaseNs = 2'000'000'000;
constexpr std::int64_t kPresentNs = 300'000'000;  // by then a board has announced its variables
constexpr std::int64_t kTypeNs = 500'000'000;     // for the answer to a request for a type

std::string name_of_topic(const std::string& topic) {
  std::string name;
  for (const char c : topic) {
    name += c == '/' ? std::string("::") : std::string(1, c);
  }
  return name;
}

// No variables: the platform's own topics, and pools.
bool is_own_topic(const dds::Publication& publication) {
  return publication.topic.starts_with("indurop/") || publication.topic.starts_with("DCPS") ||
         publication.type == "indurop::pool::Part";
}

}  // namespace

struct RemotePlane::Impl {
  // A topic of a program that is no board.
  struct Strange {
    schema::Variable declared;
    std::string problem;
  };

  // Returns a note for the user.
  Result<std::string, base::Problem> open(const dds::NetworkSettings& settings);
  void take_publications();
  void check_unreadable(std::int64_t now_ns);
  [[nodiscard]] Strange describe(const dds::Publication& publication) const;
  using Topics = std::multimap<std::string, const dds::Publication*>;  // by name
  void make_topic(const std::string& variable, dds::RemoteTopic& topic, const Topics& topics);
  void make_topics();
  void send_request();

  rt::SignalWord wake{};  // used by listeners until the readers are gone
  dds::Participant participant;
  dds::Publications publications;
  dds::Endpoint directories;
  dds::Endpoint request_writer;
  RemoteSources sources;
  std::map<dds::Guid, dds::Publication> published;                    // by endpoint
  std::map<dds::Guid, std::int64_t> seen_ns;                          // participants, since when they are seen
  std::map<std::string, Strange> unreadable;                          // by topic
  std::map<std::string, std::unique_ptr<dds::RemoteTopic>> followed;  // by variable
  std::vector<std::string> requested;
  std::size_t requests_sent = 0;
  std::uint64_t generation = 0;
};

Result<std::string, base::Problem> RemotePlane::Impl::open(const dds::NetworkSettings& settings) {
  dds::NetworkSettings network = settings;
  if (settings.one_host) {
    network.interface_name = "lo";  // third-party tools are found by multicast on it too
    network.one_host = false;
  }
  network.peers.emplace_back("127.0.0.1");  // a node of this machine
  network.known_ports = true;
  network.lease_ns = kRemoteLeaseNs;
  wake.init(false);
  auto joined = dds::join_network(network);
  if (!joined) {
    return std::move(joined).error();
  }
  participant = std::move(joined->participant);
  const auto opened_all = publications.open(participant.get(), wake);
  directories = dds::make_reader(participant.get(), indurop_wire_Directory_desc, schema::directory_topic(),
                                 dds::make_qos({}), dds::wake_listener(wake));
  request_writer =
      dds::make_writer(participant.get(), indurop_wire_Wish_desc, schema::request_topic(), dds::make_qos({}));
  if (!opened_all || !directories.ok() || !request_writer.ok()) {
    return base::Problem{
        "cannot discover the variables of boards: " +
        (opened_all ? (directories.ok() ? request_writer.why() : directories.why()) : opened_all.error().text)};
  }
  return std::move(joined->note);
}

void RemotePlane::Impl::take_publications() {
  for (dds::Publications::News& news : publications.take()) {
    if (!news.publication) {
      published.erase(news.endpoint);
      continue;
    }
    seen_ns.emplace(news.publication->participant, rt::now_ns());
    if (!is_own_topic(*news.publication)) {
      published[news.endpoint] = std::move(*news.publication);
    }
  }
}

RemotePlane::Impl::Strange RemotePlane::Impl::describe(const dds::Publication& publication) const {
  Strange strange;
  auto type = publications.type_of(publication, kTypeNs);
  if (!type) {
    strange.problem = std::move(type).error().text;
    return strange;
  }
  strange.declared.name = name_of_topic(publication.topic);
  strange.declared.type = unwrapped(*type, strange.declared.name);
  strange.declared.type_hash = schema::hash_of(strange.declared.type);
  strange.declared.source = "network";
  return strange;
}

void RemotePlane::Impl::check_unreadable(std::int64_t now_ns) {
  for (const auto& [endpoint, publication] : published) {
    const bool board = sources.at(publication.participant) != nullptr;
    const auto seen = seen_ns.find(publication.participant);
    if (board || seen == seen_ns.end() || now_ns - seen->second < kPresentNs ||
        unreadable.contains(publication.topic)) {
      continue;
    }
    unreadable[publication.topic] = describe(publication);
    ++generation;
  }
}

// Creates a reader as soon as a participant publishes the topic, under its own name or that of ROS 2.
void RemotePlane::Impl::make_topic(const std::string& variable, dds::RemoteTopic& topic, const Topics& topics) {
  const auto [first, last] = topics.equal_range(external_topic(variable));
  for (auto there = first; there != last && !topic.is_open(); ++there) {
    (void)topic.open(participant.get(), publications, *there->second, wake);
  }
  const auto [ros_first, ros_last] = topics.equal_range(schema::ros_topic(variable));
  for (auto there = ros_first; there != ros_last && !topic.is_open(); ++there) {
    const RemoteSources::Source* const board = sources.at(there->second->participant);
    if (const schema::Variable* known = board == nullptr ? nullptr : schema::find_variable(board->schema, variable);
        known != nullptr) {
      (void)topic.open_as(known->type, schema::ros_type_name(*known), participant.get(), publications, *there->second,
                          wake);
    }
  }
}

void RemotePlane::Impl::make_topics() {
  Topics topics;
  for (const auto& [variable, topic] : followed) {
    if (!topic->is_open() && !topic->may_not_read()) {
      if (topics.empty()) {
        for (const auto& [endpoint, publication] : published) {
          topics.emplace(publication.topic, &publication);
        }
      }
      make_topic(variable, *topic, topics);
    }
  }
}

// Boards with many variables announce topics only to clients that request them.
void RemotePlane::Impl::send_request() {
  if (requests_sent == requested.size()) {
    return;
  }
  requests_sent = requested.size();
  std::vector<char*> names;
  names.reserve(requested.size());
  for (std::string& name : requested) {
    names.push_back(name.data());
  }
  indurop_wire_Wish out{};
  out.variables._buffer = names.data();
  out.variables._length = out.variables._maximum = static_cast<std::uint32_t>(names.size());
  (void)dds::write(request_writer.get(), out);
}

Result<RemotePlane::Opened, base::Problem> RemotePlane::open(const dds::NetworkSettings& settings) {
  auto impl = std::make_unique<Impl>();
  auto opened = impl->open(settings);
  if (!opened) {
    return std::move(opened).error();
  }
  return Opened{std::unique_ptr<RemotePlane>(new RemotePlane(std::move(impl))), std::move(*opened)};
}

RemotePlane::RemotePlane(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
RemotePlane::~RemotePlane() = default;

void RemotePlane::poll(rt::MonoTime deadline) {
  impl_->wake.wait_until(deadline);
  while (impl_->wake.try_wait()) {
  }
  impl_->sources.take(impl_->directories.get());
  impl_->take_publications();
  impl_->check_unreadable(rt::now_ns());
  impl_->send_request();
  impl_->make_topics();
}

std::vector<RemoteBoard> RemotePlane::boards() const {
  std::vector<RemoteBoard> all;
  for (const auto& [name, plant] : impl_->sources.boards()) {
    all.push_back({name, plant, impl_->sources.of(name) != nullptr});
  }
  return all;
}

std::vector<RemoteVariable> RemotePlane::variables() const {
  std::vector<RemoteVariable> all;
  for (const auto& [participant, source] : impl_->sources.all()) {
    for (const schema::Variable& variable : source.schema.variables) {
      all.push_back({variable, source.board, source.writable.contains(variable.name)});
    }
  }
  for (const auto& [topic, strange] : impl_->unreadable) {
    if (strange.problem.empty()) {
      all.push_back({strange.declared, {}, false});
    }
  }
  std::sort(all.begin(), all.end(), [](const RemoteVariable& a, const RemoteVariable& b) {
    return std::tie(a.declared.name, a.board) < std::tie(b.declared.name, b.board);
  });
  return all;
}

std::map<std::string, std::string> RemotePlane::silent_variables() const {
  std::map<std::string, std::string> all;
  for (const auto& [participant, source] : impl_->sources.all()) {
    for (const auto& [variable, board] : source.mirrored) {
      if (impl_->sources.of(board) == nullptr) {
        all.emplace(variable, board);
      }
    }
  }
  return all;
}

std::uint64_t RemotePlane::generation() const noexcept {
  return impl_->generation + impl_->sources.generation();  // neither ever decreases
}

bool RemotePlane::complete() const {
  const std::int64_t now = rt::now_ns();
  const bool all_present = std::all_of(impl_->seen_ns.begin(), impl_->seen_ns.end(), [&](const auto& entry) {
    return impl_->sources.at(entry.first) != nullptr || now - entry.second > kPresentNs;
  });
  const bool all_heard = std::all_of(impl_->sources.boards().begin(), impl_->sources.boards().end(),
                                     [&](const auto& entry) { return impl_->sources.of(entry.first) != nullptr; });
  return !impl_->seen_ns.empty() && all_present && all_heard;
}

std::vector<std::string> RemotePlane::hidden() const {
  std::vector<std::string> all;
  for (const auto& [topic, strange] : impl_->unreadable) {
    if (!strange.problem.empty()) {
      all.push_back(topic + ": " + strange.problem);
    }
  }
  return all;
}

void RemotePlane::follow(const std::string& variable, const std::string& board) {
  auto& topic = impl_->followed[variable];
  if (topic == nullptr) {
    topic = std::make_unique<dds::RemoteTopic>();
    if (!board.empty()) {
      impl_->requested.push_back(variable);
    }
  }
}

bool RemotePlane::may_not_read(const std::string& variable) const {
  const auto topic = impl_->followed.find(variable);
  return topic != impl_->followed.end() && topic->second->may_not_read();
}

bool RemotePlane::may_not_set(const std::string& variable) const {
  const auto topic = impl_->followed.find(variable);
  return topic != impl_->followed.end() && (topic->second->may_not_read() || topic->second->may_not_send());
}

void RemotePlane::reopen(const std::string& variable) {
  const auto topic = impl_->followed.find(variable);
  if (topic != impl_->followed.end()) {
    topic->second->close();
  }
}

void RemotePlane::take(const Use& use) {
  for (const auto& followed : impl_->followed) {
    followed.second->take([&](const dds::Guid& participant, std::span<const std::uint8_t> value) {
      const RemoteSources::Source* const source = impl_->sources.at(participant);
      use(followed.first, source == nullptr ? std::string{} : source->board, value);
    });
  }
}

bool RemotePlane::send(const std::string& variable, const std::string& board, std::span<const std::uint8_t> value) {
  const auto topic = impl_->followed.find(variable);
  if (topic == impl_->followed.end()) {
    return false;
  }
  const dds::Guid* const participant = impl_->sources.participant_of(board);
  return participant != nullptr && topic->second->send(impl_->participant.get(), *participant, value);
}

}  // namespace indurop::mirror
