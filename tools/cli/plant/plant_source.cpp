// SPDX-License-Identifier: Apache-2.0
#include "tools/cli/plant/plant_source.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <utility>

#include "config/xml/plant_reader.h"
#include "core/base/read_file.h"
#include "core/keys/participant_keys.h"
#include "deploy/bundle/project.h"
#include "tools/cli/command/config_file.h"
#include "tools/client/config/checked_config.h"
#include "tools/client/text/units.h"
#include "tools/console/diagnostics.h"

namespace indurop::tools {
namespace {

// Prints errors and warnings. Returns false if there are errors.
bool print_check(Context& context, const CheckedPlant& checked) {
  auto diagnostics = checked.diagnostics;
  std::erase_if(diagnostics, [](const auto& d) { return d.severity == base::Diagnostic::Severity::Note; });
  print_diagnostics(context, diagnostics, false);
  return checked.ok();
}

// Writes the archive of the sources. Returns it by its path in the package.
Result<std::map<std::string, std::filesystem::path>, base::Problem> archived(Context& context, const Project& project,
                                                                             const std::filesystem::path& to) {
  for (const JsonValue& path : project.about["left_out"].values()) {
    context.out.note(fmt::format("{} holds a private key and does not travel with the sources",
                                 printable((project.folder / path.text().value_or("")).string())));
  }
  for (const Project::Skipped& one : project.skipped) {
    const bool is_link = one.reason == Project::Skipped::Link;
    context.out.note(fmt::format("{} is {} and does not travel with the sources",
                                 printable((project.folder / one.path).string()),
                                 is_link ? "a symbolic link" : "a git repository of its own"));
  }
  const std::filesystem::path archive = to / "project.tar.zst";
  if (auto written = deploy::write_project(project.about, project.files, archive); !written) {
    return std::move(written).error();
  }
  return std::map<std::string, std::filesystem::path>{{deploy::kProjectPath, archive}};
}

Result<PlantSource, Failure> read_bundle(Context& context, const std::string& file) {
  PlantSource source;
  source.temporary = std::make_unique<base::TemporaryFolder>();
  if (source.temporary->path().empty()) {
    return Failure{kFailed, source.temporary->problem()};
  }
  auto opened = deploy::open_bundle(file, source.temporary->path());
  if (!opened) {
    return Failure{kFailed, std::move(opened).error().text};
  }
  if (!opened->packed.package.release.empty()) {
    return Failure{kUsage, fmt::format("{} is a release of the platform; indurop platform deploy takes it", file)};
  }
  CheckedPlant checked = load_plant(opened->manifest.string(), {});
  if (!print_check(context, checked)) {
    return Failure{kCheckFailed, {}};
  }
  if (!deploy::is_package_of(opened->packed.package, checked.plant)) {
    return Failure{kFailed, fmt::format("{}: the bundle names another plant, or other boards, than the manifest in it; "
                                        "pack it again",
                                        file)};
  }
  source.plant = std::move(checked.plant);
  source.packed = std::move(opened->packed);
  source.signature = std::move(opened->signature);
  return source;
}

}  // namespace

Result<PlantSource, Failure> read_plant_source(Context& context, const std::string& file,
                                               const std::vector<std::string>& also, const std::string& comment) {
  if (const auto found = find_config(file); !found) {
    return found.error();
  }
  if (const auto opened = base::open_file(file); !opened && opened.error().kind == base::FileProblem::Kind::System) {
    return Failure{kFailed, base::cannot_read(file, opened.error()) + "; check its permissions (ls -l)"};
  }
  if (deploy::is_bundle(file)) {
    if (!comment.empty()) {
      return Failure{kUsage, fmt::format("{} is a bundle, whose comment is that of its indurop pack; --comment is for "
                                         "a manifest",
                                         file)};
    }
    return read_bundle(context, file);
  }
  if (!config::is_plant_file(file)) {
    return Failure{kUsage, fmt::format("'{}' is not the manifest of a plant, nor a bundle of indurop pack", file)};
  }
  CheckedPlant checked = load_plant(file, {});
  if (!print_check(context, checked)) {
    return Failure{kCheckFailed, {}};
  }
  PlantSource source;
  source.temporary = std::make_unique<base::TemporaryFolder>();
  if (source.temporary->path().empty()) {
    return Failure{kFailed, source.temporary->problem()};
  }
  auto project = find_project(checked.plant, {also.begin(), also.end()});
  if (!project) {
    return Failure{kFailed, std::move(project).error().text};
  }
  source.project = std::move(project).value();
  std::map<std::string, std::filesystem::path> sources;
  if (source.project) {
    auto made = archived(context, *source.project, source.temporary->path());
    if (!made) {
      return Failure{kFailed, std::move(made).error().text};
    }
    sources = std::move(made).value();
  }
  auto packed = deploy::pack_plant(checked.plant, {also.begin(), also.end()}, comment, sources);
  if (!packed) {
    return Failure{kFailed, std::move(packed).error().text};
  }
  source.plant = std::move(checked.plant);
  source.packed = std::move(packed).value();
  return source;
}

Failure not_done(const Failure& failure, const char* act) {
  return failure.code == kCheckFailed && failure.text.empty()
             ? Failure{failure.code, fmt::format("nothing was {}", act)}
             : failure;
}

Result<void, base::Problem> write_signed_bundle(Context& context, const PlantSource& source, const std::string& keys,
                                                const std::filesystem::path& file) {
  const std::string from = keys.empty() ? source.plant.security.string() : keys;
  deploy::BundleSignature signature;
  if (from.empty()) {
    context.out.note("not signed: no keys. Plants with keys do not accept this bundle; --keys signs it");
  } else {
    auto made = deploy::sign_package(source.packed.text, from);
    if (!made) {
      return std::move(made).error();
    }
    signature = std::move(made).value();
  }
  return deploy::write_bundle(source.packed, signature, file);
}

std::string bundle_refusal(const PlantSource& source, const std::filesystem::path& keys) {
  if (!source.signature || keys.empty()) {
    return {};
  }
  const keys::ParticipantKeys own(keys);
  const auto authority = base::read_file(own.authority);
  const auto revoked = base::read_file(own.revoked);
  return deploy::bundle_refusal(*source.signature, source.packed.text, authority ? *authority : std::string(),
                                revoked ? *revoked : std::string());
}

}  // namespace indurop::tools
