// SPDX-License-Identifier: Apache-2.0
#include "mirror/deploy_link.h"

#include <deploy.h>
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <map>
#include <random>

#include "mirror/dds_setup.h"
#include "mirror/lent.h"
#include "mirror/other_releases.h"
#include "rt/clock.h"
#include "rt/machine.h"
#include "rt/signal_word.h"
#include "schema/topic_name.h"

namespace indurop::mirror {
namespace {

constexpr std::int64_t kLeaseNs = 2'000'000'000;
constexpr std::int64_t kBlockNs = 100'000'000;  // a chunk waits so long for room
constexpr std::int32_t kDepth = 512;            // messages a receiver may lag behind
constexpr std::size_t kMostRoom = 2U << 20U;

std::string topic_name(const std::string& what) {
  return schema::deploy_topics() + what;
}

std::string blob_topic(std::uint64_t requester) {
  return topic_name(fmt::format("blob/{:016x}", requester));
}

Qos link_qos(bool state) {
  return make_qos({.block_ns = kBlockNs,
                   .for_late_ones = state,
                   .depth = state ? 1 : kDepth,
                   .lease_ns = kLeaseNs,
                   .dispose_at_end = true});
}

class Names {
 public:
  explicit Names(const std::vector<std::string>& names) {
    for (const std::string& name : names) {
      pointers_.push_back(lent(name));
    }
  }
  template <class Sequence>
  void put(Sequence& sequence) {
    sequence._buffer = pointers_.data();
    sequence._length = sequence._maximum = static_cast<std::uint32_t>(pointers_.size());
    sequence._release = false;
  }
  template <class Sequence>
  static std::vector<std::string> get(const Sequence& sequence) {
    return {sequence._buffer, sequence._buffer + sequence._length};
  }

 private:
  std::vector<char*> pointers_;
};

template <class Enum>
Enum bounded(std::uint8_t value, Enum last) {
  return value <= static_cast<std::uint8_t>(last) ? static_cast<Enum>(value) : last;
}

deploy::BoardReport from_wire(const indurop_deploy_BoardReport& in) {
  deploy::BoardReport out;
  out.board = in.board;
  out.agent = in.agent;
  out.host = in.host;
  out.release = in.release;
  out.generation = in.generation;
  out.plant = in.plant;
  out.current = in.current;
  out.current_size = in.current_size;
  out.previous = in.previous;
  out.members = Names::get(in.members);
  out.deployer = in.deployer;
  out.deployer_host = in.deployer_host;
  out.proposed = in.proposed;
  out.phase = bounded(in.phase, deploy::Phase::Failed);
  out.stage = bounded(in.stage, deploy::Phase::Failed);
  out.files = in.files;
  out.files_done = in.files_done;
  out.bytes = in.bytes;
  out.bytes_done = in.bytes_done;
  out.message = in.message;
  out.grant = in.grant;
  out.refused = in.refused;
  out.refusal = in.refusal;
  out.node = bounded(in.node, deploy::NodeCondition::Stopped);
  out.tick = in.tick;
  out.lost_ticks = in.lost_ticks;
  out.overruns = in.overruns;
  out.faults = in.faults;
  out.clock_offset_ns = in.clock_offset_ns;
  return out;
}

deploy::Order from_wire(const indurop_deploy_Order& in) {
  deploy::Order out;
  out.deployer = in.deployer;
  out.host = in.host;
  out.plant = in.plant;
  out.deployment = in.deployment;
  out.size = in.size;
  out.generation = in.generation;
  out.boards = Names::get(in.boards);
  out.step = bounded(in.step, deploy::Step::Abort);
  out.said_at_ns = in.said_at_ns;
  out.switch_at_ns = in.switch_at_ns;
  out.health_ns = in.health_ns;
  out.grant = in.grant;
  out.signature = in.signature;
  return out;
}

}  // namespace

struct DeployLink::Impl {
  // Empty: made. Else what failed.
  std::string make();
  Endpoint reader(const dds_topic_descriptor_t& type, const std::string& topic, bool state);
  Endpoint writer(const dds_topic_descriptor_t& type, const std::string& topic, bool state);

