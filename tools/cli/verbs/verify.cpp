// SPDX-License-Identifier: Apache-2.0
// indurop verify: checks that the files on the boards are those that were deployed.
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <system_error>

#include "core/rt/clock.h"
#include "deploy/disk/state_check.h"
#include "store/vars/retain.h"
#include "tools/cli/plant/discovered_boards.h"
#include "tools/cli/verbs/verbs.h"
#include "tools/client/board/board_texts.h"
#include "tools/client/process/interrupt.h"
#include "tools/client/text/units.h"

namespace indurop::tools {
namespace {

struct VerifyOptions {
  bool plant = false;
  std::string board;
  deploy::LinkSettings link;
  std::int64_t timeout_ns = 60'000'000'000;
};

// The findings on each board, as reported by deploy/agent/board_verify.h and state_check.h.
using Findings = std::map<std::string, JsonValue>;

bool is_state_folder(const std::filesystem::path& folder, std::error_code& error) {
  return std::filesystem::is_directory(folder / "deployments", error);
}

// A folder of another user could be that of a board.
Failure not_readable(const std::filesystem::path& folder, std::error_code error) {
  return {kFailed, fmt::format("cannot read {}: {}; run this as the user of the agents, or let them verify: --plant",
                               folder.string(), error.message())};
}

Result<Findings, Failure> verify_local() {
  Findings found;
  const std::filesystem::path root = vars::state_directory("x").parent_path();
  std::error_code error;
  for (std::filesystem::directory_iterator at(root, error), end; at != end; at.increment(error)) {
    std::error_code hidden;
    if (!is_state_folder(at->path(), hidden)) {
      if (hidden == std::errc::permission_denied) {
        return not_readable(at->path(), hidden);
      }
      continue;
    }
    deploy::StateCheck check(at->path());
    while (!check.step()) {
      if (interrupted()) {
        return Failure{interrupt_code(), {}};
      }
    }
    found[at->path().filename()] = json_of(check.report());
  }
  if (error == std::errc::permission_denied) {
    return not_readable(root, error);
  }
  if (found.empty()) {
    return Failure{kUnreachable, fmt::format("no board of this machine has anything in {}; boards of the network are "
                                             "verified with --plant or --board NAME",
                                             root.string())};
  }
  return found;
}

// Requests until all have answered; boards without an answer in time, or of a release that does not support it, are in
// `silent`.
Result<Findings, Failure> verify_remote(Context& context, VerifyOptions& options, std::vector<std::string>& silent) {
  auto boards = discover_boards(context, options.link, options.board);
  if (!boards) {
    return boards.error();
  }
  std::map<std::uint64_t, std::string> names;
  for (const deploy::BoardReport& report : boards->reports) {
    names[report.agent] = report.board;
  }
  const std::string question = std::string(deploy::kVerifyBlob) + std::to_string(options.link.self);
  const std::int64_t deadline = rt::now_ns() + options.timeout_ns;
  Findings found;
  while (found.size() < names.size() && !interrupted() && rt::now_ns() < deadline) {
    std::vector<std::uint64_t> agents;
    for (const auto& [agent, name] : names) {
      if (!found.contains(name)) {
        agents.push_back(agent);
      }
    }
    const auto texts = fetch_texts(*boards->link, options.link.self, question, agents);
    for (const auto& [agent, text] : texts) {
      const JsonValue answer = JsonValue::parse(text).value_or(JsonValue());
      if (answer["done"].boolean().value_or(false)) {
        found[names.at(agent)] = answer;
      }
    }
    if (texts.empty()) {
      break;  // they do not support the request
    }
  }
  for (const auto& [agent, name] : names) {
    if (!found.contains(name)) {
      silent.push_back(name);
    }
  }
  return interrupted() ? Result<Findings, Failure>(Failure{interrupt_code(), {}}) : std::move(found);
}

void report_finding(Context& context, const std::string& board, const JsonValue& finding) {
  for (const JsonValue& one : finding["damaged"].values()) {
    deploy::Damage damage;
    std::string file;
    bool repaired = false;
    read(one, "file", file);
    read(one, "name", damage.name);
    read(one, "sha256", damage.expected);
    read(one, "found", damage.found);
    read(one, "repaired", repaired);
    damage.file = file;
    context.out.error(
        fmt::format("{}: {}{}", board, describe(damage), repaired ? "; it was restored from another copy" : ""));
  }
}

int verify(Context& context, VerifyOptions& options) {
  std::vector<std::string> silent;
  const bool remote = options.plant || !options.board.empty();
  const auto found = remote ? verify_remote(context, options, silent) : verify_local();
  if (!found) {
    return report(context.out, found.error());
  }
  Table table({{"BOARD", "board"},
               {"DEPLOYMENTS", "deployments", Align::Right},
               {"RELEASES", "releases", Align::Right},
               {"FILES", "files", Align::Right},
               {"SIZE", "bytes", Align::Right},
               {"DAMAGED", "damaged", Align::Right}});
  bool sound = true;
  for (const auto& [board, finding] : *found) {
    report_finding(context, board, finding);
    const std::size_t damaged = finding["damaged"].values().size();
    const std::uint64_t bytes = finding["bytes"].natural().value_or(0);
    const std::uint64_t files = finding["files"].natural().value_or(0);
    sound = sound && damaged == 0;
    table.add({Cell(printable(board), Style::Bold),
               {std::to_string(finding["deployments"].values().size()), finding["deployments"]},
               {std::to_string(finding["releases"].values().size()), finding["releases"]},
               {std::to_string(files), files},
               {human_bytes(bytes), bytes},
               {std::to_string(damaged), finding["damaged"], damaged > 0 ? Style::Bad : Style::Good}});
  }
  for (const std::string& board : silent) {
    context.out.error(fmt::format("{}: its agent did not answer within {}; one of an older release cannot verify",
                                  printable(board), human_age(options.timeout_ns)));
  }
  print_table(context, table, {{"silent", silent}}, "boards");
  if (!sound) {
    context.out.error(remote
                          ? "what is damaged is not run; a deployment that runs is fetched again from the other boards "
                            "of its plant, else by indurop deploy"
                          : "what is damaged is not run; an agent repairs it when it starts, and with indurop verify "
                            "--board NAME");
    return kCheckFailed;
  }
  return silent.empty() ? kOk : kUnreachable;
}

Action declare_verify(base::Options& app, Context& context) {
  auto options = std::make_shared<VerifyOptions>();
  app.flag("--plant", options->plant, "All boards of the network, through their agents");
  app.add("--board", "NAME", options->board, "Only this board of the network, through its agent");
  deploy::add_link_options(app, options->link);
  add_time_option(app, "--timeout", options->timeout_ns, "How long to wait for agents to answer (default: 60s)");
  add_format_option(app, context, {Format::Table, Format::Json, Format::Csv});
  return [options](Context& c) { return verify(c, *options); };
}

}  // namespace

const Verb kVerifyVerb{
    "verify", "Plants", "Compare the files of deployments and releases on the boards with their digests",
    "Reads everything that a board keeps of its deployments and of releases of InduRoP: the committed state, its\n"
    "files and the copies that run. Without --plant or --board it reads the boards of this machine and changes\n"
    "nothing. With them, each agent also deletes damaged files of a deployment and restores them from other\n"
    "copies on the board.\n"
    "Exit codes: 0 everything is as it was deployed, 1 the files of a board cannot be read, 4 something is damaged,\n"
    "6 a board is missing or does not answer.\n"
    "Examples:\n"
    "  indurop verify\n"
    "  indurop verify --plant\n"
    "  indurop verify --board press_1 -o json\n",
    &declare_verify};

}  // namespace indurop::tools
