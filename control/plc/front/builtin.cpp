// SPDX-License-Identifier: Apache-2.0
#include "control/plc/front/builtin.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <iterator>
#include <memory>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "control/plc/library/hidden.h"
#include "control/plc/model/elementary.h"
#include "control/plc/model/make.h"
#include "control/plc/model/walk.h"
#include "control/plc/st/parser.h"

namespace indurop::plc {
namespace {

// HMI_NODE marks a place in the tree of SVGHMI pictures.
constexpr std::array<std::string_view, 11> kHmiTypes{"SINT",  "INT",   "DINT", "LINT",   "USINT", "UINT",
                                                     "UDINT", "ULINT", "REAL", "STRING", "BOOL"};

constexpr std::string_view kLevels = "TYPE LOGLEVEL : (CRITICAL, WARNING, INFO, DEBUG) := INFO; END_TYPE\n";
constexpr std::string_view kLogger = R"(FUNCTION_BLOCK LOGGER
VAR_INPUT TRIG : BOOL; MSG : STRING; LEVEL : LOGLEVEL := INFO; END_VAR
VAR before : BOOL; END_VAR
END_FUNCTION_BLOCK
)";

// Functions of Table 36 of the standard with several outputs, written in the language.
struct Split {
  std::string_view name;
  std::string_view text;  // text after FUNCTION and the name
};
constexpr std::string_view kSplitDay = R"( VAR_OUTPUT YEAR, MONTH, DAY : INT; END_VAR
VAR text_ : STRING[20]; END_VAR
text_ := DATE_TO_STRING(IN);
YEAR := STRING_TO_INT(MID(text_, 4, 3));
MONTH := STRING_TO_INT(MID(text_, 2, 8));
DAY := STRING_TO_INT(MID(text_, 2, 11));
END_FUNCTION
)";
constexpr std::string_view kSplitTime = R"( VAR_OUTPUT HOUR, MINUTE, SECOND, MILLISECOND : INT; END_VAR
VAR rest_ : DINT; END_VAR
rest_ := TOD_TO_DINT(IN);
HOUR := DINT_TO_INT(rest_ / 3600000);
MINUTE := DINT_TO_INT(rest_ / 60000 MOD 60);
SECOND := DINT_TO_INT(rest_ / 1000 MOD 60);
MILLISECOND := DINT_TO_INT(rest_ MOD 1000);
END_FUNCTION
)";
constexpr std::string_view kSplitBoth =
    R"( VAR_OUTPUT YEAR, MONTH, DAY, HOUR, MINUTE, SECOND, MILLISECOND : INT; END_VAR
VAR text_ : STRING[20]; rest_ : DINT; END_VAR
text_ := DATE_TO_STRING(DT_TO_DATE(IN));
YEAR := STRING_TO_INT(MID(text_, 4, 3));
MONTH := STRING_TO_INT(MID(text_, 2, 8));
DAY := STRING_TO_INT(MID(text_, 2, 11));
rest_ := TOD_TO_DINT(DT_TO_TOD(IN));
HOUR := DINT_TO_INT(rest_ / 3600000);
MINUTE := DINT_TO_INT(rest_ / 60000 MOD 60);
SECOND := DINT_TO_INT(rest_ / 1000 MOD 60);
MILLISECOND := DINT_TO_INT(rest_ MOD 1000);
END_FUNCTION
)";
constexpr std::array<Split, 6> kSplits{{{"DATE", kSplitDay},
                                        {"LDATE", kSplitDay},
                                        {"TOD", kSplitTime},
                                        {"LTOD", kSplitTime},
                                        {"DT", kSplitBoth},
                                        {"LDT", kSplitBoth}}};

// ADSLOGSTR of TwinCAT: writes a line to the log of the module. The last function it calls has no name in the language.
constexpr std::string_view kAdsLog = R"(FUNCTION ADSLOGSTR : DINT
VAR_INPUT msgCtrlMask : DWORD; msgFmtStr, strArg : STRING[255]; END_VAR
VAR at_, level_ : INT; text_ : STRING[255]; END_VAR
text_ := msgFmtStr;
at_ := FIND(text_, '%s');
IF at_ > 0 THEN text_ := REPLACE(text_, strArg, 2, at_); END_IF;
level_ := SEL(msgCtrlMask.2, SEL(msgCtrlMask.1, 2, 1), 0);
ADSLOGSTR := 0;
END_FUNCTION
)";
struct LogType {
  std::string_view name;
  int value;
};
constexpr std::array<LogType, 6> kAdsLogTypes{
    {{"HINT", 1}, {"WARN", 2}, {"ERROR", 4}, {"LOG", 16}, {"MSGBOX", 32}, {"STRING", 128}}};

std::set<std::string> called_functions(Project& project) {
  std::set<std::string> names;
  const ast::Visit note = [&](ast::Expression& one) {
    if (one.kind == ast::Expression::Kind::Call && one.operands[0].kind == ast::Expression::Kind::Name) {
      names.insert(upper(one.operands[0].name));
    }
  };
  for (ast::Pou& pou : project.pous) {
    ast::each_expression(pou.body, note);
    for (ast::Pou& method : pou.methods) {
      ast::each_expression(method.body, note);
    }
  }
  return names;
}

