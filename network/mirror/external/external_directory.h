// SPDX-License-Identifier: Apache-2.0
// The directory that a board announces to InduRoP's own tools in addition to the topics: its published variables with
// units and ranges, and the boards of its plant. Topics that are announced on demand can be requested by name.

#pragma once

#include <indurop/result.h>

#include <cstdint>
#include <string>
#include <vector>

#include "core/base/problem.h"
#include "network/dds/endpoint.h"

namespace indurop::mirror {

class ExternalDirectory {
 public:
  struct Content {
    std::string plant;  // empty: a single node without a plant
    std::string board;
    std::vector<std::string> boards;  // all boards of the plant
    std::string schema;               // JSON
    std::vector<std::string> writable;
    struct Mirrored {
      std::string name;
      std::string board;  // board that owns it
    };
    std::vector<Mirrored> mirrored;  // variables that the board reads from other boards
  };
  // `asked`: clients may request topics.
  Result<void, base::Problem> open(dds::Handle participant, const Content& content, bool asked);
  // Replaces the content that was announced before.
  Result<void, base::Problem> publish(const Content& content);
  void close() noexcept;
  // Returns the variables that clients request to read.
  std::vector<std::string> take_requests();

 private:
  dds::Endpoint writer_;
  dds::Endpoint requests_;
};

}  // namespace indurop::mirror
