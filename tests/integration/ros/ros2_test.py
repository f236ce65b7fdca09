# SPDX-License-Identifier: Apache-2.0
"""The arm by a client of ROS 2: names, types and hashes on the wire, goals, cancels, set points, and what a client must
not be able to do. ros2_test.py PROGRAMS CELL SOURCE IO_MODULE PEER WORK"""

import math
import os
import pathlib
import shutil
import sys
import time

import ros2_harness as ros2
from ros2_harness import ABORTED, CANCELED, SUCCEEDED, trajectory
from ros_harness import Setting, skip, wait_for

sys.path.insert(0, str(pathlib.Path(__file__).parents[2] / "support"))
from npm_packages import fetch  # noqa: E402

ACTION = "arm_controller/follow_joint_trajectory"
POINTS = "rt/arm_controller/joint_trajectory"
# As the generator of ROS 2 (iron, jazzy) has them in its own output.
PUBLISHED = {
    "sensor_msgs/msg/JointState": "a13ee3a330e346c9d87b5aa18d24e11690752bd33a0350f11c5882bc9179260e",
    "std_msgs/msg/String": "df668c740482bbd48fb39d76a70dfd4bd59db1288021743503259e948f6b1a18",
    "trajectory_msgs/msg/JointTrajectory": "179b33eba59d676f6d967ac71fe35e7ca2f64b2f3928f4a018cec115e213796e",
    "control_msgs/action/FollowJointTrajectory_SendGoal_Request": "179c93691f1f6d1d115881ff88c3917b7cc6eac2ba4bf56766cc7c4389e19ef1",
    "control_msgs/action/FollowJointTrajectory_SendGoal_Response": "e6a48ba740ae254500129a877f0b071be8663a115da1a539b74599cc97921fbf",
    "control_msgs/action/FollowJointTrajectory_GetResult_Request": "ecf7ea8463d3beec7084bca75216d0b01b87b6e1e4e09679bb26093041efcbe9",
    "control_msgs/action/FollowJointTrajectory_GetResult_Response": "08eefbaa146ce02ba45898d5e99160afd6c4c54a30d159aee0f2ca6035b1580f",
    "control_msgs/action/FollowJointTrajectory_FeedbackMessage": "80398fcb9674a79081a9906e2ccf0c804dd7cb15e22e362e606ee87186beab71",
    "action_msgs/srv/CancelGoal_Request": "3d3c84653c1f96918086887e1dcb236faec88b81a5b14fd4cf4840065bcdf8af",
    "action_msgs/srv/CancelGoal_Response": "35e682cf3f510e83c70a82a4aac888496dedee56773bf9d8e5e0aa81f9e1c960",
    "action_msgs/msg/GoalStatusArray": "6c1684b00f177d37438febe6e709fc4e2b0d4248dca4854946f9ed8b30cda83e",
    "std_srvs/srv/Trigger_Request": "d010825374ce8918e72bfd826c82603e60f45419e932ea976f807b74a863a199",
    "std_srvs/srv/Trigger_Response": "2d946c21e2fc3f1e9ca6986a8191d85fcc70097a8bb7771a053564bc47009cdf",
    "rmw_dds_common/msg/ParticipantEntitiesInfo": "91a0593bacdcc50ea9bdcf849a938b128412cc1ea821245c663bcd26f83c295e",
}


def ends():
    """All that the door has in the network: (reader or writer, topic, type)."""
    action = f"{ACTION}/_action"
    found = [("writer", "rt/joint_states", "sensor_msgs/msg/JointState"), ("writer", "rt/robot_description", "std_msgs/msg/String"),
             ("reader", POINTS, ros2.TRAJECTORY), ("writer", f"rt/{action}/feedback", ros2.GOAL + "_FeedbackMessage"),
             ("writer", f"rt/{action}/status", "action_msgs/msg/GoalStatusArray"),
             ("writer", "ros_discovery_info", "rmw_dds_common/msg/ParticipantEntitiesInfo")]
    services = [(f"{action}/send_goal", ros2.GOAL + "_SendGoal"), (f"{action}/get_result", ros2.GOAL + "_GetResult"),
                (f"{action}/cancel_goal", ros2.CANCEL)]
    services += [(f"arm_controller/{name}", ros2.TRIGGER) for name in ("enable", "disable", "reset")]
    for name, kind in services:
        found += [("reader", f"rq/{name}Request", kind + "_Request"), ("writer", f"rr/{name}Reply", kind + "_Response")]
    return found


