// SPDX-License-Identifier: Apache-2.0
// Says that it was built with headers of an InduRoP that does not exist yet.
asm(".pushsection .indurop.abi,\"\",@progbits\n.long 4711\n.popsection");

extern "C" void run() {}
