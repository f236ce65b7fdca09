// SPDX-License-Identifier: Apache-2.0
// indurop deploy: deploys a plant on all its boards, or changes nothing.
#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "core/base/inside_folder.h"
#include "core/rt/clock.h"
#include "deploy/link/link_keys.h"
#include "deploy/transaction/package.h"
#include "tools/cli/plant/older_bundle.h"
#include "tools/cli/plant/plant_source.h"
#include "tools/cli/plant/release_bundle.h"
#include "tools/cli/plant/run_deployment.h"
#include "tools/cli/verbs/package_options.h"
#include "tools/cli/verbs/verbs.h"
#include "tools/client/board/deploy_key.h"
#include "tools/client/text/units.h"
#include "tools/console/diagnostics.h"

namespace indurop::tools {
namespace {

struct DeployOptions {
  std::string file = "plant.xml";
  deploy::LinkSettings link;
  std::int64_t timeout_ns = 5'000'000'000;
  std::int64_t health_ns = 3'000'000'000;
  std::vector<std::string> also;  // folders
  std::string comment;
  bool allow_missing = false;
  bool older = false;
  bool restart = false;
  bool dry_run = false;
};

std::vector<std::string> addresses(const config::Plant& plant) {
  std::vector<std::string> all;
  for (const config::Board& board : plant.boards) {
    if (!board.address.empty()) {
      all.push_back(board.address);
    }
  }
  return all;
}

constexpr std::int64_t kLeftOutNs = 1'000'000'000;  // time to discover boards that are not in the manifest

bool among(const std::vector<std::string>& names, const std::string& name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

// Adds boards that run this plant but are not in it any more: those that are present take part, so that their nodes end
// at the same switch and return if it is rolled back.
void add_left_out(Context& context, deploy::DeployLink& link, BoardRoster& roster, const deploy::Package& package,
                  std::vector<std::string>& boards) {
  const auto is_discovered = [&](const auto& entry) {
    const deploy::BoardReport& report = entry.second.report;
    return report.plant != package.plant || std::all_of(report.members.begin(), report.members.end(),
                                                        [&](const auto& m) { return roster.find(m) != nullptr; });
  };
  roster.gather(link, kLeftOutNs, [&] { return std::all_of(roster.all().begin(), roster.all().end(), is_discovered); });
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

// Returns why the bundle must not be deployed without --older; empty if none of the boards runs something newer.
std::string older_refusal(deploy::DeployLink& link, const BoardRoster& roster, const std::vector<std::string>& boards,
                          const std::string& id, const DeployOptions& options) {
  std::vector<std::uint64_t> agents;
  for (const std::string& board : boards) {
    agents.push_back(roster.find(board)->report.agent);
  }
  const auto histories = fetch_histories(link, options.link.self, agents);
  for (const std::string& board : boards) {
    const deploy::BoardReport& report = roster.find(board)->report;
    const auto history = histories.find(report.agent);
    if (history == histories.end()) {
      continue;
    }
    if (const auto older = older_bundle(history->second, report.current, id)) {
      return fmt::format(
          "{}: deployment {} was committed on board {} on {}, before {}, which it runs since {}; nothing was "
          "deployed. If the plant is to go back, add --older",
          options.file, deploy::shown_id(id), board, local_time(older->bundle.wall_ns),
          deploy::shown_id(report.current), local_time(older->current.wall_ns));
    }
  }
  return {};
}

void print_size(Context& context, const Deployment& deployment, const deploy::Package& package) {
  std::uint64_t bytes = 0;
  for (const deploy::PackageFile& file : package.files) {
    bytes += file.size;
  }
  if (!context.out.quiet()) {
    context.out.message_line(fmt::format("{}: {}, {}, {}", deployment.title,
                                         counted(deployment.order.boards.size(), "board"),
                                         counted(package.files.size(), "file"), human_bytes(bytes)));
  }
}

// Reads the key from --keys, else from the folder that the manifest names.
Result<std::string, base::Problem> deploy_key(Context& context, const PlantSource& source, const std::string& file,
                                              deploy::LinkSettings& link) {
  const config::Plant& plant = source.plant;
  if (link.keys.empty() && !plant.security.empty()) {
    if (source.signature && base::lies_inside(plant.security, source.temporary->path())) {
      return base::Problem{
          fmt::format("{}: the plant has keys, which a bundle does not contain; name the folder of "
                      "your keys: --keys DIR",
                      file)};
    }
    link.keys = plant.security;
    if (auto used = deploy::use_keys(link); !used) {
      return std::move(used).error();
    }
  }
  return read_deploy_key(context.out, link.keys);
}

int deploy_plant(Context& context, DeployOptions& options) {
  if (options.dry_run && options.restart) {
    context.out.error("--dry-run shows what a deployment does without --restart; leave out one of both");
    return kUsage;
  }
  auto read = read_plant_source(context, options.file, options.also, options.comment);
  if (!read) {
    return report(context.out, not_done(read.error(), "deployed"));
  }
  const PlantSource source = std::move(read).value();
  const deploy::PackedPlant* const packed = &source.packed;
  options.link.network.multicast = source.plant.multicast;
  options.link.network.peers = addresses(source.plant);
  auto key = deploy_key(context, source, options.file, options.link);
  if (!key) {
    context.out.error(key.error().text);
    return kFailed;
  }
  if (const std::string refusal = bundle_refusal(source, options.link.keys); !refusal.empty()) {
    context.out.error(fmt::format("{}: {}", options.file, refusal));
    return kFailed;
  }
  auto link = open_link(context.out, options.link);
  if (link == nullptr) {
    return kUnreachable;
  }
  BoardRoster roster;
  Deployment deployment;
  auto present =
      present_boards(context, *link, roster, packed->package.boards, options.allow_missing, options.timeout_ns);
  if (!present) {
    return report(context.out, with_keys_hint(present.error(), options.link));
  }
  if (source.signature && !options.older) {
    if (const std::string refusal = older_refusal(*link, roster, *present, packed->id, options); !refusal.empty()) {
      context.out.error(refusal);
      return kFailed;
    }
  }
  deployment.key = std::move(key).value();
  deployment.order.boards = std::move(present).value();
  add_left_out(context, *link, roster, packed->package, deployment.order.boards);
  deployment.order.deployer = options.link.self;
  deployment.order.host = deploy::host_name();
  deployment.order.plant = packed->package.plant;
  deployment.order.deployment = packed->id;
  deployment.order.size = packed->text.size();
  deployment.order.generation = next_generation(roster);
  deployment.order.health_ns = options.health_ns;
  deployment.order.way = options.dry_run   ? deploy::Way::Compare
                         : options.restart ? deploy::Way::Restart
                                           : deploy::Way::Exchange;
  deployment.patience_ns = options.timeout_ns;
  deployment.title = fmt::format("plant {}, deployment {}", packed->package.plant, deploy::shown_id(packed->id));
  deployment.head = {
      {"plant", packed->package.plant}, {"deployment", packed->id}, {"generation", deployment.order.generation}};
  deployment.files = [&packed](const std::string& name) { return blob_of(*packed, name); };
  print_size(context, deployment, packed->package);
  return run_deployment(context, *link, roster, std::move(deployment));
}

Action declare_deploy(base::Options& app, Context& context) {
  auto options = std::make_shared<DeployOptions>();
  app.add("file", "FILE", options->file, "Manifest of the plant, or a bundle of indurop pack (default: plant.xml)");
  deploy::add_link_options(app, options->link);
  add_time_option(app, "--timeout", options->timeout_ns,
                  "How long to wait for boards to report or answer (default: 5s)");
  add_time_option(app, "--health", options->health_ns,
                  "How long to monitor the new deployment before it is committed (default: 3s)");
  add_comment_option(app, options->comment);
  add_also_option(app, options->also);
  app.flag("--allow-missing", options->allow_missing,
           "Deploy to the boards that report; the others take it over when they appear");
  app.flag("--older", options->older,
           "Deploy a bundle even if the boards have already replaced it with a newer deployment");
  app.flag("--restart", options->restart, "Restart all nodes, even if modules could be exchanged while they run");
  app.flag("--dry-run", options->dry_run, "Send missing files and show what would be done; change nothing");
  add_format_option(app, context, {Format::Table, Format::Json, Format::Csv});
  return [options](Context& c) { return deploy_plant(c, *options); };
}

}  // namespace

const Verb kDeployVerb{
    "deploy", "Plants", "Deploy a plant to all of its boards, or change nothing",
    "Checks the plant, sends missing files to the boards, lets every board check its own copy, switches all of\n"
    "them at one instant, monitors them for a while and commits. If anything fails on any board, all of them roll\n"
    "back. If only files of thread modules differ, these are exchanged in one tick, with what they keep, and\n"
    "everything else continues; otherwise the nodes are restarted. What will be done to each module is shown\n"
    "first. Every board needs a running agent: indurop-agent --board NAME.\n"
    "Exit codes: 0 committed, 1 not deployed (another deployment is under way, a board could not fetch it, the\n"
    "bundle is older than what runs), 4 the check found errors, 5 rolled back, 6 boards are missing. The keys are\n"
    "those of --keys, else of <security> in the manifest.\n"
    "Examples:\n"
    "  indurop deploy plant.xml\n"
    "  indurop deploy plant.xml --dry-run\n"
    "  indurop deploy plant.xml --keys keys --health 5s\n"
    "  indurop deploy plant.xml -m 'gripper opens wider'\n"
    "  indurop deploy cell.bundle --keys keys\n",
    &declare_deploy};

}  // namespace indurop::tools
