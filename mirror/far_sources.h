// SPDX-License-Identifier: Apache-2.0
// Boards in the network by what they tell of themselves (external_directory.h): which variables they show, and which
// other boards there should be.

#pragma once

#include <wire.h>

#include <cstdint>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "mirror/far_topic.h"
#include "schema/schema.h"

namespace indurop::mirror {

class FarSources {
 public:
  // A participant that shows variables.
  struct Source {
    std::string board;
    std::string plant;
    schema::Schema schema;
    std::set<std::string> writable;
    std::uint64_t session = 0;
  };

  // Takes what this reader of directories has got.
  void take(dds_entity_t directories);
  // Null if none is heard.
  [[nodiscard]] const Source* at(const Guid& participant) const;
  [[nodiscard]] const Source* of(const std::string& board) const;
  [[nodiscard]] const Guid* participant_of(const std::string& board) const;

  [[nodiscard]] const std::map<Guid, Source>& all() const noexcept { return sources_; }
  // name -> plant, also of those not heard.
  [[nodiscard]] const std::map<std::string, std::string>& boards() const noexcept { return boards_; }
  [[nodiscard]] std::uint64_t generation() const noexcept { return generation_; }

 private:
  void take_one(dds_entity_t directories, const indurop_wire_Directory& told, const dds_sample_info_t& info);

  std::map<Guid, Source> sources_;
  std::map<std::string, std::string> boards_;
  std::uint64_t generation_ = 0;
};

}  // namespace indurop::mirror
