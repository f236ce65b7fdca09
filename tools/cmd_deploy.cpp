// SPDX-License-Identifier: Apache-2.0
// indurop deploy: puts a plant to work on all its boards, or changes nothing.
#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "deploy/package.h"
#include "rt/clock.h"
#include "tools/config_file.h"
#include "tools/run_deployment.h"
#include "tools/units.h"
#include "tools/verbs.h"

namespace indurop::tools {
namespace {

struct Options {
  std::string file = "plant.xml";
  mirror::LinkSettings link;
  std::int64_t timeout_ns = 5'000'000'000;
  std::int64_t health_ns = 3'000'000'000;
  bool allow_missing = false;
  std::filesystem::path keys;
};

std::vector<std::string> addresses(const deploy::Plant& plant) {
  std::vector<std::string> all;
  for (const deploy::Board& board : plant.boards) {
    if (!board.address.empty()) {
      all.push_back(board.address);
    }
  }
  return all;
}

constexpr std::int64_t kLeftOutNs = 1'000'000'000;  // for boards that are not in the manifest to be heard

bool among(const std::vector<std::string>& names, const std::string& name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

// Boards that run this plant and are not in it any more: those that are there take part, so that their nodes end with
// the same switch and come back if it is taken back.
void add_left_out(Context& context, mirror::DeployLink& link, BoardRoster& roster, const deploy::Package& package,
                  std::vector<std::string>& boards) {
  const auto heard = [&](const auto& entry) {
    const deploy::BoardReport& report = entry.second.report;
    return report.plant != package.plant || std::all_of(report.members.begin(), report.members.end(),
                                                        [&](const auto& m) { return roster.find(m) != nullptr; });
  };
  roster.gather(link, kLeftOutNs, [&] { return std::all_of(roster.all().begin(), roster.all().end(), heard); });
  std::set<std::string> silent;
  for (const auto& [key, entry] : roster.all()) {
    const deploy::BoardReport& report = entry.report;
    if (report.plant != package.plant || report.current.empty()) {
      continue;
    }
    for (const std::string& member : report.members) {
      if (!among(package.boards, member) && roster.find(member) == nullptr) {
        silent.insert(member);
      }
    }
    if (among(report.members, key.first) && !among(package.boards, key.first) && !among(boards, key.first)) {
      context.out.note(fmt::format("board {} is not part of the plant any more: its node ends with this deployment",
                                   printable(key.first)));
      boards.push_back(key.first);
    }
  }
  for (const std::string& board : silent) {
    context.out.note(
        fmt::format("board {} is not part of the plant any more and was not heard: its node ends when it comes back",
                    printable(board)));
  }
}

int deploy_plant(Context& context, Options& options) {
  if (!deploy::is_plant_file(options.file)) {
    context.out.error(
        fmt::format("'{}' is not the manifest of a plant; deploy needs one (see indurop check)", options.file));
    return kUsage;
  }
  const CheckedPlant checked = load_plant(options.file, {});
  auto diagnostics = checked.diagnostics;
  std::erase_if(diagnostics, [](const auto& d) { return d.severity == deploy::Diagnostic::Severity::Note; });
  print_diagnostics(context, diagnostics, false);
  if (!checked.ok()) {
    context.out.error("nothing was deployed");
    return kCheckFailed;
  }
  std::string problem;
  const auto packed = deploy::pack_plant(checked.plant, problem);
  if (!packed) {
    context.out.error(problem);
    return kFailed;
  }
  options.link.multicast = checked.plant.multicast;
  options.link.peers = addresses(checked.plant);
  auto link = open_link(context, options.link);
  if (link == nullptr) {
    return kUnreachable;
  }
  BoardRoster roster;
  Deployment deployment;
  if (!read_deploy_key(context, options.keys.empty() ? checked.plant.security : options.keys, deployment.key)) {
    return kFailed;
  }
  int code = kFailed;
  deployment.order.boards =
      present_boards(context, *link, roster, packed->package.boards, options.allow_missing, options.timeout_ns, code);
  if (deployment.order.boards.empty()) {
    return code;
  }
  add_left_out(context, *link, roster, packed->package, deployment.order.boards);
  deployment.order.deployer = options.link.self;
  deployment.order.host = mirror::host_name();
  deployment.order.plant = packed->package.plant;
  deployment.order.deployment = packed->id;
  deployment.order.size = packed->text.size();
  deployment.order.generation = next_generation(roster);
  deployment.order.health_ns = options.health_ns;
  deployment.patience_ns = options.timeout_ns;
  deployment.title = fmt::format("plant {}, deployment {}", packed->package.plant, deploy::shown_id(packed->id));
  deployment.head = {
      {"plant", packed->package.plant}, {"deployment", packed->id}, {"generation", deployment.order.generation}};
  deployment.files = [&packed](const std::string& name, mirror::BlobServer::Blob& blob) {
    if (name == packed->id) {
      blob.text = packed->text;
      return true;
    }
    const auto found = packed->sources.find(name);
    if (found != packed->sources.end()) {
      blob.file = found->second;
    }
    return found != packed->sources.end();
  };
  std::uint64_t bytes = 0;
  for (const deploy::PackageFile& file : packed->package.files) {
    bytes += file.size;
  }
  if (!context.out.quiet()) {
    context.out.message_line(fmt::format("{}: {}, {}, {}", deployment.title,
                                         counted(deployment.order.boards.size(), "board"),
                                         counted(packed->package.files.size(), "file"), human_bytes(bytes)));
  }
  return run_deployment(context, *link, roster, std::move(deployment));
}

Action declare(CLI::App& app, Context& context) {
  auto options = std::make_shared<Options>();
  app.add_option("file", options->file, "Manifest of the plant (default: plant.xml)")->type_name("FILE");
  add_link_options(app, options->link);
  add_time_option(app, "--timeout", options->timeout_ns,
                  "Wait so long for boards to be heard, or to go on (default: 5s)");
  add_time_option(app, "--health", options->health_ns,
                  "Watch the new deployment so long before it is committed (default: 3s)");
  app.add_flag("--allow-missing", options->allow_missing,
               "Deploy to the boards that are there; the others take it over when they come");
  app.add_option("--keys", options->keys, "Folder of the plant's keys (default: <security> of the manifest)")
      ->type_name("DIR");
  add_format_option(app, context, {Format::Table, Format::Json, Format::Csv});
  return [options](Context& c) { return deploy_plant(c, *options); };
}

}  // namespace

const Verb kDeployVerb{
    "deploy", "Plants", "Put a plant to work on all its boards, or change nothing",
    "Checks the plant, sends what the boards lack, lets every board check its own copy, switches all of them at\n"
    "one instant, watches them for a while and commits. If anything goes wrong on any board, all of them go back.\n"
    "Every board needs a running agent: indurop-node --agent --board NAME.\n"
    "Exit codes: 0 committed, 1 not deployed (another deployment is under way, a board could not fetch it), 4 the\n"
    "check found errors, 5 rolled back, 6 boards are missing.\n",
    &declare};

}  // namespace indurop::tools
