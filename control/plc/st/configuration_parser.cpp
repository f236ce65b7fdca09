// SPDX-License-Identifier: Apache-2.0
#include "control/plc/st/configuration_parser.h"

#include <limits>

namespace indurop::plc::st {

void ConfigurationParser::element(Project& to) {
  if (in_.accept("CONFIGURATION")) {
    configuration(to);
  } else if (in_.accept("VAR_CONFIG")) {
    configured(to.configured);
  } else {
    accesses("", to.accesses);
  }
}

bool ConfigurationParser::name(std::string& to, std::string_view what) {
  if (!in_.expect_name(what)) {
    return false;
  }
  to = in_.take().text;
  return true;
}

void ConfigurationParser::recover() {
  while (!in_.at_end() && !TokenReader::is_end_word(in_.peek())) {
    if (in_.take().is(";")) {
      return;
    }
  }
}

// Parses nothing, or ( item , item ).
template <class Item>
bool ConfigurationParser::in_brackets(Item item, std::string_view behind) {
  if (!in_.accept("(")) {
    return true;
  }
  do {
    if (!item()) {
      return false;
    }
  } while (in_.accept(","));
  return in_.expect(")", behind);
}

// Parses the items of the section whose word was consumed.
template <class Item>
void ConfigurationParser::up_to_end_var(std::string_view section, Item item) {
  const int line = in_.previous().line;
  while (!in_.at_end() && !in_.peek().is("END_VAR")) {
    const std::size_t from = in_.position();
    if (!item()) {
      recover();
    }
    if (in_.position() == from) {
      break;
    }
  }
  if (in_.expect("END_VAR", fmt::format("to close the {} of line {}", section, line))) {
    in_.accept(";");
  }
}

void ConfigurationParser::configuration(Project& to) {
  Configuration out;
  const int line = in_.previous().line;
  out.at = in_.here();
  if (!name(out.name, "the configuration")) {
    recover();
  }
  Resource direct;  // tasks and programs outside of any resource
  direct.at = out.at;
  while (!in_.at_end() && !TokenReader::is_end_word(in_.peek())) {
    if (in_.accept("VAR_CONFIG")) {
      configured(to.configured);
    } else if (in_.peek().is("VAR_ACCESS")) {
      accesses("", to.accesses);
    } else if (declarations_.at_variables()) {
      declarations_.variables(out.globals);
    } else if (in_.accept("RESOURCE")) {
      resource(out.resources);
    } else if (!resource_item(direct)) {
      recover();
    }
  }
  if (in_.expect("END_CONFIGURATION", fmt::format("to close the CONFIGURATION of line {}", line))) {
    in_.accept(";");
  }
  if (!direct.tasks.empty() || !direct.programs.empty()) {
    out.resources.push_back(std::move(direct));
  }
  to.configurations.push_back(std::move(out));
}

// RESOURCE name ON processor
void ConfigurationParser::resource(std::vector<Resource>& to) {
  Resource out;
  const int line = in_.previous().line;
  out.at = in_.here();
  std::string processor;
  const bool ok = name(out.name, "the resource") && (!in_.accept("ON") || name(processor, "the processor"));
  if (!ok) {
    recover();
  }
  while (!in_.at_end() && !TokenReader::is_end_word(in_.peek())) {
    if (declarations_.at_variables()) {
      declarations_.variables(out.globals);
    } else if (!resource_item(out)) {
      recover();
    }
  }
  if (in_.expect("END_RESOURCE", fmt::format("to close the RESOURCE of line {}", line))) {
    in_.accept(";");
  }
  to.push_back(std::move(out));
}

bool ConfigurationParser::resource_item(Resource& out) {
  if (in_.accept("TASK")) {
    return task(out);
  }
  if (in_.accept("PROGRAM")) {
    return program(out);
  }
  const Token& token = in_.take();
  in_.error(token, fmt::format("expected TASK, PROGRAM, RESOURCE, VAR_GLOBAL or VAR_ACCESS, found {}",
                               TokenReader::spelled(token)));
  return false;
}

// TASK name (INTERVAL := T#10ms, PRIORITY := 1);
bool ConfigurationParser::task(Resource& out) {
  Task one;
  const Token& at = in_.peek();
  one.at = in_.here();
  if (!name(one.name, "the task")) {
    return false;
  }
  if (!in_brackets([&] { return task_property(one); }, "after the task's properties")) {
    return false;
  }
  if (one.interval_ns == std::optional<std::int64_t>(0)) {
    if (one.single.empty()) {
      in_.error(at, "INTERVAL is 0 and SINGLE is not given, so this task never runs; write INTERVAL := T#10ms");
      one.interval_ns = kDefaultIntervalNs;
    } else {
      one.interval_ns.reset();
    }
  }
  out.tasks.push_back(std::move(one));
  return in_.expect(";", "after the task");
}

bool ConfigurationParser::task_property(Task& out) {
  const Token& word = in_.take();
  if (!in_.expect(":=", "after INTERVAL, PRIORITY or SINGLE")) {
    return false;
  }
  const Token& at = in_.peek();
  const auto value = expressions_.expression();
  if (!value) {
    return false;
  }
  const bool literal = value->kind == ast::Expression::Kind::Literal;
  const auto* time = literal ? std::get_if<std::int64_t>(&value->value) : nullptr;
  const auto* number = literal ? std::get_if<std::uint64_t>(&value->value) : nullptr;
  if (word.is("INTERVAL")) {
    const bool fine = time != nullptr && *time >= 0;
    out.interval_ns = fine ? *time : kDefaultIntervalNs;
    if (!fine) {
      in_.error(at, "INTERVAL is a time such as T#10ms");
    }
  } else if (word.is("PRIORITY")) {
    if (number != nullptr && *number <= std::numeric_limits<std::int32_t>::max()) {
      out.priority = static_cast<std::int32_t>(*number);
    } else {
      in_.error(at, "PRIORITY is a whole number from 0, the most urgent, such as 1");
    }
  } else if (word.is("SINGLE")) {
    if (value->kind == ast::Expression::Kind::Name || value->kind == ast::Expression::Kind::Direct) {
      out.single = value->kind == ast::Expression::Kind::Name ? value->name : ast::to_string(value->address);
    } else {
      in_.error(at, "SINGLE is a global variable or an address, at whose rising edge the task runs");
    }
  } else {
    in_.error(word, fmt::format("a task has no '{}', only INTERVAL, PRIORITY and SINGLE", word.text));
  }
  return true;
}

// PROGRAM name WITH task : type (...);
bool ConfigurationParser::program(Resource& out) {
  ProgramInstance one;
  while (in_.accept("RETAIN") || in_.accept("NON_RETAIN")) {
  }
  one.at = in_.here();
  if (!name(one.name, "the program's instance")) {
    return false;
  }
  if (in_.accept("WITH") && !name(one.task, "the task")) {
    return false;
  }
  if (!in_.expect(":", "before the program's type") || !name(one.type, "the program")) {
    return false;
  }
  if (!in_brackets([&] { return connection(one); }, "after the connections of the program")) {
    return false;
  }
  out.programs.push_back(std::move(one));
  return in_.expect(";", "after the program");
}

// input := variable or value, output => variable
bool ConfigurationParser::connection(ProgramInstance& out) {
  Connection one;
  one.at = in_.here();
  if (!name(one.parameter, "an input or output of the program")) {
    return false;
  }
  if (in_.peek().is("WITH")) {
    in_.error(in_.peek(),
              "a task of its own for a function block of a program is not supported, give the program to "
              "that task, or declare another program for the function block");
    return false;
  }
  one.output = in_.accept("=>");
  if (!one.output && !in_.expect(":=", "and a variable or value, or '=>' and a variable")) {
    return false;
  }
  auto value = path();
  if (!value) {
    return false;
  }
  one.value = std::move(*value);
  out.connections.push_back(std::move(one));
  return true;
}

std::optional<ast::Expression> ConfigurationParser::path() {
  while (in_.peek().kind == TokenKind::Word && in_.peek(1).is(".") && in_.peek(2).kind == TokenKind::Address) {
    in_.take();
    in_.take();
  }
  return expressions_.expression();
}

void ConfigurationParser::accesses(const std::string& program, std::vector<Access>& to) {
  in_.take();
  up_to_end_var("VAR_ACCESS", [&] {
    Access one;
    one.program = program;
    if (!access(one)) {
      return false;
    }
    to.push_back(std::move(one));
    return true;
  });
}

// pressure : plc.main.tank.pressure : REAL READ_WRITE;
bool ConfigurationParser::access(Access& out) {
  out.at = in_.here();
  if (!name(out.name, "the access path") || !in_.expect(":", "after the name, before the variable")) {
    return false;
  }
  auto to = path();
  if (!to) {
    return false;
  }
  out.to = std::move(*to);
  auto spec = in_.expect(":", "after the variable, before its type") ? declarations_.type() : std::nullopt;
  if (!spec) {
    return false;
  }
  out.type = std::move(*spec);
  out.writable = in_.accept("READ_WRITE");
  if (!out.writable) {
    in_.accept("READ_ONLY");
  }
  return in_.expect_end("after the access path");
}

void ConfigurationParser::configured(std::vector<Configured>& to) {
  up_to_end_var("VAR_CONFIG", [&] {
    Configured one;
    if (!configured(one)) {
      return false;
    }
    to.push_back(std::move(one));
    return true;
  });
}

// plc.main.motor.running AT %QX1.0 : BOOL := TRUE;
bool ConfigurationParser::configured(Configured& out) {
  out.at = in_.here();
  do {
    if (!in_.expect_name("a resource, program, instance or variable")) {
      return false;
    }
    out.path.emplace_back(in_.take().text);
  } while (in_.accept("."));
  ast::Variable place;
  if (in_.accept("AT") && !declarations_.address(place)) {
    return false;
  }
  out.address = place.address;
  auto spec = in_.expect(":", "after the name, before the type") ? declarations_.type() : std::nullopt;
  if (!spec) {
    return false;
  }
  out.type = std::move(*spec);
  if (in_.accept(":=")) {
    out.initial = expressions_.initial(out.type.kind == ast::TypeSpec::Kind::Array);
    if (!out.initial) {
      return false;
    }
  }
  return in_.expect_end("after the variable");
}

}  // namespace indurop::plc::st