class Arm:
    def __init__(self, setting, peer):
        self.setting, self.peer = setting, peer

    def connect(self):
        self.client = ros2.ActionClient(self.peer, ACTION)
        self.power = {name: ros2.ServiceClient(self.peer, f"arm_controller/{name}", ros2.TRIGGER)
                      for name in ("enable", "disable", "reset")}
        self.peer.say("writer", POINTS, ros2.dds_type(ros2.TRAJECTORY), "-")
        wait_for(lambda: self.peer.matched.get(POINTS) == 1, "the door reads set points")

    def joints(self):
        return [float(one) for one in self.setting.get("ROBOT_ARM.joint").strip("[]").split(",")]

    def stands(self):
        return all(self.setting.get(f"AXIS_STATE[{axis}].eState").startswith("AXIS_STANDSTILL") for axis in range(6))

    def call(self, name):
        """A robot that has just started may need a second attempt."""
        answers = []

        def succeeds():
            answers.append(self.power[name].call({"structure_needs_at_least_one_member": 0}))
            return answers[-1]["success"]

        try:
            wait_for(succeeds, name)
        except AssertionError as error:
            raise AssertionError(f"{error}; the last of {len(answers)} answers: {answers[-1:]}") from error

    def rejects(self, path, reason, **more):
        """ROS 2 has no words for a rejection: the door reports them."""
        before = len(self.setting.log_of_door())
        accepted, goal_id = self.client.start(path, **more)
        assert not accepted
        assert reason in self.setting.log_of_door()[before:], self.setting.log_of_door()[before:]
        assert self.client.result(goal_id)[0] == 0, "it is unknown"


def test_names_and_hashes(arm):
    """By Foxglove's definitions, and as ROS 2 publishes them; clients find both ends of a service by its number."""
    peer = arm.peer
    wanted = {(end, topic, ros2.dds_type(kind)): kind for end, topic, kind in ends()}
    marks = wait_for(lambda: (found := {one[:3]: one[3] for one in peer.endpoints if one[:3] in wanted}).keys() == wanted.keys()
                     and found, "all ends")
    numbers = {}
    for key, kind in wanted.items():
        *service, hashed = marks[key].rstrip(";").split(";")
        assert hashed == "typehash=" + peer.codec.ask("hash", kind), key
        assert hashed == "typehash=RIHS01_" + PUBLISHED[kind], key
        if key[1][:3] in ("rq/", "rr/"):
            assert service[0].startswith("serviceid="), key
            numbers.setdefault(service[0], []).append(key[1][3:].replace("Request", "").replace("Reply", ""))
        else:
            assert not service, key
    assert len(numbers) == 6 and all(len(names) == 2 and len(set(names)) == 1 for names in numbers.values()), numbers
    assert {key for key in peer.endpoints if key[1].startswith(("rt/", "rq/", "rr/", "ros_"))} <= {
        (*key, marks[key]) for key in wanted}, "there is nothing else"
    assert "enclave=/;" in peer.participants


