// SPDX-License-Identifier: Apache-2.0
// Boards in the network by their announced directories (external_directory.h): their variables, and which other boards
// belong to the plant.

#pragma once

#include <indurop/idl/wire.h>

#include <cstdint>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "core/schema/schema.h"
#include "network/dds/guid.h"

namespace indurop::mirror {

class RemoteSources {
 public:
  // A participant that publishes variables.
  struct Source {
    std::string board;
    std::string plant;
    schema::Schema schema;
    std::set<std::string> writable;
    std::map<std::string, std::string> mirrored;  // variable -> the board it reads it from
    std::uint64_t session = 0;
  };

  // Takes the samples of this reader of directories.
  void take(dds::Handle directories);
  // Returns null if no such participant was discovered.
  [[nodiscard]] const Source* at(const dds::Guid& participant) const;
  [[nodiscard]] const Source* of(const std::string& board) const;
  [[nodiscard]] const dds::Guid* participant_of(const std::string& board) const;

  [[nodiscard]] const std::map<dds::Guid, Source>& all() const noexcept { return sources_; }
  // name -> plant, including boards that were not discovered.
  [[nodiscard]] const std::map<std::string, std::string>& boards() const noexcept { return boards_; }
  [[nodiscard]] std::uint64_t generation() const noexcept { return generation_; }

 private:
  void take_one(dds::Handle directories, const indurop_wire_Directory& directory, const dds::SampleInfo& info);

  std::map<dds::Guid, Source> sources_;
  std::map<std::string, std::string> boards_;
  std::uint64_t generation_ = 0;
};

}  // namespace indurop::mirror
