// SPDX-License-Identifier: Apache-2.0
#include "tools/console/context.h"

#include "core/base/duration.h"
#include "deploy/link/link_keys.h"
#include "network/dds/network_options.h"
#include "tools/console/table_text.h"

namespace indurop::tools {
namespace {

const char* name_of(Format format) {
  switch (format) {
    case Format::Table:
      return "table";
    case Format::Json:
      return "json";
    case Format::Csv:
      return "csv";
    case Format::Svg:
      return "svg";
  }
  return "table";
}

}  // namespace

void add_node_option(base::Options& app, Context& context) {
  app.add("--node", "NAME", context.node, "Node to use (default: $INDUROP_NODE, \"local\", or the only one there is)")
      .completes(base::Completion::Node);
}

void add_reason_option(base::Options& app, Context& context) {
  app.add("--reason", "TEXT", context.reason, "Reason; recorded with your name (indurop audit)");
}

void add_remote_options(base::Options& app, Context& context) {
  RemoteOptions& remote = context.remote;
  app.flag("--remote", remote.wanted,
           "Use boards in the network instead of a node on this machine; NAME@BOARD selects one");
  dds::add_network_options(app, remote.network, "the variables that boards publish", &remote.wanted, "--remote");
  deploy::add_keys_option(app, remote.network.security, keys::Role::Viewer,
                          "Keys of a tool or of a plant, for boards with <external secure=\"on\">; implies --remote",
                          &remote.keys)
      .implies(remote.wanted);
  app.add("--peer", "ADDRESS", remote.network.peers,
          "Address of a board, for networks without multicast; implies --remote")
      .one_at_a_time()
      .implies(remote.wanted);
  add_time_option(app, "--wait", remote.wait_ns, "With --remote: how long to wait for boards and values (default 3 s)");
}

void add_format_option(base::Options& app, Context& context, std::initializer_list<Format> formats) {
  const std::vector<Format> allowed(formats);
  std::vector<std::string> names;
  std::string choices;
  for (const Format format : allowed) {
    names.emplace_back(name_of(format));
    choices += (choices.empty() ? "" : "|") + names.back();
  }
  context.format = allowed.front();
  const auto take = [&context, allowed](const std::string& text) {
    for (const Format format : allowed) {
      context.format = text == name_of(format) ? format : context.format;
    }
    return std::string();
  };
  app.add("-o,--output", "FORM", take, "Output format: " + choices).choices(names);
}

base::Option add_time_option(base::Options& app, const std::string& names, std::int64_t& to_ns,
                             const std::string& help) {
  const auto take = [&to_ns](const std::string& text) {
    const base::DurationText read = base::read_duration(text, true, base::PlainNumber::Seconds);
    to_ns = read.value ? read.value->count() : to_ns;
    return read.problem;
  };
  return app.add(names, "TIME", take, help);
}

JsonValue document() {
  return JsonValue{{"schema_version", kJsonVersion}};
}

void print_table(Context& context, const Table& table, const JsonValue& head, const std::string& rows_key) {
  switch (context.format) {
    case Format::Json: {
      JsonValue whole = document();
      whole.update(head);
      whole[rows_key] = table.json();
      context.out.line(whole.dump());
      break;
    }
    case Format::Csv:
      context.out.write(table.csv());
      break;
    case Format::Table:
    case Format::Svg:
      context.out.write(table_text(table, context.out));
      break;
  }
}

}  // namespace indurop::tools
