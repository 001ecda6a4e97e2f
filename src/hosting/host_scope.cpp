// SPDX-License-Identifier: Apache-2.0
#include "src/hosting/host_scope.h"

namespace penumbra {
namespace {

void requireNoTransformFeedback() {
    GLboolean active = GL_FALSE, paused = GL_FALSE;
    glGetBooleanv(GL_TRANSFORM_FEEDBACK_ACTIVE, &active);
    glGetBooleanv(GL_TRANSFORM_FEEDBACK_PAUSED, &paused);
    if (active == GL_TRUE && paused == GL_FALSE) {
        throw Error(Error::Kind::badArgument,
                    "transform feedback is active: end or pause it before this call");
    }
}

}  // namespace

HostScope::HostScope(const Device::Internals& device) : ledger_(device.ledger) {
    device.requireContext();
    requireNoTransformFeedback();
    if (device.keepHostState) state_.emplace();
    setKnownState();
}

}  // namespace penumbra
