// SPDX-License-Identifier: Apache-2.0
#include "tools/cli/robot/calibrating.h"

#include <fmt/format.h>

#include "tools/cli/robot/teaching.h"
#include "tools/console/diagnostics.h"

namespace indurop::tools {
namespace {

using robot::Calibration;
using robot::CalibrationKind;

Cell millimetres(double value) {
  return {fmt::format("{:.3f}", value), JsonValue(value)};
}

// What the numbers of a result mean, on standard error.
void explain(Context& context, const Calibration& now) {
  const auto& [x, y, z] = now.place_deviation;
  const auto& [roll, pitch, yaw] = now.turn_deviation;
  if (!now.points.empty() && now.worst > 0) {
    context.out.note(
        fmt::format("what remains: {:.3f} mm rms, {:.3f} mm at most (point {})", now.rms, now.most, now.worst));
  }
  if (!now.wrong.empty()) {
    context.out.note("no result: " + now.wrong);
    return;
  }
  if (now.spare == 0) {
    context.out.note("these are just enough points, so nothing shows how exact they are: take more");
  } else {
    context.out.note(fmt::format("standard deviation: {:.3f} {:.3f} {:.3f} mm{}", x, y, z,
                                 now.turned ? fmt::format(", {:.3f} {:.3f} {:.3f} deg about its axes", roll, pitch, yaw)
                                            : std::string(", orientation not calibrated")));
  }
  constexpr double kMostScale = 0.01;
  if (now.scale < 1 - kMostScale || now.scale > 1 + kMostScale) {
    context.out.note(
        fmt::format("warning: what was touched is {:.4f} times as large as what the camera saw: its scale "
                    "is wrong",
                    now.scale));
  }
}

void print_calibration(Context& context, const Calibration& now, bool camera) {
  std::vector<Column> columns{{"POINT", "point", Align::Right}, {"MARK", "mark"}};
  if (camera) {
    columns.push_back({"SEEN", "seen"});
  }
  columns.push_back({"PLACE", "place"});
  columns.push_back({"OFF MM", "off", Align::Right});
  Table table(columns);
  for (std::size_t i = 0; i < now.points.size(); ++i) {
    const robot::CalibrationPoint& one = now.points[i];
    std::vector<Cell> cells{Cell(std::to_string(i + 1), JsonValue(i + 1)), Cell(one.mark)};
    if (camera) {
      cells.emplace_back(one.seen);
    }
    cells.emplace_back(one.place);
    cells.push_back(one.off ? millimetres(*one.off) : Cell("-", JsonValue()));
    table.add(cells);
  }
  print_table(context, table,
              {{"declaration", now.declaration},
               {"wrong", now.wrong},
               {"next", now.next},
               {"rms", now.rms},
               {"most", now.most},
               {"worst", now.worst},
               {"sigma", now.sigma},
               {"spare", now.spare},
               {"dx", now.place_deviation[0]},
               {"dy", now.place_deviation[1]},
               {"dz", now.place_deviation[2]},
               {"droll", now.turn_deviation[0]},
               {"dpitch", now.turn_deviation[1]},
               {"dyaw", now.turn_deviation[2]},
               {"scale", now.scale}},
              "points");
}

int act_on(Context& context, const RobotChoice& choice, const robot::FileNames& names,
           const robot::CalibrationOrder& order, CalibrationAct& act, Calibration& now) {
  if (act.take) {
    RobotPlace place;
    if (const int code = place_to_write(context, choice, place); code != kOk) {
      return code;
    }
    act.taken.tool = place.tool;
    now = robot::take_point(names, order, act.taken, place.stand);
  } else if (act.drop || act.drop_all) {
    now = robot::drop_point(names, order, static_cast<std::size_t>(act.drop.value_or(0)));
  } else if (act.accept) {
    now = robot::accept_calibration(names, order);
  } else {
    now = robot::show_calibration(names, order);
  }
  return kOk;
}

}  // namespace

int calibrate(Context& context, const RobotChoice& choice, const robot::CalibrationOrder& order, CalibrationAct act) {
  if (act.take + act.accept + act.drop_all + act.drop.has_value() > 1) {
    context.out.error("--take, --drop, --drop-all and --accept are used one at a time");
    return kUsage;
  }
  const bool alone = !choice.config.empty() && !act.take;
  const auto files = alone ? files_of_config(choice) : files_of_node(context.node, choice, act.take || act.accept);
  if (!files) {
    return report(context.out, files.error());
  }
  Calibration now;
  if (const int code = act_on(context, choice, files->names, order, act, now); code != kOk) {
    return code;
  }
  if (!now.errors.empty() || !now.problem.empty()) {
    print_diagnostics(context, now.errors, false);
    if (!now.problem.empty()) {
      context.out.error(now.problem);
    }
    return now.errors.empty() ? kFailed : kCheckFailed;
  }
  const bool camera = order.kind == CalibrationKind::Camera || order.kind == CalibrationKind::HandCamera;
  print_calibration(context, now, camera);
  if (context.format == Format::Table) {
    explain(context, now);
  }
  if (act.accept) {
    context.out.note(fmt::format("{}:{}: {}", now.file, now.line, now.declaration));
    context.out.note((now.before.empty() ? std::string() : "it was " + now.before + "; ") +
                     "the robot uses it after it has read its files again: indurop robot reload");
  } else {
    context.out.note(!now.next.empty() ? "next: " + now.next
                     : now.wrong.empty()
                         ? fmt::format("result: {}; declare it with --accept, or take more points", now.declaration)
                         : std::string("take more points, or drop wrong ones"));
  }
  return kOk;
}

}  // namespace indurop::tools
