// SPDX-License-Identifier: Apache-2.0
// The robot task (chapter, Figure 13): reads the axes, serves what the PLC program asks for, moves, and writes the
// axes. Kinematics, trajectories and jobs are those of <indurop/robot/controller.h>; properties: urdf, jobs.
#include <indurop/indurop.h>

#include <indurop/crash_guard.h>
#include <indurop/files.h>
#include <indurop/generated.h>
#include <indurop/robot/controller.h>

#include <algorithm>
#include <chrono>
#include <memory>
#include <random>
#include <sstream>
#include <stdexcept>
#include <thread>

#include "job_signals.h"
#include "robot_space.h"

// A second robot of the node is this file again, built with the namespace of its own variables: ROBOT_GROUP=PLC_ROBOT2.
#ifndef ROBOT_GROUP
#define ROBOT_GROUP PLC_ROBOT
#endif
using namespace ROBOT_GROUP;
namespace robot = indurop::robot;
#define TEXT_OF(name) #name
#define NAME_OF(group) TEXT_OF(group)

namespace {

std::unique_ptr<robot::Controller> plcRobot;
std::unique_ptr<JobSignals> signals;
std::unique_ptr<RobotSpace> space;
robot::Inputs in;
robot::Outputs out;
std::uint32_t first_number = 0;  // of a question, for all starts another one

// In a simulation no time passes while a module runs, and a thread in the background would end at an arbitrary time.
bool time_stands() {
  const std::int64_t before = irp::now_ns();
  std::this_thread::sleep_for(std::chrono::microseconds(100));
  return irp::now_ns() == before;
}

std::vector<std::string> files(const std::string& names) {
  std::istringstream stream(names);
  std::vector<std::string> list;
  for (std::string name; stream >> name;) {
    list.push_back(irp::file_beside_config(name));
  }
  return list;
}

robot::DriveIn from(const AXIS1_IN_t& axis) {
  return {axis.error, axis.status, axis.mode, axis.position, axis.probe, axis.probe_rise, axis.probe_fall, axis.torque};
}
AXIS1_OUT_t to(const robot::DriveOut& drive) {
  return {drive.control, drive.mode, drive.position, drive.probe, drive.torque_offset, drive.torque};
}

// A .glb of an arm with more axes has variables of these names, which are found before these.
const AXIS1_IN_t AXIS7_IN, AXIS8_IN;
AXIS1_OUT_t AXIS7_OUT, AXIS8_OUT;

}  // namespace

namespace ROBOT_GROUP {
namespace {

void read_axes() {
  in.drives = {from(AXIS1_IN), from(AXIS2_IN), from(AXIS3_IN), from(AXIS4_IN),
               from(AXIS5_IN), from(AXIS6_IN), from(AXIS7_IN), from(AXIS8_IN)};
}

void write_axes() {
  AXIS1_OUT = to(out.drives[0]);
  AXIS2_OUT = to(out.drives[1]);
  AXIS3_OUT = to(out.drives[2]);
  AXIS4_OUT = to(out.drives[3]);
  AXIS5_OUT = to(out.drives[4]);
  AXIS6_OUT = to(out.drives[5]);
  AXIS7_OUT = to(out.drives[6]);
  AXIS8_OUT = to(out.drives[7]);
}

}  // namespace
}  // namespace ROBOT_GROUP