def test_node_is_listed(arm):
    """ros2 node list, and what belongs to the node."""
    peer = arm.peer
    peer.read("ros_discovery_info", "rmw_dds_common/msg/ParticipantEntitiesInfo", late=True)
    info, = wait_for(lambda: peer.messages("ros_discovery_info", "rmw_dds_common/msg/ParticipantEntitiesInfo"), "the node")
    node, = info["node_entities_info_seq"]
    assert (node["node_namespace"], node["node_name"]) == ("/", "indurop")
    readers, writers = ([tuple(one["data"]) for one in node[side + "_gid_seq"]] for side in ("reader", "writer"))
    assert len(set(readers)) == 7 and len(set(writers)) == 10
    assert {one[:12] for one in readers + writers} == {tuple(info["gid"]["data"][:12])}, "they are of this participant"


def test_namespace_without_move(arm):
    """Another door, whose arm no client may move: there is nothing to write to."""
    peer = arm.peer
    door = start_door(arm.setting, "--namespace", "cell/left", name="other")
    wait_for(lambda: sum(one[1].startswith("rt/cell/left/") for one in peer.endpoints) == 2
             and sum(one[:2] == ("writer", "ros_discovery_info") for one in peer.endpoints) == 1, "its topics")
    assert {one[1] for one in peer.endpoints if "cell" in one[1]} == {"rt/cell/left/joint_states", "rt/cell/left/robot_description"}
    wait_for(lambda: any(one["node_entities_info_seq"][0]["node_namespace"] == "/cell/left" for one in
                         peer.messages("ros_discovery_info", "rmw_dds_common/msg/ParticipantEntitiesInfo")), "its node")
    door.terminate()
    assert door.wait(20) == 128 + 15


def test_joint_states(arm):
    peer = arm.peer
    peer.read("rt/joint_states", "sensor_msgs/msg/JointState")
    wait_for(lambda: len(peer.samples.get("rt/joint_states", [])) > 20, "joint states")
    state = peer.messages("rt/joint_states", "sensor_msgs/msg/JointState")[-1]
    assert state["name"] == [f"joint{i}" for i in range(1, 7)] and len(state["velocity"]) == 6
    assert all(abs(math.degrees(a) - b) < 0.01 for a, b in zip(state["position"], arm.joints()))
    assert abs(state["header"]["stamp"]["sec"] - time.time()) < 5
    peer.read("rt/robot_description", "std_msgs/msg/String", late=True)
    text, = wait_for(lambda: peer.messages("rt/robot_description", "std_msgs/msg/String"), "the description")
    assert text["data"] == (arm.setting.folder / "robot.urdf").read_text()


def test_power(arm):
    arm.connect()
    arm.rejects(trajectory((1, [0] * 6)), "the drives have no power")
    arm.call("enable")


def test_success(arm):
    """Each joint is where the trajectory has it, when it has it, and success comes after the arm stands."""
    start = arm.joints()
    target = [20, 10, -15, 30, 25, -40]
    middle = [(a + b) / 2 for a, b in zip(start, target)]
    arm.peer.samples["rt/joint_states"] = []
    began = time.monotonic()
    accepted, goal_id = arm.client.start(trajectory((0, start), (2, middle), (4, target)))
    assert accepted and arm.client.state(goal_id) in (None, 2)
    state, code, text = arm.client.result(goal_id)
    assert (state, code) == (SUCCEEDED, 0), text
    assert arm.stands() and time.monotonic() - began >= 4
    assert all(abs(a - b) < 0.6 for a, b in zip(arm.joints(), target)), arm.joints()
    assert arm.client.state(goal_id) == SUCCEEDED
    at_half = [one for one in arm.peer.messages("rt/joint_states", "sensor_msgs/msg/JointState")
               if all(abs(math.degrees(one["position"][k]) - middle[k]) < 2.5 for k in range(6))]
    assert at_half, "all joints pass the middle together"
    feedback = arm.client.feedback(goal_id)
    assert len(feedback) > 20 and feedback[-1]["joint_names"] == [f"joint{i}" for i in range(1, 7)]
    last = feedback[-1]
    assert all(abs(a - b - c) < 1e-9 for a, b, c in
               zip(last["desired"]["positions"], last["actual"]["positions"], last["error"]["positions"]))
    assert arm.client.result(goal_id)[0] == SUCCEEDED, "a result can be asked for again"


