// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "src/techniques/common/depth_map.h"
#include "src/techniques/common/view_constants.h"
#include "src/techniques/shadow_width_map/shadow_width_io.h"

namespace penumbra::shadow_width_map {

/// What all passes get that resolve visibility: see receiver.glsl.
struct ReceiverBinding {
    const ViewBinding& view;
    const DepthMap& depthMap;
    const gl::ConstantBuffer<ShadowWidthConstants>& constants;
    const VisibilityBuffer& out;
    bool hasNormals;

    void bindTo(gl::Pass& pass) const {
        pass.bind(view).bind(depthMap).bind("ShadowWidthBlock", constants).bind("visibility", imageOf(out));
    }
};

}  // namespace penumbra::shadow_width_map