namespace {

void read_commands() {
  const auto commands = MC_COMMAND.get();
  for (std::size_t k = 0; k < commands.size(); ++k) {
    const MC_COMMAND_t& c = commands[k];
    in.commands[k] = {c.nNumber,
                      c.eOpCode,
                      c.nAxis,
                      c.nUpdates,
                      static_cast<robot::BufferMode>(c.eBufferMode),
                      static_cast<robot::Direction>(c.eDirection),
                      static_cast<robot::CoordSystem>(c.eCoordSystem),
                      c.nOption,
                      c.bExecute,
                      c.nJob,
                      c.dTo,
                      c.dAux,
                      c.dVelocity,
                      c.dAcceleration,
                      c.dDeceleration,
                      c.dJerk,
                      c.dTransition};
  }
  const auto cams = MC_CAM.get();
  for (std::size_t k = 0; k < cams.size(); ++k) {
    in.cams[k] = {cams[k].nPoints, cams[k].dMaster, cams[k].dSlave};
  }
  const auto belts = MC_BELT.get();
  for (std::size_t k = 0; k < belts.size(); ++k) {
    in.belts[k] = {belts[k].dPlace, belts[k].nBeat};
  }
  const auto profiles = MC_PROFILE.get();
  for (std::size_t k = 0; k < profiles.size(); ++k) {
    in.profiles[k] = {profiles[k].nCommand, profiles[k].nPoints, profiles[k].dTime, profiles[k].dValue};
  }
  const MC_FACTORS_t factors = MC_FACTORS;
  if (factors.bSet != 0) {
    in.factors = {factors.dVelocity, factors.dAcceleration, factors.dJerk, factors.dGroup};
  } else {
    in.factors = {};
  }
}

void write_tool() {
  MC_TOOL = {out.machine.position,     out.product.position,     out.machine.velocity, out.product.velocity,
             out.machine.acceleration, out.product.acceleration, out.acceleration,     out.product_frame};
}

void write_answers() {
  auto answers = lock(MC_ANSWER);
  for (std::size_t k = 0; k < out.commands.size(); ++k) {
    const robot::CommandAnswer& a = out.commands[k];
    answers[k] = {a.number, static_cast<int16_t>(a.state), a.reached, static_cast<uint32_t>(a.error)};
  }
}

void read_requests() {
  const ROBOT_MODULE_SERVICE_t service = ROBOT_MODULE_SERVICE;
  in.service = {service.eOpCode,   service.nRequest, service.t_pl, static_cast<double>(service.t_speed),
                service.p_Target,  service.p_Mid,    service.nJob, service.dTarget,
                service.dVelocity, service.nLine,    service.nTool};
  in.edit = msgRobotServiceEditNum != 0;
  in.requests_known = valid(ROBOT_MODULE_SERVICE) && valid(AXIS_SERVICE) && valid(MC_COMMAND);
  const auto axes = AXIS_SERVICE.get();
  for (std::size_t k = 0; k < axes.size(); ++k) {
    const AXIS_SERVICE_t& a = axes[k];
    in.axes[k] = {a.nRequest, a.eOpCode, a.dPosition, a.dVelocity, a.dAcceleration, a.dJerk};
  }
  in.speed_override = ROBOT_OVERRIDE;
  in.hold = ROBOT_HOLD != 0;
  const ROBOT_JOG_t jog = ROBOT_JOG;
  in.jog = {jog.bEnable != 0, static_cast<robot::JogFrame>(jog.eFrame), jog.dSpeed, jog.nBeat, jog.frame};
  const ROBOT_MODE_t mode = ROBOT_MODE;
  in.mode = {static_cast<robot::OperatingMode>(mode.eMode), mode.bEnable != 0, mode.nBeat};
  if (!valid(ROBOT_MODE)) {
    in.mode.mode = robot::OperatingMode::Manual;  // the mode is unknown, so nothing moves
    in.mode.enabled = false;
  }
  const ROBOT_PAUSE_t pause = ROBOT_PAUSE;
  in.single_step = pause.bStep != 0;
  for (std::size_t k = 0; k < in.breakpoints.size(); ++k) {
    in.breakpoints[k] = {pause.nJob[k], pause.nLine[k]};
  }
  const ROBOT_ANSWER_t answer = ROBOT_ANSWER;
  in.answer = {answer.nRequest, answer.nQuestion, answer.dAnswer, valid(ROBOT_ANSWER)};
  // Who cannot hear the emergency stop, which is the cell's, stops.
  in.emergency = PLC_ROBOT::EMERGENCY_STOP.bActive != 0 || !valid(PLC_ROBOT::EMERGENCY_STOP);
}

// Figure 11's fields have no sign: what is negative is stored as its bits.
unsigned long bits(double thousandths) {
  return static_cast<unsigned long>(static_cast<long>(thousandths));
}

void write_state() {
  auto state = lock(ROBOT_MODULE_STATE);
  state->nAXESGROUP = static_cast<unsigned short>(plcRobot->axis_count());
  state->MotionDone = out.motion_done;
  state->Busy = out.busy;
  state->eState = static_cast<ROBOT_GROUP_STATE>(out.state);
  state->bRuntimeService = out.acknowledged != out.done;
  state->bJob_RobotMoving = out.moving_by_job;
  for (std::size_t k = 0; k < state->dCurJoint.size(); ++k) {
    state->dCurJoint[k] = bits(1000 * out.joints[k]);
    state->dCmdJoint[k] = bits(1000 * out.command[k]);
    state->dJointSpeed[k] = bits(1000 * out.speed[k]);
  }
  for (std::size_t k = 0; k < 6; ++k) {
    const double place = k < 3 ? out.position[k] : out.orientation[k - 3];
    const double speed = k < 3 ? out.velocity[k] : out.turning[k - 3];
    state->dWorldPos[k] = state->dUserPos[k] = state->dBasePos[k] = bits(1000 * place);
    state->dWorldSpeed[k] = state->dBaseSpeed[k] = bits(1000 * speed);
  }
  state->nAcknowledge = out.acknowledged;
  state->nDone = out.done;
  state->nError = static_cast<ROBOT_ERROR>(out.error);
  state->nErrorAxis = out.error_axis;
}

void write_arm() {
  auto arm = lock(ROBOT_ARM);
  arm->joint = out.joints;
  arm->command = out.command;
  arm->speed = out.speed;
  arm->position = out.position;
  arm->orientation = out.orientation;
  arm->tool_speed = out.tool_speed;
  arm->override_now = out.path_speed;
  arm->to_go = out.to_go;
  arm->nTool = static_cast<uint16_t>(out.tool);
  arm->tool = out.tool_name;
  arm->eMode = static_cast<ROBOT_OPERATING_MODE>(out.mode);
  arm->bMayMove = out.may_move;
  arm->bGuided = out.guided;
}

void write_path() {
  if (!out.ways_changed) {
    return;
  }
  auto path = lock(ROBOT_PATH);
  for (std::size_t k = 0; k < out.ways.size(); ++k) {
    auto& motion = path->motion[k];
    const robot::ToolWay* const way = out.ways[k];
    motion = {};
    if (way != nullptr) {
      motion.nPlaces = way->count;
      for (std::size_t i = 0; i < way->count; ++i) {
        std::copy(way->place[i].begin(), way->place[i].end(), motion.place.begin() + 3 * i);
        motion.speed[i] = way->speed[i];
      }
    }
  }
}

void write_job() {
  auto job = lock(ROBOT_JOB);
  job->eState = static_cast<ROBOT_JOB_STATE>(out.job.state);
  job->nJob = static_cast<uint16_t>(out.job.job);
  job->nLine = out.job.line;
  job->nCycles = out.job.cycles;
  job->name = out.job.name;
  job->cMessage = out.job.message;
  job->bResume = out.job.can_resume;
  job->called = out.job.called;
  job->nInterrupted = out.job.interrupted_count;
  for (std::size_t k = 0; k < out.job.interrupted.size(); ++k) {
    job->interrupted[k].name = out.job.interrupted[k].name;
    job->interrupted[k].nLine = out.job.interrupted[k].line;
  }
  job->nPending = out.job.pending_count;
  for (std::size_t k = 0; k < out.job.pending.size(); ++k) {
    job->pending[k].name = out.job.pending[k];
  }
}

void write_question() {
  const robot::QuestionReport& asked = out.job.question;
  auto question = lock(ROBOT_QUESTION);
  question->nNumber = asked.number;
  question->cText = asked.text;
  question->nChoices = static_cast<uint16_t>(asked.count);
  for (std::size_t k = 0; k < asked.choices.size(); ++k) {
    question->choice[k].text = asked.choices[k];
  }
  question->dLower = asked.lower;
  question->dUpper = asked.upper;
  question->dStep = asked.step;
  question->dLeft = asked.left;
  question->nAcknowledge = asked.acknowledged;
  question->nError = static_cast<ROBOT_ERROR>(asked.error);
  question->cReason = asked.reason;
}

void write_axis_states() {
  auto axes = lock(AXIS_STATE);
  for (std::size_t k = 0; k < MAX_JOINTS; ++k) {
    const robot::AxisReport& a = out.axes[k];
    axes[k] = {static_cast<ROBOT_AXIS_STATE>(a.state),
               a.acknowledged,
               a.done,
               a.aborted,
               static_cast<ROBOT_ERROR>(a.error),
               static_cast<short>(a.power),
               a.homed,
               a.in_velocity,
               a.position,
               a.velocity,
               a.command,
               a.acceleration,
               a.measured_velocity,
               a.lower,
               a.upper,
               a.most_velocity,
               a.most_acceleration,
               a.most_jerk,
               a.probe,
               a.phase,
               a.torque,
               a.push,
               a.own_lower,
               a.own_upper,
               a.own_velocity,
               a.own_acceleration,
               a.own_deceleration,
               a.own_jerk,
               static_cast<short>(a.lower_counts),
               static_cast<short>(a.upper_counts)};
  }
}

}  // namespace