def test_refusals(arm):
    here = arm.joints()
    arm.rejects(trajectory((1, [0] * 5), names=[f"joint{i}" for i in range(1, 6)]), "joint 'joint6' is missing")
    arm.rejects(trajectory((1, here), names=[f"other{i}" for i in range(1, 7)]), "joint 'joint1' is missing")
    arm.rejects(trajectory(), "it has no points")
    arm.rejects(trajectory((1, here), (1, here)), "is not above")
    arm.rejects(trajectory((1, [200, 0, 0, 0, 0, 0])), "not within the ends of axis 1")
    arm.rejects(trajectory((1, [math.nan] * 6)), "not within the ends of axis 1")
    arm.rejects(trajectory((0, [one + 5 for one in here]), (2, here)), "away from where axis 1 is")
    arm.rejects(trajectory((0.2, [here[0] + 40] + here[1:])), "is too slow", goal_time_tolerance=ros2.duration(0.1))
    arm.rejects(trajectory((1, here), stamp=time.time() - 10), "in the past")
    zero = {"x": 0, "y": 0, "z": 0}
    free = {"transforms": [{"translation": zero, "rotation": {**zero, "w": 1}}], "velocities": [], "accelerations": [],
            "time_from_start": ros2.duration(1)}
    arm.rejects(trajectory((1, here)), "is missing", multi_dof_trajectory={
        "header": trajectory()["header"], "joint_names": ["floating"], "points": [free]})
    arm.setting.set("PLC_ROBOT::ROBOT_HOLD", 1)
    arm.rejects(trajectory((2, here)), "held")
    arm.setting.set("PLC_ROBOT::ROBOT_HOLD", 0)
    assert arm.stands()


def test_cancel(arm):
    here = arm.joints()
    far = [here[0] + 50] + here[1:]
    accepted, goal_id = arm.client.start(trajectory((10, far)))
    assert accepted
    wait_for(lambda: abs(arm.joints()[0] - here[0]) > 2, "it moves")
    assert not arm.client.start(trajectory((10, far)), goal_id=goal_id)[0], "its identifier is in use"
    answer = arm.client.cancel(goal_id)
    assert answer["return_code"] == 0 and [one["goal_id"]["uuid"] for one in answer["goals_canceling"]] == [goal_id]
    assert arm.client.result(goal_id)[0] == CANCELED
    assert arm.stands() and abs(arm.joints()[0] - far[0]) > 5
    assert arm.client.state(goal_id) == CANCELED
    assert arm.client.cancel(goal_id)["return_code"] == 3, "it has ended"
    assert arm.client.cancel(list(range(16)))["return_code"] == 2, "there is none"
    assert arm.client.cancel()["goals_canceling"] == []


def test_replace(arm):
    """A new goal cancels the one before; a request to cancel all, of another client, reaches the one that waits, too."""
    here = arm.joints()
    far = [here[0] + 50] + here[1:]
    accepted, first = arm.client.start(trajectory((10, far)))
    wait_for(lambda: accepted and not arm.stands(), "it moves")
    assert arm.client.run(trajectory((3, here)))[0] == SUCCEEDED
    assert arm.client.result(first)[0] == CANCELED
    for _ in range(5):
        accepted, first = arm.client.start(trajectory((10, far)))
        wait_for(lambda: accepted and not arm.stands(), "it moves again")
        waiting = arm.client.request(trajectory((3, here)))
        number = arm.client.send_goal.send(waiting)
        arm.client.cancel()
        answer = wait_for(lambda: arm.client.send_goal.answer(number), "an answer to the one that waits")
        assert arm.client.result(first)[0] == CANCELED
        if not answer["accepted"]:
            break
        # Two topics have no common order: the request to cancel has come first.
        assert arm.client.result(waiting["goal_id"]["uuid"])[0] == SUCCEEDED
    assert not answer["accepted"] and arm.stands()


