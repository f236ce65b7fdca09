// SPDX-License-Identifier: Apache-2.0
#include "tools/cli/recordings/recording_replay.h"

#include <fmt/format.h>

#include <utility>

#include "core/base/replace_file.h"
#include "core/base/temporary_folder.h"
#include "history/recorder/sources.h"
#include "history/recording/mcap_reader.h"
#include "tools/cli/command/node_program.h"
#include "tools/cli/pictures/recording_svg.h"
#include "tools/cli/recordings/recorded_csv.h"
#include "tools/cli/recordings/replayed_over.h"
#include "tools/client/process/child.h"
#include "tools/client/recordings/replay_setup.h"

namespace indurop::tools {
namespace {

// Draws the variables that differ according to the replay's recording: the replayed values over the recorded ones.
// Returns the exit code.
int draw(Context& context, const ReplayOptions& options, const std::filesystem::path& output, int code) {
  const auto reader = recording::McapReader::open(output);
  if (!reader) {
    context.out.error(reader.error().text);
    return kFailed;
  }
  const std::string prefix = options.board.empty() ? "" : options.board + "/";
  CsvOptions now_csv;
  CsvOptions then_csv;
  for (const auto& [name, runs] : recorder::last_metadata(*reader, recorder::kDifferingMetadata)) {
    now_csv.names.push_back(name);
    then_csv.names.push_back(prefix + name);
  }
  if (now_csv.names.empty()) {
    context.out.note("no value differs: there is no picture");
    return code;
  }
  const auto now = recorded_csv(output, now_csv);
  const auto then = recorded_csv(options.file, then_csv);
  if (!now || !then) {
    context.out.error(now ? then.error().text : now.error().text);
    return kFailed;
  }
  std::size_t left_out = 0;
  const auto both = laid_over(then->text, prefix, now->text, left_out);
  if (!both) {
    context.out.error(both.error().text);
    return kFailed;
  }
  if (both->series.empty()) {
    context.out.note("no value that can be drawn differs: there is no picture");
    return code;
  }
  const std::string heading = fmt::format("{}: recorded, and what is left now", options.file.filename().string());
  if (const auto saved = base::replace_file(options.svg, chart_svg(heading, *both), base::Durable::No); !saved) {
    context.out.error(base::cannot_write(options.svg, saved.error()));
    return kFailed;
  }
  context.out.note(fmt::format("wrote a chart of the differences to {}{}", options.svg,
                               left_out > 0 ? fmt::format(", but for {} more columns", left_out) : ""));
  return code;
}

// Runs the node as a child process, because there is work to do afterwards.
int as_child(Context& context, const ReplayOptions& options, const std::filesystem::path& program,
             config::RunOptions run) {
  const base::TemporaryFolder folder;
  if (folder.path().empty()) {
    context.out.error(folder.problem());
    return kFailed;
  }
  if (run.replay.output.empty() && !options.svg.empty()) {
    run.replay.output = folder.path() / "now.mcap";
  }
  std::vector<std::string> words = config::words_of(run);
  words.insert(words.begin(), program.string());
  const auto code = run_child(words);
  if (!code) {
    context.out.error(code.error().text);
    return kFailed;
  }
  std::error_code ignored;
  const bool drawn = !options.svg.empty() && std::filesystem::exists(run.replay.output, ignored);
  return drawn ? draw(context, options, run.replay.output, *code) : *code;
}

}  // namespace

int replay_recording(Context& context, const ReplayOptions& options) {
  const bool one_tick = options.at != config::Replay::kLastTick;
  if (one_tick && (options.from != 0 || options.to != config::Replay::kLastTick)) {
    context.out.error("--at is one tick: leave out --from and --to");
    return kUsage;
  }
  if (options.from > options.to) {
    context.out.error("--from is later than --to");
    return kUsage;
  }
  const auto program = node_program(context);
  if (program.empty()) {
    return kFailed;
  }
  auto setup = replay_setup(options.file, options.board, options.config);
  if (!setup) {
    context.out.error(setup.error().text);
    return kFailed;
  }
  config::RunOptions run = std::move(setup).value();
  run.quiet = context.out.quiet();
  run.replay.with = options.with;
  run.replay.output = options.output;
  const bool stops = options.stop_at != config::Replay::kLastTick;
  const std::uint64_t from = stops && options.from == 0 ? options.stop_at : options.from;
  run.replay.stop_tick = options.stop_at;
  run.replay.from_tick = one_tick ? options.at : from;
  run.replay.to_tick = one_tick ? options.at : options.to;
  run.node = options.node;
  return options.svg.empty() && !options.comes_back ? become_node(context, program, run)
                                                    : as_child(context, options, program, std::move(run));
}

}  // namespace indurop::tools