void use(const ast::TypeSpec& type, std::set<std::string>& names) {
  if (type.kind == ast::TypeSpec::Kind::Named) {
    names.insert(upper(type.name));
  }
  if (type.element) {
    use(*type.element, names);
  }
  for (const ast::Variable& field : type.fields) {
    use(field.type, names);
  }
}

void use(const std::vector<ast::Variable>& variables, std::set<std::string>& names) {
  for (const ast::Variable& one : variables) {
    use(one.type, names);
  }
}

std::set<std::string> used_types(const Project& project) {
  std::set<std::string> names;
  use(project.globals, names);
  for (const Configuration& configuration : project.configurations) {
    use(configuration.globals, names);
    for (const Resource& resource : configuration.resources) {
      use(resource.globals, names);
    }
  }
  for (const ast::TypeDeclaration& one : project.types) {
    use(one.type, names);
  }
  for (const ast::Pou& pou : project.pous) {
    use(pou.variables, names);
    for (const ast::Pou& method : pou.methods) {
      use(method.variables, names);
    }
  }
  return names;
}

bool declares(const Project& project, std::string_view name) {
  const auto same = [&](const auto& one) { return same_name(one.name, name); };
  return std::any_of(project.types.begin(), project.types.end(), same) ||
         std::any_of(project.pous.begin(), project.pous.end(), same);
}

Project parsed(std::string_view text, const char* whose) {
  Place at;
  at.within = std::make_shared<const std::string>(whose);
  Diagnostics quiet;
  std::vector<st::WrittenBody> others;
  return st::parse_project({text, at}, others, quiet);
}

// Makes IF TRIG AND NOT before THEN write the line; END_IF; before := TRIG;
ast::Body logger_body(const Place& at) {
  std::vector<ast::Argument> values;
  std::vector<ast::Argument> level;
  level.push_back(make::argument("", make::name(at, "LEVEL")));
  values.push_back(make::argument("", make::call(at, make::name(at, "LOGLEVEL_TO_INT"), std::move(level))));
  values.push_back(make::argument("", make::name(at, "MSG")));
  ast::Body write;
  write.push_back(make::call_statement(make::call(at, make::name(at, std::string(kLogMessage)), std::move(values))));
  ast::Body out;
  out.push_back(
      make::when(make::both(make::name(at, "TRIG"), make::negation(make::name(at, "before"))), std::move(write)));
  out.push_back(make::assign(make::name(at, "before"), make::name(at, "TRIG")));
  return out;
}

}  // namespace

namespace {

void add_ads_log(Project& project) {
  std::string text(kAdsLog);
  for (const LogType& one : kAdsLogTypes) {
    const std::string name = fmt::format("ADSLOG_MSGTYPE_{}", one.name);
    const bool known = std::any_of(project.globals.begin(), project.globals.end(),
                                   [&](const ast::Variable& each) { return same_name(each.name, name); });
    text += known ? "" : fmt::format("VAR_GLOBAL CONSTANT {} : DWORD := {}; END_VAR\n", name, one.value);
  }
  Project made = parsed(text, "the library Tc2_System");
  ast::Pou& pou = made.pous.front();
  std::vector<ast::Argument> values;
  values.push_back(make::argument("", make::name(pou.at, "level_")));
  values.push_back(make::argument("", make::name(pou.at, "text_")));
  pou.body.push_back(
      make::call_statement(make::call(pou.at, make::name(pou.at, std::string(kLogMessage)), std::move(values))));
  append(project, std::move(made));
}

void add_functions(Project& project) {
  const std::set<std::string> called = called_functions(project);
  if (called.contains("ADSLOGSTR") && !declares(project, "ADSLOGSTR")) {
    add_ads_log(project);
  }
  std::string text;
  for (const Split& one : kSplits) {
    const std::string name = fmt::format("SPLIT_{}", one.name);
    if (called.contains(name) && !declares(project, name)) {
      text += fmt::format("FUNCTION {} VAR_INPUT IN : {}; END_VAR{}", name, one.name, one.text);
    }
  }
  if (!text.empty()) {
    append(project, parsed(text, "the library of the standard"));
  }
}

}  // namespace

void add_builtin(Project& project) {
  add_functions(project);
  const std::set<std::string> names = used_types(project);
  const auto misses = [&](const std::string& name) { return names.contains(name) && !declares(project, name); };
  std::string text;
  for (const std::string_view type : kHmiTypes) {
    if (misses(fmt::format("HMI_{}", type))) {
      text += fmt::format("TYPE HMI_{0} : {0}; END_TYPE\n", type);
    }
  }
  if (misses("HMI_NODE")) {
    text += "TYPE HMI_NODE : BOOL; END_TYPE\n";
  }
  const bool logger = misses("LOGGER");
  if ((logger && !declares(project, "LOGLEVEL")) || misses("LOGLEVEL")) {
    text += kLevels;
  }
  text += logger ? kLogger : "";
  if (text.empty()) {
    return;
  }
  Project made = parsed(text, "what Beremiz brings along");
  for (ast::Pou& pou : made.pous) {
    pou.body = logger_body(pou.at);
  }
  append(project, std::move(made));
}

}  // namespace indurop::plc
