// SPDX-License-Identifier: Apache-2.0
#include "control/robot/job/tools.h"

#include <string>
#include <utility>

namespace indurop::robot {

// Parses "TOOL pen", "TOOL pen = POSE 0 0 120 RPY 0 0 0", "TOOL pen = POINTS A B C D", "TOOL grip = POSE ... MASS 2.5
// kg CENTRE 0 0 60"
void ToolReader::tool() {
  const JobToken name = line_.take();
  if (name.kind != JobToken::Kind::Word) {
    line_.error(name, "expected the name of a tool, found " + JobLine::shown(name));
    return;
  }
  if (!line_.accept("=")) {
    draft_.add(Op::Tool);
    names_.refer(JobNames::To::Tool, name);
    return;
  }
  Tool tool;
  tool.name = name.text;
  tool.file = line_.file();
  tool.place = line_.place(name);
  if (tools_.contains(tool.name)) {
    line_.error(name, "there is already a tool " + in_quotes(name.text));
    return;
  }
  if (line_.accept("POSE")) {
    line_.pose(tool.tip);
  } else if (line_.accept("POINTS")) {
    taught_tool(tool);
  } else {
    line_.error(line_.peek(), "expected POSE or POINTS, found " + JobLine::shown(line_.peek()) + "; TOOL " + tool.name +
                                  " = POSE 0 0 120 RPY 0 0 0, or = POINTS A B C D");
  }
  if (!line_.failed() && line_.accept("MASS")) {
    mass(tool.body);
  }
  if (!line_.failed()) {
    tools_.insert(tool.name);
    draft_.book().tools.push_back(std::move(tool));
  }
}

// Parses points at which its tip touches the same place; its orientation cannot be taught, only given.
void ToolReader::taught_tool(Tool& tool) {
  tool.is_taught = true;
  const JobToken first = line_.peek();
  std::size_t count = 0;
  for (; line_.peek().kind == JobToken::Kind::Word && !same_word(line_.peek().text, "RPY") &&
         !same_word(line_.peek().text, "MASS");
       ++count) {
    const JobToken point = line_.take();
    line_.accept(",");
    names_.declare(JobNames::In::ToolPoint, draft_.book().tools.size(), point);
  }
  constexpr std::size_t kLeastPoints = 3;
  constexpr std::size_t kMaxPoints = 32;
  if (count < kLeastPoints || count > kMaxPoints) {
    line_.error(first,
                "a tool is taught by 3 points or more, 32 at most, at which its tip touches the same place, turned "
                "otherwise each time; here are " +
                    std::to_string(count));
  } else if (line_.accept("RPY")) {
    line_.rpy(tool.tip.orientation);
  }
  if (line_.failed()) {
    names_.drop(JobNames::In::ToolPoint, count);
  }
}

// Parses "2.5 kg CENTRE 0 0 60", "2.5 kg CENTRE 0 0 60 INERTIA 0.01 0.01 0.02 0 0 0"
void ToolReader::mass(Body& body) {
  const JobToken number = line_.peek();
  if (!line_.numbers(1, &body.mass, "a mass, 2.5 kg")) {
    return;
  }
  if (!(body.mass > 0)) {
    line_.error(number, "a mass is above 0 kg; LOAD 0 says that nothing is held");
    return;
  }
  if (!line_.accept("kg")) {
    line_.error(line_.peek(), "expected kg, found " + JobLine::shown(line_.peek()));
    return;
  }
  if (!line_.accept("CENTRE")) {
    line_.error(line_.peek(), "expected CENTRE and x y z of the centre of mass in mm, seen from the arm's end; found " +
                                  JobLine::shown(line_.peek()));
    return;
  }
  double centre[3];
  if (!line_.numbers(3, centre, "x y z of the centre of mass in mm")) {
    return;
  }
  body.centre = Vec3(centre[0], centre[1], centre[2]) / 1000;
  const JobToken inertia = line_.peek();
  double i[6];
  if (!line_.accept("INERTIA") ||
      !line_.numbers(6, i, "xx yy zz xy xz yz of the inertia about the centre of mass in kg m^2")) {
    return;
  }
  body.inertia << i[0], i[3], i[4], i[3], i[1], i[5], i[4], i[5], i[2];
  if (const std::string wrong = wrong_inertia(body.inertia); !wrong.empty()) {
    line_.error(inertia, wrong);
  }
}

// Parses "LOAD 2.5 kg CENTRE 0 0 60", "LOAD 0"
void ToolReader::load() {
  draft_.add(Op::Load).index = 0;
  if (line_.peek().kind == JobToken::Kind::Number && line_.peek().value == 0) {
    line_.take();
    line_.accept("kg");
    return;
  }
  Body body;
  mass(body);
  if (!line_.failed()) {
    draft_.last().index = static_cast<int>(draft_.book().loads.size());
    draft_.book().loads.push_back(body);
  }
}

}  // namespace indurop::robot
