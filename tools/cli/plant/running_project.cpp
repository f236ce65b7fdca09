// SPDX-License-Identifier: Apache-2.0
#include "tools/cli/plant/running_project.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "core/base/temporary_folder.h"
#include "core/keys/digest.h"
#include "tools/cli/plant/board_file.h"
#include "tools/client/board/board_texts.h"
#include "tools/client/text/units.h"

namespace indurop::tools {

Result<RunningPlant, Failure> running_plant(DiscoveredBoards& boards, std::uint64_t self, const std::string& plant) {
  auto name = choose_plant(boards.roster, plant);
  if (!name) {
    return std::move(name).error();
  }
  RunningPlant running;
  running.plant = printable(*name);
  std::vector<std::uint64_t> agents;
  for (const deploy::BoardReport& report : boards.reports) {
    if (report.plant != *name || report.current.empty()) {
      continue;
    }
    if (!running.id.empty() && report.current != running.id) {
      return Failure{kFailed, fmt::format("boards {} and {} run different deployments; see indurop boards",
                                          printable(running.source.board), printable(report.board))};
    }
    running.id = report.current;
    running.source = report;
    agents.push_back(report.agent);
  }
  for (const auto& [agent, text] : fetch_texts(*boards.link, self, running.id, agents)) {
    auto package = deploy::read_package(text);
    if (package && keys::digest_of(text) == running.id) {
      running.package = std::move(package).value();
      running.source = *std::find_if(boards.reports.begin(), boards.reports.end(),
                                     [sender = agent](const auto& report) { return report.agent == sender; });
      return running;
    }
  }
  return Failure{kUnreachable,
                 fmt::format("no board of plant {} answers with a valid list of its files", running.plant)};
}

Result<deploy::OpenedProject, Failure> fetch_project(DiscoveredBoards& boards, std::uint64_t self,
                                                     const RunningPlant& running, const std::filesystem::path& folder) {
  const auto& files = running.package.files;
  const auto found =
      std::find_if(files.begin(), files.end(), [](const auto& file) { return file.path == deploy::kProjectPath; });
  if (found == files.end()) {
    return Failure{kFailed, fmt::format("plant {} was deployed without its sources (see <sources> of the manifest)",
                                        running.plant)};
  }
  const base::TemporaryFolder temporary;
  if (temporary.path().empty()) {
    return Failure{kFailed, temporary.problem()};
  }
  const std::filesystem::path archive = temporary.path() / "sources";
  const BoardFile wanted{printable(running.source.board), running.source.agent, found->digest, found->size};
  if (auto fetched = fetch_file(*boards.link, self, wanted, archive); !fetched) {
    return std::move(fetched).error();
  }
  const auto digest = keys::digest_of_file(archive);
  if (!digest || digest->digest != found->digest) {
    return Failure{
        kFailed,
        fmt::format("what board {} sent are not the sources that were deployed: the SHA-256 differs", wanted.board)};
  }
  auto opened = deploy::open_project(archive, folder);
  if (!opened) {
    return Failure{kFailed, std::move(opened).error().text};
  }
  return std::move(opened).value();
}

}  // namespace indurop::tools
