// SPDX-License-Identifier: Apache-2.0
#include "tools/cli/robot/teaching.h"

#include <fmt/format.h>

#include "tools/client/node/node_choice.h"
#include "tools/console/diagnostics.h"

namespace indurop::tools {

int show_points(Context& context, const RobotChoice& choice) {
  const auto files = files_of_node(context.node, choice, false);
  if (!files) {
    return report(context.out, files.error());
  }
  const robot::ListedPoints listed = robot::list_points(files->names);
  if (!listed.errors.empty()) {
    print_diagnostics(context, listed.errors, false);
    return kCheckFailed;
  }
  Table table({{"POINT", "point"}, {"PLACE", "place"}, {"FILE", "file"}, {"LINE", "line", Align::Right}});
  for (const robot::ListedPoint& one : listed.points) {
    table.add(
        {Cell(one.name), Cell(one.place), Cell(one.file), Cell(fmt::format("{}", one.line), JsonValue(one.line))});
  }
  if (table.empty() && context.format == Format::Table) {
    context.out.note(fmt::format("the files of {} have no points", files->module));
  }
  print_table(context, table, {{"module", files->module}}, "points");
  return kOk;
}

int place_to_write(Context& context, const RobotChoice& choice, RobotPlace& to) {
  const auto store = open_store(context, vars::Mode::ReadOnly);
  if (!store) {
    return report(context.out, store.error());
  }
  auto place = read_place(*store, choice.space);
  if (!place) {
    context.out.error(place.error().text);
    return kFailed;
  }
  if (place->moves) {
    context.out.error("the robot moves: teach at standstill");
    return kFailed;
  }
  to = std::move(place).value();
  return kOk;
}

int teach_point(Context& context, const RobotChoice& choice, const robot::TeachOrder& order) {
  const auto files = files_of_node(context.node, choice, true);
  if (!files) {
    return report(context.out, files.error());
  }
  RobotPlace place;
  if (const int code = place_to_write(context, choice, place); code != kOk) {
    return code;
  }
  const robot::TaughtPoint taught = robot::teach_point(files->names, order, place.stand);
  if (!taught.errors.empty() || !taught.problem.empty()) {
    print_diagnostics(context, taught.errors, false);
    if (!taught.problem.empty()) {
      context.out.error(taught.problem);
    }
    return taught.errors.empty() ? kFailed : kCheckFailed;
  }
  const robot::ListedPoint& now = taught.now;
  context.out.note(fmt::format("{}:{}: POINT {} = {}", now.file, now.line, now.name, now.place));
  const bool by_tool = now.place.starts_with("POSE") && !place.tool.empty();
  context.out.note(fmt::format("{}{}the robot knows it after it has read its files again: indurop robot reload",
                               taught.before.empty() ? "" : "it was " + taught.before + "; ",
                               by_tool ? "the tip is that of tool " + place.tool + "; " : ""));
  return kOk;
}

}  // namespace indurop::tools
