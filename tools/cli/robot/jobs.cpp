// SPDX-License-Identifier: Apache-2.0
#include "tools/cli/robot/jobs.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "tools/cli/values/forcing.h"
#include "tools/client/node/node_choice.h"

namespace indurop::tools {
namespace {

struct JobStateName {
  std::string_view enumerator;
  const char* word;
};
// As the page shows them.
constexpr std::array<JobStateName, 7> kJobStates{{{"ROBOT_JOB_IDLE", "idle"},
                                                  {"ROBOT_JOB_RUNS", "running"},
                                                  {"ROBOT_JOB_WAITS", "waiting"},
                                                  {"ROBOT_JOB_ENDED", "ended"},
                                                  {"ROBOT_JOB_FAILED", "failed"},
                                                  {"ROBOT_JOB_PAUSES", "paused"},
                                                  {"ROBOT_JOB_RESUMES", "resuming"}}};

std::string job_state_word(const std::string& enumerator) {
  const auto* const found = std::find_if(kJobStates.begin(), kJobStates.end(),
                                         [&](const JobStateName& each) { return each.enumerator == enumerator; });
  return found == kJobStates.end() ? enumerator : found->word;
}

std::string job_text(const JsonValue& value, const char* field) {
  return value[field].text().value_or("");
}

// The entries of a list of fixed size that are in use.
std::span<const JsonValue> listed(const JsonValue& job, const char* list, const char* count) {
  const std::span<const JsonValue> all = job[list].values();
  return all.first(std::min<std::size_t>(all.size(), job[count].natural().value_or(0)));
}

Cell job_line_cell(std::uint64_t line) {
  return line == 0 ? Cell("-", JsonValue()) : Cell(fmt::format("{}", line), JsonValue(line));
}

// The jobs inside each other, the innermost last, then those that interrupts will call.
void add_jobs_of_robot(const JsonValue& job, Table& table) {
  const std::string started = job_text(job, "name");
  const auto add = [&](const std::string& name, std::uint64_t line, const std::string& state, const std::string& why) {
    const bool called = table.empty() && !started.empty() && name != started;
    table.add({Cell(called ? started + ", in " + name : name, JsonValue(name)), job_line_cell(line),
               Cell(state, JsonValue(state)), Cell(why.empty() ? "-" : why, JsonValue(why))});
  };
  for (const JsonValue& each : listed(job, "interrupted", "nInterrupted")) {
    add(job_text(each, "name"), each["nLine"].natural().value_or(0), "interrupted", "");
  }
  add(job_text(job, "called"), job["nLine"].natural().value_or(0), job_state_word(job_text(job, "eState")),
      job_text(job, "cMessage"));
  for (const JsonValue& each : listed(job, "pending", "nPending")) {
    add(job_text(each, "name"), 0, "pending", "");
  }
}

}  // namespace

int show_job(Context& context, const RobotChoice& choice) {
  const std::string name = choice.space + "::ROBOT_JOB";
  const auto store = open_store(context, vars::Mode::ReadOnly, {name});
  if (!store) {
    return report(context.out, store.error());
  }
  std::vector<Item> items;
  if (const int code = select_items(context, *store, {name}, items); code != kOk) {
    return code;
  }
  const auto bytes = operate::read(*store, items.front());
  if (!bytes) {
    context.out.error(bytes.error().text);
    return kFailed;
  }
  const JsonValue job = raw_value(items.front().place.type, *bytes);
  Table table({{"JOB", "job"}, {"LINE", "line", Align::Right}, {"STATE", "state"}, {"MESSAGE", "message"}});
  const std::string started = job_text(job, "name");
  if (!started.empty()) {
    add_jobs_of_robot(job, table);
  } else if (context.format == Format::Table) {
    context.out.note("no job was started");
  }
  print_table(context, table,
              {{"space", choice.space},
               {"job", started.empty() ? JsonValue() : JsonValue(started)},
               {"resumable", JsonValue(job["bResume"].natural().value_or(0) != 0)},
               {"pending", JsonValue(job["nPending"].natural().value_or(0))}},
              "jobs");
  return kOk;
}

}  // namespace indurop::tools