def test_stops(arm):
    """What stops the robot ends the goal once the arm stands."""
    here = arm.joints()
    accepted, goal_id = arm.client.start(trajectory((10, [here[0] + 50] + here[1:])))
    wait_for(lambda: accepted and not arm.stands(), "it moves")
    arm.setting.set("PLC_ROBOT::I14", 0)
    state, code, text = arm.client.result(goal_id)
    assert state == ABORTED and code in (-1, -4) and text
    arm.setting.set("PLC_ROBOT::I14", 1)
    wait_for(lambda: arm.setting.number("PLC_ROBOT::EMERGENCY_STOP.bActive") == 0, "the circuit is closed")
    arm.call("reset")
    arm.call("enable")


def test_set_points(arm):
    """A stream moves the arm; it comes to rest when the stream stops, wherever its last set point is."""
    here = arm.joints()
    ros2.stream(arm.peer, POINTS, [trajectory((0.02, [here[0] + 0.2 * i] + here[1:], [10] + [0] * 5)) for i in range(100)], 0.02)
    wait_for(arm.stands, "it stands")
    assert 15 < arm.joints()[0] - here[0] < 21.5, arm.joints()[0] - here[0]
    far = [here[0] - 100] + here[1:]
    arm.setting.set("PLC_ROBOT::ROBOT_OVERRIDE", 10)
    arm.peer.write(POINTS, ros2.TRAJECTORY, trajectory((0.02, far)))  # nothing comes after it
    wait_for(lambda: "no set point came" in arm.setting.log_of_door(), "the stop is reported")
    wait_for(arm.stands, "it stands")
    assert arm.joints()[0] - far[0] > 50, "on its way"
    arm.setting.set("PLC_ROBOT::ROBOT_OVERRIDE", 100)
    arm.peer.write(POINTS, ros2.TRAJECTORY, trajectory((2, here), (4, far)))
    wait_for(lambda: not arm.stands(), "several points are a trajectory")
    arm.peer.write(POINTS, ros2.TRAJECTORY, trajectory())
    wait_for(arm.stands, "none stops it")


