# SPDX-License-Identifier: Apache-2.0
"""Programs of ROS 2 as indurop-ros2 meets them: on the wire by Fast DDS (ros2_peer.cpp), their messages by Foxglove's
packages (ros2_codec.mjs). The rules of services and actions are those of rmw_cyclonedds_cpp and rcl_action."""

import itertools
import json
import math
import os
import pathlib
import re
import subprocess
import threading
import time
import uuid

from ros_harness import wait_for

HERE = pathlib.Path(__file__).parent
GOAL, CANCELED, SUCCEEDED, ABORTED = "control_msgs/action/FollowJointTrajectory", 5, 4, 6
TRAJECTORY, TRIGGER, CANCEL = "trajectory_msgs/msg/JointTrajectory", "std_srvs/srv/Trigger", "action_msgs/srv/CancelGoal"


class Codec:
    """Encodes and decodes messages, and knows the hashes of their types."""

    def __init__(self, packages):
        self.node = subprocess.Popen(["node", HERE / "ros2_codec.mjs", packages], stdin=subprocess.PIPE,
                                     stdout=subprocess.PIPE, text=True)

    def ask(self, what, kind, **more):
        self.node.stdin.write(json.dumps({"do": what, "type": kind, **more}) + "\n")
        self.node.stdin.flush()
        answer = json.loads(self.node.stdout.readline())
        assert "answer" in answer, answer
        return answer["answer"]

    def close(self):
        self.node.stdin.close()
        self.node.wait(20)


def dds_type(kind):
    return re.sub(r"(\w+)/(\w+)/(\w+)", r"\1::\2::dds_::\3_", kind)


class Peer:
    """A participant in the network."""

    def __init__(self, program, domain, codec):
        self.codec = codec
        self.samples, self.matched, self.endpoints, self.participants = {}, {}, set(), []
        self.process = subprocess.Popen([program, str(domain)], stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True)
        self.listener = threading.Thread(target=self.listen, daemon=True)
        self.listener.start()

    def listen(self):
        for line in self.process.stdout:
            word, *rest = line.split()
            if word == "sample":
                self.samples.setdefault(rest[0], []).append(rest[1])
            elif word == "matched":
                self.matched[rest[0]] = int(rest[1])
            elif word == "endpoint":
                self.endpoints.add(tuple(rest))
            elif word == "participant":
                self.participants.append(rest[0])

    def say(self, *words):
        self.process.stdin.write(" ".join(words) + "\n")
        self.process.stdin.flush()

    def read(self, topic, kind, late=False, mark="-"):
        self.say("late" if late else "reader", topic, dds_type(kind), mark)

    def write(self, topic, kind, value, header=False):
        self.say("write", topic, self.codec.ask("encode", kind, value=value, header=header))

    def messages(self, topic, kind, header=False):
        return [self.codec.ask("decode", kind, hex=one, header=header) for one in self.samples.get(topic, [])]

    def close(self):
        self.process.stdin.close()
        self.process.wait(20)
        self.listener.join(20)


class ServiceClient:
    """Finds its replies by the number that it gave, among those of all clients."""

    numbers = itertools.count(1)

    def __init__(self, peer, name, kind):
        self.peer, self.kind = peer, kind
        self.request, self.reply = f"rq/{name}Request", f"rr/{name}Reply"
        self.guid = next(self.numbers) + (os.getpid() << 8)
        mark = f"clientid=1.f.{self.guid:x};typehash="
        peer.read(self.reply, kind + "_Response", mark=mark + peer.codec.ask("hash", kind + "_Response") + ";")
        peer.say("writer", self.request, dds_type(kind + "_Request"), mark + peer.codec.ask("hash", kind + "_Request") + ";")
        wait_for(lambda: peer.matched.get(self.request) == 1 and peer.matched.get(self.reply) == 1, f"the service {name}")

    def send(self, value):
        number = next(self.numbers)
        self.peer.write(self.request, self.kind + "_Request", {"guid": self.guid, "sequence": number, **value}, header=True)
        return number

    def answer(self, number):
        """The reply to this request; None: there is none yet."""
        return next((one for one in self.peer.messages(self.reply, self.kind + "_Response", header=True)
                     if (one["guid"], one["sequence"]) == (self.guid, number)), None)

    def call(self, value):
        number = self.send(value)
        return wait_for(lambda: self.answer(number), f"a reply of {self.request}")

    def call_again(self, value, every_s=1):
        """A service that has just come may not know the client when it asks."""
        numbers = []

        def answered():
            if time.monotonic() >= begin + every_s * len(numbers):
                numbers.append(self.send(value))
            return next(filter(None, map(self.answer, numbers)), None)
        begin = time.monotonic()
        return wait_for(answered, f"a reply of {self.request}")


