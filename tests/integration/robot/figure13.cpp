// SPDX-License-Identifier: Apache-2.0
// Figure 13 of the chapter with its statements about shared variables as printed. What its own headers declare
// (platform.h, MotionControl.h) stands above it in the smallest form that compiles.
#include <indurop/indurop.h>

#include <indurop/generated.h>

using namespace PLC_ROBOT;

// Names and layout are the chapter's.
// NOLINTBEGIN(readability-*,cppcoreguidelines-*,bugprone-narrowing-conversions)

namespace {

enum Command { OPCODE_MOVJ };
struct Speed {
  double dValue;
};
struct RobotServiceMessage {
  OPCODE_ROBOT_SERVICE eOpCode;
  struct {
    Command eOpCode;
    struct {
      struct {
        Speed t_speed;
      } argMOVE;
    } ARG_CMD;
  } arg;
};
struct {
  ROBOT_GROUP_STATE eState;
  struct {
    int nRobotAxis;
  } plcRobotInfo;
  unsigned long dCurJoint[6];
} plcRobot;
RobotServiceMessage msgRobotService[1];
int Handling_Robot_Service(RobotServiceMessage* message) {
  return static_cast<int>(message->eOpCode);
}

}  // namespace

void start() {
  int k;
  std::cout << "[START]" << std::endl;
  PLC_ROBOT::ROBOT_MODULE_STATE.eState = plcRobot.eState = ROBOT_GROUP_DISABLED;
  PLC_ROBOT::ROBOT_MODULE_SERVICE.eOpCode = SVC_AD_GROUP_ENABLE;
  PLC_ROBOT::msgRobotServiceEditNum = 1;
  plcRobot.plcRobotInfo.nRobotAxis = 6;
  for (k = 0; k < 6; k++)
    PLC_ROBOT::ROBOT_MODULE_STATE.dCurJoint[k] = 0.0;
}

void run() {
  int k;
  int N;
  int nRetCode;
  int32_t joint[6];
  joint[0] = PLC_ROBOT::AXIS1_IN.position / 1320000 * 360;
  joint[1] = PLC_ROBOT::AXIS2_IN.position / 1320000 * 360;
  joint[2] = PLC_ROBOT::AXIS3_IN.position / 1320000 * 360;
  joint[3] = PLC_ROBOT::AXIS4_IN.position / 1320000 * 360;
  joint[4] = PLC_ROBOT::AXIS5_IN.position / 1320000 * 360;
  joint[5] = PLC_ROBOT::AXIS6_IN.position / 1320000 * 360;
  for (k = 0; k < 6; k++)
    plcRobot.dCurJoint[k] = PLC_ROBOT::ROBOT_MODULE_STATE.dCurJoint[k] = (unsigned long)joint[k];
  if (PLC_ROBOT::msgRobotServiceEditNum != 0) {
    msgRobotService[0].eOpCode = (OPCODE_ROBOT_SERVICE)((int)PLC_ROBOT::ROBOT_MODULE_SERVICE.eOpCode);
    msgRobotService[0].arg.eOpCode = OPCODE_MOVJ;
    msgRobotService[0].arg.ARG_CMD.argMOVE.t_speed.dValue = 50;
    nRetCode = Handling_Robot_Service(&msgRobotService[0]);
    if (nRetCode != 0 && PLC_ROBOT::ROBOT_MODULE_STATE.MotionDone == 1)
      PLC_ROBOT::msgRobotServiceEditNum = 0;
  }
  N = 5;  // N is Gear Ratio
  PLC_ROBOT::AXIS1_OUT.position = N * 1320000 * joint[0] / 360;
  PLC_ROBOT::AXIS2_OUT.position = N * 1320000 * joint[1] / 360;
  PLC_ROBOT::AXIS3_OUT.position = N * 1320000 * joint[2] / 360;
  PLC_ROBOT::AXIS4_OUT.position = N * 1320000 * joint[3] / 360;
  PLC_ROBOT::AXIS5_OUT.position = N * 1320000 * joint[4] / 360;
  PLC_ROBOT::AXIS6_OUT.position = N * 1320000 * joint[5] / 360;
}
// NOLINTEND(readability-*,cppcoreguidelines-*,bugprone-narrowing-conversions)
