// SPDX-License-Identifier: Apache-2.0
#include "studio/scene/builtin/builtin.h"
#include "tests/support/technique_test.h"

namespace penumbra::studio {
namespace {

using VarianceTest = TechniqueTest;

TEST_F(VarianceTest, CastsTheShadowsThatRaysFind) {
    // In 8 % of the pixels where there is no shadow, in 4 % where it is the hard one of the light's centre.
    const Scene scene = makeBuiltin("two-boxes");
    EXPECT_LE(shareOfDifferentPixels(truth(scene), render("variance", scene), 0.2f), 0.03);
}

}  // namespace
}  // namespace penumbra::studio
