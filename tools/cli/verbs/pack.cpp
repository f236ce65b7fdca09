// SPDX-License-Identifier: Apache-2.0
// indurop pack: a plant as one file, to be deployed where its sources are not.
#include <fmt/format.h>

#include <cstdint>
#include <filesystem>
#include <memory>
#include <utility>

#include "deploy/bundle/bundle.h"
#include "deploy/link/link_keys.h"
#include "tools/cli/plant/plant_source.h"
#include "tools/cli/verbs/package_options.h"
#include "tools/cli/verbs/verbs.h"
#include "tools/client/text/units.h"
#include "tools/console/diagnostics.h"

namespace indurop::tools {
namespace {

struct PackOptions {
  std::string file = "plant.xml";
  std::string out;
  std::vector<std::string> also;
  std::string comment;
  std::string keys;
};

int pack(Context& context, const PackOptions& options) {
  if (deploy::is_bundle(options.file)) {
    context.out.error(fmt::format("{} is a bundle already; indurop deploy takes it", options.file));
    return kUsage;
  }
  auto source = read_plant_source(context, options.file, options.also, options.comment);
  if (!source) {
    return report(context.out, not_done(source.error(), "packed"));
  }
  const std::filesystem::path file = options.out.empty() ? source->plant.name + ".bundle" : options.out;
  if (const auto written = write_signed_bundle(context, *source, options.keys, file); !written) {
    context.out.error(written.error().text);
    return kFailed;
  }
  std::error_code error;
  const std::uint64_t size = std::filesystem::file_size(file, error);
  context.out.line(fmt::format("{}: plant {}, deployment {}, {}, {}", file.string(), source->plant.name,
                               deploy::shown_id(source->packed.id),
                               counted(source->packed.package.files.size(), "file"), human_bytes(error ? 0 : size)));
  return kOk;
}

Action declare_pack(base::Options& app, Context& /*context*/) {
  auto options = std::make_shared<PackOptions>();
  app.add("file", "FILE", options->file, "Manifest of the plant (default: plant.xml)");
  app.add("-o,--file", "FILE", options->out, "Bundle to write (default: PLANT.bundle)");
  app.add("--keys", "DIR", options->keys, "Sign with the deployer's keys in DIR (default: <security> of the manifest)")
      .completes(base::Completion::Folder);
  add_comment_option(app, options->comment);
  add_also_option(app, options->also);
  return [options](Context& c) { return pack(c, *options); };
}

}  // namespace

const Verb kPackVerb{
    "pack", "Plants", "Pack a plant into one signed file",
    "Checks the plant and writes its manifest, modules and data to one file, which indurop deploy accepts on any\n"
    "machine, without sources or a compiler. Equal files have the same deployment id, which indurop deploy shows.\n"
    "The file is a tar archive with zstd compression: tar tf FILE lists it.\n"
    "Exit codes: 0 packed, 1 a file cannot be read or written, 4 the check found errors.\n"
    "Examples:\n"
    "  indurop pack plant.xml\n"
    "  indurop pack plant.xml -o cell-12.bundle --keys keys -m 'gripper opens wider'\n",
    &declare_pack};

}  // namespace indurop::tools
