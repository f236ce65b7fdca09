// SPDX-License-Identifier: Apache-2.0
// indurop rollback: the boards of a plant go back to what they ran before, as one deployment.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <set>

#include "tools/board_history.h"
#include "tools/run_deployment.h"
#include "tools/verbs.h"

namespace indurop::tools {
namespace {

struct Options {
  std::string id;
  std::string plant;
  mirror::LinkSettings link;
  std::int64_t timeout_ns = 5'000'000'000;
  std::int64_t health_ns = 3'000'000'000;
  bool allow_missing = false;
  std::filesystem::path keys;
};

constexpr std::int64_t kHearNs = 1'000'000'000;
constexpr std::size_t kShortestId = 4;

// The plant that is meant; empty after an error.
std::string choose_plant(Context& context, const BoardRoster& roster, const Options& options, int& code) {
  std::set<std::string> plants;
  for (const auto& [key, entry] : roster.all()) {
    if (!entry.report.current.empty()) {
      plants.insert(entry.report.plant);
    }
  }
  if (!options.plant.empty() && plants.count(options.plant) != 0) {
    return options.plant;
  }
  if (plants.empty() || !options.plant.empty()) {
    context.out.error(options.plant.empty() ? "no board with a deployment was heard"
                                            : fmt::format("no board of plant {} was heard", options.plant));
    code = kUnreachable;
    return {};
  }
  if (plants.size() > 1) {
    context.out.error(fmt::format("there are several plants: {}; say which with --plant", fmt::join(plants, ", ")));
    code = kUsage;
    return {};
  }
  return *plants.begin();
}

// Ids that were committed on the board and begin as told.
std::set<std::string> ids_like(const std::vector<PastDeployment>& history, const std::string& begin) {
  std::set<std::string> ids;
  for (const PastDeployment& past : history) {
    if (past.outcome == "committed" && past.deployment.starts_with(begin)) {
      ids.insert(past.deployment);
    }
  }
  return ids;
}

// What to go back to; empty after an error.
std::string choose_target(Context& context, mirror::DeployLink& link, const BoardRoster& roster,
                          const std::vector<std::string>& boards, const Options& options) {
  const deploy::BoardReport& first = roster.find(boards.front())->report;
  if (!options.id.empty()) {
    const auto ids = ids_like(fetch_history(link, options.link.self, first.agent), options.id);
    if (ids.size() == 1) {
      return *ids.begin();
    }
    context.out.error(ids.empty() ? fmt::format("board {} never committed a deployment {}", first.board, options.id)
                                  : fmt::format("{} is the beginning of several deployments", options.id));
    return {};
  }
  for (const std::string& board : boards) {
    const deploy::BoardReport& other = roster.find(board)->report;
    if (other.previous != first.previous || other.previous.empty()) {
      context.out.error(other.previous.empty()
                            ? fmt::format("board {} ran nothing before", board)
                            : fmt::format("boards {} and {} ran different deployments before; say which with its id "
                                          "(indurop history)",
                                          first.board, board));
      return {};
    }
  }
  return first.previous;
}

int roll_back(Context& context, Options& options) {
  auto link = open_link(context, options.link);
  if (link == nullptr) {
    return kUnreachable;
  }
  BoardRoster roster;
  roster.gather(*link, kHearNs, [] { return false; });
  int code = kFailed;
  const std::string plant = choose_plant(context, roster, options, code);
  if (plant.empty()) {
    return code;
  }
  // The members as the newest deployment has them.
  const deploy::BoardReport* newest = nullptr;
  for (const auto& [key, entry] : roster.all()) {
    if (entry.report.plant == plant && (newest == nullptr || entry.report.generation > newest->generation)) {
      newest = &entry.report;
    }
  }
  const std::vector<std::string> members = newest->members;
  Deployment deployment;
  if (!read_deploy_key(context, options.keys, deployment.key)) {
    return kFailed;
  }
  deployment.order.boards =
      present_boards(context, *link, roster, members, options.allow_missing, options.timeout_ns, code);
  if (deployment.order.boards.empty()) {
    return code;
  }
  const std::string target = choose_target(context, *link, roster, deployment.order.boards, options);
  if (target.empty()) {
    return kFailed;
  }
  deployment.order.deployer = options.link.self;
  deployment.order.host = mirror::host_name();
  deployment.order.plant = plant;
  deployment.order.deployment = target;
  deployment.order.generation = next_generation(roster);
  deployment.order.health_ns = options.health_ns;
  deployment.patience_ns = options.timeout_ns;
  deployment.title = fmt::format("plant {}, deployment {} again", plant, deploy::shown_id(target));
  deployment.head = {{"plant", plant}, {"deployment", target}, {"generation", deployment.order.generation}};
  deployment.files = [](const std::string& /*name*/, mirror::BlobServer::Blob& /*blob*/) { return false; };
  return run_deployment(context, *link, roster, std::move(deployment));
}

Action declare(CLI::App& app, Context& context) {
  auto options = std::make_shared<Options>();
  app.add_option("id", options->id, "Deployment to go back to (default: the one before the present one)")
      ->check([](const std::string& text) {
        const bool hex = text.find_first_not_of("0123456789abcdef") == std::string::npos;
        return hex && text.size() >= kShortestId ? std::string{} : "an id is 4 to 64 of the digits 0-9 and a-f";
      })
      ->type_name("ID");
  app.add_option("--plant", options->plant, "Plant that is meant (default: the only one)")->type_name("NAME");
  add_link_options(app, options->link);
  add_time_option(app, "--timeout", options->timeout_ns,
                  "Wait so long for boards to be heard, or to go on (default: 5s)");
  add_time_option(app, "--health", options->health_ns,
                  "Watch the deployment so long before it is committed (default: 3s)");
  app.add_flag("--allow-missing", options->allow_missing,
               "Roll back the boards that are there; the others follow when they come");
  app.add_option("--keys", options->keys, "Folder of the plant's keys, if it has some")->type_name("DIR");
  add_format_option(app, context, {Format::Table, Format::Json, Format::Csv});
  return [options](Context& c) { return roll_back(c, *options); };
}

}  // namespace

const Verb kRollbackVerb{
    "rollback", "Plants", "Put all boards of a plant back to what they ran before",
    "A deployment like any other, of files the boards still have: it is watched, and if it does not do, all boards\n"
    "stay with what they run. A second rollback goes forward again. Exit codes as of indurop deploy.\n",
    &declare};

}  // namespace indurop::tools
