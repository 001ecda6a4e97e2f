// SPDX-License-Identifier: Apache-2.0
#include "penumbra/technique.h"
#include "src/gl/gl.h"

namespace penumbra {

void prewarm(Device& device, Technique& technique, const ShadowInputs& inputs) {
    VisibilityBuffer nowhere(device, inputs.view.width_px, inputs.view.height_px,
                             inputs.light.radianceTexture != 0);
    // What a first frame leaves to be read in the second may decide what that one needs.
    for (int frame = 0; frame < 2; ++frame) technique.render(inputs, nowhere);
    glFinish();
}

}  // namespace penumbra
