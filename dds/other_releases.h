// SPDX-License-Identifier: Apache-2.0
// Who in the network speaks another protocol of InduRoP. Nothing they say is understood or even heard, because their
// topics have other names; but DDS tells that these topics are there, and that is enough to say it.

#pragma once

#include <indurop/result.h>

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "base/problem.h"
#include "dds/entity.h"
#include "dds/guid.h"
#include "schema/topic_name.h"

namespace indurop::dds {

class OtherReleases {
 public:
  struct Speaker {
    schema::TopicSpeaker topic;
    std::string host;     // empty: not told
    std::string program;  // its name; likewise
    std::string name;     // what it calls itself: the board, for an agent; likewise
  };
  Result<void, base::Problem> open(Handle participant);
  void close() noexcept;
  // Takes what DDS has found since. True: somebody came or went.
  bool look();
  // One for each participant and plant.
  [[nodiscard]] std::vector<Speaker> speakers() const;

 private:
  struct Participant {
    std::string host;
    std::string program;
    std::string name;
  };
  struct Publication {
    Guid participant{};
    schema::TopicSpeaker topic;
  };
  bool take_participants();
  bool take_publications();

  Entity participants_in_;
  Entity publications_in_;
  std::map<Guid, Participant> participants_;
  std::map<Guid, Publication> publications_;
};

}  // namespace indurop::dds
