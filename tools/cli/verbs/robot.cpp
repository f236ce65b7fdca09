// SPDX-License-Identifier: Apache-2.0
// indurop robot: shows and teaches points, jogs the robot, and answers the questions of its jobs.
#include <sstream>

#include "core/base/word_values.h"
#include "tools/cli/robot/calibrating.h"
#include "tools/cli/robot/formatting.h"
#include "tools/cli/robot/guiding.h"
#include "tools/cli/robot/hand.h"
#include "tools/cli/robot/identifying.h"
#include "tools/cli/robot/jobs.h"
#include "tools/cli/robot/questions.h"
#include "tools/cli/robot/reload.h"
#include "tools/cli/robot/teaching.h"
#include "tools/cli/verbs/verbs.h"
#include "tools/client/node/node_choice.h"

namespace indurop::tools {
namespace {

// Parses "10,20.5"; returns what is wrong, else an empty string.
std::string numbers_in(const std::string& text, std::vector<double>& to) {
  std::istringstream all(text);
  to.clear();
  for (std::string word; std::getline(all, word, ',');) {
    const auto number = base::number_in(word);
    if (!number) {
      return "'" + word + "' is not a number; write x,y or x,y,z, or x,y,z,roll,pitch,yaw";
    }
    to.push_back(*number);
  }
  return {};
}

struct RobotOptions {
  RobotChoice choice;
  robot::TeachOrder order;
  robot::CalibrationOrder calibration;
  CalibrationAct act;
  std::string kind;
  Hand hand{"", "base"};
  GuideOrder guide;
  RobotAnswer answer;
  FormatOrder format;
  std::string recording;
  std::int64_t wait_ns = 0;
  std::function<int(Context&)> chosen;
};

void add_choice(base::Options& app, Context& context, RobotOptions& options) {
  app.add("--space", "NAMESPACE", options.choice.space, "Namespace of the robot's variables (default: PLC_ROBOT)");
  add_node_option(app, context);
}

void add_files(base::Options& app, RobotOptions& options) {
  app.add("--module", "NAME", options.choice.module, "The robot, if the node has several");
  app.add("--config", "FILE", options.choice.config,
          "module.xml or plant.xml that names the files (default: what the node runs)")
      .completes(base::Completion::File);
}

void declare_points(base::Options& app, Context& context, RobotOptions& options) {
  base::Options& points = app.command("points", "Show the points in the robot's files", [&options] {
    options.chosen = [&options](Context& c) { return show_points(c, options.choice); };
  });
  add_choice(points, context, options);
  add_files(points, options);
  add_format_option(points, context, {Format::Table, Format::Json, Format::Csv});
}

void declare_teach(base::Options& app, Context& context, RobotOptions& options) {
  base::Options& teach = app.command("teach", "Write the robot's position into its files as a point", [&options] {
    options.chosen = [&options](Context& c) { return teach_point(c, options.choice, options.order); };
  });
  robot::TeachOrder& order = options.order;
  teach.add("point", "NAME", order.point, "Name of the point; a new point goes to the file with the most points")
      .required();
  teach.flag("--joint", order.as_joint,
             "Write it as joint angles (the default for a new point), whatever it was before");
  teach.flag("--pose", order.as_pose, "Write it as the pose of the current tool's tip, whatever it was before");
  teach.add("--in", "FRAME", order.frame, "Write it as a pose in this work frame");
  teach.add("--file", "FILE", order.file, "File of a new point").completes(base::Completion::File);
  add_choice(teach, context, options);
  add_files(teach, options);
}

void declare_reload(base::Options& app, Context& context, RobotOptions& options) {
  base::Options& command =
      app.command("reload", "Read jobs and points again; the robot must be at standstill",
                  [&options] { options.chosen = [&options](Context& c) { return reload_jobs(c, options.choice); }; });
  add_choice(command, context, options);
}

void declare_jog(base::Options& app, Context& context, RobotOptions& options) {
  base::Options& command = app.command("jog", "Jog the robot as long as the command runs", [&options] {
    options.chosen = [&options](Context& c) { return jog(c, options.choice, options.hand); };
  });
  Hand& hand = options.hand;
  command
      .add("direction", "AXIS+|AXIS-", hand.direction,
           "Joint J1+ to J8-, or direction of the tip: x+ y+ z+ rx+ ry+ rz+, or with -")
      .required();
  command.add("--frame", "base|tool|world|FRAME", hand.frame,
              "Frame of the directions x to rz; a work frame by its name (default: base)");
  command.add("--speed", "PERCENT", hand.percent, "Percentage of the maximum speed for jogging, 250 mm/s (default: 10)")
      .range(0.1, 100);
  add_time_option(command, "--for", hand.for_ns, "Stop after this time (default: Ctrl-C)");
  add_choice(command, context, options);
  add_remote_options(command, context);
}

void declare_guide(base::Options& app, Context& context, RobotOptions& options) {
  base::Options& command = app.command("guide", "Let a hand move the robot, and write a job of its path", [&options] {
    options.chosen = [&options](Context& c) { return guide(c, options.choice, options.guide); };
  });
  robot::PathOrder& path = options.guide.path;
  command.add("job", "JOB", path.job, "Name of the job to write (default: nothing is recorded)");
  command.add("--file", "FILE", path.file, "Its file (default: JOB.job next to the robot's other jobs)")
      .completes(base::Completion::File);
  command.add("--within", "MM", path.tolerance, "How far the job may deviate from the path (default: 1)")
      .range(0.05, 100);
  command.add("--turned", "DEG", path.turn_tolerance, "How far the tool may be turned from it (default: 1)")
      .range(0.05, 45);
  command.add("--speed", "MM/S", path.speed, "Speed of the job's lines and splines (default: 100)").range(0.1, 10000);
  add_time_option(command, "--for", options.guide.for_ns, "Stop after this time (default: Ctrl-C)");
  add_choice(command, context, options);
  add_files(command, options);
}

void declare_identify(base::Options& app, Context& context, RobotOptions& options) {
  base::Options& command =
      app.command("identify", "Find mass and centre of what the arm holds, and friction, from a recording", [&options] {
        options.chosen = [&options](Context& c) { return identify_load(c, options.choice, options.recording); };
      });
  command.add("recording", "FILE", options.recording, "Recording of AXIS_STATE, with torques, while all axes move")
      .required()
      .completes(base::Completion::File);
  add_choice(command, context, options);
  add_files(command, options);
  add_format_option(command, context, {Format::Table, Format::Json, Format::Csv});
}

void declare_calibrate(base::Options& app, Context& context, RobotOptions& options) {
  base::Options& command =
      app.command("calibrate", "Find a tool, a frame or a camera from what the robot touches", [&options] {
        options.chosen = [&options](Context& c) {
          options.calibration.kind = *robot::calibration_kind(options.kind);
          return calibrate(c, options.choice, options.calibration, options.act);
        };
      });
  CalibrationAct& act = options.act;
  command.add("kind", "tool|frame|camera|hand-camera", options.kind, "What to calibrate; hand-camera: one on the arm")
      .required()
      .choices({"tool", "frame", "camera", "hand-camera"});
  command
      .add("name", "NAME", options.calibration.name,
           "Name of the tool or frame; a camera is a frame, on the arm a tool")
      .required();
  command.flag("--take", act.take, "Add the current position of the robot to the points");
  command.add("--mark", "MARK", act.taken.mark,
              "What it touches: TIP, X, XZ; ORIGIN, X, XY; SEEN (default: what is missing)");
  command.add(
      "--seen", "X,Y[,Z[,R,P,Y]]", [&act](const std::string& text) { return numbers_in(text, act.taken.seen); },
      "Where the camera saw it, in mm and degrees");
  command.add("--drop", "POINT", act.drop, "Remove this point, from 1").range(1, 1000);
  command.flag("--drop-all", act.drop_all, "Remove all points");
  command.flag("--accept", act.accept,
               "Declare the result in the files of the robot; what was before stays as a comment");
  command
      .add("--points", "FILE", options.calibration.points,
           "File with the points (default: NAME.KIND.points, next to the first job file)")
      .completes(base::Completion::File);
  command
      .add("--file", "FILE", options.calibration.file, "File of a new declaration (default: the one with most points)")
      .completes(base::Completion::File);
  add_choice(command, context, options);
  add_files(command, options);
  add_format_option(command, context, {Format::Table, Format::Json, Format::Csv});
}

void declare_format(base::Options& app, RobotOptions& options) {
  base::Options& command =
      app.command("format", "Lay out job files: indentation, blanks, case of keywords",
                  [&options] { options.chosen = [&options](Context& c) { return format_jobs(c, options.format); }; });
  command.add("files", "FILE", options.format.files, "Job files, which are replaced")
      .required()
      .completes(base::Completion::File);
  command.flag("--check", options.format.check, "Change nothing; exit code 4 if a file would change");
}

void declare_job(base::Options& app, Context& context, RobotOptions& options) {
  base::Options& command =
      app.command("job", "Show the job, what it has interrupted, and which interrupts wait",
                  [&options] { options.chosen = [&options](Context& c) { return show_job(c, options.choice); }; });
  add_choice(command, context, options);
  add_remote_options(command, context);
  add_format_option(command, context, {Format::Table, Format::Json, Format::Csv});
}

void declare_question(base::Options& app, Context& context, RobotOptions& options) {
  base::Options& command = app.command("question", "Show the question that the job asks the operator", [&options] {
    options.chosen = [&options](Context& c) { return show_question(c, options.choice, options.wait_ns); };
  });
  add_time_option(command, "--timeout", options.wait_ns, "Wait for a question; fails if none is asked in this time");
  add_choice(command, context, options);
  add_remote_options(command, context);
  add_format_option(command, context, {Format::Table, Format::Json, Format::Csv});
}

void declare_answer(base::Options& app, Context& context, RobotOptions& options) {
  base::Options& command = app.command("answer", "Answer the question that the job asks", [&options] {
    options.chosen = [&options](Context& c) { return answer_question(c, options.choice, options.answer); };
  });
  command
      .add("answer", "ANSWER", options.answer.text,
           "One of the answers or its number, or the number that was asked for")
      .required();
  command.add("--question", "NUMBER", options.answer.question,
              "Answer only the question with this number (default: the one that is open)");
  add_choice(command, context, options);
  add_reason_option(command, context);
  add_remote_options(command, context);
}

Action declare_robot(base::Options& app, Context& context) {
  auto options = std::make_shared<RobotOptions>();
  declare_points(app, context, *options);
  declare_teach(app, context, *options);
  declare_reload(app, context, *options);
  declare_jog(app, context, *options);
  declare_guide(app, context, *options);
  declare_identify(app, context, *options);
  declare_calibrate(app, context, *options);
  declare_job(app, context, *options);
  declare_question(app, context, *options);
  declare_answer(app, context, *options);
  declare_format(app, *options);
  return [options](Context& c) { return options->chosen(c); };
}

}  // namespace

const Verb kRobotVerb{
    "robot", "Variables", "Show, teach and reload the points of a robot, move it by hand, answer its jobs",
    "teach writes a point in the form that it has in the file (joint angles, or a pose in its frame), and keeps\n"
    "the comment after it; the file is replaced as a whole or not at all. The robot uses the new point after\n"
    "reload, or when its module starts again. jog is not a safety function: that requires an enabling switch\n"
    "wired to the drives.\n"
    "Examples:\n"
    "  indurop robot jog z+ --speed 20\n"
    "  indurop robot jog J1- --for 2s\n"
    "  indurop robot guide seam --within 0.5\n"
    "  indurop robot teach PICK\n"
    "  indurop robot teach CORNER --in pallet --file points.job\n"
    "  indurop robot reload\n"
    "  indurop robot points\n"
    "  indurop robot job\n"
    "  indurop robot answer left\n"
    "  indurop robot format *.job\n"
    "  indurop robot identify swing.mcap --config module.xml\n"
    "  indurop robot calibrate tool pen --take\n"
    "  indurop robot calibrate tool pen --accept\n",
    &declare_robot};

}  // namespace indurop::tools
