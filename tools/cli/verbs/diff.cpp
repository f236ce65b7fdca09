// SPDX-License-Identifier: Apache-2.0
// indurop diff: what a plant runs against what is in the folder.
#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>

#include "core/base/temporary_folder.h"
#include "core/keys/digest.h"
#include "deploy/link/link_keys.h"
#include "tools/cli/plant/plant_source.h"
#include "tools/cli/plant/running_project.h"
#include "tools/cli/verbs/package_options.h"
#include "tools/cli/verbs/verbs.h"
#include "tools/client/text/table.h"

namespace indurop::tools {
namespace {

struct DiffOptions {
  std::string file = "plant.xml";
  std::vector<std::string> also;
  deploy::LinkSettings link;
};

using Digests = std::map<std::string, std::string>;  // by path

Digests digests_of(const deploy::Package& package) {
  Digests digests;
  for (const deploy::PackageFile& file : package.files) {
    if (file.path != deploy::kProjectPath) {
      digests.emplace(file.path, file.digest);
    }
  }
  return digests;
}

std::string digest_at(const std::filesystem::path& file) {
  const auto digest = keys::digest_of_file(file);
  return digest ? digest->digest : "";
}

// Adds a row for each path that is not the same on both sides. Returns their number.
std::size_t compare(const char* kind, const Digests& here, const Digests& there, Table& table) {
  std::set<std::string> paths;
  for (const Digests& side : {here, there}) {
    for (const auto& [path, digest] : side) {
      paths.insert(path);
    }
  }
  std::size_t different = 0;
  for (const std::string& path : paths) {
    const auto mine = here.find(path);
    const auto running = there.find(path);
    std::string what = "changed";
    if (mine == here.end()) {
      what = "only in the plant";
    } else if (running == there.end()) {
      what = "only here";
    } else if (mine->second == running->second) {
      continue;
    }
    ++different;
    table.add({Cell(std::string(kind)), Cell(printable(path)), Cell(what, Style::Bold)});
  }
  return different;
}

// Compares the sources, if both sides have them.
Result<std::size_t, Failure> compare_sources(DiscoveredBoards& boards, std::uint64_t self, const RunningPlant& running,
                                             const std::optional<Project>& project, Table& table) {
  const bool deployed = std::any_of(running.package.files.begin(), running.package.files.end(),
                                    [](const auto& file) { return file.path == deploy::kProjectPath; });
  if (!project || !deployed) {
    return std::size_t{0};
  }
  const base::TemporaryFolder folder;
  if (folder.path().empty()) {
    return Failure{kFailed, folder.problem()};
  }
  const auto fetched = fetch_project(boards, self, running, folder.path());
  if (!fetched) {
    return fetched.error();
  }
  Digests here;
  Digests there;
  for (const deploy::ProjectFile& file : project->files) {
    here.emplace(file.path, digest_at(file.source));
  }
  for (const std::string& path : fetched->paths) {
    there.emplace(path, digest_at(folder.path() / path));
    // What was pulled is in no work tree of git, where hidden files are no sources, but these were.
    const std::filesystem::path file = project->folder / path;
    std::error_code error;
    if (!here.contains(path) && std::filesystem::is_regular_file(std::filesystem::symlink_status(file, error))) {
      here.emplace(path, digest_at(file));
    }
  }
  return compare("source", here, there, table);
}

int diff(Context& context, DiffOptions& options) {
  auto source = read_plant_source(context, options.file, options.also, {});
  if (!source) {
    return report(context.out, not_done(source.error(), "compared"));
  }
  options.link.network.multicast = source->plant.multicast;
  auto boards = discover_boards(context, options.link, {});
  if (!boards) {
    return report(context.out, boards.error());
  }
  const auto running = running_plant(*boards, options.link.self, source->plant.name);
  if (!running) {
    return report(context.out, running.error());
  }
  Table table({{"KIND", "kind"}, {"FILE", "file"}, {"DIFFERENCE", "difference"}});
  std::size_t different = compare("deployed", digests_of(source->packed.package), digests_of(running->package), table);
  const auto sources = compare_sources(*boards, options.link.self, *running, source->project, table);
  if (!sources) {
    return report(context.out, sources.error());
  }
  different += *sources;
  print_table(context, table, {{"plant", running->plant}, {"deployment", running->id}, {"equal", different == 0}},
              "files");
  if (different == 0) {
    context.out.note(
        fmt::format("plant {} runs what is here (deployment {})", running->plant, deploy::shown_id(running->id)));
  }
  return different == 0 ? kOk : kFailed;
}

Action declare_diff(base::Options& app, Context& context) {
  auto options = std::make_shared<DiffOptions>();
  app.add("file", "FILE", options->file, "Manifest of the plant, or a bundle (default: plant.xml)");
  add_also_option(app, options->also);
  deploy::add_link_options(app, options->link);
  add_format_option(app, context, {Format::Table, Format::Json, Format::Csv});
  return [options](Context& c) { return diff(c, *options); };
}

}  // namespace

const Verb kDiffVerb{
    "diff", "Plants", "Compare what a plant runs with the local files",
    "Compares the modules and files of the plant's deployment, and its sources if they were deployed, with those\n"
    "of the manifest, byte for byte (SHA-256).\n"
    "Exit codes: 0 equal, 1 different, 4 the check of the manifest found errors, 6 no board of the plant reports.\n"
    "Examples:\n"
    "  indurop diff\n"
    "  indurop diff plant.xml -o json\n",
    &declare_diff};

}  // namespace indurop::tools
