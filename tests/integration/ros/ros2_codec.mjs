// SPDX-License-Identifier: Apache-2.0
// Messages of ROS 2 by Foxglove's definitions (those of jazzy) and encoder: ros2_codec.mjs PACKAGES. Each line of stdin
// is a request {do: "encode" | "decode" | "hash", type, value | hex}; its answer is one line of JSON.
import {createHash} from "node:crypto";
import {createRequire} from "node:module";
import {createInterface} from "node:readline";

const require = createRequire(process.argv[2] + "/");
const {parse} = require("@foxglove/rosmsg");
const {ros2jazzy} = require("@foxglove/rosmsg-msgs-common");
const {MessageReader, MessageWriter} = require("@foxglove/rosmsg2-serialization");

// What Foxglove's package does not have, by the texts of the packages control_msgs 5, action_msgs 2, std_srvs 5 and
// rmw_dds_common 3.
const MORE = {
  "control_msgs/msg/JointTolerance": "string name\nfloat64 position\nfloat64 velocity\nfloat64 acceleration",
  "control_msgs/msg/JointComponentTolerance":
    "string joint_name\nuint16 component\nfloat64 position\nfloat64 velocity\nfloat64 acceleration",
  "control_msgs/action/FollowJointTrajectory_Goal": `trajectory_msgs/JointTrajectory trajectory
    trajectory_msgs/MultiDOFJointTrajectory multi_dof_trajectory
    control_msgs/JointTolerance[] path_tolerance
    control_msgs/JointComponentTolerance[] component_path_tolerance
    control_msgs/JointTolerance[] goal_tolerance
    control_msgs/JointComponentTolerance[] component_goal_tolerance
    builtin_interfaces/Duration goal_time_tolerance`,
  "control_msgs/action/FollowJointTrajectory_Result": "int32 error_code\nstring error_string",
  "control_msgs/action/FollowJointTrajectory_Feedback": `std_msgs/Header header
    string[] joint_names
    trajectory_msgs/JointTrajectoryPoint desired
    trajectory_msgs/JointTrajectoryPoint actual
    trajectory_msgs/JointTrajectoryPoint error
    string[] multi_dof_joint_names
    trajectory_msgs/MultiDOFJointTrajectoryPoint multi_dof_desired
    trajectory_msgs/MultiDOFJointTrajectoryPoint multi_dof_actual
    trajectory_msgs/MultiDOFJointTrajectoryPoint multi_dof_error`,
  "control_msgs/action/FollowJointTrajectory_SendGoal_Request":
    "unique_identifier_msgs/UUID goal_id\ncontrol_msgs/FollowJointTrajectory_Goal goal",
  "control_msgs/action/FollowJointTrajectory_SendGoal_Response": "bool accepted\nbuiltin_interfaces/Time stamp",
  "control_msgs/action/FollowJointTrajectory_GetResult_Request": "unique_identifier_msgs/UUID goal_id",
  "control_msgs/action/FollowJointTrajectory_GetResult_Response":
    "int8 status\ncontrol_msgs/FollowJointTrajectory_Result result",
  "control_msgs/action/FollowJointTrajectory_FeedbackMessage":
    "unique_identifier_msgs/UUID goal_id\ncontrol_msgs/FollowJointTrajectory_Feedback feedback",
  "action_msgs/srv/CancelGoal_Request": "action_msgs/GoalInfo goal_info",
  "action_msgs/srv/CancelGoal_Response": "int8 return_code\naction_msgs/GoalInfo[] goals_canceling",
  "std_srvs/srv/Trigger_Request": "uint8 structure_needs_at_least_one_member",
  "std_srvs/srv/Trigger_Response": "bool success\nstring message",
  "rmw_dds_common/msg/Gid": "uint8[16] data",
  "rmw_dds_common/msg/NodeEntitiesInfo":
    "string<=256 node_namespace\nstring<=256 node_name\nrmw_dds_common/Gid[] reader_gid_seq\nrmw_dds_common/Gid[] writer_gid_seq",
  "rmw_dds_common/msg/ParticipantEntitiesInfo":
    "rmw_dds_common/Gid gid\nrmw_dds_common/NodeEntitiesInfo[] node_entities_info_seq",
};