void start() {
  robot::Settings settings;
  settings.name = NAME_OF(ROBOT_GROUP);
  settings.urdf = irp::file_beside_config(irp::property("urdf", "robot.urdf"));
  settings.jobs = files(irp::property("jobs", ""));
  settings.period = irp::period();
  settings.plan_in_tick = time_stands();
  settings.learned = [](bool what) noexcept { return irp::learned(what ? 1 : 0) != 0; };
  settings.guarded = &irp::guarded;
  if (!settings.plan_in_tick) {
    first_number = std::random_device{}() >> 1;
    settings.first_question = []() noexcept { return static_cast<std::uint32_t>(irp::learned(first_number)); };
  }
  std::vector<std::string> errors;
  robot::take_properties([](const char* name) { return irp::property(name, ""); }, settings, errors);
  plcRobot = robot::Controller::load(settings, errors);
  for (const std::string& error : errors) {
    irp::printf("%s\n", error.c_str());
  }
  if (!errors.empty()) {
    throw std::runtime_error("the robot cannot be started, see the messages above");
  }
  irp::printf("the arm: %s\n", plcRobot->kind().c_str());
  if (plcRobot->axis_count() > MAX_JOINTS) {
    throw std::runtime_error("the arm has " + std::to_string(plcRobot->axis_count()) +
                             " axes, the .glb has variables of " + std::to_string(MAX_JOINTS) +
                             ": raise MAX_JOINTS and add AXIS" + std::to_string(MAX_JOINTS + 1) + "_IN, AXIS" +
                             std::to_string(MAX_JOINTS + 1) + "_OUT");
  }
  signals = std::make_unique<JobSignals>(plcRobot->signals());
  space = std::make_unique<RobotSpace>(settings.name, settings.other_robots);
  ROBOT_MODULE_STATE.eState = ROBOT_GROUP_DISABLED;
  for (std::size_t k = 0; k < 6; k++) {
    ROBOT_MODULE_STATE.dCurJoint[k] = 0.0;
  }
}

void run() {
  in.tick = irp::tick();
  read_axes();
  read_requests();
  read_commands();
  space->read(in);
  plcRobot->step(in, *signals, out);
  if (out.edit_done) {
    msgRobotServiceEditNum = 0;
  }
  write_axes();
  write_state();
  write_arm();
  write_path();
  write_job();
  space->write(out);
  write_question();
  write_axis_states();
  write_answers();
  write_tool();
  if (out.broken != nullptr) {
    throw std::runtime_error(out.broken);  // the drives have no power any more
  }
}

// `in` and `out` are set in each run.
namespace {
std::size_t save(void* to, std::size_t most) {
  return plcRobot->save(to, most);
}
bool restore(const void* from, std::size_t bytes) {
  return plcRobot->restore(from, bytes);
}
}  // namespace

INDUROP_STATE_BY(most = robot::Controller::kMostKept, save = &::save, restore = &::restore)
INDUROP_MODULE(run = &::run, start = &::start, name = "Robot", description = "robot task")