def trajectory(*points, names=None, stamp=0):
    """Points are (time, joints in degrees) or (time, joints, velocities)."""
    def point(at, joints, velocities=()):
        return {"positions": [math.radians(one) for one in joints], "velocities": [math.radians(one) for one in velocities],
                "accelerations": [], "effort": [], "time_from_start": duration(at)}
    return {"header": {"stamp": duration(stamp), "frame_id": ""}, "joint_names": names or [f"joint{i}" for i in range(1, 7)],
            "points": [point(*one) for one in points]}


def duration(seconds):
    return {"sec": int(seconds), "nsec": round((seconds % 1) * 1e9)}


class ActionClient:
    def __init__(self, peer, name):
        self.peer, self.name = peer, name
        self.send_goal = ServiceClient(peer, f"{name}/_action/send_goal", GOAL + "_SendGoal")
        self.cancel_goal = ServiceClient(peer, f"{name}/_action/cancel_goal", CANCEL)
        self.get_result = ServiceClient(peer, f"{name}/_action/get_result", GOAL + "_GetResult")
        peer.read(f"rt/{name}/_action/feedback", GOAL + "_FeedbackMessage")
        peer.read(f"rt/{name}/_action/status", "action_msgs/msg/GoalStatusArray", late=True)
        wait_for(lambda: peer.matched.get(f"rt/{name}/_action/status") == 1, "the states")

    def request(self, path, goal_id=None, **more):
        goal = {"trajectory": path, "multi_dof_trajectory": {"header": path["header"], "joint_names": [], "points": []},
                "path_tolerance": [], "component_path_tolerance": [], "goal_tolerance": [], "component_goal_tolerance": [],
                "goal_time_tolerance": duration(0), **more}
        return {"goal_id": {"uuid": goal_id or list(uuid.uuid4().bytes)}, "goal": goal}

    def start(self, path, **more):
        """Sends a goal. Returns whether it was accepted, and its identifier."""
        request = self.request(path, **more)
        return self.send_goal.call(request)["accepted"], request["goal_id"]["uuid"]

    def result(self, goal_id):
        """Waits for the end of the goal: state, code, text."""
        answer = self.get_result.call({"goal_id": {"uuid": goal_id}})
        return answer["status"], answer["result"]["error_code"], answer["result"]["error_string"]

    def run(self, path, **more):
        accepted, goal_id = self.start(path, **more)
        assert accepted
        return self.result(goal_id)

    def cancel(self, goal_id=None, stamp=0):
        return self.cancel_goal.call({"goal_info": {"goal_id": {"uuid": goal_id or [0] * 16}, "stamp": duration(stamp)}})

    def state(self, goal_id):
        """The last published one of a goal; None: it is not among the states."""
        last = self.peer.messages(f"rt/{self.name}/_action/status", "action_msgs/msg/GoalStatusArray")[-1]
        return next((one["status"] for one in last["status_list"] if one["goal_info"]["goal_id"]["uuid"] == goal_id), None)

    def feedback(self, goal_id):
        return [one["feedback"] for one in self.peer.messages(f"rt/{self.name}/_action/feedback", GOAL + "_FeedbackMessage")
                if one["goal_id"]["uuid"] == goal_id]


def stream(peer, topic, paths, period_s):
    """Publishes each path when it is due."""
    begin = time.monotonic()
    for i, path in enumerate(paths):
        wait_for(lambda due=begin + i * period_s: time.monotonic() >= due, "its time")
        peer.write(topic, TRAJECTORY, path)
