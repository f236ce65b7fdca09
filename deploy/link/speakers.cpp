// SPDX-License-Identifier: Apache-2.0
#include "deploy/link/speakers.h"

#include <algorithm>

#include "core/base/read_file.h"
#include "core/keys/credentials.h"

namespace indurop::deploy {
namespace {

constexpr std::size_t kMaxPerKind = 4096;  // maximum of each kind, then it is cleared: a participant invents them
constexpr std::size_t kMaxImpersonations = 64;

template <class Container>
void bound(Container& container) {
  if (container.size() >= kMaxPerKind) {
    container.clear();
  }
}

}  // namespace

Speakers::Speakers(const std::string& certificate) {
  if (certificate.empty()) {
    return;
  }
  const auto text = base::read_file(certificate);
  const auto facts = keys::read_certificate(text ? *text : std::string{});
  // Without a name no report is accepted; the network cannot be joined with such a certificate anyway.
  plant_ = facts ? facts->organisation : "?";
}

std::optional<dds::Guid> Speakers::participant_of(dds::Handle reader, dds::InstanceHandle publication) {
  if (const auto known = publications_.find(publication); known != publications_.end()) {
    return known->second;
  }
  const auto found = dds::participant_of(reader, publication);
  if (found) {
    bound(publications_);
    publications_[publication] = *found;
  }
  return found;
}

const std::string& Speakers::digest_of(const std::string& board) {
  bound(digests_);
  std::string& digest = digests_[board];
  if (digest.empty()) {
    digest = keys::subject_digest({plant_, "", board});
  }
  return digest;
}

bool Speakers::speaks_for(dds::Handle reader, dds::InstanceHandle publication, const std::string& board) {
  if (plant_.empty()) {
    return true;
  }
  const auto who = participant_of(reader, publication);
  return who && dds::is_numbered_by(*who, digest_of(board));
}

bool Speakers::admit(dds::Handle reader, dds::InstanceHandle publication, const BoardReport& report,
                     std::uint64_t reports) {
  if (plant_.empty()) {
    return true;
  }
  const auto who = participant_of(reader, publication);
  if (!who) {
    return false;
  }
  bound(boards_);
  boards_.insert(*who);
  if (!dds::is_numbered_by(*who, digest_of(report.board))) {
    note_impostor(*who, report.board, reports);
    return false;
  }
  bound(agents_);
  agents_[report.agent] = {report.board, publication};
  for (const std::string& member : report.members) {
    (void)digest_of(member);
  }
  return true;
}

bool Speakers::leave(dds::Handle reader, dds::InstanceHandle publication, const std::string& board,
                     std::uint64_t agent) {
  if (plant_.empty()) {
    return true;
  }
  const auto known = agents_.find(agent);
  if (known == agents_.end() || known->second.board != board ||
      (known->second.publication != publication && dds::participant_of(reader, known->second.publication))) {
    return false;
  }
  agents_.erase(known);
  return true;
}

bool Speakers::speaks_as(dds::Handle reader, dds::InstanceHandle publication, std::uint64_t session) {
  if (plant_.empty()) {
    return true;
  }
  if (const auto agent = agents_.find(session); agent != agents_.end()) {
    return speaks_for(reader, publication, agent->second.board);
  }
  const auto who = participant_of(reader, publication);
  return who && !boards_.contains(*who);
}

void Speakers::note_impostor(const dds::Guid& who, const std::string& claimed, std::uint64_t reports) {
  const auto known = std::find_if(impersonations_.begin(), impersonations_.end(),
                                  [&](const Impersonation& one) { return one.who == who && one.claimed == claimed; });
  if (known != impersonations_.end()) {
    known->reports += reports;
  } else if (impersonations_.size() < kMaxImpersonations) {
    impersonations_.push_back({who, claimed, reports});
  }
}

std::vector<Impostor> Speakers::impostors() const {
  std::vector<Impostor> all;
  for (const Impersonation& one : impersonations_) {
    const auto named = std::find_if(digests_.begin(), digests_.end(),
                                    [&](const auto& known) { return dds::is_numbered_by(one.who, known.second); });
    all.push_back({one.claimed, named == digests_.end() ? std::string{} : named->first, one.reports});
  }
  return all;
}

}  // namespace indurop::deploy
