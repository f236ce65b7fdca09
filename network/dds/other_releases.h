// SPDX-License-Identifier: Apache-2.0
// Detects participants that use another protocol version of InduRoP. Their data are not received, because their topics
// have other names; but DDS discovers these topics, which is enough to report them.

#pragma once

#include <indurop/result.h>

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "core/base/problem.h"
#include "core/schema/topic_name.h"
#include "network/dds/entity.h"
#include "network/dds/guid.h"

namespace indurop::dds {

class OtherReleases {
 public:
  struct Sender {
    schema::TopicSender topic;
    std::string host;     // empty: not announced
    std::string program;  // program name; empty: not announced
    std::string name;     // own name, of an agent that of the board; empty: not announced
  };
  Result<void, base::Problem> open(Handle participant);
  void close() noexcept;
  // Takes the discoveries of DDS since the last call. Returns true if a participant came or left.
  bool poll();
  // Returns one entry for each participant and plant.
  [[nodiscard]] std::vector<Sender> senders() const;

 private:
  struct Participant {
    std::string host;
    std::string program;
    std::string name;
  };
  struct Publication {
    Guid participant{};
    schema::TopicSender topic;
  };
  bool take_participants();
  bool take_publications();

  Entity participants_in_;
  Entity publications_in_;
  std::map<Guid, Participant> participants_;
  std::map<Guid, Publication> publications_;
};

}  // namespace indurop::dds
