// SPDX-License-Identifier: Apache-2.0
#include "tests/support/compatibility_gl_state.h"

#include <array>
#include <sstream>

namespace penumbra::test {
namespace {

constexpr std::array capabilities = {
    GL_ALPHA_TEST,   GL_AUTO_NORMAL,     GL_COLOR_MATERIAL,   GL_COLOR_SUM,     GL_FOG,
    GL_LIGHT0,       GL_LIGHTING,        GL_LINE_STIPPLE,     GL_NORMALIZE,     GL_POINT_SMOOTH,
    GL_POINT_SPRITE, GL_POLYGON_STIPPLE, GL_RESCALE_NORMAL,   GL_TEXTURE_1D,    GL_TEXTURE_2D,
    GL_TEXTURE_3D,   GL_TEXTURE_GEN_S,   GL_TEXTURE_CUBE_MAP, GL_INDEX_LOGIC_OP};

/// Enabled although there is none of the host's, which breaks nothing but drawing with it.
constexpr std::array<std::pair<GLenum, const char*>, 2> assemblyPrograms = {
    {{GL_VERTEX_PROGRAM_ARB, "GL_ARB_vertex_program"}, {GL_FRAGMENT_PROGRAM_ARB, "GL_ARB_fragment_program"}}};

struct Value {
    GLenum name;
    GLfloat standard, odd;
};
constexpr std::array<Value, 14> transfers = {{{GL_RED_SCALE, 1, 0.5f},
                                              {GL_GREEN_SCALE, 1, 0.5f},
                                              {GL_BLUE_SCALE, 1, 0.5f},
                                              {GL_ALPHA_SCALE, 1, 0.5f},
                                              {GL_DEPTH_SCALE, 1, 0.5f},
                                              {GL_RED_BIAS, 0, 0.25f},
                                              {GL_GREEN_BIAS, 0, 0.25f},
                                              {GL_BLUE_BIAS, 0, 0.25f},
                                              {GL_ALPHA_BIAS, 0, 0.25f},
                                              {GL_DEPTH_BIAS, 0, 0.25f},
                                              {GL_INDEX_SHIFT, 0, 1},
                                              {GL_INDEX_OFFSET, 0, 3},
                                              {GL_MAP_COLOR, 0, 1},
                                              {GL_MAP_STENCIL, 0, 1}}};

constexpr std::array values = {GL_ALPHA_TEST_FUNC,    GL_ALPHA_TEST_REF, GL_CLAMP_FRAGMENT_COLOR,
                               GL_CLAMP_VERTEX_COLOR, GL_MATRIX_MODE,    GL_MODELVIEW_STACK_DEPTH,
                               GL_ATTRIB_STACK_DEPTH, GL_SHADE_MODEL,    GL_LIST_INDEX,
                               GL_RENDER_MODE};

bool isCompatibility() {
    GLint profile = 0;
    glGetIntegerv(GL_CONTEXT_PROFILE_MASK, &profile);
    return (profile & GL_CONTEXT_COMPATIBILITY_PROFILE_BIT) != 0;
}

std::string named(const char* what, GLenum name) {
    std::ostringstream text;
    text << "compatibility " << what << " 0x" << std::hex << name;
    return text.str();
}

/// Patterns are read from, and written to, the buffer for pixels where one is bound.
template <typename Call>
void withoutBuffer(GLenum target, GLenum binding, Call call) {
    GLint bound = 0;
    glGetIntegerv(binding, &bound);
    glBindBuffer(target, 0);
    call();
    glBindBuffer(target, GLuint(bound));
}

}  // namespace

void captureCompatibilityState(GlState& state) {
    if (!isCompatibility()) return;
    for (const GLenum name : capabilities) state[named("enabled", name)] = {double(glIsEnabled(name))};
    for (const auto& [name, extension] : assemblyPrograms) {
        if (epoxy_has_gl_extension(extension)) state[named("enabled", name)] = {double(glIsEnabled(name))};
    }
    const auto capture = [&](GLenum name) {
        GLdouble value = 0;
        glGetDoublev(name, &value);
        state[named("value", name)] = {value};
    };
    for (const Value& transfer : transfers) capture(transfer.name);
    for (const GLenum name : values) capture(name);
    std::array<GLubyte, 128> stipple{};
    withoutBuffer(GL_PIXEL_PACK_BUFFER, GL_PIXEL_PACK_BUFFER_BINDING,
                  [&] { glGetPolygonStipple(stipple.data()); });
    state["compatibility polygon stipple"].assign(stipple.begin(), stipple.end());
}

void setOddCompatibilityState() {
    if (!isCompatibility()) return;
    for (const GLenum name : capabilities) glEnable(name);
    for (const auto& [name, extension] : assemblyPrograms) {
        if (epoxy_has_gl_extension(extension)) glEnable(name);
    }
    for (const Value& transfer : transfers) glPixelTransferf(transfer.name, transfer.odd);
    glAlphaFunc(GL_NEVER, 0.5f);
    constexpr std::array<GLubyte, 128> nothing{};
    withoutBuffer(GL_PIXEL_UNPACK_BUFFER, GL_PIXEL_UNPACK_BUFFER_BINDING,
                  [&] { glPolygonStipple(nothing.data()); });
    glClampColor(GL_CLAMP_FRAGMENT_COLOR, GL_TRUE);
    glClampColor(GL_CLAMP_VERTEX_COLOR, GL_TRUE);
    glMatrixMode(GL_TEXTURE);
    glShadeModel(GL_FLAT);
}

void resetCompatibilityTransfer() {
    if (!isCompatibility()) return;
    for (const Value& transfer : transfers) glPixelTransferf(transfer.name, transfer.standard);
}

}  // namespace penumbra::test
