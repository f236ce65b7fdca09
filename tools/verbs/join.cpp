// SPDX-License-Identifier: Apache-2.0
// indurop join: the recordings of a plant's boards become one.
#include <fmt/format.h>

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "recorder/join.h"
#include "tools/verbs/verbs.h"

namespace indurop::tools {
namespace {

struct Options {
  std::vector<std::string> files;
  std::filesystem::path to;
};

int join(Context& context, const Options& options) {
  const auto joined = recorder::join({options.files.begin(), options.files.end()}, options.to);
  if (!joined) {
    context.out.error(joined.error().text);
    return kFailed;
  }
  context.out.note(
      fmt::format("{}: {} messages of {}", options.to.string(), joined->messages, fmt::join(joined->names, ", ")));
  return kOk;
}

Action declare(base::Options& app, Context& /*context*/) {
  auto options = std::make_shared<Options>();
  app.add("files", "FILE.mcap", options->files, "The recordings, one of each board or node")
      .required()
      .completes(base::Completion::File);
  app.add("-o,--file", "FILE.mcap", options->to, "The file; it must not be there yet").required();
  return [options](Context& c) { return join(c, *options); };
}

}  // namespace

const Verb kJoinVerb{
    "join", "Variables", "Join the recordings of several boards to one on common time",
    "Topics become BOARD/TOPIC (NODE/TOPIC of a node of its own), so that the signals of all boards lie over each\n"
    "other in Foxglove and PlotJuggler. Times are those of the recordings: clocks of boards that are not kept by PTP "
    "or\n"
    "NTP differ; boards of a simulation have one. The parts are still what indurop replay takes.\n"
    "Examples:\n"
    "  indurop run plant.xml --sim --until 10s --record run.mcap\n"
    "  indurop join run.sensor.mcap run.control.mcap -o plant.mcap\n",
    &declare};

}  // namespace indurop::tools
