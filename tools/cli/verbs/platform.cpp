// SPDX-License-Identifier: Apache-2.0
// indurop platform: the releases of the platform on the boards of a plant: packed, deployed, shown, taken back.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <filesystem>
#include <memory>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "core/base/program_folder.h"
#include "core/rt/clock.h"
#include "deploy/transaction/release_package.h"
#include "deploy/words/release_version.h"
#include "tools/cli/plant/release_bundle.h"
#include "tools/cli/plant/run_deployment.h"
#include "tools/cli/verbs/package_options.h"
#include "tools/cli/verbs/verbs.h"
#include "tools/client/board/board_table.h"
#include "tools/client/board/deploy_key.h"
#include "tools/client/text/units.h"
#include "tools/console/diagnostics.h"

namespace indurop::tools {
namespace {

namespace fs = std::filesystem;

struct PlatformRequest {
  std::vector<std::string> folders;
  std::string version;
  std::string file;
  std::string out;
  std::string comment;
  std::string keys;
  std::string plant;
  deploy::LinkSettings link;
  std::int64_t timeout_ns = 5'000'000'000;
  std::int64_t health_ns = 5'000'000'000;
  std::int64_t wait_ns = 3'000'000'000;  // less if all are discovered
  bool allow_missing = false;
  bool older = false;
};

int pack(Context& context, PlatformRequest& request) {
  std::vector<fs::path> prefixes(request.folders.begin(), request.folders.end());
  if (prefixes.empty()) {
    prefixes.push_back(base::program_folder().parent_path());
  }
  auto version = request.version.empty() ? version_of_installation(prefixes.front()) : request.version;
  if (version.empty()) {
    context.out.error(fmt::format("{}/bin/indurop-agent does not tell its version here; say it with --release-version",
                                  prefixes.front().string()));
    return kFailed;
  }
  const auto packed = deploy::pack_release(prefixes, version, request.comment);
  if (!packed) {
    context.out.error(packed.error().text);
    return kFailed;
  }
  const fs::path file = request.out.empty() ? "indurop-" + version + ".release" : request.out;
  if (const auto written = write_release(context, *packed, request.keys, file); !written) {
    context.out.error(written.error().text);
    return kFailed;
  }
  std::error_code error;
  const std::uint64_t size = fs::file_size(file, error);
  context.out.line(fmt::format("{}: release {} for {}, {}, {}, {}", file.string(), version,
                               fmt::join(deploy::architectures_of(packed->package), " and "),
                               deploy::shown_id(packed->id), counted(packed->package.files.size(), "file"),
                               human_bytes(error ? 0 : size)));
  return kOk;
}

// The boards of one plant that a release is for, and that are there.
struct Meant {
  std::string plant;
  std::vector<std::string> boards;
};

// Discovers boards and returns those of the plant; a failure if one that others name is absent, unless that is allowed.
Result<Meant, Failure> find_boards(Context& context, deploy::DeployLink& link, BoardRoster& roster,
                                   const PlatformRequest& request) {
  roster.gather(link, request.wait_ns, [&] { return roster.complete(); });
  const auto plant = choose_plant(roster, request.plant);
  if (!plant) {
    return with_keys_hint(plant.error(), request.link);
  }
  std::set<std::string> boards;
  for (const auto& [key, entry] : roster.all()) {
    if (entry.report.plant == *plant) {
      boards.insert(entry.report.members.begin(), entry.report.members.end());
    }
  }
  auto present =
      present_boards(context, link, roster, {boards.begin(), boards.end()}, request.allow_missing, request.timeout_ns);
  if (!present) {
    return with_keys_hint(present.error(), request.link);
  }
  return Meant{*plant, std::move(*present)};
}

// Returns why this release must not be deployed without --older; empty if none of the boards runs a newer one.
std::string older_refusal(const BoardRoster& roster, const std::vector<std::string>& boards,
                          const std::string& version) {
  for (const std::string& board : boards) {
    const deploy::BoardReport& report = roster.find(board)->report;
    if (deploy::is_older_release(version, report.release)) {
      return fmt::format(
          "release {} is older than {}, which board {} runs; nothing was deployed. If the plant is to go back, add "
          "--older, or use indurop platform back",
          version, report.release, board);
    }
  }
  return {};
}

// A board that cannot run its release, because both copies of a file are damaged, gets it again.
bool runs(const deploy::BoardReport& report, const std::string& release) {
  return report.current == release && report.message.find(deploy::kCannotBeRun) == std::string::npos;
}

// Fills in what every switch to a release has in common.
Deployment deployment_of(const PlatformRequest& request, const std::string& plant, std::vector<std::string> boards,
                         const BoardRoster& roster, const std::string& id, const std::string& version) {
  Deployment deployment;
  deployment.order.deployer = request.link.self;
  deployment.order.host = deploy::host_name();
  deployment.order.plant = plant;
  deployment.order.boards = std::move(boards);
  deployment.order.deployment = id;
  deployment.order.generation = next_generation(roster);
  deployment.order.health_ns = request.health_ns;
  // A board's agent ends and comes back as another program.
  deployment.patience_ns = std::max(request.timeout_ns, std::int64_t{30'000'000'000});
  deployment.lost = std::chrono::nanoseconds(deployment.patience_ns);
  deployment.title = fmt::format("release {} ({}) of plant {}", version, deploy::shown_id(id), plant);
  deployment.head = {
      {"plant", plant}, {"release", version}, {"deployment", id}, {"generation", deployment.order.generation}};
  return deployment;
}

int deploy_release(Context& context, PlatformRequest& request) {
  auto key = read_deploy_key(context.out, request.link.keys);
  if (!key) {
    context.out.error(key.error().text);
    return kFailed;
  }
  auto bundle = read_release(request.file, request.link.keys);
  if (!bundle) {
    return report(context.out, bundle.error());
  }
  const deploy::PackedPlant& packed = bundle->packed;
  auto link = open_link(context.out, request.link);
  if (link == nullptr) {
    return kUnreachable;
  }
  BoardRoster roster;
  auto meant = find_boards(context, *link, roster, request);
  if (!meant) {
    return report(context.out, meant.error());
  }
  const std::string& version = packed.package.release;
  if (std::all_of(meant->boards.begin(), meant->boards.end(),
                  [&](const std::string& board) { return runs(roster.find(board)->report, packed.id); })) {
    context.out.line(fmt::format("release {} ({}) runs on all boards of plant {} already", version,
                                 deploy::shown_id(packed.id), meant->plant));
    return kOk;
  }
  if (const std::string refusal = older_refusal(roster, meant->boards, version); !request.older && !refusal.empty()) {
    context.out.error(refusal);
    return kFailed;
  }
  Deployment deployment = deployment_of(request, meant->plant, std::move(meant->boards), roster, packed.id, version);
  deployment.key = std::move(*key);
  deployment.order.size = packed.text.size();
  deployment.files = [&packed](const std::string& name) { return blob_of(packed, name); };
  return run_deployment(context, *link, roster, std::move(deployment));
}

// Returns the release that all boards ran before; a failure if they ran different ones, or none.
Result<std::string, Failure> former_release(const BoardRoster& roster, const std::vector<std::string>& boards) {
  const deploy::BoardReport& first = roster.find(boards.front())->report;
  for (const std::string& board : boards) {
    const deploy::BoardReport& other = roster.find(board)->report;
    if (other.previous.empty()) {
      return Failure{kFailed, fmt::format("board {} ran no other release before", board)};
    }
    if (other.previous != first.previous) {
      return Failure{
          kFailed, fmt::format("boards {} and {} ran different releases before, {} and {}; deploy the one "
                               "that both are to run",
                               first.board, board, deploy::shown_id(first.previous), deploy::shown_id(other.previous))};
    }
  }
  return first.previous;
}

int go_back(Context& context, PlatformRequest& request) {
  auto key = read_deploy_key(context.out, request.link.keys);
  if (!key) {
    context.out.error(key.error().text);
    return kFailed;
  }
  auto link = open_link(context.out, request.link);
  if (link == nullptr) {
    return kUnreachable;
  }
  BoardRoster roster;
  auto meant = find_boards(context, *link, roster, request);
  if (!meant) {
    return report(context.out, meant.error());
  }
  const auto target = former_release(roster, meant->boards);
  if (!target) {
    return report(context.out, target.error());
  }
  const bool to_installed = *target == deploy::kInstalledRelease;
  const std::string name = to_installed ? "installed" : deploy::shown_id(*target);
  Deployment deployment = deployment_of(request, meant->plant, std::move(meant->boards), roster, *target, name);
  deployment.title =
      fmt::format("{} of plant {}", to_installed ? "the installed release" : "release " + name, meant->plant);
  deployment.key = std::move(*key);
  deployment.files = [](const std::string&) { return std::nullopt; };
  return run_deployment(context, *link, roster, std::move(deployment));
}

int show_status(Context& context, PlatformRequest& request) {
  auto link = open_link(context.out, request.link);
  if (link == nullptr) {
    return kUnreachable;
  }
  BoardRoster roster;
  roster.gather(*link, request.wait_ns, [&] { return roster.complete(); });
  Table table({{"BOARD", "board"},
               {"HOST", "host"},
               {"PLANT", "plant"},
               {"RELEASE", "release"},
               {"ID", "deployment"},
               {"BEFORE", "previous"},
               {"", "generation"},
               {"STATE", "state"},
               {"UPDATE", "phase"},
               {"MESSAGE", "message"}});
  for (const auto& [board, entry] : roster.all()) {
    const deploy::BoardReport& one = entry.report;
    const bool steady = one.phase == deploy::Phase::Steady;
    table.add({Cell(printable(one.board), Style::Bold),
               Cell(printable(one.host)),
               Cell(printable(one.plant)),
               Cell(printable(one.release)),
               {deploy::shown_id(one.current), one.current},
               {one.previous.empty() ? "-" : deploy::shown_id(one.previous), one.previous},
               {"", one.generation},
               Cell(deploy::to_text(one.node)),
               {steady ? "" : deploy::to_text(one.phase), deploy::to_text(one.phase), Style::Warn},
               Cell(printable(one.message), one.message.empty() ? Style::None : Style::Warn)});
  }
  if (table.empty()) {
    context.out.note(
        fmt::format("no board was heard within {}{}", human_age(request.wait_ns), keys_hint(request.link)));
  }
  note_others(context.out, roster);
  print_table(context, table, {{"missing", missing_boards(roster)}, {"other_releases", json_of_others(roster)}},
              "boards");
  return table.empty() ? kUnreachable : kOk;
}

void add_switch_options(base::Options& line, Context& context, PlatformRequest& request) {
  deploy::add_link_options(line, request.link);
  line.add("--plant", "NAME", request.plant, "Name of the plant (default: the only one)");
  add_time_option(line, "--timeout", request.timeout_ns,
                  "How long to wait for boards to report or answer (default: 5s)");
  add_time_option(line, "--health", request.health_ns,
                  "How long to monitor the release before it is committed (default: 5s)");
  line.flag("--allow-missing", request.allow_missing,
            "Continue without boards that do not report; they follow when they appear");
  add_format_option(line, context, {Format::Table, Format::Json, Format::Csv});
}

Action declare_platform(base::Options& app, Context& context) {
  auto request = std::make_shared<PlatformRequest>();
  request->link.subject = deploy::Subject::Platform;
  auto chosen = std::make_shared<Action>();
  const auto verb = [&](const char* name, const char* help,
                        int (*action)(Context&, PlatformRequest&)) -> base::Options& {
    return app.command(name, help, [request, chosen, action] {
      *chosen = [request, action](Context& c) { return action(c, *request); };
    });
  };
  base::Options& packing = verb("pack", "Pack an installation of the platform into one signed file", &pack);
  packing
      .add("folder", "FOLDER", request->folders,
           "Installations with bin/ and lib/, one for each architecture (default: that of this program)")
      .completes(base::Completion::Folder);
  packing
      .add("--release-version", "VERSION", request->version, "Version of the release (default: that of its programs)")
      .check([](const std::string& text) {
        return deploy::is_release_version(text) ? "" : "a version is a digit, then letters, digits and '.+~'";
      });
  packing.add("-o,--file", "FILE", request->out, "File to write (default: indurop-VERSION.release)");
  packing.add("--keys", "DIR", request->keys, "Sign with the deployer's keys in DIR")
      .completes(base::Completion::Folder);
  add_comment_option(packing, request->comment);
  base::Options& deploying =
      verb("deploy", "Update the platform on all boards of a plant, or on none", &deploy_release);
  deploying.add("file", "FILE", request->file, "File of indurop platform pack").required();
  add_switch_options(deploying, context, *request);
  deploying.flag("--older", request->older, "Also deploy a release that is older than what the boards run");
  add_switch_options(verb("back", "Go back to the previous release", &go_back), context, *request);
  base::Options& showing = verb("status", "Show the release of each board", &show_status);
  deploy::add_link_options(showing, request->link);
  add_time_option(showing, "--wait", request->wait_ns, "Maximum time to wait for boards (default: 3s)");
  add_format_option(showing, context, {Format::Table, Format::Json, Format::Csv});
  return [chosen](Context& c) { return (*chosen)(c); };
}

}  // namespace

const Verb kPlatformVerb{
    "platform", "Plants", "Update InduRoP itself on the boards of a plant",
    "A release contains programs and libraries. Boards store it next to the running release, check it, switch\n"
    "together, and go back together if one of them is not healthy. The switch restarts their nodes, so the plant\n"
    "stops for a moment. The exit codes are those of indurop deploy.\n"
    "Examples:\n"
    "  indurop platform pack /usr --keys keys\n"
    "  indurop platform deploy indurop-0.3.0.release --keys keys\n"
    "  indurop platform status\n"
    "  indurop platform back --keys keys\n",
    &declare_platform};

}  // namespace indurop::tools