def test_bad_bytes(arm):
    """What is no message of the type is counted and moves nothing, and the next client is served."""
    here = arm.joints()
    good = arm.peer.codec.ask("encode", ros2.TRAJECTORY, value=trajectory((0.02, [here[0] + 20] + here[1:])))
    goal = arm.peer.codec.ask("encode", ros2.GOAL + "_SendGoal_Request", header=True, value={
        "guid": 1, "sequence": 1, **arm.client.request(trajectory((1, [here[0] + 20] + here[1:])))})
    bad = [good[:len(good) // 2], good[:24] + "ffffff7f" + good[32:], "00010000", "00070000" + good[8:]]
    for text in bad:
        arm.peer.say("write", POINTS, text)
    for text in (goal[:60], goal[:len(goal) - 40], "00010000" + "ff" * 200):
        arm.peer.say("write", f"rq/{ACTION}/_action/send_goalRequest", text)
    wait_for(lambda: "messages were ignored" in arm.setting.log_of_door(), "they are counted")
    assert arm.client.run(trajectory((1, here)))[0] == SUCCEEDED
    assert all(abs(a - b) < 0.6 for a, b in zip(arm.joints(), here)), "nothing else has moved it"


def test_other_middlewares(arm):
    """Clients of rmw_fastrtps_cpp have the number of a request elsewhere: what they send is not read, and the door says so."""
    stranger = ros2.Peer(sys.argv[5], domain(), arm.peer.codec)
    topic = f"rq/{ACTION}/_action/cancel_goalRequest"
    stranger.say("writer", topic, ros2.dds_type(ros2.CANCEL + "_Request"), "typehash=RIHS01_;")
    wait_for(lambda: stranger.matched.get(topic) == 1, "the service")
    accepted, goal_id = arm.client.start(trajectory((1, arm.joints())))
    request = {"guid": 1, "sequence": 1, "goal_info": {"goal_id": {"uuid": [0] * 16}, "stamp": ros2.duration(0)}}

    def reported():  # the door misses what is written before it has discovered the writer, which this side cannot see
        stranger.write(topic, ros2.CANCEL + "_Request", request, header=True)
        return "RMW_IMPLEMENTATION" in arm.setting.log_of_door()

    wait_for(reported, "it is reported")
    assert accepted and arm.client.result(goal_id)[0] == SUCCEEDED
    stranger.close()


def test_node_is_away(arm):
    """A goal ends with the node. What is wanted meanwhile is rejected, and not executed when the node is back."""
    here = arm.joints()
    accepted, goal_id = arm.client.start(trajectory((10, [here[0] + 50] + here[1:])))
    wait_for(lambda: accepted and not arm.stands(), "it moves")
    arm.setting.indurop("stop")
    state, _, text = arm.client.result(goal_id)
    assert state == ABORTED and "the node has ended" in text
    arm.rejects(trajectory((1, [0] * 6)), "the node does not run")
    arm.peer.write(POINTS, ros2.TRAJECTORY, trajectory((0.02, [10] * 6)))
    before = len(arm.setting.log_of_door())
    arm.setting.start_robot()
    wait_for(lambda: "an arm with 6 joints" in arm.setting.log_of_door()[before:], "the door continues")
    arm.call("enable")
    here = arm.joints()
    assert arm.client.run(trajectory((1, here)))[0] == SUCCEEDED
    assert all(abs(a - b) < 0.6 for a, b in zip(arm.joints(), here))


def test_door_is_killed(arm):
    """The goals of a door that was killed are unknown to the next one, which serves the same client."""
    here = arm.joints()
    accepted, goal_id = arm.client.start(trajectory((1, here)))
    assert accepted and arm.client.result(goal_id)[0] == SUCCEEDED
    arm.door.kill()
    arm.door.wait(20)
    number = arm.client.send_goal.send(arm.client.request(trajectory((1, [one + 5 for one in here]))))  # reaches no door
    (arm.setting.folder / "door.log").write_text("")
    arm.door = start_door(arm.setting, "--move")
    assert arm.client.get_result.call_again({"goal_id": {"uuid": goal_id}})["status"] == 0, "the goal is unknown"
    goal = arm.client.request(trajectory((1, here)))
    assert arm.client.send_goal.call_again(goal)["accepted"]
    assert arm.client.result(goal["goal_id"]["uuid"])[0] == SUCCEEDED
    assert arm.client.send_goal.answer(number) is None
    assert all(abs(a - b) < 0.6 for a, b in zip(arm.joints(), here))


def start_door(setting, *options, name="door"):
    return setting.start_door("--urdf", "robot.urdf", "--interface", "lo", "--domain", domain(), *options,
                              program="indurop-ros2", name=name)


def domain():
    return 20 + os.getpid() % 200


TESTS = (test_names_and_hashes, test_node_is_listed, test_namespace_without_move, test_joint_states, test_power, test_success, test_refusals, test_cancel,
         test_replace, test_stops, test_set_points, test_bad_bytes, test_other_middlewares,
         test_node_is_away, test_door_is_killed)


def main():
    if not shutil.which("npm") or not shutil.which("node"):
        skip("there is no npm here")
    packages = pathlib.Path(sys.argv[6]).absolute() / "judges"
    fetch(ros2.HERE / "judges", packages)
    codec = ros2.Codec(packages)
    peer = ros2.Peer(sys.argv[5], domain(), codec)
    try:
        with Setting(*sys.argv[1:5]) as setting:
            setting.start_robot()
            arm = Arm(setting, peer)
            arm.door = start_door(setting, "--move")
            for test in TESTS:
                print(test.__name__, flush=True)
                test(arm)
    finally:
        peer.close()
        codec.close()


main()
