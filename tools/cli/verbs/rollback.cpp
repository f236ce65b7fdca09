// SPDX-License-Identifier: Apache-2.0
// indurop rollback: returns the boards of a plant to an earlier deployment, as one deployment.
#include <memory>
#include <string>

#include "deploy/link/deploy_link.h"
#include "tools/cli/plant/roll_back.h"
#include "tools/cli/verbs/verbs.h"

namespace indurop::tools {
namespace {

constexpr std::size_t kShortestId = 4;

Action declare_rollback(base::Options& app, Context& context) {
  auto options = std::make_shared<RollbackOptions>();
  app.add("id", "ID", options->id, "Deployment to go back to (default: the one before the present one)")
      .check([](const std::string& text) {
        const bool hex = text.find_first_not_of("0123456789abcdef") == std::string::npos;
        return hex && text.size() >= kShortestId ? std::string{} : "an id is 4 to 64 of the digits 0-9 and a-f";
      });
  app.add("--plant", "NAME", options->plant, "Name of the plant (default: the only one)");
  deploy::add_link_options(app, options->link);
  add_time_option(app, "--timeout", options->timeout_ns,
                  "How long to wait for boards to report or answer (default: 5s)");
  add_time_option(app, "--health", options->health_ns,
                  "How long to monitor the deployment before it is committed (default: 3s)");
  app.flag("--allow-missing", options->allow_missing,
           "Roll back the boards that report; the others follow when they appear");
  app.flag("--restart", options->restart, "Restart all nodes, even if modules could be exchanged while they run");
  add_format_option(app, context, {Format::Table, Format::Json, Format::Csv});
  return [options](Context& c) { return roll_back(c, *options); };
}

}  // namespace

const Verb kRollbackVerb{
    "rollback", "Plants", "Roll all boards of a plant back to their previous deployment",
    "A rollback is a deployment like any other, of files that the boards still have: where possible, modules are\n"
    "exchanged in one tick, with what they keep. It is monitored, and if a board is not healthy, all boards go\n"
    "back to what they run now. A second rollback goes forward again. The exit codes are those of indurop deploy.\n"
    "Examples:\n"
    "  indurop rollback\n"
    "  indurop rollback 3f2a91\n",
    &declare_rollback};

}  // namespace indurop::tools
