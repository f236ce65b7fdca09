// SPDX-License-Identifier: Apache-2.0
// indurop blackbox: what nodes of this host kept when something went wrong.
#include <fmt/format.h>

#include <algorithm>

#include "recording/mcap_reader.h"
#include "tools/command/table.h"
#include "tools/command/units.h"
#include "tools/verbs/verbs.h"
#include "vars/retain.h"

namespace indurop::tools {
namespace {

struct Box {
  std::filesystem::path file;
  std::string node;
  std::string reason;
  std::uint64_t bytes = 0;
};

// What the file says of itself; a damaged one says nothing.
std::string reason_of(const std::filesystem::path& file) {
  const auto reader = recording::McapReader::open(file);
  if (!reader) {
    return reader.error().text;
  }
  for (const auto& index : reader->contents().metadata) {
    if (const auto about = reader->metadata(index); about && about->values.contains("reason")) {
      return about->values.at("reason");
    }
  }
  return "not complete";
}

std::vector<Box> find_boxes(const std::string& node) {
  std::vector<Box> boxes;
  std::error_code ignored;
  const auto look = [&](const std::filesystem::path& folder) {
    for (const auto& entry : std::filesystem::directory_iterator(folder / "boxes", ignored)) {
      if (entry.path().extension() == ".mcap") {
        boxes.push_back({entry.path(), folder.filename().string(), reason_of(entry.path()), entry.file_size(ignored)});
      }
    }
  };
  if (!node.empty()) {
    look(vars::state_directory(node));
  } else {
    for (const auto& entry : std::filesystem::directory_iterator(vars::state_directory("x").parent_path(), ignored)) {
      look(entry.path());
    }
  }
  std::sort(boxes.begin(), boxes.end(),
            [](const Box& a, const Box& b) { return a.file.filename() > b.file.filename(); });
  return boxes;
}

int blackbox(Context& context) {
  const auto boxes = find_boxes(context.node);
  Table table({{"NODE", "node"}, {"WHY", "reason"}, {"SIZE", "bytes", Align::Right}, {"FILE", "file"}});
  for (const Box& box : boxes) {
    table.add({Cell(box.node, Style::Bold),
               Cell(printable(box.reason)),
               {human_bytes(box.bytes), box.bytes},
               Cell(box.file.string())});
  }
  print_table(context, table, {}, "boxes");
  if (boxes.empty() && context.format == Format::Table) {
    context.out.line("no black box: no module faulted and no node crashed, as far as is remembered");
  }
  return kOk;
}

Action declare(base::Options& app, Context& context) {
  add_node_option(app, context);
  add_format_option(app, context, {Format::Table, Format::Json, Format::Csv});
  return [](Context& c) { return blackbox(c); };
}

}  // namespace

const Verb kBlackboxVerb{
    "blackbox", "Timing", "List what nodes kept when something went wrong",
    "When a module faults, and when a node starts again that crashed, the last seconds of its tape are kept as a\n"
    "recording: what every run saw and wrote. The newest ten of each node stay. The newest is listed first. They are\n"
    "read by `indurop replay`, Foxglove and PlotJuggler.\n"
    "Examples:\n"
    "  indurop blackbox\n"
    "  indurop blackbox --node cell -o json\n",
    &declare};

}  // namespace indurop::tools
