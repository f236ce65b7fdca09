// SPDX-License-Identifier: Apache-2.0
#include "tools/cli/plc/plc_debug.h"

#include <fmt/format.h>

#include <filesystem>
#include <optional>

#include "control/plc/front/compiler.h"
#include "core/base/replace_file.h"
#include "core/base/temporary_folder.h"
#include "tools/cli/plc/debug_link.h"
#include "tools/cli/plc/debug_session.h"
#include "tools/cli/plc/debugged_node.h"
#include "tools/cli/plc/plc_build.h"
#include "tools/cli/plc/plc_file.h"
#include "tools/cli/plc/plc_sources.h"
#include "tools/client/process/interrupt.h"

namespace indurop::tools {
namespace {

namespace fs = std::filesystem;

struct PlcDebugRequest {
  plc::CompileOptions compile;
  std::string config;
  std::string until;
};

// Builds the program alone and a configuration for it.
bool build(Context& context, PlcDebugRequest& request, const plc::Compiled& compiled, const fs::path& folder) {
  if (!write_modules(context, request.compile, compiled, folder, false)) {
    return false;
  }
  request.config = (folder / "module.xml").string();
  const auto saved = base::replace_file(request.config, "<root>\n" + plc::module_xml(compiled.modules) + "</root>\n",
                                        base::Durable::No);
  if (!saved) {
    context.out.error(base::cannot_write(request.config, saved.error()));
  }
  return saved.ok();
}

int debug(Context& context, PlcDebugRequest& request) {
  request.compile.debug = true;
  const auto files = with_project_files(context, request.compile.files);
  if (!files) {
    return kCheckFailed;
  }
  request.compile.files = *files;
  std::optional<EndsAtOnce> ends(std::in_place);
  const plc::Compiled compiled = plc::compile(request.compile);
  ends.reset();
  print_diagnostics(context, compiled.diagnostics);
  if (!compiled.ok) {
    return kCheckFailed;
  }
  const base::TemporaryFolder folder;
  if (folder.path().empty()) {
    context.out.error(folder.problem());
    return kFailed;
  }
  if (request.config.empty() && !build(context, request, compiled, folder.path())) {
    return kFailed;
  }
  const fs::path socket = folder.path() / "socket";
  DebugLink link(socket);
  if (!link.is_open()) {
    context.out.error("cannot make a socket in " + folder.path().string());
    return kFailed;
  }
  DebuggedNode node(request.config, socket, request.until);
  if (!node.start(false)) {
    context.out.error("cannot start a node: the program indurop is not in the folder of this one");
    return kFailed;
  }
  context.node = node.name();
  const int code = DebugSession(context, compiled, link, node, !request.until.empty()).run();
  link.close();
  return code;
}

}  // namespace

void add_plc_debug(base::Options& app, const std::shared_ptr<Action>& chosen) {
  const auto request = std::make_shared<PlcDebugRequest>();
  base::Options& made =
      app.command("debug", "Run a program in simulation, with breakpoints and line by line",
                  [request, chosen] { *chosen = [request](Context& c) { return debug(c, *request); }; });
  add_plc_sources(made, request->compile);
  made.add("--run", "FILE", request->config,
           "The configuration to run, with modules built with --debug (default: the program alone)");
  made.add("--until", "TIME", request->until, "End the simulation at this time");
}

}  // namespace indurop::tools
