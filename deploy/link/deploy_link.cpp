// SPDX-License-Identifier: Apache-2.0
#include "deploy/link/deploy_link.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <map>
#include <memory>
#include <optional>
#include <random>
#include <utility>

#include "core/rt/clock.h"
#include "core/rt/machine.h"
#include "core/rt/signal_word.h"
#include "core/schema/topic_name.h"
#include "deploy/link/link_keys.h"
#include "deploy/link/report_inbox.h"
#include "deploy/link/speakers.h"
#include "deploy/link/wire_words.h"
#include "network/dds/endpoint.h"
#include "network/dds/guid.h"
#include "network/dds/network_options.h"
#include "network/dds/other_releases.h"
#include "network/dds/setup.h"

namespace indurop::deploy {
namespace {

constexpr std::int64_t kLeaseNs = 2'000'000'000;
// Writers that live as long as their program have the shortest lease of its participant. When a writer with the
// shortest lease is deleted, Cyclone (0.10) lets that of the next one end after the difference of the two: at once if
// they are equal, and then other participants forget this one although it is alive.
constexpr std::int64_t kStateLeaseNs = 1'900'000'000;
constexpr std::int64_t kChunkBlockNs = 100'000'000;  // maximum time that a chunk waits for room
constexpr std::int32_t kChunkDepth = 512;            // messages a receiver may lag behind
constexpr std::int32_t kReports = 8;  // of one name: several threads of DDS may store one before ReportInbox takes it
constexpr std::int64_t kLettingInNs = 2'000'000'000;
constexpr std::size_t kMaxRoom = 2U << 20U;

dds::Qos link_qos(bool state, bool writer) {
  return dds::make_qos({.block_ns = kChunkBlockNs,
                        .for_late_ones = state,
                        .depth = !state   ? kChunkDepth
                                 : writer ? 1
                                          : kReports,
                        .lease_ns = state && writer ? kStateLeaseNs : kLeaseNs,
                        .dispose_at_end = true});
}

}  // namespace

struct DeployLink::Impl {
  Impl(Subject about, std::uint64_t session, std::string own_certificate)
      : subject(about), self(session), certificate(std::move(own_certificate)), senders(certificate) {
    wake.init(false);
  }
  Result<void, base::Problem> make();
  [[nodiscard]] std::string topic_name(const std::string& what) const {
    return (subject == Subject::Plant ? schema::deploy_topics() : schema::platform_topics()) + what;
  }
  [[nodiscard]] std::string blob_topic(std::uint64_t requester) const {
    return topic_name(fmt::format("blob/{:016x}", requester));
  }
  dds::Endpoint reader(const dds::TypeDescriptor& type, const std::string& topic, bool state,
                       const dds::Listener& listener);
  dds::Endpoint writer(const dds::TypeDescriptor& type, const std::string& topic, bool state);

