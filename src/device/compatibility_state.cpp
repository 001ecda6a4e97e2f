// SPDX-License-Identifier: Apache-2.0
#include "src/device/compatibility_state.h"

namespace penumbra {
namespace {

struct Capability {
    GLenum name;
    const char* extension;  ///< that it belongs to; null: to OpenGL itself
};
constexpr std::array<Capability, 4> disturbing = {{{GL_ALPHA_TEST, nullptr},
                                                   {GL_POLYGON_STIPPLE, nullptr},
                                                   {GL_VERTEX_PROGRAM_ARB, "GL_ARB_vertex_program"},
                                                   {GL_FRAGMENT_PROGRAM_ARB, "GL_ARB_fragment_program"}}};

bool exists(const Capability& capability) {
    return capability.extension == nullptr || epoxy_has_gl_extension(capability.extension);
}

struct Transfer {
    GLenum name;
    GLfloat standard;
};
constexpr std::array<Transfer, 14> pixelTransfers = {{{GL_RED_SCALE, 1},
                                                      {GL_GREEN_SCALE, 1},
                                                      {GL_BLUE_SCALE, 1},
                                                      {GL_ALPHA_SCALE, 1},
                                                      {GL_DEPTH_SCALE, 1},
                                                      {GL_RED_BIAS, 0},
                                                      {GL_GREEN_BIAS, 0},
                                                      {GL_BLUE_BIAS, 0},
                                                      {GL_ALPHA_BIAS, 0},
                                                      {GL_DEPTH_BIAS, 0},
                                                      {GL_INDEX_SHIFT, 0},
                                                      {GL_INDEX_OFFSET, 0},
                                                      {GL_MAP_COLOR, 0},
                                                      {GL_MAP_STENCIL, 0}}};

}  // namespace

bool isCompatibilityContext() {
    GLint profile = 0;
    glGetIntegerv(GL_CONTEXT_PROFILE_MASK, &profile);
    return (profile & GL_CONTEXT_COMPATIBILITY_PROFILE_BIT) != 0;
}

void setKnownCompatibilityState() {
    if (!isCompatibilityContext()) return;
    for (const Capability& capability : disturbing) {
        if (exists(capability)) glDisable(capability.name);
    }
    for (const Transfer& transfer : pixelTransfers) glPixelTransferf(transfer.name, transfer.standard);
    glClampColor(GL_CLAMP_FRAGMENT_COLOR, GL_FALSE);
}

CompatibilityState::CompatibilityState() : exists_(isCompatibilityContext()) {
    static_assert(capabilities == disturbing.size() && transfers == pixelTransfers.size());
    if (!exists_) return;
    for (std::size_t i = 0; i < capabilities; ++i) {
        if (exists(disturbing[i])) enabled_[i] = glIsEnabled(disturbing[i].name);
    }
    for (std::size_t i = 0; i < transfers; ++i) glGetFloatv(pixelTransfers[i].name, &transfer_[i]);
    glGetIntegerv(GL_CLAMP_FRAGMENT_COLOR, &clampFragmentColor_);
}

CompatibilityState::~CompatibilityState() {
    if (!exists_) return;
    for (std::size_t i = 0; i < capabilities; ++i) {
        if (enabled_[i]) glEnable(disturbing[i].name);
    }
    for (std::size_t i = 0; i < transfers; ++i) glPixelTransferf(pixelTransfers[i].name, transfer_[i]);
    glClampColor(GL_CLAMP_FRAGMENT_COLOR, GLenum(clampFragmentColor_));
}

}  // namespace penumbra
