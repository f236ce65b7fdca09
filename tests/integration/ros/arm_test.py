# SPDX-License-Identifier: Apache-2.0
"""The arm by an actionlib client of ROS 1: where it is while it moves is judged by the drives of the node, and the time
by the trajectory that was sent."""

import math
import os
import pathlib
import subprocess
import sys

from ros_harness import Setting, skip, wait_for

try:
    import actionlib
    import rospy
    import sensor_msgs.msg
    import trajectory_msgs.msg
    from actionlib_msgs.msg import GoalStatus
except ImportError as missing:
    skip(f"{missing}: python3-actionlib, python3-rosservice, python3-rosmaster, python3-trajectory-msgs")

PACKAGES = ("std_msgs", "actionlib_msgs", "trajectory_msgs")
# Of control_msgs as it was released for ROS 1.
KNOWN = {"FollowJointTrajectoryAction": "bc4f9b743838566551c0390c65f1a248",
         "FollowJointTrajectoryGoal": "69636787b6ecbde4d61d711979bc7ecb"}


def control_msgs(folder, texts):
    """The package as genpy makes it of the texts; Debian has none."""
    package = folder / "python" / "control_msgs" / "msg"
    package.mkdir(parents=True)
    includes = [f"-Icontrol_msgs:{texts}"] + [f"-I{name}:/usr/share/{name}/msg" for name in PACKAGES]
    subprocess.run(["/usr/bin/python3", "/usr/lib/genpy/genmsg_py.py", "-p", "control_msgs", "-o", package, *includes,
                    *sorted(texts.glob("*.msg"))], check=True, capture_output=True)
    subprocess.run(["/usr/bin/python3", "/usr/lib/genpy/genmsg_py.py", "--initpy", "-o", package], check=True)
    (package.parent / "__init__.py").touch()
    sys.path.insert(0, str(folder / "python"))
    import control_msgs.msg
    for name, md5 in KNOWN.items():
        assert getattr(control_msgs.msg, name)._md5sum == md5, name
    return control_msgs.msg


def trajectory(*points, names=None):
    """Points are (time, joints in degrees)."""
    path = trajectory_msgs.msg.JointTrajectory(joint_names=names or [f"joint{i}" for i in range(1, 7)])
    for time, joints in points:
        path.points.append(trajectory_msgs.msg.JointTrajectoryPoint(
            positions=[math.radians(one) for one in joints], time_from_start=rospy.Duration.from_sec(time)))
    return path


class Arm:
    def __init__(self, setting, messages):
        self.setting, self.messages = setting, messages
        self.client = actionlib.SimpleActionClient("arm_controller/follow_joint_trajectory",
                                                   messages.FollowJointTrajectoryAction)
        assert self.client.wait_for_server(rospy.Duration(30))
        self.states = []
        rospy.Subscriber("/joint_states", sensor_msgs.msg.JointState, self.states.append)
        self.feedback = []

    def joints(self):
        return [float(one) for one in self.setting.get("ROBOT_ARM.joint").strip("[]").split(",")]

    def send(self, path, **more):
        goal = self.messages.FollowJointTrajectoryGoal(trajectory=path, **more)
        self.feedback.clear()
        self.client.send_goal(goal, feedback_cb=self.feedback.append)

    def result(self):
        assert self.client.wait_for_result(rospy.Duration(60))
        return self.client.get_state(), self.client.get_result()

    def run(self, path, **more):
        self.send(path, **more)
        return self.result()

    def stands(self):
        return all(self.setting.get(f"AXIS_STATE[{axis}].eState").startswith("AXIS_STANDSTILL") for axis in range(6))

    def rejects(self, path, code, reason, **more):
        state, result = self.run(path, **more)
        assert state == GoalStatus.REJECTED and result.error_code == code and reason in result.error_string, (state, result)


def call(name):
    done = subprocess.run(["/usr/bin/rosservice", "call", f"/arm_controller/{name}"], capture_output=True, text=True, timeout=60)
    assert done.returncode == 0, done.stderr
    return done.stdout