  Subject subject;
  std::uint64_t self;
  std::string certificate;
  rt::SignalWord wake{};  // used by listeners until the readers are gone
  ReportInbox reports{wake};
  std::shared_ptr<dds::Participant> participant;
  std::optional<dds::OtherReleases> others;
  Speakers senders;
  dds::Endpoint boards_out;  // these two are made when they are needed: participants with keys agree on each endpoint
  dds::Endpoint orders_out;
  dds::Endpoint requests_out;
  std::map<std::uint64_t, dds::Endpoint> blobs_out;  // by requester
  dds::Endpoint boards_in;
  dds::Endpoint orders_in;
  dds::Endpoint requests_in;
  dds::Endpoint blobs_in;
};

dds::Endpoint DeployLink::Impl::reader(const dds::TypeDescriptor& type, const std::string& topic, bool state,
                                       const dds::Listener& listener) {
  return dds::make_reader(participant->get(), type, topic, link_qos(state, false), listener);
}

dds::Endpoint DeployLink::Impl::writer(const dds::TypeDescriptor& type, const std::string& topic, bool state) {
  return dds::make_writer(participant->get(), type, topic, link_qos(state, true));
}

Result<void, base::Problem> DeployLink::Impl::make() {
  const dds::Listener wakes = dds::wake_listener(wake);
  boards_in = reader(indurop_deploy_BoardReport_desc, topic_name("board"), true, reports.listener());
  orders_in = reader(indurop_deploy_Order_desc, topic_name("order"), true, wakes);
  requests_in = reader(indurop_deploy_Request_desc, topic_name("request"), false, wakes);
  blobs_in = reader(indurop_deploy_Chunk_desc, blob_topic(self), false, wakes);
  requests_out = writer(indurop_deploy_Request_desc, topic_name("request"), false);
  for (const dds::Endpoint* end : {&boards_in, &orders_in, &requests_in, &blobs_in, &requests_out}) {
    // No participant's keys permit all of it: a viewer receives no orders.
    if (!end->ok() && !end->forbidden()) {
      return base::Problem{"deployment topics cannot be made: " + end->why()};
    }
  }
  return {};
}

void add_agent_options(base::Options& line, LinkSettings& settings) {
  dds::add_network_options(line, settings.network, "the agents");
}

void add_link_options(base::Options& line, LinkSettings& settings) {
  add_agent_options(line, settings);
  const auto take = [&settings](const std::string& text) {
    settings.keys = text;
    const auto done = use_keys(settings);
    return done ? std::string() : done.error().text;
  };
  line.add("--keys", "DIR", take,
           "Folder with the keys of the plant, a deployer or a viewer; needed if the boards have keys")
      .completes(base::Completion::Folder);
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

Result<DeployLink::Opened, base::Problem> DeployLink::open(const LinkSettings& settings) {
  dds::NetworkSettings network = settings.network;
  network.known_ports = true;
  network.lease_ns = kLeaseNs;
  auto impl = std::make_unique<Impl>(settings.subject, settings.self, network.security.certificate);
  auto joined = dds::join_network(network);
  if (!joined) {
    return std::move(joined).error();
  }
  impl->participant = std::make_shared<dds::Participant>(std::move(joined->participant));
  if (auto made = impl->make(); !made) {
    return std::move(made).error();
  }
  if (auto opened = impl->others.emplace().open(impl->participant->get()); !opened) {
    return std::move(opened).error();
  }
  return Opened{std::unique_ptr<DeployLink>(new DeployLink(std::move(impl), network.security.on())),
                std::move(joined->note)};
}

Result<std::unique_ptr<DeployLink>, base::Problem> DeployLink::open_platform() const {
  auto impl = std::make_unique<Impl>(Subject::Platform, impl_->self, impl_->certificate);
  impl->participant = impl_->participant;
  if (auto made = impl->make(); !made) {
    return std::move(made).error();
  }
  return std::unique_ptr<DeployLink>(new DeployLink(std::move(impl), letting_in_ns_ > 0));
}

DeployLink::DeployLink(std::unique_ptr<Impl> impl, bool secured)
    : impl_(std::move(impl)),
      letting_in_ns_(secured ? kLettingInNs : 0),
      room_(std::clamp(rt::largest_receive_buffer() / 2, 2 * kChunk, kMaxRoom)) {}
DeployLink::~DeployLink() = default;

void DeployLink::publish(const BoardReport& report) {
  dds::Endpoint& writer = impl_->boards_out;
  if (!writer.ok()) {
    writer = impl_->writer(indurop_deploy_BoardReport_desc, impl_->topic_name("board"), true);
  }
  const wire::Lent lent(report);
  (void)dds::write(writer.get(), lent.sample());  // it is sent again soon
}

void DeployLink::publish(const Order& order) {
  dds::Endpoint& writer = impl_->orders_out;
  if (!writer.ok()) {
    writer = impl_->writer(indurop_deploy_Order_desc, impl_->topic_name("order"), true);
  }
  const wire::Lent lent(order);
  (void)dds::write(writer.get(), lent.sample());
}

void DeployLink::request(const BlobRequest& request) {
  const wire::Lent lent(request);
  (void)dds::write(impl_->requests_out.get(), lent.sample());
}

DeployLink::Sent DeployLink::send(std::uint64_t requester, const BlobChunk& chunk) {
  dds::Endpoint& writer = impl_->blobs_out[requester];
  if (!writer.ok()) {
    writer = impl_->writer(indurop_deploy_Chunk_desc, impl_->blob_topic(requester), false);
  }
  const auto readers = writer.ok() ? dds::readers_of(writer.get()) : std::nullopt;
  if (!readers) {
    return Sent::Failed;
  }
  if (*readers == 0) {
    return Sent::Later;
  }
  const wire::Lent lent(chunk);
  const dds::Written written = dds::write(writer.get(), lent.sample());
  return written.timed_out() ? Sent::Later : written.ok() ? Sent::Yes : Sent::Failed;
}

void DeployLink::forget(std::uint64_t requester) {
  impl_->blobs_out.erase(requester);
}

std::vector<DeployLink::BoardNews> DeployLink::take_boards() {
  std::vector<BoardNews> news;
  const dds::Handle reader = impl_->boards_in.get();
  Speakers& senders = impl_->senders;
  for (ReportInbox::Received& one : impl_->reports.take()) {
    if (one.report && senders.admit(reader, one.publication, *one.report, one.reports)) {
      news.push_back({std::move(*one.report), false});
    }
    if (one.gone && senders.leave(reader, one.publication, one.board, one.agent)) {
      BoardReport name;
      name.board = std::move(one.board);
      name.agent = one.agent;
      news.push_back({std::move(name), true});
    }
  }
  return news;
}

std::vector<DeployLink::OrderNews> DeployLink::take_orders() {
  std::vector<OrderNews> news;
  dds::take_all<indurop_deploy_Order>(impl_->orders_in.get(), [&](const auto& sample, const dds::SampleInfo& info) {
    if (info.valid) {
      news.push_back({wire::word_of<Order>(sample), false});
    }
    if (!info.alive) {
      Order order;
      order.deployer = sample.deployer;
      news.push_back({std::move(order), true});
    }
  });
  return news;
}

std::vector<deploy::BlobRequest> DeployLink::take_requests() {
  std::vector<deploy::BlobRequest> requests;
  const dds::Handle reader = impl_->requests_in.get();
  dds::take_all<indurop_deploy_Request>(reader, [&](const auto& sample, const dds::SampleInfo& info) {
    if (info.valid && sample.source == impl_->self &&
        impl_->senders.speaks_as(reader, info.publication, sample.requester)) {
      requests.push_back(wire::word_of<BlobRequest>(sample));
    }
  });
  return requests;
}

std::vector<deploy::BlobChunk> DeployLink::take_chunks() {
  std::vector<deploy::BlobChunk> chunks;
  const dds::Handle reader = impl_->blobs_in.get();
  dds::take_all<indurop_deploy_Chunk>(reader, [&](const auto& sample, const dds::SampleInfo& info) {
    if (info.valid && impl_->senders.speaks_as(reader, info.publication, sample.source)) {
      chunks.push_back(wire::word_of<BlobChunk>(sample));
    }
  });
  return chunks;
}

std::vector<deploy::OtherAgent> DeployLink::other_agents() {
  constexpr const char* kTool = "indurop";  // it has the same topics, and leaves again
  std::vector<deploy::OtherAgent> agents;
  if (!impl_->others) {
    return agents;
  }
  (void)impl_->others->poll();
  for (dds::OtherReleases::Sender& speaker : impl_->others->senders()) {
    if (speaker.topic.plant == "deploy" && speaker.program != kTool) {
      agents.push_back({speaker.topic.protocol, std::move(speaker.name), std::move(speaker.host)});
    }
  }
  return agents;
}

std::vector<deploy::Impostor> DeployLink::impostors() const {
  return impl_->senders.impostors();
}

bool DeployLink::speaks_for(int reader, std::uint64_t publication, const std::string& board) {
  return impl_->senders.speaks_for(reader, publication, board);
}

int DeployLink::participant() const noexcept {
  return impl_->participant->get();
}

rt::SignalWord& DeployLink::wake_word() noexcept {
  return impl_->wake;
}

void DeployLink::wait(rt::MonoTime deadline) {
  impl_->wake.wait_until(deadline);
  while (impl_->wake.try_wait()) {
  }
}

}  // namespace indurop::deploy
