// SPDX-License-Identifier: Apache-2.0
// Authenticates messages in a plant with keys: a message of a board is accepted only from the participant whose
// certificate has the name of that board. Messages in the name of another board are counted. In an open plant every
// message is accepted.

#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "deploy/words/deployment_words.h"
#include "network/dds/guid.h"

namespace indurop::deploy {

class Speakers {
 public:
  // `certificate`: that of this participant; an empty path: the plant is open.
  explicit Speakers(const std::string& certificate);

  // Returns whether this report, the last of `reports`, is accepted. `publication`: of its writer, as `reader` knows
  // it.
  bool admit(dds::Handle reader, dds::InstanceHandle publication, const BoardReport& report, std::uint64_t reports);
  // Reports that no participant writes this agent's reports any more. Returns false if only another participant claims
  // so.
  bool leave(dds::Handle reader, dds::InstanceHandle publication, const std::string& board, std::uint64_t agent);
  bool speaks_for(dds::Handle reader, dds::InstanceHandle publication, const std::string& board);
  // Returns whether it is the agent with this session, or, if no agent has it, at least not a board.
  bool speaks_as(dds::Handle reader, dds::InstanceHandle publication, std::uint64_t session);

  [[nodiscard]] std::vector<Impostor> impostors() const;

 private:
  [[nodiscard]] std::optional<dds::Guid> participant_of(dds::Handle reader, dds::InstanceHandle publication);
  const std::string& digest_of(const std::string& board);
  void note_impostor(const dds::Guid& who, const std::string& claimed, std::uint64_t reports);

  struct Agent {
    std::string board;
    dds::InstanceHandle publication = 0;
  };
  struct Impersonation {
    dds::Guid who{};
    std::string claimed;
    std::uint64_t reports = 0;
  };
  std::string plant_;                                      // empty: open
  std::map<dds::InstanceHandle, dds::Guid> publications_;  // participant that owns each
  std::map<std::string, std::string> digests_;             // digests of certificate subjects, by board
  std::map<std::uint64_t, Agent> agents_;                  // by session
  std::set<dds::Guid> boards_;                             // participants that report
  std::vector<Impersonation> impersonations_;
};

}  // namespace indurop::deploy
