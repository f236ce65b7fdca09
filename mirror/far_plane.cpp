// SPDX-License-Identifier: Apache-2.0
#include "mirror/far_plane.h"

#include <wire.h>

#include <algorithm>
#include <array>
#include <map>
#include <set>
#include <tuple>

#include "mirror/dds_setup.h"
#include "mirror/external_directory.h"
#include "mirror/external_type.h"
#include "mirror/far_sources.h"
#include "mirror/far_topic.h"
#include "mirror/far_type.h"
#include "rt/clock.h"
#include "rt/signal_word.h"
#include "schema/ros_name.h"

namespace indurop::mirror {
namespace {

constexpr std::int64_t kLeaseNs = 2'000'000'000;
constexpr std::int64_t kPresentNs = 300'000'000;  // by then a board has told what it shows
constexpr std::uint32_t kAtOnce = 32;
constexpr std::int64_t kTypeNs = 500'000'000;  // for the answer to a question about a type

std::string name_of_topic(const std::string& topic) {
  std::string name;
  for (const char c : topic) {
    name += c == '/' ? std::string("::") : std::string(1, c);
  }
  return name;
}

bool is_own_topic(std::string_view topic) {
  return topic.starts_with("indurop/") || topic.starts_with("DCPS");
}

}  // namespace

struct FarPlane::Impl {
  struct Publication {
    Guid participant{};
    std::string topic;
    dds_instance_handle_t instance = 0;  // of the reader of publications, which keeps what was told
  };
  // A topic of somebody who is no board.
  struct Strange {
    schema::Variable declared;
    std::string problem;
  };

  bool open(const FarSettings& settings, std::string& problem);
  void take_publications();
  void note(const dds_builtintopic_endpoint_t& told, const dds_sample_info_t& info);
  void look_at_strangers(std::int64_t now_ns);
  void describe(const Publication& publication, Strange& strange);
  // What was told about it; false if it is gone.
  bool with(const Publication& publication, const std::function<void(dds_builtintopic_endpoint_t&)>& use) const;
  using Topics = std::multimap<std::string, const Publication*>;  // by name
  void make_topic(const std::string& variable, FarTopic& topic, const Topics& topics);
  void make_topics();
  void wish();

