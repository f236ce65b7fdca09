// SPDX-License-Identifier: Apache-2.0
// Writes the layout table for people, and the list of all outputs.

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <iterator>
#include <utility>

#include "glb2idl/emit.h"
#include "glb2idl/text.h"

namespace indurop::glb2idl {
namespace {

using Row = std::vector<std::string>;

// Formats a table: columns as wide as their longest cell; numbers right-aligned.
std::string table(const std::vector<Row>& rows, std::string_view right_aligned) {
  std::vector<std::size_t> widths;
  for (const Row& row : rows) {
    widths.resize(std::max(widths.size(), row.size()));
    for (std::size_t i = 0; i < row.size(); ++i) {
      widths[i] = std::max(widths[i], row[i].size());
    }
  }
  std::string out;
  for (const Row& row : rows) {
    std::string line;
    for (std::size_t i = 0; i < row.size(); ++i) {
      const std::string gap(widths[i] - row[i].size(), ' ');
      line += i == 0 ? "" : "  ";
      line += i < right_aligned.size() && right_aligned[i] == 'r' ? gap + row[i] : row[i] + gap;
    }
    line.erase(line.find_last_not_of(' ') + 1);
    out += line + "\n";
  }
  return out;
}

std::string range_text(const std::optional<schema::Range>& range) {
  return range ? fmt::format("{}..{}", range->min, range->max) : std::string("-");
}

std::string or_dash(const std::string& text) {
  return text.empty() ? "-" : text;
}

std::string duration_text(std::int64_t ns) {
  constexpr std::array<std::pair<std::int64_t, std::string_view>, 4> kUnits{
      {{1'000'000'000, "s"}, {1'000'000, "ms"}, {1'000, "us"}, {1, "ns"}}};
  for (const auto& [unit, name] : kUnits) {
    if (ns % unit == 0) {
      return fmt::format("{} {}", ns / unit, name);
    }
  }
  return {};
}

// Returns "initial 45", or only "initial" if the value is long.
std::string value_text(std::string_view what, const schema::Type& type, const std::vector<std::uint8_t>& bytes) {
  constexpr std::size_t kShort = 32;
  const std::string value = type.size() > kShort ? std::string() : schema::format_value(type, bytes);
  return value.empty() || value.size() > kShort ? std::string(what) : fmt::format("{} {}", what, value);
}

std::string properties(const schema::Variable& v) {
  std::string out;
  const auto add = [&out](const std::string& text) { out += (out.empty() ? "" : ", ") + text; };
  if (v.retain) {
    add("retain");
  }
  if (v.view) {
    add("view");
  }
  if (v.optional) {
    add("optional");
  }
  if (v.maxage_ns != 0) {
    add(fmt::format("maxage {}", duration_text(v.maxage_ns)));
  }
  if (!v.initial.empty()) {
    add(value_text("initial", v.type, v.initial));
  }
  if (!v.fallback.empty()) {
    add(value_text("fallback", v.type, v.fallback));
  }
  return or_dash(out);
}

void add_alarms(std::vector<Row>& rows, const std::string& name, const schema::Type& type,
                const std::vector<schema::Alarm>& alarms) {
  for (const schema::Alarm& alarm : alarms) {
    const std::string condition = schema::condition_text(type, alarm);
    rows.push_back({condition.empty() ? name : fmt::format("{} {}", name, condition),
                    alarm.deadband == 0 ? "-" : fmt::format("{}", alarm.deadband), schema::word_of(alarm.priority),
                    alarm.delay_ns == 0 ? "-" : duration_text(alarm.delay_ns), alarm.text});
  }
}

// Adds the alarms of a variable or of a struct's fields.
void add_field_alarms(std::vector<Row>& rows, const schema::Type& type, const std::string& prefix) {
  for (const schema::Field& field : type.fields) {
    add_alarms(rows, prefix + field.name, field.type, field.alarms);
  }
}

void add_fields(std::vector<Row>& rows, const schema::Type& type, const std::string& prefix, std::uint64_t base) {
  for (const schema::Field& field : type.fields) {
    const std::uint64_t offset = base + field.offset;
    rows.push_back({fmt::format("{}", offset), fmt::format("{}", field.type.size()), prefix + field.name,
                    schema::display_name(field.type), or_dash(field.unit), range_text(field.range),
                    comment_line(field.description)});
    if (field.type.base == schema::Base::Struct && field.type.dims.empty()) {
      add_fields(rows, field.type, prefix + field.name + ".", offset);
    }
  }
}

}  // namespace

std::string emit_layout(const Program& program, const GlbFile& unit) {
  std::vector<Row> variables{{"variable", "type", "bytes", "kind", "unit", "range", "properties", "description"}};
  std::vector<Row> alarms{{"alarm", "deadband", "priority", "delay", "text"}};
  std::string structs;
  std::uint64_t bytes = 0;
  std::string functions;
  std::string pools;
  for (const Item& item : unit.items) {
    if (const auto* v = std::get_if<schema::Variable>(&item)) {
      bytes += v->type.size();
      variables.push_back({v->name, schema::display_name(v->type), fmt::format("{}", v->type.size()),
                           v->kind == abi::Kind::Scalar ? "scalar" : "ring", or_dash(v->unit), range_text(v->range),
                           properties(*v), comment_line(v->description)});
      add_alarms(alarms, v->name, v->type, v->alarms);
    } else if (const auto* s = std::get_if<Structure>(&item)) {
      add_field_alarms(alarms, s->type, s->type.name + ".");
      std::vector<Row> rows{{"offset", "bytes", "field", "type", "unit", "range", "description"}};
      add_fields(rows, s->type, "", 0);
      structs += fmt::format("\nstruct {}: {} bytes, aligned to {}\n{}", s->type.name, s->type.element_size,
                             s->type.align, table(rows, "rr"));
    } else if (const auto* f = std::get_if<schema::Function>(&item)) {
      functions +=
          fmt::format("{}: {} bytes of arguments, {} bytes of result\n", f->name,
                      is_void(f->arguments) ? 0 : f->arguments.size(), is_void(f->result) ? 0 : f->result.size());
    } else if (const auto* p = std::get_if<schema::Pool>(&item)) {
      pools +=
          fmt::format("{}: {} chunks of {} bytes, {}\n", p->name, p->type.dims[0], p->type.element_size, p->type.name);
    }
  }
  std::string out = fmt::format("Layout of {}.glb, written by glb2idl: {} variables, {} bytes\n", unit.stem,
                                variables.size() - 1, bytes);
  for (const std::size_t other : unit.includes) {
    out += fmt::format("includes {}.glb\n", program.units[other].stem);
  }
  if (variables.size() > 1) {
    out += fmt::format("\n{}", table(variables, "  r"));
  }
  out += structs;
  if (alarms.size() > 1) {
    out += fmt::format("\n{}", table(alarms, ""));
  }
  if (!pools.empty()) {
    out += fmt::format("\npools\n{}", pools);
  }
  return functions.empty() ? out : fmt::format("{}\nshared functions\n{}", out, functions);
}

std::vector<Output> emit_all(const Program& program) {
  std::vector<Output> out;
  std::vector<Header> headers = emit_cpp(program);
  std::string all = "// All shared variables, written by glb2idl. Do not edit.\n#pragma once\n\n";
  for (std::size_t i = 0; i < program.units.size(); ++i) {
    const GlbFile& unit = program.units[i];
    out.push_back({unit.stem + ".idl", emit_idl(program, unit)});
    out.push_back({unit.stem + ".glb.h", std::move(headers[i].text)});
    out.push_back({unit.stem + ".layout.txt", emit_layout(program, unit)});
    all += fmt::format("#include \"../{}.glb.h\"\n", unit.stem);
  }
  out.push_back({"indurop/generated.h", std::move(all)});
  return out;
}

}  // namespace indurop::glb2idl
