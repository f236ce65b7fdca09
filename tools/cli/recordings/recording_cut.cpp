// SPDX-License-Identifier: Apache-2.0
#include "tools/cli/recordings/recording_cut.h"

#include <fmt/format.h>

#include <cstdint>
#include <filesystem>

#include "history/recorder/cut.h"

namespace indurop::tools {
namespace {

struct RecordingCutOptions {
  std::filesystem::path file;
  std::filesystem::path to;
  std::int64_t from_ns = 0;
  std::int64_t to_ns = 0;
};

int cut(Context& context, const RecordingCutOptions& options) {
  if (options.to_ns != 0 && options.to_ns <= options.from_ns) {
    context.out.error("--to is not later than --from");
    return kUsage;
  }
  const auto done = recorder::cut(options.file, options.from_ns, options.to_ns, options.to);
  if (!done) {
    context.out.error(done.error().text);
    return kFailed;
  }
  context.out.note(fmt::format("{}: {} messages, {} runs", options.to.string(), done->messages, done->runs));
  if (done->runs > 0 && !done->from_first_run) {
    context.out.note(
        "it does not begin with the first run: a replay begins with each module at its first keyframe. Cut from 0 if a "
        "module without keyframes keeps values between runs");
  }
  return kOk;
}

}  // namespace

void add_recording_cut(base::Options& app, const std::shared_ptr<Action>& chosen) {
  auto options = std::make_shared<RecordingCutOptions>();
  base::Options& verb = app.command("cut", "Copy a part of a recording into a new one", [options, chosen] {
    *chosen = [options](Context& c) { return cut(c, *options); };
  });
  verb.add("file", "FILE.mcap", options->file, "The recording").required().completes(base::Completion::File);
  verb.add("-o,--file", "FILE.mcap", options->to, "New file; it must not exist yet").required();
  add_time_option(verb, "--from", options->from_ns,
                  "Beginning of the part, from the beginning of the recording (default: 0)");
  add_time_option(verb, "--to", options->to_ns,
                  "End of the part, from the beginning of the recording (default: its end)");
  verb.details(
      "Copies the runs that ended between these times, each with all that it read and wrote, and the values that\n"
      "were current before them, so that the part can be drawn and replayed on its own.\n");
}

}  // namespace indurop::tools
