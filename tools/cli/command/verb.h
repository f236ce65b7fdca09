// SPDX-License-Identifier: Apache-2.0
// A verb of `indurop`: a name, a help text, options, and an action. One file per verb (tools/cli/verbs); verbs.cpp has
// the list of all.

#pragma once

#include <filesystem>
#include <functional>
#include <initializer_list>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "core/base/exit_code.h"
#include "core/base/options.h"
#include "network/dds/network_settings.h"
#include "tools/cli/command/output.h"
#include "tools/client/failure.h"
#include "tools/client/text/table.h"

namespace indurop::tools {

enum class Format { Table, Json, Csv, Svg };

// Use variables of boards in the network instead of a local node.
struct RemoteOptions {
  bool wanted = false;
  dds::NetworkSettings network;
  std::filesystem::path keys;            // folder from which network.security was read; empty: none
  std::int64_t wait_ns = 3'000'000'000;  // maximum time to receive boards and values
};
class ValueSource;

// Data that every verb gets in addition to its own options.
struct Context {
  Output out;
  Format format = Format::Table;
  std::string node;  // as given by --node, else empty
  RemoteOptions remote;
  std::shared_ptr<ValueSource> values;  // once open_store() has opened them
  std::string who;                      // who gives the command; empty: the user of this process
  std::string from;                     // from where it was given: an address; empty likewise
  std::string reason;                   // as given by --reason, else empty
};

using Action = std::function<int(Context&)>;

struct Verb {
  const char* name = "";
  const char* group = "";    // heading in the list of verbs
  const char* summary = "";  // one line
  const char* details = "";  // below the options: what it prints, examples
  // Adds the verb's options to `app` and returns the action to run after they are parsed.
  Action (*declare)(base::Options& app, Context& context) = nullptr;
};

std::span<const Verb> all_verbs();

// Options that several verbs share. The first format is the default.
void add_node_option(base::Options& app, Context& context);
// Adds --reason, for verbs that change something.
void add_reason_option(base::Options& app, Context& context);
// Adds --remote and related options.
void add_remote_options(base::Options& app, Context& context);
void add_format_option(base::Options& app, Context& context, std::initializer_list<Format> formats);

// Adds an option for a time in seconds or with a unit, converted to nanoseconds; wrong text is a usage error.
base::Option add_time_option(base::Options& app, const std::string& names, std::int64_t& to_ns,
                             const std::string& help);

// Prints JSON, "schema_version" and `head` first and the table's rows under `rows_key`, or the table as text or CSV.
void print_table(Context& context, const Table& table, const JsonValue& head, const std::string& rows_key);
// A JSON document that begins with "schema_version".
JsonValue document();

}  // namespace indurop::tools
