// SPDX-License-Identifier: Apache-2.0
// indurop blackbox: what nodes of this host, or boards in the network, recorded when a fault occurred.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "core/base/temporary_folder.h"
#include "core/rt/clock.h"
#include "history/recorder/boxes.h"
#include "history/recorder/join.h"
#include "store/vars/box_request.h"
#include "store/vars/retain.h"
#include "tools/cli/plant/board_boxes.h"
#include "tools/cli/plant/board_file.h"
#include "tools/cli/plant/discovered_boards.h"
#include "tools/cli/recordings/recording_export.h"
#include "tools/cli/recordings/recording_info.h"
#include "tools/cli/recordings/recording_replay.h"
#include "tools/cli/verbs/verbs.h"
#include "tools/client/board/board_commander.h"
#include "tools/client/node/node_choice.h"
#include "tools/client/process/interrupt.h"
#include "tools/client/text/table.h"
#include "tools/client/text/units.h"
#include "tools/client/values/variables.h"

namespace indurop::tools {
namespace {

struct BlackboxOptions {
  std::string what;  // reason, or a file
  std::string when;
  std::string at;     // name of a box; empty: the newest
  ExportOptions out;  // with export
  std::string svg;
  std::vector<std::string> with;
  bool remote = false;
  std::string board;  // empty: all
  deploy::LinkSettings link;
  [[nodiscard]] bool is_remote() const noexcept { return remote || !board.empty(); }
};

Result<DiscoveredBoards, Failure> discover(Context& context, BlackboxOptions& options) {
  if (!context.node.empty() && options.when.empty()) {
    return Failure{kUsage, "--node names a node of this machine; a board in the network is chosen with --board"};
  }
  return discover_boards(context, options.link, options.board);
}

// Returns the boxes of this host, as if their nodes were boards.
std::vector<BoardBox> boxes_here(const std::string& node) {
  std::vector<BoardBox> all;
  for (const recorder::Box& box : node.empty() ? recorder::boxes_here() : recorder::boxes_of(node)) {
    all.push_back({box.node, 0, box.file.filename().string(), box.reason, box.bytes, box.end_ns});
  }
  return all;
}

std::filesystem::path file_here(const BoardBox& box) {
  return recorder::box_folder(box.board) / box.name;
}

int list(Context& context, BlackboxOptions& options) {
  std::vector<BoardBox> boxes;
  if (options.is_remote()) {
    const auto boards = discover(context, options);
    if (!boards) {
      return report(context.out, boards.error());
    }
    boxes = fetch_box_lists(*boards->link, options.link.self, boards->reports);
  } else {
    boxes = boxes_here(context.node);
  }
  Table table({{options.is_remote() ? "BOARD" : "NODE", "node"},
               {"WHY", "reason"},
               {"SIZE", "bytes", Align::Right},
               {"FILE", "file"}});
  for (const BoardBox& box : boxes) {
    table.add({Cell(printable(box.board), Style::Bold),
               Cell(printable(box.reason)),
               {human_bytes(box.bytes), box.bytes},
               Cell(options.is_remote() ? printable(box.name) : file_here(box).string())});
  }
  print_table(context, table, {}, "boxes");
  if (boxes.empty() && context.format == Format::Table) {
    context.out.line("no black box: no module faulted and no node crashed, as far as is remembered");
  }
  return kOk;
}

// Returns the newest box, or the one that is named; null after an error message.
const BoardBox* choose(Context& context, const BlackboxOptions& options, const std::vector<BoardBox>& boxes) {
  const auto found = std::find_if(boxes.begin(), boxes.end(), [&](const BoardBox& box) {
    return options.at.empty() || box.name == std::filesystem::path(options.at).filename();
  });
  if (found == boxes.end()) {
    context.out.error(boxes.empty() ? "there is no black box" : "there is no black box " + printable(options.at));
    return nullptr;
  }
  return &*found;
}

int join_to(Context& context, const std::vector<std::filesystem::path>& files, const std::string& to) {
  const auto joined = recorder::join(files, to);
  if (!joined) {
    context.out.error(joined.error().text);
    return kFailed;
  }
  context.out.note(fmt::format("{}: {} messages of {}", to, joined->messages, fmt::join(joined->names, ", ")));
  return kOk;
}

int fetch_local(Context& context, const BlackboxOptions& options) {
  const auto boxes = boxes_here(context.node);
  const BoardBox* const first = choose(context, options, boxes);
  if (first == nullptr) {
    return kFailed;
  }
  std::vector<std::filesystem::path> files;
  for (const BoardBox& box : boxes_of_moment(boxes, first->end_ns)) {
    files.push_back(file_here(box));
  }
  return join_to(context, files, options.what);
}

// Returns the boards of the plant without a box among these.
std::vector<std::string> missing(const DiscoveredBoards& boards, const BoardBox& first,
                                 const std::vector<BoardBox>& chosen) {
  const auto of = std::find_if(boards.reports.begin(), boards.reports.end(),
                               [&](const deploy::BoardReport& report) { return report.agent == first.agent; });
  std::vector<std::string> names = of->members;
  std::erase_if(names, [&](const std::string& name) {
    return std::any_of(chosen.begin(), chosen.end(), [&](const BoardBox& box) { return box.board == name; });
  });
  return names;
}

int fetch_remote(Context& context, BlackboxOptions& options) {
  const auto boards = discover(context, options);
  if (!boards) {
    return report(context.out, boards.error());
  }
  auto boxes = fetch_box_lists(*boards->link, options.link.self, boards->reports);
  const BoardBox* const found = choose(context, options, boxes);
  if (found == nullptr) {
    return kFailed;
  }
  const BoardBox first = *found;
  const auto plant_of = [&](std::uint64_t agent) {
    return std::find_if(boards->reports.begin(), boards->reports.end(),
                        [&](const deploy::BoardReport& report) { return report.agent == agent; })
        ->plant;
  };
  std::erase_if(boxes, [&](const BoardBox& box) { return plant_of(box.agent) != plant_of(first.agent); });
  const auto chosen = boxes_of_moment(boxes, first.end_ns);
  const base::TemporaryFolder folder;
  if (folder.path().empty()) {
    context.out.error(folder.problem());
    return kFailed;
  }
  std::vector<std::filesystem::path> files;
  for (const BoardBox& box : chosen) {
    files.push_back(folder.path() / (std::to_string(files.size()) + ".mcap"));
    const BoardFile file{box.board, box.agent, std::string(deploy::kBoxBlob) + box.name, box.bytes};
    if (const auto fetched = fetch_file(*boards->link, options.link.self, file, files.back()); !fetched) {
      return report(context.out, fetched.error());
    }
  }
  int code = join_to(context, files, options.what);
  if (options.board.empty()) {
    for (const std::string& name : missing(*boards, first, chosen)) {
      context.out.error(fmt::format("board {} has no black box of that moment", printable(name)));
      code = kFailed;
    }
  }
  return code;
}

int fetch(Context& context, BlackboxOptions& options) {
  return options.is_remote() ? fetch_remote(context, options) : fetch_local(context, options);
}

// Processes one box, or the boxes of several boards from one moment, like any recording.
template <class Act>
int use(Context& context, BlackboxOptions& options, Act act) {
  const base::TemporaryFolder folder;
  std::filesystem::path file = folder.path() / "moment.mcap";
  if (options.is_remote()) {
    options.what = file.string();
    if (const int code = folder.path().empty() ? kFailed : fetch_remote(context, options); code != kOk) {
      return code;
    }
  } else {
    const auto boxes = boxes_here(context.node);
    const BoardBox* const box = choose(context, options, boxes);
    if (box == nullptr) {
      return kFailed;
    }
    file = file_here(*box);
    context.out.note(fmt::format("{}: {}", file.string(), printable(box->reason)));
  }
  return act(file);
}

int show_box(Context& context, BlackboxOptions& options) {
  return use(context, options, [&](const std::filesystem::path& file) { return show_recording(context, file); });
}

int export_box(Context& context, BlackboxOptions& options) {
  return use(context, options, [&](const std::filesystem::path& file) {
    options.out.file = file;
    return export_recording(context, options.out);
  });
}

int replay_box(Context& context, BlackboxOptions& options) {
  return use(context, options, [&](const std::filesystem::path& file) {
    ReplayOptions replay;
    replay.file = file;
    replay.board = options.board;
    replay.node = context.node.empty() ? "" : context.node + "-replay";
    replay.with = options.with;
    replay.svg = options.svg;
    replay.comes_back = true;
    return replay_recording(context, replay);
  });
}

// Waits until a variable becomes non-zero. Returns the exit code.
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
      const auto bytes = operate::read(*store, item);
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

// The node writes the box: only it has all data of its runs.
int keep(Context& context, const std::string& why) {
  constexpr std::chrono::seconds kPatience{5};
  const auto node = choose_node(context.node);
  if (!node) {
    return report(context.out, node.error());
  }
  const auto run = RunView::open(*node);
  if (!run || !run->node_alive()) {
    context.out.error(fmt::format("node '{}' does not run", *node));
    return kUnreachable;
  }
  if (const Status requested = vars::request_box(*node, why.empty() ? "requested by a user" : why); !requested) {
    context.out.error(requested.error().code == Errc::Busy
                          ? fmt::format("node '{}': {}", *node, vars::kBoxesTooClose)
                          : fmt::format("{} cannot be written", vars::state_directory(*node).string()));
    return kFailed;
  }
  if (!vars::box_request_is_read(*node, kPatience)) {
    context.out.error(
        fmt::format("node '{}' keeps no black box: it is a simulation, has no tape (--tape 0), or does "
                    "not read requests in {}, because its user or its INDUROP_STATE_DIR is another one",
                    *node, vars::state_directory(*node).string()));
    return kFailed;
  }
  context.out.note(fmt::format("node '{}' keeps its black box; indurop blackbox lists it in a moment", *node));
  return kOk;
}

// Saves a box on all discovered boards, at about the same time. They are discovered first, so that a box still contains
// what preceded it.
int keep_remote(Context& context, BlackboxOptions& options) {
  constexpr std::int64_t kTimeoutNs = 5'000'000'000;
  auto commander = BoardCommander::make(context.out, options.link.keys);
  if (!commander) {
    return report(context.out, commander.error());
  }
  auto boards = discover(context, options);
  if (!boards) {
    return report(context.out, boards.error());
  }
  if (const int code = options.when.empty() ? kOk : await(context, options.when); code != kOk) {
    return code;
  }
  boards->refresh(options.board);
  int code = kOk;
  for (const deploy::BoardReport& board : boards->reports) {
    const auto answered = commander->send(
        *boards->link, options.link.self, board, deploy::Action::KeepBox,
        options.what.empty() ? "requested by a user of " + deploy::host_name() : options.what, kTimeoutNs);
    if (!answered) {
      context.out.error(fmt::format("board {}: {}", printable(board.board), answered.error().text));
      code = answered.error().code;
    } else if (answered->reply.outcome != deploy::Outcome::Done) {
      context.out.error(fmt::format("board {}: {}", printable(board.board), printable(answered->reply.text)));
      code = kFailed;
    } else {
      context.out.note(fmt::format("board {} keeps its black box", printable(board.board)));
    }
  }
  return code;
}

int keep_any(Context& context, BlackboxOptions& options) {
  options.what = options.what.empty() ? options.when : options.what;
  if (options.is_remote()) {
    return keep_remote(context, options);
  }
  if (const int code = options.when.empty() ? kOk : await(context, options.when); code != kOk) {
    return code;
  }
  return keep(context, options.what);
}

Action declare_blackbox(base::Options& app, Context& context) {
  auto options = std::make_shared<BlackboxOptions>();
  auto chosen = std::make_shared<Action>();
  const auto verb = [&](const char* name, const char* help, int (*act)(Context&, BlackboxOptions&)) -> base::Options& {
    return app.command(name, help,
                       [options, chosen, act] { *chosen = [options, act](Context& c) { return act(c, *options); }; });
  };
  const auto of_a_box = [&](const char* name, const char* help,
                            int (*act)(Context&, BlackboxOptions&)) -> base::Options& {
    base::Options& made = verb(name, help, act);
    made.add("--at", "BOX", options->at, "The box, as listed, or its time (default: the newest)");
    return made;
  };
  verb("list", "List the black boxes, the newest first", [](Context& c, BlackboxOptions& o) { return list(c, o); });
  of_a_box("show", "Describe the newest box, as indurop recording info does", &show_box);
  base::Options& made = of_a_box("export", "Write the newest box as CSV or as a trace", &export_box);
  made.add("--csv", "FILE", options->out.csv, "Write the values, as indurop recording export does");
  made.add("--trace", "FILE", options->out.trace, "Write when each module ran, for https://ui.perfetto.dev");
  base::Options& again = of_a_box("replay", "Run the newest box again and compare the results", &replay_box);
  again.add("--with", "FILE.so", options->with, "Use this file for the module of its name")
      .completes(base::Completion::File);
  again.add("--svg", "FILE", options->svg, "Draw what differs");
  base::Options& keeping = verb("keep", "Save a black box now", &keep_any);
  keeping.add("reason", "TEXT", options->what, "Reason, for the list");
  keeping.add("--when", "NAME", options->when, "Wait until this local variable becomes non-zero")
      .completes(base::Completion::Variable);
  base::Options& fetching =
      of_a_box("fetch", "Write the boxes that all boards kept at one moment into one file", &fetch);
  fetching.add("file", "FILE.mcap", options->what, "The file to write").required().completes(base::Completion::File);
  app.flag("--remote", options->remote,
           "Use all boards of the network, through their agents, instead of the nodes of this machine");
  app.add("--board", "NAME", options->board, "Only this board; implies --remote");
  deploy::add_link_options(app, options->link);
  add_node_option(app, context);
  add_format_option(app, context, {Format::Table, Format::Json, Format::Csv});
  return [chosen](Context& c) { return (*chosen)(c); };
}

}  // namespace

const Verb kBlackboxVerb{
    "blackbox", "Timing", "List black boxes of nodes, save one now, or fetch those of all boards",
    "When a module faults or has many overruns, or when a node starts after a crash, the last seconds of its tape\n"
    "are kept as a recording of what every run read and wrote; agents make all boards of the plant keep theirs.\n"
    "The newest ten of each node are kept. `indurop explain --from`, `replay`, `recording`, Foxglove and\n"
    "PlotJuggler can read them, too. `fetch` joins what the boards kept within ten seconds of one moment into one\n"
    "file with a common time; the exit code is 1 if a board of the plant has none.\n"
    "Examples:\n"
    "  indurop blackbox\n"
    "  indurop blackbox show\n"
    "  indurop blackbox export --csv box.csv --trace box.json\n"
    "  indurop blackbox replay --with new/main.so\n"
    "  indurop blackbox keep 'the drill broke'\n"
    "  indurop blackbox keep --when PLC_ROBOT::alarm\n"
    "  indurop blackbox --remote\n"
    "  indurop blackbox keep 'the drill broke' --remote\n"
    "  indurop blackbox keep --when PLC_ROBOT::alarm --remote\n"
    "  indurop blackbox fetch moment.mcap --remote\n"
    "  indurop blackbox --node cell -o json\n",
    &declare_blackbox};

}  // namespace indurop::tools
