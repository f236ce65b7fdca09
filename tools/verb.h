// SPDX-License-Identifier: Apache-2.0
// What a verb of `indurop` is: a name, a help text, options, and an action. One file per verb (cmd_*.cpp); the list
// of all is in verbs.cpp.

#pragma once

#include <CLI/CLI.hpp>

#include <functional>
#include <initializer_list>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "deploy/exit_code.h"
#include "mirror/far_plane.h"
#include "tools/output.h"
#include "tools/table.h"

namespace indurop::tools {

enum class Format { Table, Json, Csv, Svg };

// Variables of boards in the network instead of a node here.
struct FarOptions {
  bool wanted = false;
  mirror::FarSettings network;
  std::int64_t wait_ns = 3'000'000'000;  // for boards and values to be heard
};
class FarValues;

// What every verb gets besides its own options.
struct Context {
  Output out;
  Format format = Format::Table;
  std::string node;  // as given by --node, else empty
  FarOptions far;
  std::shared_ptr<FarValues> far_values;  // once they are open
};

using Action = std::function<int(Context&)>;

struct Verb {
  const char* name = "";
  const char* group = "";    // heading in the list of verbs
  const char* summary = "";  // one line
  const char* details = "";  // below the options: what it prints, examples
  // Adds the verb's options to `app` and returns what to do once they are parsed.
  Action (*declare)(CLI::App& app, Context& context) = nullptr;
  // Set: gets all arguments as they are instead (a verb that hands them to another program).
  int (*pass_through)(Context& context, const std::vector<std::string>& arguments) = nullptr;
};

// Put before arguments like "-2.5" and "[1, 2]" so that the parser takes them for values; take it off with value_of().
inline constexpr char kValueMark = '\x01';
std::string value_of(const std::string& argument);

std::span<const Verb> all_verbs();

// Options several verbs share. The first format is the default.
void add_node_option(CLI::App& app, Context& context);
// --remote and what belongs to it.
void add_far_options(CLI::App& app, Context& context);
void add_format_option(CLI::App& app, Context& context, std::initializer_list<Format> formats);

// A time given in seconds or with a unit, into nanoseconds; wrong text is a usage error.
CLI::Option* add_time_option(CLI::App& app, const std::string& names, std::int64_t& to_ns, const std::string& help);

// Prints `head` with "schema_version" in front and the table's rows under `rows_key`, or the table as text or CSV.
void print_table(Context& context, const Table& table, JsonValue head, const std::string& rows_key);
// A JSON document that begins with "schema_version".
JsonValue document();

}  // namespace indurop::tools
