// SPDX-License-Identifier: Apache-2.0
#include "tools/cli/verbs/verbs.h"

#include <array>

namespace indurop::tools {

std::span<const Verb> all_verbs() {
  // In the order `indurop help` shows them.
  static const std::array kVerbs{
      kDemoVerb,    kNewVerb,    kCheckVerb,    kPlanVerb,    kPlcVerb,      kTestVerb,     kKeysVerb,   kUsersVerb,
      kIoVerb,      kDoctorVerb, kRunVerb,      kStopVerb,    kStartVerb,    kRestartVerb,  kReloadVerb, kResetVerb,
      kCleanVerb,   kStatusVerb, kNodesVerb,    kTopVerb,     kAlarmsVerb,   kAuditVerb,    kServeVerb,  kVarsVerb,
      kGetVerb,     kSetVerb,    kForceVerb,    kUnforceVerb, kForcesVerb,   kLockVerb,     kRecipeVerb, kRobotVerb,
      kWatchVerb,   kScopeVerb,  kStreamVerb,   kChartVerb,   kHzVerb,       kTypeofVerb,   kRecordVerb, kRecordingVerb,
      kReplayVerb,  kJitterVerb, kOverrunsVerb, kExplainVerb, kAgeVerb,      kBlackboxVerb, kLogVerb,    kPackVerb,
      kPackageVerb, kDeployVerb, kPullVerb,     kDiffVerb,    kRollbackVerb, kHistoryVerb,  kVerifyVerb, kBoardsVerb,
      kPlatformVerb};
  return kVerbs;
}

}  // namespace indurop::tools