  std::uint64_t self = 0;
  rt::SignalWord wake{};  // used by listeners until the readers are gone
  Participant joined;
  OtherReleases others;
  Endpoint boards_out;
  Endpoint orders_out;
  Endpoint requests_out;
  std::map<std::uint64_t, Endpoint> blobs_out;  // by requester
  Endpoint boards_in;
  Endpoint orders_in;
  Endpoint requests_in;
  Endpoint blobs_in;
};

Endpoint DeployLink::Impl::reader(const dds_topic_descriptor_t& type, const std::string& topic, bool state) {
  const auto wake_up = [](dds_entity_t /*reader*/, void* word) { static_cast<rt::SignalWord*>(word)->wake(); };
  return make_reader(joined.participant.get(), type, topic, link_qos(state), data_listener(wake_up, &wake));
}

Endpoint DeployLink::Impl::writer(const dds_topic_descriptor_t& type, const std::string& topic, bool state) {
  return make_writer(joined.participant.get(), type, topic, link_qos(state));
}

std::string DeployLink::Impl::make() {
  boards_in = reader(indurop_deploy_BoardReport_desc, topic_name("board"), true);
  orders_in = reader(indurop_deploy_Order_desc, topic_name("order"), true);
  requests_in = reader(indurop_deploy_Request_desc, topic_name("request"), false);
  blobs_in = reader(indurop_deploy_Chunk_desc, blob_topic(self), false);
  boards_out = writer(indurop_deploy_BoardReport_desc, topic_name("board"), true);
  orders_out = writer(indurop_deploy_Order_desc, topic_name("order"), true);
  requests_out = writer(indurop_deploy_Request_desc, topic_name("request"), false);
  for (const Endpoint* end :
       {&boards_in, &orders_in, &requests_in, &blobs_in, &boards_out, &orders_out, &requests_out}) {
    if (!end->ok()) {
      return "deployment topics cannot be made: " + end->why();
    }
  }
  std::string problem;
  (void)others.open(joined.participant.get(), problem);
  return problem;
}

std::uint64_t new_session() {
  // The clock first, so that of two deployers the one that began earlier has the smaller number.
  std::random_device random;
  return (static_cast<std::uint64_t>(rt::wall_ns()) & ~std::uint64_t{0xffff}) | (random() & 0xffffU);
}

std::string host_name() {
  std::array<char, 256> name{};
  return ::gethostname(name.data(), name.size() - 1) == 0 ? name.data() : "?";
}

std::unique_ptr<DeployLink> DeployLink::open(const LinkSettings& settings, std::string& problem) {
  Settings network;
  network.domain = settings.domain;
  network.board = settings.board;
  network.interface_name = settings.interface_name;
  network.address = settings.address;
  network.multicast = settings.multicast;
  network.peers = settings.peers;
  network.one_host = settings.one_host;
  network.known_ports = true;
  network.lease_ns = kLeaseNs;
  auto impl = std::make_unique<Impl>();
  impl->self = settings.self;
  impl->wake.init(false);
  impl->joined = join_plant(network, problem);
  if (!impl->joined.participant.ok()) {
    return nullptr;
  }
  if (const std::string failed = impl->make(); !failed.empty()) {
    problem = failed;
    return nullptr;
  }
  return std::unique_ptr<DeployLink>(new DeployLink(std::move(impl)));
}

DeployLink::DeployLink(std::unique_ptr<Impl> impl)
    : impl_(std::move(impl)), room_(std::clamp(rt::largest_receive_buffer() / 2, 2 * kChunk, kMostRoom)) {}
DeployLink::~DeployLink() = default;

void DeployLink::publish(const deploy::BoardReport& report) {
  indurop_deploy_BoardReport out{};
  Names members(report.members);
  out.board = lent(report.board);
  out.agent = report.agent;
  out.host = lent(report.host);
  out.release = lent(report.release);
  out.generation = report.generation;
  out.plant = lent(report.plant);
  out.current = lent(report.current);
  out.current_size = report.current_size;
  out.previous = lent(report.previous);
  members.put(out.members);
  out.deployer = report.deployer;
  out.deployer_host = lent(report.deployer_host);
  out.proposed = lent(report.proposed);
  out.phase = static_cast<std::uint8_t>(report.phase);
  out.stage = static_cast<std::uint8_t>(report.stage);
  out.files = report.files;
  out.files_done = report.files_done;
  out.bytes = report.bytes;
  out.bytes_done = report.bytes_done;
  out.message = lent(report.message);
  out.grant = lent(report.grant);
  out.refused = report.refused;
  out.refusal = lent(report.refusal);
  out.node = static_cast<std::uint8_t>(report.node);
  out.tick = report.tick;
  out.lost_ticks = report.lost_ticks;
  out.overruns = report.overruns;
  out.faults = report.faults;
  out.clock_offset_ns = report.clock_offset_ns;
  (void)dds_write(impl_->boards_out.get(), &out);  // told again soon
}

void DeployLink::publish(const deploy::Order& order) {
  indurop_deploy_Order out{};
  Names boards(order.boards);
  out.deployer = order.deployer;
  out.host = lent(order.host);
  out.plant = lent(order.plant);
  out.deployment = lent(order.deployment);
  out.size = order.size;
  out.generation = order.generation;
  boards.put(out.boards);
  out.step = static_cast<std::uint8_t>(order.step);
  out.said_at_ns = order.said_at_ns;
  out.switch_at_ns = order.switch_at_ns;
  out.health_ns = order.health_ns;
  out.grant = lent(order.grant);
  out.signature = lent(order.signature);
  (void)dds_write(impl_->orders_out.get(), &out);
}

void DeployLink::request(const deploy::BlobRequest& request) {
  const indurop_deploy_Request out{request.requester, request.source, lent(request.blob),
                                   request.offset,    request.length, request.restart};
  (void)dds_write(impl_->requests_out.get(), &out);
}

DeployLink::Sent DeployLink::send(std::uint64_t requester, const deploy::BlobChunk& chunk) {
  Endpoint& writer = impl_->blobs_out[requester];
  if (!writer.ok()) {
    writer = impl_->writer(indurop_deploy_Chunk_desc, blob_topic(requester), false);
  }
  dds_publication_matched_status_t matched{};
  if (!writer.ok() || dds_get_publication_matched_status(writer.get(), &matched) < 0) {
    return Sent::Failed;
  }
  if (matched.current_count == 0) {
    return Sent::Later;
  }
  indurop_deploy_Chunk out{};
  out.source = chunk.source;
  out.blob = lent(chunk.blob);
  out.offset = chunk.offset;
  out.missing = chunk.missing;
  out.data._buffer = lent(chunk.data.data());
  out.data._length = out.data._maximum = static_cast<std::uint32_t>(chunk.data.size());
  const dds_return_t code = dds_write(writer.get(), &out);
  return code == DDS_RETCODE_TIMEOUT ? Sent::Later : code < 0 ? Sent::Failed : Sent::Yes;
}

void DeployLink::forget(std::uint64_t requester) {
  impl_->blobs_out.erase(requester);
}

std::vector<DeployLink::BoardNews> DeployLink::take_boards() {
  std::vector<BoardNews> news;
  take_all<indurop_deploy_BoardReport>(impl_->boards_in.get(), [&](const auto& sample, const dds_sample_info_t& info) {
    if (info.valid_data) {
      news.push_back({from_wire(sample), false});
    }
    if (info.instance_state != DDS_IST_ALIVE) {
      deploy::BoardReport report;
      report.board = sample.board;
      report.agent = sample.agent;
      news.push_back({std::move(report), true});
    }
  });
  return news;
}

std::vector<DeployLink::OrderNews> DeployLink::take_orders() {
  std::vector<OrderNews> news;
  take_all<indurop_deploy_Order>(impl_->orders_in.get(), [&](const auto& sample, const dds_sample_info_t& info) {
    if (info.valid_data) {
      news.push_back({from_wire(sample), false});
    }
    if (info.instance_state != DDS_IST_ALIVE) {
      deploy::Order order;
      order.deployer = sample.deployer;
      news.push_back({std::move(order), true});
    }
  });
  return news;
}

std::vector<deploy::BlobRequest> DeployLink::take_requests() {
  std::vector<deploy::BlobRequest> requests;
  take_all<indurop_deploy_Request>(impl_->requests_in.get(), [&](const auto& sample, const dds_sample_info_t& info) {
    if (info.valid_data && sample.source == impl_->self) {
      requests.push_back({sample.requester, sample.source, sample.blob, sample.offset, sample.length, sample.restart});
    }
  });
  return requests;
}

std::vector<deploy::BlobChunk> DeployLink::take_chunks() {
  std::vector<deploy::BlobChunk> chunks;
  take_all<indurop_deploy_Chunk>(impl_->blobs_in.get(), [&](const auto& sample, const dds_sample_info_t& info) {
    if (info.valid_data) {
      chunks.push_back({sample.source,
                        sample.blob,
                        sample.offset,
                        sample.missing,
                        {sample.data._buffer, sample.data._buffer + sample.data._length}});
    }
  });
  return chunks;
}

std::vector<deploy::OtherAgent> DeployLink::other_agents() {
  constexpr const char* kTool = "indurop";  // it has the same topics, and goes again
  (void)impl_->others.look();
  std::vector<deploy::OtherAgent> agents;
  for (OtherReleases::Speaker& speaker : impl_->others.speakers()) {
    if (speaker.topic.plant == "deploy" && speaker.program != kTool) {
      agents.push_back({speaker.topic.protocol, std::move(speaker.name), std::move(speaker.host)});
    }
  }
  return agents;
}

int DeployLink::participant() const noexcept {
  return impl_->joined.participant.get();
}

rt::SignalWord& DeployLink::wake_word() noexcept {
  return impl_->wake;
}

void DeployLink::wait(std::int64_t deadline_ns) {
  impl_->wake.wait_until(deadline_ns);
  while (impl_->wake.try_wait()) {
  }
}

}  // namespace indurop::mirror
