// SPDX-License-Identifier: Apache-2.0
#include "control/robot/job/parser.h"

#include <algorithm>
#include <iterator>

namespace indurop::robot {

namespace {

constexpr std::size_t kMostSteps = 20000;
constexpr const char* kStatements =
    "POINT, FRAME, TOOL, LOAD, BODY, KEEPOUT, PARAM, VAR, SPEED, ACC, ZONE, MOVJ, MOVL, MOVC, MOVS, MOVE FREE TO, "
    "SEARCH, "
    "WEAVE, "
    "CORRECT, PRESS, TRACK, PUSH, FOLLOW, SET, PULSE, WAIT, ASK, CALL, ON, OFF, RETURN, RAISE, MESSAGE, LABEL, GOTO, "
    "IF, "
    "ELSEIF, "
    "ELSE, "
    "WHILE, "
    "FOR, LOOP, EXIT, SWITCH, CASE, DEFAULT, TRY, RECOVER and END";

}  // namespace

JobParser::JobParser(JobBook& book, base::Diagnostics& errors, const ArmShape& shape)
    : line_(errors),
      draft_(book, line_),
      names_(line_, draft_),
      expressions_(line_, draft_),
      place_formulas_(line_, draft_, names_, expressions_),
      places_({line_, draft_, names_, expressions_}, shape),
      tools_({line_, draft_, names_, expressions_}),
      bodies_({line_, draft_, names_, expressions_}),
      motions_({line_, draft_, names_, expressions_}, shape),
      each_period_({line_, draft_, names_, expressions_}),
      weaving_({line_, draft_, names_, expressions_}),
      pushing_({line_, draft_, names_, expressions_}, shape),
      flow_({line_, draft_, names_, expressions_}),
      values_({line_, draft_, names_, expressions_}, flow_, place_formulas_),
      blocks_({line_, draft_, names_, expressions_}) {}

void JobParser::begin(const JobFile& file) {
  draft_.begin(file);
  names_.begin_job();
  blocks_.begin();
  line_.begin(file.path);
}

void JobParser::read_line(std::string_view text) {
  line_.next(text);
  if (!line_.at_end()) {
    statement();
  }
}

void JobParser::end() {
  line_.next({});
  if (draft_.next() > kMostSteps) {
    line_.error({}, "more than " + std::to_string(kMostSteps) + " steps; split the job and use CALL");
  }
  blocks_.end();
}

void JobParser::read(const JobFile& file) {
  begin(file);
  for (JobLines lines(file.text); !lines.at_end() && draft_.next() <= kMostSteps;) {
    read_line(lines.take());
  }
  end();
}

// Long: one line for each statement.
void JobParser::statement() {
  struct Known {
    const char* word;
    void (*parse)(JobParser&);
  };
  static constexpr Known kKnown[] = {
      {"POINT", [](JobParser& p) { p.places_.point(); }},
      {"FRAME", [](JobParser& p) { p.places_.frame(); }},
      {"TOOL", [](JobParser& p) { p.tools_.tool(); }},
      {"LOAD", [](JobParser& p) { p.tools_.load(); }},
      {"BODY", [](JobParser& p) { p.bodies_.body(); }},
      {"KEEPOUT", [](JobParser& p) { p.bodies_.keepout(); }},
      {"SPEED", [](JobParser& p) { p.motions_.speed(); }},
      {"ZONE", [](JobParser& p) { p.motions_.zone(); }},
      {"ACC", [](JobParser& p) { p.motions_.acceleration(); }},
      {"MOVJ", [](JobParser& p) { p.motions_.move(Move::Joint); }},
      {"MOVL", [](JobParser& p) { p.motions_.move(Move::Line); }},
      {"MOVC", [](JobParser& p) { p.motions_.move(Move::Circle); }},
      {"MOVS", [](JobParser& p) { p.motions_.spline(); }},
      {"MOVE", [](JobParser& p) { p.motions_.free(); }},
      {"SEARCH", [](JobParser& p) { p.motions_.search(); }},
      {"WEAVE", [](JobParser& p) { p.weaving_.weave(); }},
      {"CORRECT", [](JobParser& p) { p.each_period_.correct(); }},
      {"PRESS", [](JobParser& p) { p.each_period_.press(); }},
      {"FOLLOW", [](JobParser& p) { p.each_period_.follow(); }},
      {"TRACK", [](JobParser& p) { p.each_period_.track(); }},
      {"PUSH", [](JobParser& p) { p.pushing_.push(); }},
      {"SET", [](JobParser& p) { p.values_.set(); }},
      {"PULSE", [](JobParser& p) { p.values_.pulse(); }},
      {"WAIT",
       [](JobParser& p) {
         p.flow_.wait();
         p.blocks_.timeout_else();
       }},
      {"ASK",
       [](JobParser& p) {
         p.flow_.ask();
         p.blocks_.timeout_else();
       }},
      {"CALL", [](JobParser& p) { p.flow_.call(); }},
      {"ON", [](JobParser& p) { p.flow_.arm(); }},
      {"OFF", [](JobParser& p) { p.flow_.disarm(); }},
      {"LABEL", [](JobParser& p) { p.flow_.label(); }},
      {"GOTO", [](JobParser& p) { p.flow_.jump(); }},
      {"IF", [](JobParser& p) { p.blocks_.if_goto(); }},
      {"LOOP", [](JobParser& p) { p.blocks_.loop(); }},
      {"END", [](JobParser& p) { p.blocks_.end_block(); }},
      {"VAR", [](JobParser& p) { p.values_.variable(); }},
      {"PARAM", [](JobParser& p) { p.values_.parameters(); }},
      {"RETURN", [](JobParser& p) { p.flow_.leave(); }},
      {"RAISE", [](JobParser& p) { p.flow_.raise(); }},
      {"MESSAGE", [](JobParser& p) { p.flow_.message(); }},
      {"ELSE", [](JobParser& p) { p.blocks_.otherwise(false); }},
      {"ELSEIF", [](JobParser& p) { p.blocks_.otherwise(true); }},
      {"WHILE", [](JobParser& p) { p.blocks_.while_block(); }},
      {"FOR", [](JobParser& p) { p.blocks_.for_block(); }},
      {"EXIT", [](JobParser& p) { p.blocks_.exit(); }},
      {"SWITCH", [](JobParser& p) { p.blocks_.switch_block(); }},
      {"CASE", [](JobParser& p) { p.blocks_.case_of(); }},
      {"DEFAULT", [](JobParser& p) { p.blocks_.case_default(); }},
      {"TRY", [](JobParser& p) { p.blocks_.try_block(); }},
      {"RECOVER", [](JobParser& p) { p.blocks_.recover(); }},
  };
  const auto* const known =
      std::find_if(std::begin(kKnown), std::end(kKnown), [this](const Known& each) { return line_.accept(each.word); });
  if (known != std::end(kKnown)) {
    known->parse(*this);
  } else if (line_.peek().kind == JobToken::Kind::Word && (line_.after().text == "=" || line_.after().text == "[")) {
    values_.assign();
  } else {
    line_.error(line_.peek(), "unknown statement " + JobLine::shown(line_.peek()) + "; known are " + kStatements);
  }
  if (!line_.failed()) {
    line_.expect_end();
  }
}

}  // namespace indurop::robot
