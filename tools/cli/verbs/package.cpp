// SPDX-License-Identifier: Apache-2.0
// indurop package: a plant as a Debian package.
#include <fmt/format.h>

#include <filesystem>
#include <memory>
#include <utility>

#include "core/base/temporary_folder.h"
#include "deploy/bundle/bundle.h"
#include "deploy/words/deployment_words.h"
#include "tools/cli/plant/plant_package.h"
#include "tools/cli/plant/plant_source.h"
#include "tools/cli/verbs/package_options.h"
#include "tools/cli/verbs/verbs.h"
#include "tools/client/text/units.h"

namespace indurop::tools {
namespace {

struct PackageOptions {
  std::string file = "plant.xml";
  std::string out;
  std::string version;
  std::string maintainer = "InduRoP maintainers <maintainers@indurop.invalid>";
  std::vector<std::string> also;
  std::string comment;
  std::string keys;
};

// Puts the bundle where the package has it: a bundle as it is, of a manifest a new one.
Result<void, base::Problem> place_bundle(Context& context, const PlantSource& source, const PackageOptions& options,
                                         const std::filesystem::path& place) {
  std::error_code error;
  std::filesystem::create_directories(place.parent_path(), error);
  if (!source.signature) {
    return write_signed_bundle(context, source, options.keys, place);
  }
  std::filesystem::copy_file(options.file, place, error);
  if (error) {
    return base::Problem{fmt::format("cannot copy {} to {}: {}", options.file, place.string(), error.message())};
  }
  return {};
}

int package(Context& context, const PackageOptions& options) {
  if (options.version.empty()) {
    context.out.error("the package needs a version, by which apt knows the newer one: --package-version 1.0");
    return kUsage;
  }
  auto source = read_plant_source(context, options.file, options.also, options.comment);
  if (!source) {
    return report(context.out, not_done(source.error(), "packed"));
  }
  if (source->signature && !options.keys.empty()) {
    context.out.error(fmt::format(
        "{} is a bundle, which was signed or not when it was packed; --keys is for a manifest", options.file));
    return kUsage;
  }
  const base::TemporaryFolder temporary;
  if (temporary.path().empty()) {
    context.out.error(temporary.problem());
    return kFailed;
  }
  const PlantPackage about{source->plant.name, source->packed.id, source->packed.package.comment, options.version,
                           options.maintainer};
  const std::filesystem::path tree = temporary.path() / "tree";
  const std::filesystem::path file =
      options.out.empty() ? fmt::format("{}_{}_all.deb", package_name(about.plant), about.version) : options.out;
  std::error_code error;
  std::string refusal = std::filesystem::equivalent(file, options.file, error)
                            ? fmt::format("{} would be lost; name another file with -o", file.string())
                            : deploy::output_refusal(source->packed, file);
  if (!refusal.empty()) {
    context.out.error(refusal);
    return kFailed;
  }
  auto done = place_bundle(context, *source, options, tree / installed_bundle(about.plant));
  if (done) {
    done = write_plant_package(about, tree, file);
  }
  if (!done) {
    context.out.error(done.error().text);
    return kFailed;
  }
  context.out.line(fmt::format("{}: plant {}, deployment {}; once installed: indurop deploy /{}", file.string(),
                               about.plant, deploy::shown_id(about.deployment),
                               installed_bundle(about.plant).string()));
  return kOk;
}

Action declare_package(base::Options& app, Context& /*context*/) {
  auto options = std::make_shared<PackageOptions>();
  app.add("file", "FILE", options->file, "Manifest of the plant, or a bundle of indurop pack (default: plant.xml)");
  app.add("-o,--file", "FILE", options->out, "Package to write (default: indurop-plant-PLANT_VERSION_all.deb)");
  app.add("--package-version", "VERSION", options->version, "Version of the package; apt takes the highest")
      .check(version_problem);
  app.add("--maintainer", "WHO", options->maintainer, "Who made it: NAME <ADDRESS>").check(maintainer_problem);
  app.add("--keys", "DIR", options->keys,
          "Of a manifest: sign with the deployer's keys in DIR (default: <security> of the manifest)")
      .completes(base::Completion::Folder);
  add_comment_option(app, options->comment);
  add_also_option(app, options->also);
  return [options](Context& c) { return package(c, *options); };
}

}  // namespace

const Verb kPackageVerb{
    "package", "Plants", "Make a Debian package of a plant or its bundle",
    "The package installs the bundle as /usr/share/indurop/plants/PLANT.bundle and depends on the package\n"
    "indurop. Its installation asks no questions and deploys nothing: run indurop deploy with that file when the\n"
    "plant may change. The same bundle gives the same package, byte for byte. Needs dpkg-deb, which is part of\n"
    "every Debian.\n"
    "Exit codes: 0 written, 1 a file cannot be read or written, 4 the check found errors.\n"
    "Examples:\n"
    "  indurop package cell.bundle --package-version 1.2\n"
    "  indurop package plant.xml --package-version 1.2 --keys keys --maintainer 'Cell Team <cell@factory.example>'\n",
    &declare_package};

}  // namespace indurop::tools
