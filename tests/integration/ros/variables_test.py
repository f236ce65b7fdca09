# SPDX-License-Identifier: Apache-2.0
"""Variables as topics: rostopic and rospy read those of std_msgs; messages made from structs are read by genpy, which
makes a class of the definition that came with the connection and computes the checksum itself."""

import os
import subprocess
import sys
import threading

from ros_harness import Setting, skip, wait_for

try:
    import genpy.dynamic
    import rospy
    import rostopic  # noqa: F401
    import std_msgs.msg
except ImportError as missing:
    skip(f"{missing}: python3-rostopic, python3-rosservice and python3-rosmaster")


class Reader:
    """The latest message of a topic, of any type."""

    generating = threading.Lock()  # genpy collects the formats of a type in global variables

    def __init__(self, topic):
        self.message = None
        self.header = None
        self.classes = {}
        rospy.Subscriber(topic, rospy.AnyMsg, self.take)

    def take(self, message):
        self.header = message._connection_header
        name = self.header["type"]
        if name not in self.classes:
            with self.generating:
                self.classes = genpy.dynamic.generate_dynamic(name, self.header["message_definition"])
        decoded = self.classes[name]()
        decoded.deserialize(message._buff)
        self.message = decoded

    def wait(self):
        wait_for(lambda: self.message is not None, "a message")
        return self.message


def rostopic_of(*words):
    done = subprocess.run(["/usr/bin/rostopic", *words], capture_output=True, text=True, timeout=60)
    assert done.returncode == 0, done.stderr
    return done.stdout


def test_numbers(setting):
    types = dict(rospy.get_published_topics())
    assert types["/PLC_ROBOT/I14"] == "std_msgs/Int16", types["/PLC_ROBOT/I14"]
    assert types["/PLC_ROBOT/ROBOT_OVERRIDE"] == "std_msgs/Float64"
    assert types["/PLC_ROBOT/ROBOT_ARM"] == "plc_robot_msgs/ROBOTARM"
    assert rostopic_of("echo", "-n", "1", "/PLC_ROBOT/I14").startswith("data: 1\n")
    override = []
    subscriber = rospy.Subscriber("/PLC_ROBOT/ROBOT_OVERRIDE", std_msgs.msg.Float64, lambda message: override.append(message.data))
    wait_for(lambda: override == [100], "the first value")
    setting.set("PLC_ROBOT::ROBOT_OVERRIDE", 42.5)
    wait_for(lambda: override == [100, 42.5], "the change, once")
    setting.set("PLC_ROBOT::ROBOT_OVERRIDE", 100)
    subscriber.unregister()


def test_structs(setting):
    """All topics: the checksum of each is what genmsg computes from its definition, and the values are those of the node."""
    readers = {topic: Reader(topic) for topic, _ in rospy.get_published_topics("/PLC_ROBOT")}
    assert len(readers) > 50, len(readers)
    for topic, reader in readers.items():
        message = reader.wait()
        assert message._md5sum == reader.header["md5sum"], topic
    arm = readers["/PLC_ROBOT/ROBOT_ARM"]
    joints = setting.get("ROBOT_ARM.joint").strip("[]").split(",")
    assert [round(one, 6) for one in arm.message.joint] == [round(float(one), 6) for one in joints]
    assert readers["/PLC_ROBOT/AXIS_STATE"].message.value[2].d_max_velocity == setting.number("AXIS_STATE[2].dMaxVelocity")
    assert readers["/PLC_ROBOT/MC_PROFILE"].message.value[7].n_points == 0
    setting.set("PLC_ROBOT::ROBOT_JOG", '{frame: "pallet", dSpeed: [1, 2, 3, 4, 5, 6]}')
    jog = readers["/PLC_ROBOT/ROBOT_JOG"]
    wait_for(lambda: jog.message.frame == "pallet", "the text")
    assert list(jog.message.d_speed) == [1, 2, 3, 4, 5, 6], jog.message
    setting.set("PLC_ROBOT::ROBOT_JOG", '{frame: "", dSpeed: [0, 0, 0, 0, 0, 0]}')


def test_joint_states(setting):
    import sensor_msgs.msg
    state = rospy.wait_for_message("/joint_states", sensor_msgs.msg.JointState, timeout=30)
    assert state.name == [f"joint{i}" for i in range(1, 7)], state.name
    assert len(state.position) == 6 and abs(rospy.Time.now().to_sec() - state.header.stamp.to_sec()) < 60
    assert rospy.get_param("/robot_description").startswith("<?xml")


def test_node_comes_back(setting):
    """The program goes on with a node that was started again."""
    setting.indurop("stop")
    wait_for(lambda: "waits" in setting.log_of_door(), "it waits")
    setting.start_robot()
    setting.set("PLC_ROBOT::ROBOT_OVERRIDE", 37)
    reader = Reader("/PLC_ROBOT/ROBOT_OVERRIDE")
    wait_for(lambda: reader.message is not None and reader.message.data == 37, "a value of the new node")


def test_master_ends(setting, master, door):
    master.terminate()
    assert door.wait(30) == 1
    assert "has ended" in setting.log_of_door()


def main():
    with Setting(*sys.argv[1:5]) as setting:
        master = setting.start_master()
        setting.start_robot()
        door = setting.start_door("--variables", "PLC_ROBOT::*", "--urdf", "robot.urdf")
        rospy.init_node("judge", disable_signals=True)
        test_numbers(setting)
        test_structs(setting)
        test_joint_states(setting)
        topics = dict(rospy.get_published_topics())
        assert "/arm_controller/follow_joint_trajectory/status" not in topics, "without --move"
        test_node_comes_back(setting)
        test_master_ends(setting, master, door)
    sys.stdout.flush()
    os._exit(0)  # threads of rospy wait for the master


main()
