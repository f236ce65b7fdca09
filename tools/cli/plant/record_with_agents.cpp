// SPDX-License-Identifier: Apache-2.0
#include "tools/cli/plant/record_with_agents.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <system_error>
#include <utility>

#include "core/rt/clock.h"
#include "history/recorder/join.h"
#include "tools/cli/plant/board_recordings.h"
#include "tools/client/board/board_commander.h"
#include "tools/client/board/board_roster.h"
#include "tools/client/process/interrupt.h"
#include "tools/client/text/units.h"

namespace indurop::tools {
namespace {

namespace fs = std::filesystem;

constexpr const char* kHere = "this.host.mcap";  // no board has this name: board names have no dots

bool among(const std::vector<std::string>& names, const std::string& name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

// Removes from `unmatched` the names that a board has.
int begin(Context& context, const RecordRequest& request, const deploy::LinkSettings& link, BoardRecordings& recordings,
          std::vector<std::string>& unmatched) {
  std::vector<std::string> boards;
  for (const BoardElsewhere& board : request.boards) {
    boards.push_back(board.name);
  }
  recordings.discover(boards);
  int code = kOk;
  for (const BoardElsewhere& board : request.boards) {
    const auto unknown = recordings.begin(board.name, request.plant, request.names, request.past);
    if (unknown) {
      std::erase_if(unmatched, [&](const std::string& name) { return !among(*unknown, name); });
      continue;
    }
    const Failure failure = with_keys_hint(unknown.error(), link);
    context.out.error(fmt::format("board {} is not in the recording: {}{}", board.name,
                                  board.why.empty() ? "" : board.why + "; by its agent: ", failure.text));
    code = failure.code;
  }
  return code;
}

int print_problems(Context& context, const std::vector<std::string>& problems) {
  for (const std::string& problem : problems) {
    context.out.error(problem);
  }
  return problems.empty() ? kOk : kFailed;
}

void wait(std::int64_t duration_ns) {
  constexpr std::int64_t kRecordPollNs = 1'000'000'000;
  const std::int64_t end = rt::now_ns() + duration_ns;
  while (!interrupted() && (duration_ns == 0 || rt::now_ns() < end)) {
    wait_until(duration_ns == 0 ? rt::now_ns() + kRecordPollNs : end);
  }
}

int join(Context& context, const RecordRequest& request, BoardRecordings& recordings, const fs::path& parts) {
  const int interrupt = interrupted() ? interrupt_code() : kOk;
  take_interrupt();  // it ended the recording, and must not end what follows
  int code = print_problems(context, recordings.end());
  auto [files, problems] = recordings.fetch(parts);
  code = std::max(code, print_problems(context, problems));
  std::error_code ignored;
  if (fs::exists(parts / kHere, ignored)) {
    files.insert(files.begin(), parts / kHere);
  }
  if (files.empty()) {
    fs::remove_all(parts, ignored);
    return code;
  }
  const auto joined = recorder::join(files, request.file);
  if (!joined) {
    context.out.error(fmt::format("{}; what was recorded is in {}", joined.error().text, parts.string()));
    return kFailed;
  }
  fs::remove_all(parts, ignored);
  recordings.drop();
  context.out.note(fmt::format("{}: {} messages of {}, {}", request.file.string(), joined->messages,
                               fmt::join(joined->names, ", "), human_bytes(fs::file_size(request.file, ignored))));
  return code == kOk ? interrupt : code;
}

}  // namespace

int record_with_agents(Context& context, const RecordRequest& request, deploy::LinkSettings& link,
                       const std::vector<std::string>& unmatched,
                       const std::function<int(const fs::path& file)>& here) {
  auto commander = BoardCommander::make(context.out, link.keys);
  if (!commander) {
    return report(context.out, commander.error());
  }
  const fs::path parts = request.file.string() + ".parts";
  std::error_code error;
  if (fs::exists(request.file, error) || !fs::create_directories(parts, error)) {
    const std::string what = fs::exists(request.file, error) ? request.file.string() : parts.string();
    context.out.error(what + " exists already, or cannot be written; remove it, or give another name");
    return kFailed;
  }
  auto opened = open_link(context.out, link);
  if (opened == nullptr) {
    fs::remove_all(parts, error);
    return kUnreachable;
  }
  BoardRecordings recordings(std::move(opened), link.self, std::move(*commander));
  std::vector<std::string> missing = unmatched;
  int code = begin(context, request, link, recordings, missing);
  if (code == kOk && !missing.empty()) {
    (void)recordings.end();
    recordings.drop();
    fs::remove_all(parts, error);
    context.out.error(fmt::format("no board has a variable '{}'; see indurop vars", missing.front()));
    return kFailed;
  }
  if (recordings.empty() && !here) {
    fs::remove_all(parts, error);
    return code;
  }
  recordings.go_on();
  int recorded = kOk;
  if (here) {
    recorded = here(parts / kHere);
  } else {
    wait(request.duration_ns);
  }
  const int joined = join(context, request, recordings, parts);
  for (const int next : {recorded, joined}) {
    code = code == kOk ? next : code;
  }
  return code;
}

}  // namespace indurop::tools
