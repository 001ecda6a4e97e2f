#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Makes a new room from nothing: ./dev room FOLDER TECHNIQUE, for instance ./dev room variance_map variance
# The technique in it says that everything is lit, and its test fails until it casts a shadow.
set -euo pipefail
cd "$(dirname "$0")/../.."

fail() {
    echo "$1" >&2
    exit 2
}
room=${1:-} technique=${2:-}
[[ $room =~ ^[a-z][a-z0-9_]*$ ]] || fail "FOLDER must be snake_case: ./dev room FOLDER TECHNIQUE"
[[ $technique =~ ^[a-z][a-z0-9-]*$ ]] || fail "TECHNIQUE must be lower case, with hyphens: ./dev room FOLDER TECHNIQUE"
folder=src/techniques/$room
[ ! -e "$folder" ] || fail "$folder is there already"
! grep -q "{\"$technique\"," src/catalog.cpp || fail "there is a technique '$technique' already"
file=${technique//-/_}
class=$(sed -E 's/(^|-)([a-z])/\U\2/g' <<<"$technique")

mkdir "$folder"
cat >"$folder/README.md" <<EOF
# $technique

*Paper: author, title, venue, year. What is theirs, what departs from it and why, what is measured, where it fails.*
EOF
cat >"$folder/CMakeLists.txt" <<EOF
# SPDX-License-Identifier: Apache-2.0
target_sources(penumbra PRIVATE $file.cpp)
penumbra_shaders(penumbra $file.comp.glsl)

if(PENUMBRA_TESTS)
    penumbra_test(${room}_test SLOWLY_IN_BOTH_PROFILES SOURCES ${file}_test.cpp LIBRARIES penumbra_test_support)
endif()
EOF
cat >"$folder/$file.h" <<EOF
// SPDX-License-Identifier: Apache-2.0
// The paper: author, title, venue, year.
#pragma once

#include "penumbra/technique.h"
#include "src/gl/pass_timers.h"
#include "src/gl/program.h"
#include "src/techniques/common/view_constants.h"

namespace penumbra::$room {

class $class final : public Technique {
  public:
    explicit $class(Device& device);

    void describe(ParameterVisitor& visitor) override;
    void render(const ShadowInputs& inputs, VisibilityBuffer& out) override;
    Statistics statistics() const override;

  private:
    gl::Program resolve_;
    ViewBinding view_;
    gl::PassTimers timers_;
};

}  // namespace penumbra::$room
EOF
cat >"$folder/$file.cpp" <<EOF
// SPDX-License-Identifier: Apache-2.0
#include "$folder/$file.h"

#include "src/device/device_internals.h"

namespace penumbra::$room {

$class::$class(Device& device) : resolve_(internalsOf(device).shaders, {"$folder/$file.comp.glsl"}) {}

void $class::describe(ParameterVisitor&) {}

void $class::render(const ShadowInputs& inputs, VisibilityBuffer& out) {
    const auto pass = timers_.pass("$technique/resolve");
    view_.fill(inputs.view, lightFromWorld(inputs));
    gl::Pass(resolve_).bind(view_).bind("visibility", imageOf(out)).dispatchPixels(out.width_px(), out.height_px());
}

Statistics $class::statistics() const {
    return {.counts = {}, .passes = passTimes(timers_)};
}

}  // namespace penumbra::$room
EOF
cat >"$folder/$file.comp.glsl" <<EOF
// SPDX-License-Identifier: Apache-2.0
#version 450
#include "src/techniques/common/view.glsl"
layout(local_size_x = 8, local_size_y = 8) in;
uniform writeonly image2D visibility;

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(pixel, view.size_px.xy))) return;
    Receiver receiver;
    float seen = loadReceiver(pixel, receiver) ? 1.0 : 1.0;  // the first is for you to find
    imageStore(visibility, pixel, vec4(seen));
}
EOF
cat >"$folder/${file}_test.cpp" <<EOF
// SPDX-License-Identifier: Apache-2.0
#include "studio/scene/builtin/builtin.h"
#include "tests/support/technique_test.h"

namespace penumbra::studio {
namespace {

using ${class}Test = TechniqueTest;

TEST_F(${class}Test, CastsTheShadowsThatRaysFind) {
    // In 8 % of the pixels where there is no shadow, in 4 % where it is the hard one of the light's centre.
    const Scene scene = makeBuiltin("two-boxes");
    EXPECT_LE(shareOfDifferentPixels(truth(scene), render("$technique", scene), 0.2f), 0.05);
}

}  // namespace
}  // namespace penumbra::studio
EOF

# The catalog lists techniques; CMake finds rooms by itself.
sed -i "0,/^#include \"src\/techniques\//s//#include \"src\/techniques\/$room\/$file.h\"\n&/" src/catalog.cpp
sed -i "/^constexpr std::array entries/,/^};\$/ s/^};\$/    Entry{{\"$technique\", \"what it does, in one line (author year)\"}, 0.30f, make<$room::$class>},\n};/" \
    src/catalog.cpp

cat <<EOF
Made $folder, and two lines in src/catalog.cpp. (Without both there is no such room.)
Now, until it passes:
    ./dev build -DPENUMBRA_TESTS=ON && build/${room}_test
What to do then: docs/adding-a-technique.md
EOF
