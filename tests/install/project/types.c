/* A DDS program in C that knows the types of the variables. */
#include "knuRobot.h"

int main(void) {
  return knu_Robot_joints__desc.m_size > 0 ? 0 : 1;
}