def test_power(arm):
    arm.rejects(trajectory((1, [0] * 6)), -1, "the drives have no power")
    assert "success: True" in call("enable")


def test_success(arm):
    """Each joint is where the trajectory has it, when it has it, and success comes after the arm stands."""
    start = arm.joints()
    target = [20, 10, -15, 30, 25, -40]
    middle = [(a + b) / 2 for a, b in zip(start, target)]
    arm.states.clear()
    begin = rospy.Time.now().to_sec()
    state, result = arm.run(trajectory((0, start), (2, middle), (4, target)))
    took = rospy.Time.now().to_sec() - begin
    assert state == GoalStatus.SUCCEEDED and result.error_code == 0, result
    assert arm.stands() and took >= 4, took
    assert all(abs(a - b) < 0.6 for a, b in zip(arm.joints(), target)), arm.joints()
    names = arm.states[0].name
    at_half = [one for one in arm.states if all(
        abs(math.degrees(one.position[names.index(f"joint{k + 1}")]) - middle[k]) < 2.5 for k in range(6))]
    assert at_half, "all joints pass the middle together"
    assert arm.feedback and arm.feedback[-1].joint_names == names


def test_refusals(arm):
    here = arm.joints()
    arm.rejects(trajectory((1, [0] * 5), names=[f"joint{i}" for i in range(1, 6)]), -2, "joint 'joint6' is missing")
    arm.rejects(trajectory(), -1, "it has no points")
    arm.rejects(trajectory((1, here), (1, here)), -1, "is not above")
    arm.rejects(trajectory((1, [200, 0, 0, 0, 0, 0])), -1, "not within the ends of axis 1")
    arm.rejects(trajectory((0, [one + 5 for one in here]), (2, here)), -1, "away from where axis 1 is")
    arm.rejects(trajectory((0.2, [one + 40 for one in here[:1]] + here[1:])), -1, "is too slow",
                goal_time_tolerance=rospy.Duration(0.1))
    old = trajectory((1, here))
    old.header.stamp = rospy.Time.from_sec(rospy.Time.now().to_sec() - 10)
    arm.rejects(old, -3, "in the past")
    arm.setting.set("PLC_ROBOT::ROBOT_OVERRIDE", 50)
    arm.rejects(trajectory((2, here)), -1, "override")
    arm.setting.set("PLC_ROBOT::ROBOT_OVERRIDE", 100)
    arm.setting.set("PLC_ROBOT::ROBOT_HOLD", 1)
    arm.rejects(trajectory((2, here)), -1, "held")
    arm.setting.set("PLC_ROBOT::ROBOT_HOLD", 0)
    assert arm.stands()


def test_stretch(arm):
    """Too fast: takes longer, and keeps the limits of the robot, which would stop it."""
    here = arm.joints()
    target = [here[0] - 60] + here[1:]
    state, result = arm.run(trajectory((0.2, target)))
    assert state == GoalStatus.SUCCEEDED and "times as long, for the limits of axis 1" in result.error_string, result
    assert abs(arm.joints()[0] - target[0]) < 0.6


def test_many_points(arm):
    here = arm.joints()
    points = [(0.02 * i, [here[0] + 20 * math.sin(0.02 * i)] + here[1:]) for i in range(1, 300)]
    state, result = arm.run(trajectory(*points))
    assert state == GoalStatus.SUCCEEDED, result
    assert abs(arm.joints()[0] - points[-1][1][0]) < 0.6


