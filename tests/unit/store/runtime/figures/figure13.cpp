// SPDX-License-Identifier: Apache-2.0
// The statements of Figure 13 with the least of the application around them. Plain C symbols, no INDUROP_MODULE.

// clang-format off
#include <indurop/indurop.h>
#include <indurop/generated.h>

enum ROBOT_GROUP_STATE { ROBOT_GROUP_DISABLED = 3 };
enum OPCODE_ROBOT_SERVICE { SVC_AD_GROUP_ENABLE = 11, OPCODE_MOVJ };
static struct {
  int eState;
  unsigned long dCurJoint[6];
} plcRobot;
static struct {
  OPCODE_ROBOT_SERVICE eOpCode;
} msgRobotService[1];

extern "C" void start()
{
 int k;
 std::cout <<"[START]" <<std::endl;
 PLC_ROBOT::ROBOT_MODULE_STATE.eState = plcRobot.eState = ROBOT_GROUP_DISABLED;
 PLC_ROBOT::ROBOT_MODULE_SERVICE.eOpCode = SVC_AD_GROUP_ENABLE;
 PLC_ROBOT::msgRobotServiceEditNum=1;
 for (k=0; k<6; k++)
 PLC_ROBOT::ROBOT_MODULE_STATE.dCurJoint[k] = 0.0;
}

extern "C" void run()
{
 int k, N;
 int32_t joint[6];
 joint[0] = PLC_ROBOT::AXIS1_IN.position / 1320000 * 360;
 for (k=0; k<6; k++)
  plcRobot.dCurJoint[k] = PLC_ROBOT::ROBOT_MODULE_STATE.dCurJoint[k] = (unsigned long) joint[0] + k;
 if (PLC_ROBOT::msgRobotServiceEditNum!=0) {
 msgRobotService[0].eOpCode=
 (OPCODE_ROBOT_SERVICE)((int) PLC_ROBOT::ROBOT_MODULE_SERVICE.eOpCode);
 if(PLC_ROBOT::ROBOT_MODULE_STATE.MotionDone==1)
 PLC_ROBOT::msgRobotServiceEditNum = 0;
 }
 N=5; // N is Gear Ratio
 PLC_ROBOT::AXIS1_OUT.position = N*1320000 * joint[0] / 360;
}
