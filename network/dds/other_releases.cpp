// SPDX-License-Identifier: Apache-2.0
#include "network/dds/other_releases.h"

#include <memory>
#include <string_view>
#include <utility>

namespace indurop::dds {
namespace {

struct DdsFree {
  void operator()(char* text) const noexcept { dds_free(text); }
};
using DdsText = std::unique_ptr<char, DdsFree>;

// The text comes from any participant and is shown on terminals: returns a plain name, or nothing.
std::string plain_name(const DdsText& info_of_endpoint) {
  constexpr std::size_t kLongest = 64;
  constexpr std::string_view kLetters = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789._-";
  const std::string_view name = info_of_endpoint == nullptr ? std::string_view{} : info_of_endpoint.get();
  const bool plain = name.size() <= kLongest && name.find_first_not_of(kLetters) == std::string_view::npos;
  return plain ? std::string(name) : std::string{};
}

std::string property(const dds_qos_t* qos, const char* name) {
  char* raw = nullptr;
  (void)dds_qget_prop(qos, name, &raw);
  return plain_name(DdsText(raw));
}

std::string entity_name(const dds_qos_t* qos) {
  char* raw = nullptr;
  (void)dds_qget_entity_name(qos, &raw);
  return plain_name(DdsText(raw));
}

}  // namespace

Result<void, base::Problem> OtherReleases::open(Handle participant) {
  participants_in_ = Entity(dds_create_reader(participant, DDS_BUILTIN_TOPIC_DCPSPARTICIPANT, nullptr, nullptr));
  publications_in_ = Entity(dds_create_reader(participant, DDS_BUILTIN_TOPIC_DCPSPUBLICATION, nullptr, nullptr));
  if (!participants_in_.ok() || !publications_in_.ok()) {
    return base::Problem{"cannot discover the participants of the network: " +
                         (participants_in_.ok() ? publications_in_.why() : participants_in_.why())};
  }
  return {};
}

void OtherReleases::close() noexcept {
  participants_in_.reset();
  publications_in_.reset();
  participants_.clear();
  publications_.clear();
}

bool OtherReleases::take_participants() {
  bool changed = false;
  take_all<dds_builtintopic_participant_t>(participants_in_.get(), [&](const auto& info_of_endpoint, const auto& info) {
    const Guid guid = guid_of(info_of_endpoint.key);
    if (!info.valid || !info.alive) {
      participants_.erase(guid);
      return;
    }
    participants_[guid] = {property(info_of_endpoint.qos, "__Hostname"),
                           property(info_of_endpoint.qos, "__ProcessName"), entity_name(info_of_endpoint.qos)};
    changed = true;
  });
  return changed;
}

bool OtherReleases::take_publications() {
  bool changed = false;
  take_all<dds_builtintopic_endpoint_t>(publications_in_.get(), [&](const auto& info_of_endpoint, const auto& info) {
    const Guid guid = guid_of(info_of_endpoint.key);
    if (!info.valid || !info.alive) {
      changed = publications_.erase(guid) > 0 || changed;
      return;
    }
    auto topic = schema::sender_of_topic(info_of_endpoint.topic_name == nullptr ? "" : info_of_endpoint.topic_name);
    if (topic && topic->protocol != schema::protocol()) {
      publications_[guid] = {guid_of(info_of_endpoint.participant_key), std::move(*topic)};
      changed = true;
    }
  });
  return changed;
}

bool OtherReleases::poll() {
  const bool known = take_participants() && !publications_.empty();
  return take_publications() || known;
}

std::vector<OtherReleases::Sender> OtherReleases::senders() const {
  std::map<std::pair<Guid, std::string>, Sender> all;
  for (const auto& [guid, publication] : publications_) {
    const auto [at, first] = all.try_emplace({publication.participant, publication.topic.plant});
    Sender& speaker = at->second;
    if (first || speaker.topic.board.empty()) {
      speaker.topic = publication.topic;
    }
    if (const auto who = participants_.find(publication.participant); who != participants_.end()) {
      speaker.host = who->second.host;
      speaker.program = who->second.program;
      speaker.name = who->second.name;
    }
  }
  std::vector<Sender> list;
  list.reserve(all.size());
  for (auto& [key, speaker] : all) {
    list.push_back(std::move(speaker));
  }
  return list;
}

}  // namespace indurop::dds