def test_cancel_and_replace(arm):
    here = arm.joints()
    far = [here[0] + 50] + here[1:]
    arm.send(trajectory((10, far)))
    wait_for(lambda: abs(arm.joints()[0] - here[0]) > 2, "it moves")
    arm.client.cancel_goal()
    state, result = arm.result()
    assert state == GoalStatus.PREEMPTED, (state, result)
    assert arm.stands() and abs(arm.joints()[0] - far[0]) > 5
    arm.send(trajectory((10, far)))
    wait_for(lambda: arm.client.get_state() == GoalStatus.ACTIVE and not arm.stands(), "it moves again")
    other = actionlib.SimpleActionClient("arm_controller/follow_joint_trajectory", arm.messages.FollowJointTrajectoryAction)
    other.wait_for_server()
    other.send_goal(arm.messages.FollowJointTrajectoryGoal(trajectory=trajectory((3, here))))
    assert other.wait_for_result(rospy.Duration(60)) and other.get_state() == GoalStatus.SUCCEEDED, other.get_result()
    assert arm.client.get_state() == GoalStatus.PREEMPTED


def test_stops(arm):
    """What stops the robot ends the goal once the arm stands."""
    here = arm.joints()
    far = [here[0] + 50] + here[1:]
    for stop, undo in ((("ROBOT_HOLD", 1), ("ROBOT_HOLD", 0)), (("I14", 0), ("I14", 1))):
        arm.send(trajectory((10, far)))
        wait_for(lambda: not arm.stands(), "it moves")
        arm.setting.set("PLC_ROBOT::" + stop[0], stop[1])
        state, result = arm.result()
        assert state == GoalStatus.ABORTED and result.error_code in (-1, -4), (state, result)
        arm.setting.set("PLC_ROBOT::" + undo[0], undo[1])
        if stop[0] == "I14":
            wait_for(lambda: arm.setting.number("PLC_ROBOT::EMERGENCY_STOP.bActive") == 0, "the circuit is closed")
            assert "success: True" in call("reset")
            assert "success: True" in call("enable")
    state, _ = arm.run(trajectory((5, here)))
    assert state == GoalStatus.SUCCEEDED


def test_set_points(arm):
    """A stream moves the arm; it comes to rest when the stream stops, wherever its last set point is."""
    publisher = rospy.Publisher("/arm_controller/command", trajectory_msgs.msg.JointTrajectory, queue_size=1)
    wait_for(lambda: publisher.get_num_connections() == 1, "the door listens")
    here = arm.joints()
    rate = rospy.Rate(50)
    for i in range(100):
        path = trajectory((0.02, [here[0] + 0.2 * i] + here[1:]))
        path.points[0].velocities = [math.radians(10)] + [0] * 5
        publisher.publish(path)
        rate.sleep()
    wait_for(arm.stands, "it stands")
    assert 15 < arm.joints()[0] - here[0] < 21.5, arm.joints()[0] - here[0]
    far = [here[0] - 100] + here[1:]
    arm.setting.set("PLC_ROBOT::ROBOT_OVERRIDE", 10)
    publisher.publish(trajectory((0.02, far)))  # nothing comes after it
    wait_for(lambda: "no set point came" in arm.setting.log_of_door(), "the stop is reported")
    wait_for(arm.stands, "it stands")
    assert arm.joints()[0] - far[0] > 50, "on its way"
    arm.setting.set("PLC_ROBOT::ROBOT_OVERRIDE", 100)


def test_node_ends(arm):
    here = arm.joints()
    arm.send(trajectory((10, [here[0] + 50] + here[1:])))
    wait_for(lambda: not arm.stands(), "it moves")
    arm.setting.indurop("stop")
    state, result = arm.result()
    assert state == GoalStatus.ABORTED and "the node has ended" in result.error_string, (state, result)


def main():
    with Setting(*sys.argv[1:5]) as setting:
        messages = control_msgs(setting.folder, pathlib.Path(sys.argv[5]))
        setting.start_master()
        setting.start_robot()
        setting.start_door("--variables", "PLC_ROBOT::ROBOT_ARM", "--urdf", "robot.urdf", "--move")
        rospy.init_node("judge", disable_signals=True)
        arm = Arm(setting, messages)
        for test in (test_power, test_success, test_refusals, test_stretch, test_many_points, test_cancel_and_replace,
                     test_stops, test_set_points, test_node_ends):
            print(test.__name__, flush=True)
            test(arm)
    sys.stdout.flush()
    os._exit(0)  # threads of rospy wait for the master


main()
