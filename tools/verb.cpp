// SPDX-License-Identifier: Apache-2.0
#include "tools/verb.h"

#include "tools/units.h"

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

std::string value_of(const std::string& argument) {
  return argument.starts_with(kValueMark) ? argument.substr(1) : argument;
}

void add_node_option(CLI::App& app, Context& context) {
  app.add_option("--node", context.node,
                 "Node to talk to (default: $INDUROP_NODE, \"local\", or the only one there is)")
      ->type_name("NAME");
}

void add_far_options(CLI::App& app, Context& context) {
  FarOptions& far = context.far;
  const auto wanted = [&far](const auto& /*value*/) { far.wanted = true; };
  app.add_flag("--remote", far.wanted, "Boards in the network, not a node of this machine; NAME@BOARD chooses one");
  app.add_option("--domain", far.network.domain,
                 "DDS domain in which boards show variables (default 0); implies --remote")
      ->check(CLI::Range(0, 230))
      ->each(wanted)
      ->type_name("N");
  app.add_option("--interface", far.network.interface_name, "Network interface to the boards; implies --remote")
      ->each(wanted)
      ->type_name("IF");
  app.add_option("--peer", far.network.peers, "Address of a board, for networks without multicast; implies --remote")
      ->each(wanted)
      ->allow_extra_args(false)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll)
      ->type_name("ADDRESS");
  app.add_flag_function(
      "--one-host",
      [&far](std::int64_t count) {
        far.network.one_host = count > 0;
        far.wanted = far.wanted || count > 0;
      },
      "Boards on this host, by loopback; implies --remote");
  add_time_option(app, "--wait", far.wait_ns, "With --remote: how long to wait for boards and values (default 3 s)");
}

void add_format_option(CLI::App& app, Context& context, std::initializer_list<Format> formats) {
  std::vector<Format> allowed(formats);
  std::string choices;
  for (const Format format : allowed) {
    choices += (choices.empty() ? "" : "|") + std::string(name_of(format));
  }
  context.format = allowed.front();
  app.add_option_function<std::string>(
         "-o,--output",
         [&context, allowed, choices](const std::string& text) {
           for (const Format format : allowed) {
             if (text == name_of(format)) {
               context.format = format;
               return;
             }
           }
           throw CLI::ValidationError("--output", "'" + text + "' is not one of " + choices);
         },
         "Form of the output: " + choices)
      ->type_name("FORM");
}

CLI::Option* add_time_option(CLI::App& app, const std::string& names, std::int64_t& to_ns, const std::string& help) {
  return app
      .add_option_function<std::string>(
          names,
          [&to_ns, names](const std::string& text) {
            const std::int64_t ns = parse_seconds_ns(text);
            if (ns < 0) {
              throw CLI::ValidationError(names,
                                         "'" + text + "' is not a time; write seconds (2, 0.5) or 500ms, 2s, 1min");
            }
            to_ns = ns;
          },
          help)
      ->type_name("TIME");
}

JsonValue document() {
  return JsonValue{{"schema_version", kJsonVersion}};
}

void print_table(Context& context, const Table& table, JsonValue head, const std::string& rows_key) {
  switch (context.format) {
    case Format::Json: {
      JsonValue whole = document();
      whole.update(head);
      whole[rows_key] = table.json();
      context.out.line(dump(whole));
      break;
    }
    case Format::Csv:
      context.out.write(table.csv());
      break;
    case Format::Table:
    case Format::Svg:
      context.out.write(table.text(context.out));
      break;
  }
}

}  // namespace indurop::tools
