// SPDX-License-Identifier: Apache-2.0
#include "tools/cli/values/items_to_show.h"

namespace indurop::tools {

std::shared_ptr<const std::vector<std::string>> add_items_to_show(base::Options& app, Context& context) {
  auto names = std::make_shared<std::vector<std::string>>();
  app.add("names", "NAME", *names, "Variables, parts of them (joints[1].y) or globs ('knu::*')")
      .required()
      .completes(base::Completion::Variable);
  add_node_option(app, context);
  add_remote_options(app, context);
  add_format_option(app, context, {Format::Table, Format::Json, Format::Csv});
  return names;
}

}  // namespace indurop::tools
