// SPDX-License-Identifier: Apache-2.0
// indurop pull: the sources of what a plant runs.
#include <fmt/format.h>

#include <filesystem>
#include <memory>

#include "deploy/link/link_keys.h"
#include "tools/cli/plant/running_project.h"
#include "tools/cli/verbs/verbs.h"
#include "tools/client/text/units.h"
#include "tools/console/diagnostics.h"

namespace indurop::tools {
namespace {

struct PullOptions {
  std::string folder;
  std::string plant;
  deploy::LinkSettings link;
};

// Returns a problem unless the folder is empty or can be created.
std::string make_empty_folder(const std::filesystem::path& folder) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error) {
    return fmt::format("cannot create {}: {}", folder.string(), error.message());
  }
  const bool empty = std::filesystem::is_empty(folder, error);
  return !error && empty ? "" : fmt::format("{} is not an empty folder; name a new one", folder.string());
}

std::string description_of(const JsonValue& about) {
  const JsonValue& git = about["git"];
  if (!git.is_object()) {
    return "not from a git repository";
  }
  return fmt::format("git commit {}{}", printable(git["commit"].text().value_or("?").substr(0, 12)),
                     git["changed"].boolean().value_or(false) ? " with changes that were not committed" : "");
}

int pull(Context& context, PullOptions& options) {
  auto boards = discover_boards(context, options.link, {});
  if (!boards) {
    return report(context.out, boards.error());
  }
  const auto running = running_plant(*boards, options.link.self, options.plant);
  if (!running) {
    return report(context.out, running.error());
  }
  const std::filesystem::path folder = options.folder.empty() ? running->plant : options.folder;
  if (const std::string problem = make_empty_folder(folder); !problem.empty()) {
    context.out.error(problem);
    return kFailed;
  }
  const auto project = fetch_project(*boards, options.link.self, *running, folder);
  if (!project) {
    std::error_code ignored;
    std::filesystem::remove(folder, ignored);  // only if it is empty
    return report(context.out, project.error());
  }
  context.out.line(fmt::format("{}: plant {}, deployment {}, {}, {}", folder.string(), running->plant,
                               deploy::shown_id(running->id), counted(project->paths.size(), "file"),
                               description_of(project->about)));
  context.out.line(
      fmt::format("manifest: {}", printable((folder / project->about["manifest"].text().value_or("")).string())));
  return kOk;
}

Action declare_pull(base::Options& app, Context& /*context*/) {
  auto options = std::make_shared<PullOptions>();
  app.add("folder", "DIR", options->folder, "New or empty folder for the sources (default: name of the plant)");
  app.add("--plant", "NAME", options->plant, "The plant, if boards of several plants report");
  deploy::add_link_options(app, options->link);
  return [options](Context& c) { return pull(c, *options); };
}

}  // namespace

const Verb kPullVerb{
    "pull", "Plants", "Fetch the sources of what a plant runs",
    "indurop deploy and indurop pack include the sources of a plant (<sources> in the manifest). This verb\n"
    "fetches them from a board into a folder in which they can be built, and reports the commit that they came\n"
    "from.\n"
    "Exit codes: 0 fetched, 1 deployed without sources, or the folder is not empty, 6 no board of the plant\n"
    "reports.\n"
    "Examples:\n"
    "  indurop pull\n"
    "  indurop pull cell-as-it-runs --plant cell --keys keys\n",
    &declare_pull};

}  // namespace indurop::tools
