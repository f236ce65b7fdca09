// SPDX-License-Identifier: Apache-2.0
// What programs and verbs get that print for people and for other programs, and the options they share.

#pragma once

#include <initializer_list>
#include <string>

#include "core/base/options.h"
#include "tools/client/text/table.h"
#include "tools/client/values/access.h"
#include "tools/console/output.h"

namespace indurop::tools {

enum class Format { Table, Json, Csv, Svg };

// Data that every verb gets in addition to its own options.
struct Context : Access {
  Context() { messages = &out; }

  Output out;
  Format format = Format::Table;
  std::string who;     // who gives the command; empty: the user of this process
  std::string from;    // from where it was given: an address; empty likewise
  std::string reason;  // as given by --reason, else empty
};

// Options that several programs or verbs share. The first format is the default.
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
