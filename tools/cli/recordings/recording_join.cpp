// SPDX-License-Identifier: Apache-2.0
#include "tools/cli/recordings/recording_join.h"

#include <fmt/format.h>

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "history/recorder/join.h"

namespace indurop::tools {
namespace {

struct RecordingJoinOptions {
  std::vector<std::string> files;
  std::filesystem::path to;
};

int join(Context& context, const RecordingJoinOptions& options) {
  const auto joined = recorder::join({options.files.begin(), options.files.end()}, options.to);
  if (!joined) {
    context.out.error(joined.error().text);
    return kFailed;
  }
  for (const std::string& gap : joined->gaps) {
    context.out.note("warning: " + gap);
  }
  context.out.note(
      fmt::format("{}: {} messages of {}", options.to.string(), joined->messages, fmt::join(joined->names, ", ")));
  return kOk;
}

}  // namespace

void add_recording_join(base::Options& app, const std::shared_ptr<Action>& chosen) {
  auto options = std::make_shared<RecordingJoinOptions>();
  base::Options& join_command =
      app.command("join", "Join the recordings of several boards into one with a common time",
                  [options, chosen] { *chosen = [options](Context& c) { return join(c, *options); }; });
  join_command.add("files", "FILE.mcap", options->files, "The recordings, one of each board or node")
      .required()
      .completes(base::Completion::File);
  join_command.add("-o,--file", "FILE.mcap", options->to, "File to write; it must not exist yet").required();
  join_command.details(
      "Topics become BOARD/TOPIC (NODE/TOPIC for a node that is not a board), so that the signals of all boards can\n"
      "be overlaid in Foxglove and PlotJuggler. Times are those of the recordings: the clocks of boards differ\n"
      "unless PTP or NTP synchronizes them; boards of a simulation have a common clock. indurop replay --board\n"
      "replays one of them.\n");
}

}  // namespace indurop::tools
