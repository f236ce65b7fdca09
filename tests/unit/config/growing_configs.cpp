// SPDX-License-Identifier: Apache-2.0
// growing_configs --list: the names and first sizes of all texts. growing_configs NAME N: reads N names of variables in
// a schema with N variables and says what became of them; growth_test.py of the PLC compiler counts the instructions.

#include <unistd.h>

#include <cstdlib>
#include <iostream>
#include <string>
#include <string_view>
#include <vector>

#include "config/check/check.h"
#include "config/check/io_binding.h"
#include "config/xml/io_reader.h"
#include "config/xml/reader.h"
#include "store/operate/item.h"
#include "store/vars/shm_file.h"
#include "store/vars/store.h"
#include "tests/unit/config/module_file.h"

namespace {

using namespace indurop;  // NOLINT(google-build-using-namespace)
using Size = std::size_t;

// `text` n times, with its number for each '#'.
std::string repeated(Size n, std::string_view text) {
  std::string out;
  for (Size i = 0; i < n; ++i) {
    for (const char c : text) {
      out += c == '#' ? std::to_string(i) : std::string(1, c);
    }
  }
  return out;
}

schema::Schema variables(Size n) {
  schema::Schema schema;
  for (Size i = 0; i < n; ++i) {
    schema.variables.push_back(config::variable("plant::cell::value" + std::to_string(i)));
    schema.variables.back().type_hash = schema::hash_of(schema.variables.back().type);
  }
  return schema;
}

void say(Size errors, const std::string& first) {
  std::cout << (errors == 0 ? "fine" : "refused") << ", " << errors << " errors\n" << first << '\n';
}

void say(const std::vector<base::Diagnostic>& diagnostics) {
  Size errors = 0;
  for (const base::Diagnostic& one : diagnostics) {
    errors += one.severity == base::Diagnostic::Severity::Error ? 1 : 0;
  }
  say(errors, diagnostics.empty() ? "" : base::to_string(diagnostics.front()));
}

void say(const Result<void, std::vector<std::string>>& result) {
  say(result ? 0 : result.error().size(), result ? "" : result.error().front());
}

void points(Size n, std::string_view text, const std::string& driver = R"(driver="csv" file="x.csv")") {
  const std::string xml =
      "<ioconfig>\n<device name=\"a\" " + driver + ">\n" + repeated(n, text) + "</device>\n</ioconfig>\n";
  config::ReadIo read = config::read_io_config_text(xml, "in.xml");
  const schema::Schema schema = variables(n);
  static_cast<void>(config::bind_io(read.config, schema, read.diagnostics));
  say(read.diagnostics);
}

void devices(Size n, std::string_view text) {
  say(config::read_io_config_text("<ioconfig>\n" + repeated(n, text) + "</ioconfig>\n", "in.xml").diagnostics);
}

void module(Size n, const std::string& elements) {
  const config::ModuleFolder folder;
  config::ModuleSpec spec;
  spec.schema = variables(n);
  config::write_module(folder / "m.so", spec);
  const std::string xml =
      "<root><module><filename>m.so</filename><moduletype>thread</moduletype><operationtype>periodic</operationtype>"
      "<period>1ms</period><priority>1</priority>\n" +
      elements + "</module></root>\n";
  config::ReadResult read = config::read_config_text(xml, folder / "module.xml");
  if (read.diagnostics.empty()) {
    read.diagnostics = config::check_config(read.config, {}).diagnostics;
  }
  say(read.diagnostics);
}

void failsafe(Size n, std::string_view text) {
  module(n, repeated(n, text));
}
void access(Size n, std::string_view text) {
  module(n, "<access>\n" + repeated(n, text) + "</access>\n");
}

// The values of recipes and of `indurop set`.
void values(Size n, std::string_view text, bool assign) {
  const std::string node = "growing_" + std::to_string(::getpid());
  const auto store = vars::Store::create(node, variables(n));
  if (!store) {
    std::cerr << store.error().where << '\n';
    std::exit(1);
  }
  std::vector<std::string> lines;
  for (Size i = 0; i < n; ++i) {
    lines.push_back(std::string(text) + std::to_string(i) + (assign ? "=1" : ""));
  }
  const auto result = [](auto done) {
    return done ? Result<void, std::vector<std::string>>() : std::move(done).error();
  };
  say(assign ? result(operate::parse_all(*store, lines)) : result(operate::select(*store, lines)));
  static_cast<void>(vars::remove_shm_file(vars::block_file(node)));
}

struct Text {
  const char* name;
  void (*read)(Size n);
};
constexpr const char* kModbus = R"(driver="modbus_tcp" address="127.0.0.1")";
constexpr Text kTexts[] = {
    {"io_points", [](Size n) { points(n, "<input variable=\"value#\"/>\n"); }},
    {"io_points_unknown", [](Size n) { points(n, "<input variable=\"velue#\"/>\n"); }},
    {"io_points_same", [](Size n) { points(n, "<input variable=\"value0\"/>\n"); }},
    {"io_registers", [](Size n) { points(n, "<input variable=\"value#\" at=\"holding:#\"/>\n", kModbus); }},
    {"io_outputs", [](Size n) { points(n, "<output variable=\"value#\" at=\"holding:#\"/>\n", kModbus); }},
    {"io_registers_same", [](Size n) { points(n, "<output variable=\"value#\" at=\"holding:0\"/>\n", kModbus); }},
    {"io_attributes_unknown", [](Size n) { points(n, "<input variable=\"value#\" nonsense#=\"1\"/>\n"); }},
    {"io_elements_unknown", [](Size n) { points(n, "<nonsense# variable=\"value#\"/>\n"); }},
    {"io_devices", [](Size n) { devices(n, "<device name=\"d#\" driver=\"csv\" file=\"x.csv\"/>\n"); }},
    {"io_devices_same", [](Size n) { devices(n, "<device name=\"d\" driver=\"csv\" file=\"x.csv\"/>\n"); }},
    {"io_drivers_unknown", [](Size n) { devices(n, "<device name=\"d#\" driver=\"x#\"/>\n"); }},
    {"access", [](Size n) { access(n, "<read>value#</read>\n"); }},
    {"access_unknown", [](Size n) { access(n, "<read>velue#</read>\n"); }},
    {"failsafe", [](Size n) { failsafe(n, "<failsafe variable=\"value#\">0</failsafe>\n"); }},
    {"failsafe_unknown", [](Size n) { failsafe(n, "<failsafe variable=\"velue#\">0</failsafe>\n"); }},
    {"failsafe_wrong", [](Size n) { failsafe(n, "<failsafe variable=\"value#\">x</failsafe>\n"); }},
    {"recipe", [](Size n) { values(n, "value", true); }},
    {"recipe_unknown", [](Size n) { values(n, "velue", true); }},
    {"selected", [](Size n) { values(n, "value", false); }},
    {"selected_unknown", [](Size n) { values(n, "velue", false); }},
};
constexpr Size kFirst = 1000;

}  // namespace

int main(int argc, char** argv) {
  const std::string_view wanted = argc > 1 ? argv[1] : "";
  for (const Text& one : kTexts) {
    if (wanted == "--list") {
      std::cout << one.name << ' ' << kFirst << '\n';
    } else if (wanted == one.name && argc > 2) {
      one.read(std::strtoul(argv[2], nullptr, 10));
    }
  }
  return 0;
}
