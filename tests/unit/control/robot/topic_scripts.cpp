// SPDX-License-Identifier: Apache-2.0
// What the pictures of the topics show.
#include "topic_picture.h"

namespace indurop::robot {
namespace {

constexpr const char* kGreen = "#2e8b45";
constexpr const char* kTeal = "#007a8a";
constexpr const char* kBrown = "#8a5a2b";

// Long: a list.
std::vector<PictureScript> scripts_of_paths() {
  return {
      {"palletising",
       "palletising",
       "Palletising: two layers of six parts",
       'y',
       Views::SideAndAbove,
       {{"O8", "gripper", kGreen, true, true}},
       {{"O8 = 1", 1, "the gripper takes the first part from the conveyor"},
        {"O8 = 0", 1, "and places it at CORNER: x {x}, y {y}, z {z}"},
        {"O8 = 0", 6, "the last part of the first layer: x {x}, y {y}, z {z}"},
        {"O8 = 0", 7, "the first part of the second layer, turned by 90 degrees: x {x}, y {y}, z {z}"}}},
      {"tools",
       "tools",
       "Tools: a gripper is exchanged for a screwdriver",
       'y',
       Views::SideAndAbove,
       {{"O8", "tool changer", kGreen}},
       {{"at MOVL HERE OFFSET TOOL 0, 0, -80", 1,
         "TOOL FLANGE: the gripper stays in its place. From here on, the path is that of the flange, which was 120 mm "
         "above "
         "the tip"},
        {"at MOVJ PLACE2 OFFSET 0, 0, 80", 1,
         "TOOL driver: from here on, it is the path of the tip that the screwdriver will have"},
        {"O8 = 1", 1, "the tool changer locks: the arm holds the screwdriver, and lifts it along its axis"},
        {"at MOVL SCREW OFFSET 0, 0, 30 - 10 * turn RPY 0, 0, 30 * turn SPEED 50 mm/s", 2,
         "three times 10 mm down, turning by 30 degrees"}}},
      {"interrupts",
       "interrupts",
       "Interrupts: a bad part is thrown out on the way",
       'y',
       Views::Side,
       {{"I3", "bad part", kTeal, false}, {"O11", "ejector", kGreen}},
       {{"I3 = 1", 1, "I3 becomes true: the robot comes to rest on its path"},
        {"job eject", 1, "at rest at y {y}. The job 'eject' begins; BACK is this place"},
        {"O11 = 1", 1, "80 mm above BACK the ejector is on for 0.1 s"},
        {"at MOVL TO SPEED 200 mm/s", 2, "'eject' has ended: the rest of MOVL TO"}}},
      {"glue",
       "glue",
       "Glue: a bead around a rectangle",
       'y',
       Views::AboveAndSide,
       {{"O10", "valve", kGreen, true, true}},
       {{"O10 = 1", 1, "the valve opens 5 mm after G1, while the tip moves"},
        {"O10 = 0", 1, "the valve closes 5 mm before G1"}}},
      {"bead",
       "glue",
       "Glue: an even bead with FOLLOW",
       'y',
       Views::AboveAndSide,
       {{"GLUE", "flow", kGreen, true, true, true}},
       {{"at MOVL G2", 1, "FOLLOW is on: from here on, GLUE is 0.02 times the speed of the tip"},
        {"at MOVL G1 OFFSET 0, 0, 50 SPEED 300 mm/s", 1, "FOLLOW OFF at G1: GLUE is 0"}}},
      {"spline",
       "spline",
       "Spline: a smooth curve, and a wave of computed points",
       'y',
       Views::SideAndAbove,
       {},
       {{"at MOVS S1 S2 S3 SPEED 200 mm/s", 1, "the spline begins: through S1 and S2 to S3 without a stop"},
        {"at MOVL S3 OFFSET 20 * SIN(i * 12), -10 * i, 0 SPEED 300 mm/s", 1,
         "the wave begins: 31 computed points, 30 lines that are one path"}}},
      {"seam",
       "seam",
       "Seam: the torch follows what a sensor measures",
       'x',
       Views::SideAndAbove,
       {{"DY", "sensor, mm", kTeal, false, false, true}, {"WIRE", "flow of wire", kGreen, true, false, true}},
       {{"at MOVL END1 SPEED 40 mm/s", 1, "CORRECT is on: the line is shifted by DY, across the seam"},
        {"at MOVL HERE OFFSET 0, 0, 50", 1,
         "the end of the seam, 12 mm away from the taught line (dashed); CORRECT is off"}},
       false,
       {{"BEGIN", "END1"}}},
      {"external_axis",
       "external_axis",
       "External axis: an arm on a rail",
       'x',
       Views::SideAndAbove,
       {},
       {{"at MOVL HERE OFFSET 0, 0, 50", 1, "a line: 50 mm up, the rail does not move"},
        {"at MOVJ RIGHT", 2, "MOVJ: the rail and the joints arrive together"}},
       true},
      {"machine_tending",
       "machine_tending",
       "Machine tending: the kind of a part decides where it goes",
       'y',
       Views::SideAndAbove,
       {{"O1", "open the door", kGreen},
        {"I1", "door is open", kTeal, false},
        {"O2", "chuck", kBrown},
        {"kind", "", kBrown, true, false, true}},
       {{"O1 = 1", 1, "a part of kind 1: O1 opens the door, the robot waits for I1"},
        {"I1 = 1", 1, "the door is open: the part goes into the chuck"},
        {"O2 = 1", 1, "the chuck closes"},
        {"O1 = 0", 1, "the robot is out of the machine: the door may close"},
        {"kind = 2", 1, "it is closed: the next part, of kind 2, goes the same way"},
        {"at MOVJ SCRAP", 1, "kind 3 goes to the scrap"},
        {"kind = 4", 1, "kind 4 is only counted"}}},
  };
}

std::vector<PictureScript> scripts_of_times() {
  return {
      {"search",
       "search",
       "Search: the height of a stack",
       'y',
       Views::SideAndHeight,
       {{"I4", "sensor", kTeal, false}},
       {{"I4 = 1", 1, "the sensor becomes true at z {z}, on the way to BOTTOM at 200 mm/s; the robot brakes"},
        {"at MOVL FOUND OFFSET 0, 0, 10", 1, "at rest at z {z}; from here to 10 mm above the place that was found"},
        {"at SEARCH BOTTOM UNTIL I4 SPEED 10 mm/s", 1, "at z {z}, the second search begins, at 10 mm/s"},
        {"I4 = 1", 2, "the top of the stack is at z {z}"}}},
      {"timeouts",
       "timeouts",
       "Time-outs: up to three tries to close a gripper",
       'y',
       Views::None,
       {{"O8", "close", kGreen}, {"I5", "it is closed", kTeal, false}},
       {{"O8 = 1", 1, "the first try: PULSE switches O8 on for 200 ms, and the job waits for I5"},
        {"message the gripper does not close, try 1", 1,
         "0.3 s without I5: the operator reads 'the gripper does not close, try 1'; the second try begins"},
        {"I5 = 1", 1, "the gripper is closed: the wait ends at once, and EXIT leaves the loop"}}},
      {"subprograms",
       "subprograms",
       "Subprograms: heights that another job computes",
       'y',
       Views::SideAndHeight,
       {},
       {{"rest", 1, "CALL height 1, 20 returns 20: z {z}"},
        {"rest", 2, "CALL height 2, 20 returns 40: z {z}"},
        {"rest", 3, "CALL height 3, 20 returns 60, and CALL height 4, 20 the same: z {z}"}}},
      {"dialogue",
       "dialogue",
       "Dialogue: the operator answers questions",
       'y',
       Views::Side,
       {{"I6", "button", kTeal, false}},
       {{"message load 4 parts, then press I6", 1, "message: load 4 parts, then press I6"},
        {"question Is the door closed?", 1, "I6 was pressed. Is the door closed? yes"},
        {"question Which tray has the parts?", 1, "Which tray has the parts? right"},
        {"question How many parts are in it?", 1, "How many parts are in it? 12"},
        {"question How high are they, in mm?", 1, "How high are they, in mm? 22.5"},
        {"question Which kind?", 1, "Which kind? No answer within 2 s: ELSE, kind = 1"},
        {"question Begin with 12 parts?", 1, "Begin with 12 parts? No answer within 1 s: RECOVER, sure = 1"},
        {"at MOVJ RIGHT OFFSET 0, 0, height", 1, "to the right tray, 22.5 mm higher"}}},
      {"recovery",
       "recovery",
       "Recovery: a job handles its errors",
       'y',
       Views::SideAndHeight,
       {},
       {{"at MOVL HERE OFFSET TOOL 0, 0, -20", 1,
         "the first pass: MOVL FAR is rejected, since FAR is out of reach. RECOVER retracts the tool by 20 mm"},
        {"at MOVL OVER OFFSET 0, 0, -100", 2, "the second pass: 100 mm down"},
        {"at MOVL HERE OFFSET TOOL 0, 0, -20", 2,
         "RAISE 101: the part is missing. RECOVER retracts the tool by 20 mm, now from here"},
        {"at reached = i", 2, "the third pass has no error"}}},
  };
}

}  // namespace

const std::vector<PictureScript>& picture_scripts() {
  static const std::vector<PictureScript> kScripts = [] {
    std::vector<PictureScript> all = scripts_of_paths();
    for (PictureScript& script : scripts_of_times()) {
      all.push_back(std::move(script));
    }
    return all;
  }();
  return kScripts;
}

}  // namespace indurop::robot
