// SPDX-License-Identifier: Apache-2.0
#include "tools/client/history/recording_catalog.h"

#include <indurop/detail/abi.h>

#include <algorithm>
#include <system_error>
#include <tuple>
#include <utility>

#include "history/recorder/boxes.h"
#include "history/recorder/sources.h"
#include "history/recording/mcap_reader.h"

namespace indurop::tools {
namespace {

namespace fs = std::filesystem;

std::uint64_t digest_of_variable(std::string_view name, std::string_view idl) {
  const std::string both = std::string(name) + '\n' + std::string(idl);
  return abi::fnv1a64(both.data(), both.size());
}

std::vector<RecordedNode> nodes_in(const fs::path& file) {
  std::vector<RecordedNode> nodes;
  const auto reader = recording::McapReader::open(file);
  if (!reader) {
    return nodes;
  }
  const recorder::Sources sources = recorder::find_sources(*reader);
  const auto [first, last] = reader->contents().span_ns();
  for (const recorder::Source& source : sources.all) {
    nodes.push_back({file,
                     source.text("node"),
                     source.prefix,
                     {first, last + 1},
                     source.number("real_minus_node_ns"),
                     source.number("begun_wall_ns"),
                     source.number(recorder::kPartText),
                     {}});
  }
  for (const auto& [id, place] : sources.channels) {
    const recording::McapChannel& channel = reader->contents().channels.at(id);
    const auto schema = reader->contents().schemas.find(channel.schema);
    if (place.kind == recorder::ChannelKind::Value && schema != reader->contents().schemas.end()) {
      nodes[place.source].variables.push_back(digest_of_variable(place.name, schema->second.data));
    }
  }
  for (RecordedNode& node : nodes) {
    std::sort(node.variables.begin(), node.variables.end());
  }
  return nodes;
}

// A part of a recording reaches up to the next one.
void join_parts(std::vector<RecordedNode>& all) {
  for (RecordedNode& one : all) {
    const auto next = std::find_if(all.begin(), all.end(), [&one](const RecordedNode& other) {
      return one.part > 0 && other.part == one.part + 1 && other.begun_wall_ns == one.begun_wall_ns;
    });
    if (next != all.end()) {
      one.span.end_ns = std::max(one.span.end_ns, next->span.begin_ns);
    }
  }
}

}  // namespace

bool RecordedNode::has(std::string_view variable, std::string_view idl) const {
  return std::binary_search(variables.begin(), variables.end(), digest_of_variable(variable, idl));
}

void RecordingCatalog::look_into(const fs::path& folder) {
  std::error_code ignored;
  for (const auto& entry : fs::directory_iterator(folder, ignored)) {
    if (entry.path().extension() != ".mcap" || !entry.is_regular_file(ignored)) {
      continue;
    }
    Remembered& file = files_[entry.path()];
    const auto written = entry.last_write_time(ignored);
    const auto bytes = entry.file_size(ignored);
    if (written != file.written || bytes != file.bytes) {
      file = {written, bytes, true, nodes_in(entry.path())};
    }
    file.listed = true;
  }
}

std::vector<RecordedNode> RecordingCatalog::of(const std::string& node, const fs::path& folder) {
  for (auto& [path, file] : files_) {
    file.listed = false;
  }
  look_into(recorder::box_folder(node));
  if (!folder.empty()) {
    look_into(folder);
  }
  // Boxes of other nodes are found again when these are asked for.
  std::erase_if(files_, [](const auto& file) { return !file.second.listed; });
  std::vector<RecordedNode> found;
  for (const auto& [path, file] : files_) {
    std::copy_if(file.nodes.begin(), file.nodes.end(), std::back_inserter(found),
                 [&node](const RecordedNode& one) { return one.node == node && one.real_minus_node_ns != 0; });
  }
  std::stable_sort(found.begin(), found.end(),
                   [](const RecordedNode& a, const RecordedNode& b) { return a.span.begin_ns < b.span.begin_ns; });
  join_parts(found);
  return found;
}

}  // namespace indurop::tools
