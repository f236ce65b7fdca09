// SPDX-License-Identifier: Apache-2.0
// What programs of a test have started and left behind: the test inherits it, and ends it.

#pragma once

namespace indurop::test {

// From now on a descendant of this process whose parent ends becomes its child.
void inherit_orphans();

// Kills all children of this process, and what it inherits when they end, and waits for them; false if one does not
// end. No thread may start or wait for a program meanwhile.
bool end_children();

}  // namespace indurop::test