  rt::SignalWord wake{};  // used by listeners until the readers are gone
  Participant joined;
  Guid own{};
  Entity publications;
  Endpoint directories;
  Endpoint wishes;
  FarSources sources;
  std::map<Guid, Publication> published;                      // by endpoint
  std::map<Guid, std::int64_t> seen_ns;                       // participants, since when
  std::map<std::string, Strange> strangers;                   // by topic
  std::map<std::string, std::unique_ptr<FarTopic>> followed;  // by variable
  std::vector<std::string> wished;
  std::size_t wishes_told = 0;
  std::uint64_t generation = 0;
};

bool FarPlane::Impl::open(const FarSettings& settings, std::string& problem) {
  Settings network;
  network.domain = settings.domain;
  network.interface_name = settings.one_host ? "lo" : settings.interface_name;
  network.peers = settings.peers;
  network.peers.emplace_back("127.0.0.1");  // a node of this machine
  network.known_ports = true;
  network.lease_ns = kLeaseNs;
  wake.init(false);
  joined = join_plant(network, problem);
  if (!joined.participant.ok()) {
    return false;
  }
  const dds_entity_t participant = joined.participant.get();
  dds_guid_t guid{};
  (void)dds_get_guid(participant, &guid);
  own = guid_of(guid);
  const Listener listener =
      data_listener([](dds_entity_t /*reader*/, void* word) { static_cast<rt::SignalWord*>(word)->wake(); }, &wake);
  publications = Entity(dds_create_reader(participant, DDS_BUILTIN_TOPIC_DCPSPUBLICATION, nullptr, listener.get()));
  directories = make_reader(participant, indurop_wire_Directory_desc, directory_topic(), make_qos({}), listener);
  wishes = make_writer(participant, indurop_wire_Wish_desc, wish_topic(), make_qos({}));
  if (!publications.ok() || !directories.ok() || !wishes.ok()) {
    problem = "cannot look at what boards show: " +
              (publications.ok() ? (directories.ok() ? wishes.why() : directories.why()) : publications.why());
    return false;
  }
  return true;
}

void FarPlane::Impl::take_publications() {
  constexpr std::uint32_t kNews = DDS_NOT_READ_SAMPLE_STATE | DDS_ANY_VIEW_STATE | DDS_ANY_INSTANCE_STATE;
  std::array<void*, kAtOnce> samples{};
  std::array<dds_sample_info_t, kAtOnce> infos{};
  for (;;) {
    samples[0] = nullptr;
    // Read, not taken: types are looked up from it later.
    const int count = dds_read_mask(publications.get(), samples.data(), infos.data(), kAtOnce, kAtOnce, kNews);
    if (count <= 0) {
      return;
    }
    for (std::size_t i = 0; i < static_cast<std::size_t>(count); ++i) {
      note(*static_cast<const dds_builtintopic_endpoint_t*>(samples[i]), infos[i]);
    }
    (void)dds_return_loan(publications.get(), samples.data(), count);
  }
}

void FarPlane::Impl::note(const dds_builtintopic_endpoint_t& told, const dds_sample_info_t& info) {
  const Guid endpoint = guid_of(told.key);
  if (!info.valid_data || info.instance_state != DDS_IST_ALIVE) {
    published.erase(endpoint);
    return;
  }
  const Guid participant = guid_of(told.participant_key);
  if (participant == own || told.topic_name == nullptr) {
    return;
  }
  seen_ns.emplace(participant, rt::now_ns());
  if (!is_own_topic(told.topic_name)) {
    published[endpoint] = {participant, told.topic_name, info.instance_handle};
  }
}

bool FarPlane::Impl::with(const Publication& publication,
                          const std::function<void(dds_builtintopic_endpoint_t&)>& use) const {
  // As large as in take_publications(): DDS fills in what it lent this reader once, however little is asked for now.
  std::array<void*, kAtOnce> samples{};
  std::array<dds_sample_info_t, kAtOnce> infos{};
  const int count =
      dds_read_instance(publications.get(), samples.data(), infos.data(), kAtOnce, kAtOnce, publication.instance);
  if (count <= 0) {
    return false;
  }
  const bool there = infos[0].valid_data && infos[0].instance_state == DDS_IST_ALIVE;
  if (there) {
    use(*static_cast<dds_builtintopic_endpoint_t*>(samples[0]));
  }
  (void)dds_return_loan(publications.get(), samples.data(), count);
  return there;
}

void FarPlane::Impl::describe(const Publication& publication, Strange& strange) {
  strange.problem = "its publisher tells nothing about its type";
  (void)with(publication, [&](dds_builtintopic_endpoint_t& told) {
    const dds_typeinfo_t* information = nullptr;
    if (dds_builtintopic_get_endpoint_type_info(&told, &information) < 0 || information == nullptr) {
      return;
    }
    auto type = type_from_network(joined.participant.get(), information, kTypeNs, strange.problem);
    if (type) {
      strange.problem.clear();
      strange.declared.name = name_of_topic(publication.topic);
      strange.declared.type = unwrapped(*type, strange.declared.name);
      strange.declared.type_hash = schema::hash_of(strange.declared.type);
      strange.declared.source = "network";
    }
  });
}

void FarPlane::Impl::look_at_strangers(std::int64_t now_ns) {
  for (const auto& [endpoint, publication] : published) {
    const bool board = sources.at(publication.participant) != nullptr;
    const auto seen = seen_ns.find(publication.participant);
    if (board || seen == seen_ns.end() || now_ns - seen->second < kPresentNs || strangers.contains(publication.topic)) {
      continue;
    }
    describe(publication, strangers[publication.topic]);
    ++generation;
  }
}

// A reader as soon as somebody publishes it, under its own name or that of ROS 2.
void FarPlane::Impl::make_topic(const std::string& variable, FarTopic& topic, const Topics& topics) {
  const dds_entity_t participant = joined.participant.get();
  const auto [first, last] = topics.equal_range(external_topic(variable));
  for (auto there = first; there != last && !topic.is_open(); ++there) {
    (void)with(*there->second, [&](auto& told) { (void)topic.open(participant, told, wake); });
  }
  const auto [ros_first, ros_last] = topics.equal_range(schema::ros_topic(variable));
  for (auto there = ros_first; there != ros_last && !topic.is_open(); ++there) {
    const FarSources::Source* const board = sources.at(there->second->participant);
    if (const schema::Variable* known = board == nullptr ? nullptr : schema::find_variable(board->schema, variable);
        known != nullptr) {
      (void)with(*there->second, [&](auto& told) { (void)topic.open_ros(participant, told, *known, wake); });
    }
  }
}

void FarPlane::Impl::make_topics() {
  Topics topics;
  for (const auto& [variable, topic] : followed) {
    if (!topic->is_open()) {
      if (topics.empty()) {
        for (const auto& [endpoint, publication] : published) {
          topics.emplace(publication.topic, &publication);
        }
      }
      make_topic(variable, *topic, topics);
    }
  }
}

// Boards with many variables announce topics only to who asks for them.
void FarPlane::Impl::wish() {
  if (wishes_told == wished.size()) {
    return;
  }
  wishes_told = wished.size();
  std::vector<char*> names;
  names.reserve(wished.size());
  for (std::string& name : wished) {
    names.push_back(name.data());
  }
  indurop_wire_Wish out{};
  out.variables._buffer = names.data();
  out.variables._length = out.variables._maximum = static_cast<std::uint32_t>(names.size());
  (void)dds_write(wishes.get(), &out);
}

std::unique_ptr<FarPlane> FarPlane::open(const FarSettings& settings, std::string& problem) {
  auto impl = std::make_unique<Impl>();
  return impl->open(settings, problem) ? std::unique_ptr<FarPlane>(new FarPlane(std::move(impl))) : nullptr;
}

FarPlane::FarPlane(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
FarPlane::~FarPlane() = default;

void FarPlane::look(std::int64_t deadline_ns) {
  impl_->wake.wait_until(deadline_ns);
  while (impl_->wake.try_wait()) {
  }
  impl_->sources.take(impl_->directories.get());
  impl_->take_publications();
  impl_->look_at_strangers(rt::now_ns());
  impl_->wish();
  impl_->make_topics();
}

std::vector<FarBoard> FarPlane::boards() const {
  std::vector<FarBoard> all;
  for (const auto& [name, plant] : impl_->sources.boards()) {
    all.push_back({name, plant, impl_->sources.of(name) != nullptr});
  }
  return all;
}

std::vector<FarVariable> FarPlane::variables() const {
  std::vector<FarVariable> all;
  for (const auto& [participant, source] : impl_->sources.all()) {
    for (const schema::Variable& variable : source.schema.variables) {
      all.push_back({variable, source.board, source.writable.contains(variable.name)});
    }
  }
  for (const auto& [topic, strange] : impl_->strangers) {
    if (strange.problem.empty()) {
      all.push_back({strange.declared, {}, false});
    }
  }
  std::sort(all.begin(), all.end(), [](const FarVariable& a, const FarVariable& b) {
    return std::tie(a.declared.name, a.board) < std::tie(b.declared.name, b.board);
  });
  return all;
}

std::uint64_t FarPlane::generation() const noexcept {
  return impl_->generation + impl_->sources.generation();  // neither ever decreases
}

bool FarPlane::complete() const {
  const std::int64_t now = rt::now_ns();
  const bool all_present = std::all_of(impl_->seen_ns.begin(), impl_->seen_ns.end(), [&](const auto& entry) {
    return impl_->sources.at(entry.first) != nullptr || now - entry.second > kPresentNs;
  });
  const bool all_heard = std::all_of(impl_->sources.boards().begin(), impl_->sources.boards().end(),
                                     [&](const auto& entry) { return impl_->sources.of(entry.first) != nullptr; });
  return !impl_->seen_ns.empty() && all_present && all_heard;
}

std::vector<std::string> FarPlane::hidden() const {
  std::vector<std::string> all;
  for (const auto& [topic, strange] : impl_->strangers) {
    if (!strange.problem.empty()) {
      all.push_back(topic + ": " + strange.problem);
    }
  }
  return all;
}

void FarPlane::follow(const std::string& variable, const std::string& board) {
  auto& topic = impl_->followed[variable];
  if (topic == nullptr) {
    topic = std::make_unique<FarTopic>();
    if (!board.empty()) {
      impl_->wished.push_back(variable);
    }
  }
}

void FarPlane::reopen(const std::string& variable) {
  const auto topic = impl_->followed.find(variable);
  if (topic != impl_->followed.end()) {
    topic->second->close();
  }
}

void FarPlane::take(const Use& use) {
  for (const auto& followed : impl_->followed) {
    followed.second->take([&](const Guid& participant, std::span<const std::uint8_t> value) {
      const FarSources::Source* const source = impl_->sources.at(participant);
      use(followed.first, source == nullptr ? std::string{} : source->board, value);
    });
  }
}

bool FarPlane::send(const std::string& variable, const std::string& board, std::span<const std::uint8_t> value) {
  const auto topic = impl_->followed.find(variable);
  if (topic == impl_->followed.end()) {
    return false;
  }
  const Guid* const participant = impl_->sources.participant_of(board);
  return participant != nullptr && topic->second->send(impl_->joined.participant.get(), *participant, value);
}

}  // namespace indurop::mirror