const short = (name) => name.replace(/\/(msg|srv|action)\//, "/");
const full = {};  // names as ROS 2 has them, by the short ones
const known = {...ros2jazzy};
for (const name of Object.keys(ros2jazzy)) {
  full[name] = name.replace("/", "/msg/");
}
for (const [name, text] of Object.entries(MORE)) {
  full[short(name)] = name;
  known[short(name)] = {...parse(text, {ros2: true, skipTypeFixup: true})[0], name: short(name)};
}
const TIMES = {time: "builtin_interfaces/Time", duration: "builtin_interfaces/Duration"};

function parts(name, found = new Set()) {
  found.add(name);
  for (const field of known[name].definitions) {
    if (field.isComplex && !found.has(field.type)) {
      parts(field.type, found);
    }
  }
  return found;
}
// A service of rmw_cyclonedds_cpp has the number of the request before its fields.
const HEADER = parse("uint64 guid\nint64 sequence", {ros2: true})[0].definitions;
function definitions(type, header) {
  const [first, ...others] = [...parts(short(type))].map((name) => known[name]);
  return [{...first, definitions: [...(header ? HEADER : []), ...first.definitions]}, ...others];
}

// REP 2011: the SHA-256 of the description of a type, with those of the types in it.
const IDS = {int8: 2, uint8: 3, int16: 4, uint16: 5, int32: 6, uint32: 7, int64: 8, uint64: 9, float32: 10, float64: 11,
             bool: 15, string: 17};
const SECONDS = [["sec", 6], ["nanosec", 7]].map(([name, type_id]) => ({name, type: {type_id, capacity: 0, string_capacity: 0, nested_type_name: ""}}));
const nested = (field) => field.isComplex ? field.type : TIMES[field.type] ?? "";
function described(name) {
  if (Object.values(TIMES).includes(name)) {
    return {type_name: name.replace("/", "/msg/"), fields: SECONDS};
  }
  const fields = known[name].definitions.filter((one) => !one.isConstant).map((one) => {
    const inner = nested(one);
    const id = one.upperBound !== undefined ? 21 : inner ? 1 : IDS[one.type];
    return {name: one.name, type: {
      type_id: id + (one.arrayLength !== undefined ? 48 : one.isArray ? 144 : 0), capacity: one.arrayLength ?? 0,
      string_capacity: one.upperBound ?? 0, nested_type_name: inner ? full[inner] ?? inner.replace("/", "/msg/") : ""}};
  });
  return {type_name: full[name], fields};
}
function hash(type) {
  const names = parts(short(type));
  for (const name of [...names]) {
    known[name].definitions.map((one) => TIMES[one.type]).filter(Boolean).forEach((one) => names.add(one));
  }
  names.delete(short(type));
  const others = [...names].map(described).sort((a, b) => a.type_name < b.type_name ? -1 : 1);
  const text = JSON.stringify({type_description: described(short(type)), referenced_type_descriptions: others}, null, 1)
    .replace(/\n */g, " ").replace(/([[{]) /g, "$1").replace(/ ([\]}])/g, "$1");
  return "RIHS01_" + createHash("sha256").update(text).digest("hex");
}

const plain = (key, value) => typeof value === "bigint" ? Number(value) : ArrayBuffer.isView(value) ? [...value] : value;
const ACTIONS = {
  encode: ({type, value, header}) => {
    const bytes = new MessageWriter(definitions(type, header)).writeMessage(value);
    return Buffer.from(bytes.buffer, bytes.byteOffset, bytes.byteLength).toString("hex");
  },
  decode: ({type, hex, header}) => new MessageReader(definitions(type, header)).readMessage(Buffer.from(hex, "hex")),
  hash: ({type}) => hash(type),
};
for await (const line of createInterface({input: process.stdin})) {
  // Python writes what is no number as NaN, which JSON does not have.
  const asked = JSON.parse(line.replace(/\bNaN\b/g, '"NaN"'), (key, value) => value === "NaN" ? NaN : value);
  try {
    console.log(JSON.stringify({answer: ACTIONS[asked.do](asked)}, plain));
  } catch (error) {
    console.log(JSON.stringify({error: String(error.stack)}));
  }
}
