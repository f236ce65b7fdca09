// SPDX-License-Identifier: Apache-2.0
// indurop blackbox: what nodes of this host kept when something went wrong.
#include <fmt/format.h>

#include <algorithm>

#include "recording/mcap_reader.h"
#include "rt/clock.h"
#include "tools/command/interrupt.h"
#include "tools/command/table.h"
#include "tools/command/units.h"
#include "tools/values/node_choice.h"
#include "tools/values/variables.h"
#include "tools/verbs/verbs.h"
#include "vars/box_wish.h"
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

// Until a variable is not 0 any more. Returns the exit code.
int await(Context& context, const std::string& name) {
  const auto store = open_store(context, vars::Mode::ReadOnly, {name});
  if (!store) {
    return report(context.out, store.error());
  }
  std::vector<Item> items;
  if (const int code = select_items(context, *store, {name}, items); code != kOk) {
    return code;
  }
  constexpr std::int64_t kPauseNs = 5'000'000;
  while (!interrupted()) {
    for (const Item& item : items) {
      const auto bytes = read_item(*store, item);
      if (bytes && std::any_of(bytes->begin(), bytes->end(), [](std::uint8_t byte) { return byte != 0; })) {
        return kOk;
      }
    }
    if (!context.values->absence(&*store).empty()) {
      context.out.error("the node has ended meanwhile");
      return kUnreachable;
    }
    wait_until(rt::now_ns() + kPauseNs);
  }
  return interrupt_code();
}

// The node writes it: only it knows all of what belongs to its runs.
int keep(Context& context, const std::string& why) {
  const auto node = choose_node(context.node);
  if (!node) {
    return report(context.out, node.error());
  }
  const auto run = RunView::open(*node);
  if (!run || !run->node_alive()) {
    context.out.error(fmt::format("node '{}' does not run", *node));
    return kUnreachable;
  }
  if (const Status wished = vars::wish_box(*node, why.empty() ? "wanted by a user" : why); !wished) {
    context.out.error(fmt::format("{} cannot be written", vars::state_directory(*node).string()));
    return kFailed;
  }
  context.out.note(fmt::format("node '{}' keeps its black box; indurop blackbox lists it in a moment", *node));
  return kOk;
}

struct Options {
  std::string action;
  std::string why;
  std::string when;
};

int list_or_keep(Context& context, const Options& options) {
  if (options.action.empty() || options.action == "list") {
    return blackbox(context);
  }
  if (options.action != "keep") {
    context.out.error(fmt::format("blackbox cannot '{}'; it lists what there is, or keeps a box: blackbox keep [WHY]",
                                  printable(options.action)));
    return kUsage;
  }
  if (const int code = options.when.empty() ? kOk : await(context, options.when); code != kOk) {
    return code;
  }
  return keep(context, options.why.empty() && !options.when.empty() ? options.when : options.why);
}

Action declare(base::Options& app, Context& context) {
  auto options = std::make_shared<Options>();
  app.add("action", "list|keep", options->action, "What to do (default: list)");
  app.add("why", "TEXT", options->why, "With keep: why, for whoever lists it");
  app.add("--when", "NAME", options->when, "With keep: wait until this variable is not 0 any more")
      .completes(base::Completion::Variable);
  add_node_option(app, context);
  add_format_option(app, context, {Format::Table, Format::Json, Format::Csv});
  return [options](Context& c) { return list_or_keep(c, *options); };
}

}  // namespace

const Verb kBlackboxVerb{
    "blackbox", "Timing", "List what nodes kept when something went wrong, or keep it now",
    "When a module faults, has many overruns, or a node starts again that crashed, the last seconds of its tape are\n"
    "kept as a recording: what every run saw and wrote; agents have it kept on all boards of the plant. The newest "
    "ten\n"
    "of each node stay. The newest is listed first. They are read by `indurop explain --from`, `replay`, `recording`,\n"
    "Foxglove and PlotJuggler. blackbox keep keeps what there is now.\n"
    "Examples:\n"
    "  indurop blackbox\n"
    "  indurop blackbox keep 'the drill broke'\n"
    "  indurop blackbox keep --when PLC_ROBOT::alarm\n"
    "  indurop blackbox --node cell -o json\n",
    &declare};

}  // namespace indurop::tools
