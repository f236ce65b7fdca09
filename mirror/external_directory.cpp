// SPDX-License-Identifier: Apache-2.0
#include "mirror/external_directory.h"

#include <wire.h>

#include "mirror/lent.h"
#include "rt/clock.h"
#include "schema/topic_name.h"

namespace indurop::mirror {
namespace {

constexpr std::int32_t kWishes = 64;  // tools that ask at the same time

std::vector<char*> pointers_to(const std::vector<std::string>& names) {
  std::vector<char*> pointers;
  pointers.reserve(names.size());
  for (const std::string& name : names) {
    pointers.push_back(lent(name));
  }
  return pointers;
}

template <class Sequence>
void lend(Sequence& sequence, std::vector<char*>& pointers) {
  sequence._buffer = pointers.data();
  sequence._length = sequence._maximum = static_cast<std::uint32_t>(pointers.size());
  sequence._release = false;
}

}  // namespace

std::string directory_topic() {
  return schema::topic_root() + "external/directory";
}

std::string wish_topic() {
  return schema::topic_root() + "external/wish";
}

bool ExternalDirectory::open(dds_entity_t participant, const Content& content, bool asked, std::string& problem) {
  writer_ = make_writer(participant, indurop_wire_Directory_desc, directory_topic(), make_qos({}));
  if (!writer_.ok()) {
    problem = "cannot tell which variables there are: " + writer_.why();
    return false;
  }
  if (asked) {
    wishes_ = make_reader(participant, indurop_wire_Wish_desc, wish_topic(), make_qos({.depth = kWishes}));
    if (!wishes_.ok()) {
      problem = "cannot hear which variables are wanted: " + wishes_.why();
      return false;
    }
  }
  return tell(content, problem);
}

bool ExternalDirectory::tell(const Content& content, std::string& problem) {
  indurop_wire_Directory out{};
  auto boards = pointers_to(content.boards);
  auto writable = pointers_to(content.writable);
  out.board = lent(content.board);
  out.session = static_cast<std::uint64_t>(rt::wall_ns());
  out.plant = lent(content.plant);
  lend(out.boards, boards);
  out.schema = lent(content.schema);
  lend(out.writable, writable);
  const dds_return_t written = dds_write(writer_.get(), &out);
  if (written < 0) {
    problem = std::string("cannot tell which variables there are: ") + dds_strretcode(-written);
  }
  return written >= 0;
}

void ExternalDirectory::close() noexcept {
  wishes_.reset();
  writer_.reset();
}

std::vector<std::string> ExternalDirectory::take_wishes() {
  std::vector<std::string> names;
  if (wishes_.ok()) {
    take_all<indurop_wire_Wish>(wishes_.get(), [&](const auto& wish, const dds_sample_info_t& info) {
      if (info.valid_data) {
        names.insert(names.end(), wish.variables._buffer, wish.variables._buffer + wish.variables._length);
      }
    });
  }
  return names;
}

}  // namespace indurop::mirror
