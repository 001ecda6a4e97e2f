// SPDX-License-Identifier: Apache-2.0
#include "studio/scene/builtin/builtin.h"
#include "tests/support/technique_test.h"

namespace penumbra::studio {
namespace {

using ExactVisibilityTest = TechniqueTest;

}  // namespace
}  // namespace penumbra::studio
