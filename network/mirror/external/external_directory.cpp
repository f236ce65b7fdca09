// SPDX-License-Identifier: Apache-2.0
#include "network/mirror/external/external_directory.h"

#include <indurop/idl/wire.h>

#include "core/rt/clock.h"
#include "core/schema/topic_name.h"
#include "network/dds/lent.h"

namespace indurop::mirror {
namespace {

constexpr std::int32_t kRequestDepth = 64;  // number of tools that may ask at the same time

std::vector<char*> pointers_to(const std::vector<std::string>& names) {
  std::vector<char*> pointers;
  pointers.reserve(names.size());
  for (const std::string& name : names) {
    pointers.push_back(dds::lent(name));
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

Result<void, base::Problem> ExternalDirectory::open(dds::Handle participant, const Content& content, bool asked) {
  writer_ = dds::make_writer(participant, indurop_wire_Directory_desc, schema::directory_topic(), dds::make_qos({}));
  if (!writer_.ok()) {
    return base::Problem{"cannot announce the variables: " + writer_.why()};
  }
  if (asked) {
    requests_ = dds::make_reader(participant, indurop_wire_Wish_desc, schema::request_topic(),
                                 dds::make_qos({.depth = kRequestDepth}));
    if (!requests_.ok()) {
      return base::Problem{"cannot receive requests for variables: " + requests_.why()};
    }
  }
  return publish(content);
}

Result<void, base::Problem> ExternalDirectory::publish(const Content& content) {
  indurop_wire_Directory out{};
  auto boards = pointers_to(content.boards);
  auto writable = pointers_to(content.writable);
  out.board = dds::lent(content.board);
  out.session = static_cast<std::uint64_t>(rt::wall_ns());
  out.plant = dds::lent(content.plant);
  lend(out.boards, boards);
  out.schema = dds::lent(content.schema);
  lend(out.writable, writable);
  std::vector<indurop_wire_Mirrored> mirrored;
  for (const Content::Mirrored& one : content.mirrored) {
    mirrored.push_back({dds::lent(one.name), dds::lent(one.board)});
  }
  out.mirrored._buffer = mirrored.data();
  out.mirrored._length = out.mirrored._maximum = static_cast<std::uint32_t>(mirrored.size());
  if (const dds::Written written = dds::write(writer_.get(), out); !written.ok()) {
    return base::Problem{"cannot announce the variables: " + written.why()};
  }
  return {};
}

void ExternalDirectory::close() noexcept {
  requests_.reset();
  writer_.reset();
}

std::vector<std::string> ExternalDirectory::take_requests() {
  std::vector<std::string> names;
  if (requests_.ok()) {
    dds::take_all<indurop_wire_Wish>(requests_.get(), [&](const auto& request, const dds::SampleInfo& info) {
      if (info.valid) {
        names.insert(names.end(), request.variables._buffer, request.variables._buffer + request.variables._length);
      }
    });
  }
  return names;
}

}  // namespace indurop::mirror
