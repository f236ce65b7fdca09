// SPDX-License-Identifier: Apache-2.0
// The verbs, one per file of this folder.

#pragma once

#include "tools/cli/command/verb.h"

namespace indurop::tools {

extern const Verb kAgeVerb;
extern const Verb kAlarmsVerb;
extern const Verb kAuditVerb;
extern const Verb kBlackboxVerb;
extern const Verb kBoardsVerb;
extern const Verb kChartVerb;
extern const Verb kCheckVerb;
extern const Verb kCleanVerb;
extern const Verb kDemoVerb;
extern const Verb kDeployVerb;
extern const Verb kDiffVerb;
extern const Verb kDoctorVerb;
extern const Verb kExplainVerb;
extern const Verb kForceVerb;
extern const Verb kForcesVerb;
extern const Verb kGetVerb;
extern const Verb kHistoryVerb;
extern const Verb kHzVerb;
extern const Verb kIoVerb;
extern const Verb kJitterVerb;
extern const Verb kKeysVerb;
extern const Verb kLockVerb;
extern const Verb kLogVerb;
extern const Verb kNewVerb;
extern const Verb kNodesVerb;
extern const Verb kOverrunsVerb;
extern const Verb kPackVerb;
extern const Verb kPackageVerb;
extern const Verb kPlanVerb;
extern const Verb kPlatformVerb;
extern const Verb kPlcVerb;
extern const Verb kPullVerb;
extern const Verb kRecipeVerb;
extern const Verb kRobotVerb;
extern const Verb kRecordVerb;
extern const Verb kRecordingVerb;
extern const Verb kReloadVerb;
extern const Verb kReplayVerb;
extern const Verb kResetVerb;
extern const Verb kRestartVerb;
extern const Verb kRollbackVerb;
extern const Verb kRunVerb;
extern const Verb kScopeVerb;
extern const Verb kServeVerb;
extern const Verb kSetVerb;
extern const Verb kStartVerb;
extern const Verb kStatusVerb;
extern const Verb kStopVerb;
extern const Verb kTestVerb;
extern const Verb kStreamVerb;
extern const Verb kTopVerb;
extern const Verb kTypeofVerb;
extern const Verb kUnforceVerb;
extern const Verb kUsersVerb;
extern const Verb kVarsVerb;
extern const Verb kVerifyVerb;
extern const Verb kWatchVerb;

}  // namespace indurop::tools
