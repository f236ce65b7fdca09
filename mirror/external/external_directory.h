// SPDX-License-Identifier: Apache-2.0
// What a board tells InduRoP's own tools about its external plane, beside the topics: which variables it shows, with
// units and ranges, and which boards its plant has. Topics that are announced on demand can be asked for by name.

#pragma once

#include <indurop/result.h>

#include <cstdint>
#include <string>
#include <vector>

#include "base/problem.h"
#include "dds/endpoint.h"

namespace indurop::mirror {

class ExternalDirectory {
 public:
  struct Content {
    std::string plant;  // empty: a node of its own
    std::string board;
    std::vector<std::string> boards;  // of the plant
    std::string schema;               // JSON
    std::vector<std::string> writable;
    struct Mirrored {
      std::string name;
      std::string board;  // that owns it
    };
    std::vector<Mirrored> mirrored;  // what the board reads from others
  };
  // `asked`: somebody may ask for topics.
  Result<void, base::Problem> open(dds::Handle participant, const Content& content, bool asked);
  // In place of what was told before.
  Result<void, base::Problem> tell(const Content& content);
  void close() noexcept;
  // Variables that somebody wants to read.
  std::vector<std::string> take_wishes();

 private:
  dds::Endpoint writer_;
  dds::Endpoint wishes_;
};

}  // namespace indurop::mirror
