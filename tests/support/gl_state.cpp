// SPDX-License-Identifier: Apache-2.0
#include "tests/support/gl_state.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <sstream>

#include "tests/support/compatibility_gl_state.h"

namespace penumbra::test {
namespace {

struct Target {
    const char* name;
    GLenum target, binding;
};
constexpr std::array<Target, 11> textureTargets = {{
    {"1D", GL_TEXTURE_1D, GL_TEXTURE_BINDING_1D},
    {"1D_ARRAY", GL_TEXTURE_1D_ARRAY, GL_TEXTURE_BINDING_1D_ARRAY},
    {"2D", GL_TEXTURE_2D, GL_TEXTURE_BINDING_2D},
    {"2D_ARRAY", GL_TEXTURE_2D_ARRAY, GL_TEXTURE_BINDING_2D_ARRAY},
    {"2D_MULTISAMPLE", GL_TEXTURE_2D_MULTISAMPLE, GL_TEXTURE_BINDING_2D_MULTISAMPLE},
    {"2D_MULTISAMPLE_ARRAY", GL_TEXTURE_2D_MULTISAMPLE_ARRAY, GL_TEXTURE_BINDING_2D_MULTISAMPLE_ARRAY},
    {"3D", GL_TEXTURE_3D, GL_TEXTURE_BINDING_3D},
    {"BUFFER", GL_TEXTURE_BUFFER, GL_TEXTURE_BINDING_BUFFER},
    {"CUBE_MAP", GL_TEXTURE_CUBE_MAP, GL_TEXTURE_BINDING_CUBE_MAP},
    {"CUBE_MAP_ARRAY", GL_TEXTURE_CUBE_MAP_ARRAY, GL_TEXTURE_BINDING_CUBE_MAP_ARRAY},
    {"RECTANGLE", GL_TEXTURE_RECTANGLE, GL_TEXTURE_BINDING_RECTANGLE},
}};

constexpr std::array<GLenum, 11> bufferTargets = {
    GL_ARRAY_BUFFER,         GL_ATOMIC_COUNTER_BUFFER,    GL_COPY_READ_BUFFER,  GL_COPY_WRITE_BUFFER,
    GL_DRAW_INDIRECT_BUFFER, GL_DISPATCH_INDIRECT_BUFFER, GL_PIXEL_PACK_BUFFER, GL_PIXEL_UNPACK_BUFFER,
    GL_QUERY_BUFFER,         GL_SHADER_STORAGE_BUFFER,    GL_UNIFORM_BUFFER};

constexpr std::array<GLenum, 33> capabilities = {GL_COLOR_LOGIC_OP,
                                                 GL_CULL_FACE,
                                                 GL_DEPTH_CLAMP,
                                                 GL_DEPTH_TEST,
                                                 GL_DITHER,
                                                 GL_FRAMEBUFFER_SRGB,
                                                 GL_LINE_SMOOTH,
                                                 GL_MULTISAMPLE,
                                                 GL_POLYGON_OFFSET_FILL,
                                                 GL_POLYGON_OFFSET_LINE,
                                                 GL_POLYGON_OFFSET_POINT,
                                                 GL_POLYGON_SMOOTH,
                                                 GL_PRIMITIVE_RESTART,
                                                 GL_PRIMITIVE_RESTART_FIXED_INDEX,
                                                 GL_PROGRAM_POINT_SIZE,
                                                 GL_RASTERIZER_DISCARD,
                                                 GL_SAMPLE_ALPHA_TO_COVERAGE,
                                                 GL_SAMPLE_ALPHA_TO_ONE,
                                                 GL_SAMPLE_COVERAGE,
                                                 GL_SAMPLE_MASK,
                                                 GL_SAMPLE_SHADING,
                                                 GL_STENCIL_TEST,
                                                 GL_TEXTURE_CUBE_MAP_SEAMLESS,
                                                 GL_CLIP_DISTANCE0,
                                                 GL_CLIP_DISTANCE1,
                                                 GL_CLIP_DISTANCE2,
                                                 GL_CLIP_DISTANCE3,
                                                 GL_CLIP_DISTANCE4,
                                                 GL_CLIP_DISTANCE5,
                                                 GL_CLIP_DISTANCE6,
                                                 GL_CLIP_DISTANCE7,
                                                 GL_DEBUG_OUTPUT,
                                                 GL_DEBUG_OUTPUT_SYNCHRONOUS};

struct Value {
    GLenum name;
    int components = 1;
};
const std::vector<Value> values = {{GL_ACTIVE_TEXTURE},
                                   {GL_ARRAY_BUFFER_BINDING},
                                   {GL_BLEND_COLOR, 4},
                                   {GL_CLIP_DEPTH_MODE},
                                   {GL_CLIP_ORIGIN},
                                   {GL_COLOR_CLEAR_VALUE, 4},
                                   {GL_COPY_READ_BUFFER_BINDING},
                                   {GL_COPY_WRITE_BUFFER_BINDING},
                                   {GL_CULL_FACE_MODE},
                                   {GL_CURRENT_PROGRAM},
                                   {GL_DEBUG_GROUP_STACK_DEPTH},
                                   {GL_DEPTH_CLEAR_VALUE},
                                   {GL_DEPTH_FUNC},
                                   {GL_DEPTH_WRITEMASK},
                                   {GL_DISPATCH_INDIRECT_BUFFER_BINDING},
                                   {GL_DRAW_FRAMEBUFFER_BINDING},
                                   {GL_DRAW_INDIRECT_BUFFER_BINDING},
                                   {GL_ELEMENT_ARRAY_BUFFER_BINDING},
                                   {GL_FRAGMENT_SHADER_DERIVATIVE_HINT},
                                   {GL_FRONT_FACE},
                                   {GL_LINE_SMOOTH_HINT},
                                   {GL_LINE_WIDTH},
                                   {GL_LOGIC_OP_MODE},
                                   {GL_MIN_SAMPLE_SHADING_VALUE},
                                   {GL_PACK_ALIGNMENT},
                                   {GL_PACK_IMAGE_HEIGHT},
                                   {GL_PACK_LSB_FIRST},
                                   {GL_PACK_ROW_LENGTH},
                                   {GL_PACK_SKIP_IMAGES},
                                   {GL_PACK_SKIP_PIXELS},
                                   {GL_PACK_SKIP_ROWS},
                                   {GL_PACK_SWAP_BYTES},
                                   {GL_PATCH_DEFAULT_INNER_LEVEL, 2},
                                   {GL_PATCH_DEFAULT_OUTER_LEVEL, 4},
                                   {GL_PATCH_VERTICES},
                                   {GL_PIXEL_PACK_BUFFER_BINDING},
                                   {GL_PIXEL_UNPACK_BUFFER_BINDING},
                                   {GL_POINT_FADE_THRESHOLD_SIZE},
                                   {GL_POINT_SIZE},
                                   {GL_POINT_SPRITE_COORD_ORIGIN},
                                   {GL_POLYGON_MODE},
                                   {GL_POLYGON_OFFSET_FACTOR},
                                   {GL_POLYGON_OFFSET_UNITS},
                                   {GL_POLYGON_SMOOTH_HINT},
                                   {GL_PRIMITIVE_RESTART_INDEX},
                                   {GL_PROGRAM_PIPELINE_BINDING},
                                   {GL_PROVOKING_VERTEX},
                                   {GL_QUERY_BUFFER_BINDING},
                                   {GL_READ_BUFFER},
                                   {GL_READ_FRAMEBUFFER_BINDING},
                                   {GL_RENDERBUFFER_BINDING},
                                   {GL_SAMPLE_COVERAGE_INVERT},
                                   {GL_SAMPLE_COVERAGE_VALUE},
                                   {GL_SHADER_STORAGE_BUFFER_BINDING},
                                   {GL_STENCIL_BACK_FAIL},
                                   {GL_STENCIL_BACK_FUNC},
                                   {GL_STENCIL_BACK_PASS_DEPTH_FAIL},
                                   {GL_STENCIL_BACK_PASS_DEPTH_PASS},
                                   {GL_STENCIL_BACK_REF},
                                   {GL_STENCIL_BACK_VALUE_MASK},
                                   {GL_STENCIL_BACK_WRITEMASK},
                                   {GL_STENCIL_CLEAR_VALUE},
                                   {GL_STENCIL_FAIL},
                                   {GL_STENCIL_FUNC},
                                   {GL_STENCIL_PASS_DEPTH_FAIL},
                                   {GL_STENCIL_PASS_DEPTH_PASS},
                                   {GL_STENCIL_REF},
                                   {GL_STENCIL_VALUE_MASK},
                                   {GL_STENCIL_WRITEMASK},
                                   {GL_TEXTURE_COMPRESSION_HINT},
                                   {GL_TRANSFORM_FEEDBACK_BINDING},
                                   {GL_TRANSFORM_FEEDBACK_ACTIVE},
                                   {GL_TRANSFORM_FEEDBACK_PAUSED},
                                   {GL_UNIFORM_BUFFER_BINDING},
                                   {GL_UNPACK_ALIGNMENT},
                                   {GL_UNPACK_IMAGE_HEIGHT},
                                   {GL_UNPACK_LSB_FIRST},
                                   {GL_UNPACK_ROW_LENGTH},
                                   {GL_UNPACK_SKIP_IMAGES},
                                   {GL_UNPACK_SKIP_PIXELS},
                                   {GL_UNPACK_SKIP_ROWS},
                                   {GL_UNPACK_SWAP_BYTES},
                                   {GL_VERTEX_ARRAY_BINDING},
                                   {GL_VIEWPORT, 4},
                                   {GL_SCISSOR_BOX, 4},
                                   {GL_DEPTH_RANGE, 2}};

GLint integer(GLenum name) {
    GLint value = 0;
    glGetIntegerv(name, &value);
    return value;
}

double integer(GLenum name, GLuint index) {
    GLint value = 0;
    glGetIntegeri_v(name, index, &value);
    return value;
}

double integer64(GLenum name, GLuint index) {
    GLint64 value = 0;
    glGetInteger64i_v(name, index, &value);
    return double(value);
}

std::string hex(GLenum name) {
    std::ostringstream text;
    text << "0x" << std::hex << name;
    return text.str();
}

std::string numbered(const std::string& name, GLuint index) {
    return name + " " + std::to_string(index);
}

void captureIndexed(GlState& state) {
    for (GLuint i = 0; i < GLuint(integer(GL_MAX_VIEWPORTS)); ++i) {
        std::array<GLfloat, 4> viewport{};
        std::array<GLint, 4> scissor{};
        std::array<GLdouble, 2> range{};
        glGetFloati_v(GL_VIEWPORT, i, viewport.data());
        glGetIntegeri_v(GL_SCISSOR_BOX, i, scissor.data());
        glGetDoublei_v(GL_DEPTH_RANGE, i, range.data());
        state[numbered("viewport", i)].assign(viewport.begin(), viewport.end());
        state[numbered("scissor box", i)].assign(scissor.begin(), scissor.end());
        state[numbered("depth range", i)].assign(range.begin(), range.end());
        state[numbered("scissor test", i)] = {double(glIsEnabledi(GL_SCISSOR_TEST, i))};
    }
    for (GLuint i = 0; i < GLuint(integer(GL_MAX_DRAW_BUFFERS)); ++i) {
        std::array<GLboolean, 4> mask{};
        glGetBooleani_v(GL_COLOR_WRITEMASK, i, mask.data());
        state[numbered("color mask", i)].assign(mask.begin(), mask.end());
        auto& blend = state[numbered("blend", i)];
        blend = {double(glIsEnabledi(GL_BLEND, i))};
        for (const GLenum name : {GL_BLEND_EQUATION_RGB, GL_BLEND_EQUATION_ALPHA, GL_BLEND_SRC_RGB,
                                  GL_BLEND_SRC_ALPHA, GL_BLEND_DST_RGB, GL_BLEND_DST_ALPHA}) {
            blend.push_back(integer(name, i));
        }
        state[numbered("draw buffer", i)] = {double(integer(GL_DRAW_BUFFER0 + i))};
    }
    for (GLuint i = 0; i < GLuint(integer(GL_MAX_SAMPLE_MASK_WORDS)); ++i) {
        state[numbered("sample mask", i)] = {integer(GL_SAMPLE_MASK_VALUE, i)};
    }
}

void captureBindings(GlState& state) {
    const GLint active = integer(GL_ACTIVE_TEXTURE);
    for (GLuint unit = 0; unit < GLuint(integer(GL_MAX_COMBINED_TEXTURE_IMAGE_UNITS)); ++unit) {
        glActiveTexture(GL_TEXTURE0 + unit);
        for (const Target& target : textureTargets) {
            state[numbered(std::string("texture ") + target.name + " at unit", unit)] = {
                double(integer(target.binding))};
        }
        state[numbered("sampler at unit", unit)] = {double(integer(GL_SAMPLER_BINDING))};
    }
    glActiveTexture(GLenum(active));
    for (GLuint unit = 0; unit < GLuint(integer(GL_MAX_IMAGE_UNITS)); ++unit) {
        auto& image = state[numbered("image unit", unit)];
        for (const GLenum name : {GL_IMAGE_BINDING_NAME, GL_IMAGE_BINDING_LEVEL, GL_IMAGE_BINDING_LAYERED,
                                  GL_IMAGE_BINDING_LAYER, GL_IMAGE_BINDING_ACCESS, GL_IMAGE_BINDING_FORMAT}) {
            image.push_back(integer(name, unit));
        }
    }
    struct Blocks {
        const char* name;
        GLenum count, binding, start, size;
    };
    for (const Blocks& blocks :
         {Blocks{"storage block", GL_MAX_SHADER_STORAGE_BUFFER_BINDINGS, GL_SHADER_STORAGE_BUFFER_BINDING,
                 GL_SHADER_STORAGE_BUFFER_START, GL_SHADER_STORAGE_BUFFER_SIZE},
          {"uniform block", GL_MAX_UNIFORM_BUFFER_BINDINGS, GL_UNIFORM_BUFFER_BINDING,
           GL_UNIFORM_BUFFER_START, GL_UNIFORM_BUFFER_SIZE},
          {"atomic counters", GL_MAX_ATOMIC_COUNTER_BUFFER_BINDINGS, GL_ATOMIC_COUNTER_BUFFER_BINDING,
           GL_ATOMIC_COUNTER_BUFFER_START, GL_ATOMIC_COUNTER_BUFFER_SIZE},
          {"transform feedback", GL_MAX_TRANSFORM_FEEDBACK_BUFFERS, GL_TRANSFORM_FEEDBACK_BUFFER_BINDING,
           GL_TRANSFORM_FEEDBACK_BUFFER_START, GL_TRANSFORM_FEEDBACK_BUFFER_SIZE}}) {
        for (GLuint i = 0; i < GLuint(integer(blocks.count)); ++i) {
            state[numbered(blocks.name, i)] = {integer(blocks.binding, i), integer64(blocks.start, i),
                                               integer64(blocks.size, i)};
        }
    }
    for (GLuint i = 0; integer(GL_VERTEX_ARRAY_BINDING) != 0 && i < 16; ++i) {
        auto& attribute = state[numbered("vertex attribute", i)];
        for (const GLenum name : {GL_VERTEX_ATTRIB_ARRAY_ENABLED, GL_VERTEX_ATTRIB_ARRAY_BUFFER_BINDING,
                                  GL_VERTEX_ATTRIB_ARRAY_SIZE, GL_VERTEX_ATTRIB_ARRAY_STRIDE}) {
            GLint value = 0;
            glGetVertexAttribiv(i, name, &value);
            attribute.push_back(value);
        }
    }
}

/// Pixel transfer as OpenGL has it at first.
struct PixelStore {
    GLenum name;
    GLint standard, odd;
};
constexpr std::array<PixelStore, 16> pixelStores = {{{GL_UNPACK_ALIGNMENT, 4, 8},
                                                     {GL_UNPACK_ROW_LENGTH, 0, 7},
                                                     {GL_UNPACK_IMAGE_HEIGHT, 0, 7},
                                                     {GL_UNPACK_SKIP_ROWS, 0, 2},
                                                     {GL_UNPACK_SKIP_PIXELS, 0, 2},
                                                     {GL_UNPACK_SKIP_IMAGES, 0, 2},
                                                     {GL_UNPACK_SWAP_BYTES, 0, 1},
                                                     {GL_UNPACK_LSB_FIRST, 0, 1},
                                                     {GL_PACK_ALIGNMENT, 4, 1},
                                                     {GL_PACK_ROW_LENGTH, 0, 7},
                                                     {GL_PACK_IMAGE_HEIGHT, 0, 7},
                                                     {GL_PACK_SKIP_ROWS, 0, 2},
                                                     {GL_PACK_SKIP_PIXELS, 0, 2},
                                                     {GL_PACK_SKIP_IMAGES, 0, 2},
                                                     {GL_PACK_SWAP_BYTES, 0, 1},
                                                     {GL_PACK_LSB_FIRST, 0, 1}}};

GLuint makeProgram() {
    const char* const vertex = "#version 450\nvoid main() { gl_Position = vec4(0.0); }\n";
    return glCreateShaderProgramv(GL_VERTEX_SHADER, 1, &vertex);
}

}  // namespace

GlState captureState() {
    GlState state;
    for (const GLenum capability : capabilities)
        state["enabled " + hex(capability)] = {double(glIsEnabled(capability))};
    for (const Value& value : values) {
        std::array<GLdouble, 4> components{};
        glGetDoublev(value.name, components.data());
        state["value " + hex(value.name)].assign(components.begin(), components.begin() + value.components);
    }
    void* callback = nullptr;
    glGetPointerv(GL_DEBUG_CALLBACK_FUNCTION, &callback);
    state["debug callback"] = {double(reinterpret_cast<std::uintptr_t>(callback))};
    captureIndexed(state);
    captureBindings(state);
    captureCompatibilityState(state);
    return state;
}

std::string differences(const GlState& before, const GlState& after) {
    std::ostringstream text;
    for (const auto& [name, value] : before) {
        const auto found = after.find(name);
        if (found != after.end() && found->second == value) continue;
        text << name << ":";
        for (const double v : value) text << " " << v;
        text << " became";
        for (const double v : found == after.end() ? std::vector<double>{} : found->second) text << " " << v;
        text << "\n";
    }
    return text.str();
}

NastyHost::NastyHost() {
    program_ = makeProgram();
    glUseProgram(program_);
    glGenVertexArrays(1, &vertexArray_);
    glBindVertexArray(vertexArray_);
    bindBuffers();
    bindTextures();
    glGenFramebuffers(1, &framebuffer_);
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_);
    glFramebufferTexture(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, textures_[2], 0);
    glGenRenderbuffers(1, &renderbuffer_);
    glBindRenderbuffer(GL_RENDERBUFFER, renderbuffer_);
    glGenTransformFeedbacks(1, &transformFeedback_);
    glBindTransformFeedback(GL_TRANSFORM_FEEDBACK, transformFeedback_);
    setRaster();
    for (const PixelStore& store : pixelStores) glPixelStorei(store.name, store.odd);
    setOddCompatibilityState();
}

NastyHost::~NastyHost() {
    for (const PixelStore& store : pixelStores) glPixelStorei(store.name, store.standard);
    resetCompatibilityTransfer();
    glUseProgram(0);
    glDeleteProgram(program_);
    glDeleteVertexArrays(1, &vertexArray_);
    glDeleteFramebuffers(1, &framebuffer_);
    glDeleteRenderbuffers(1, &renderbuffer_);
    glDeleteSamplers(1, &sampler_);
    glDeleteBuffers(1, &buffer_);
    glDeleteTransformFeedbacks(1, &transformFeedback_);
    glDeleteTextures(GLsizei(textures_.size()), textures_.data());
}

void NastyHost::bindTextures() {
    glGenSamplers(1, &sampler_);
    glSamplerParameteri(sampler_, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
    glSamplerParameteri(sampler_, GL_TEXTURE_COMPARE_MODE, GL_COMPARE_REF_TO_TEXTURE);
    for (const Target& target : textureTargets) {
        GLuint& texture = textures_.emplace_back();
        glCreateTextures(target.target, 1, &texture);
        if (target.target == GL_TEXTURE_2D) glTextureStorage2D(texture, 1, GL_RGBA8, 4, 4);
        for (GLuint unit = 0; unit < GLuint(integer(GL_MAX_COMBINED_TEXTURE_IMAGE_UNITS)); ++unit) {
            glBindTextureUnit(unit, texture);
            glBindSampler(unit, sampler_);
        }
    }
    glActiveTexture(GL_TEXTURE3);
    for (GLuint unit = 0; unit < GLuint(integer(GL_MAX_IMAGE_UNITS)); ++unit) {
        glBindImageTexture(unit, textures_[2], 0, GL_FALSE, 0, GL_READ_ONLY, GL_RGBA8);
    }
}

void NastyHost::bindBuffers() {
    glCreateBuffers(1, &buffer_);
    glNamedBufferStorage(buffer_, 1 << 16, nullptr, GL_DYNAMIC_STORAGE_BIT);
    for (const GLenum target : bufferTargets) glBindBuffer(target, buffer_);
    glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, buffer_);
    glEnableVertexAttribArray(0);
    glVertexAttribPointer(0, 2, GL_FLOAT, GL_FALSE, 24, nullptr);
    for (GLuint i = 0; i < GLuint(integer(GL_MAX_SHADER_STORAGE_BUFFER_BINDINGS)); ++i) {
        glBindBufferRange(GL_SHADER_STORAGE_BUFFER, i, buffer_, 4096, 1024 + 16 * i);
    }
    for (GLuint i = 0; i < GLuint(integer(GL_MAX_UNIFORM_BUFFER_BINDINGS)); ++i) {
        if (i % 2 == 0) {
            glBindBufferBase(GL_UNIFORM_BUFFER, i, buffer_);
        } else {
            glBindBufferRange(GL_UNIFORM_BUFFER, i, buffer_, 8192, 256);
        }
    }
}

void NastyHost::setRaster() const {
    for (const GLenum capability : capabilities) glEnable(capability);
    glDisable(GL_DITHER);
    for (GLuint i = 0; i < GLuint(integer(GL_MAX_VIEWPORTS)); ++i) {
        glViewportIndexedf(i, 1.5f, 2.5f, 3.0f + float(i), 5);
        glScissorIndexed(i, 1, 1, 2, 2 + GLint(i));
        glDepthRangeIndexed(i, 0.25, 0.5 + 0.01 * i);
        if (i % 2 == 0) glEnablei(GL_SCISSOR_TEST, i);
    }
    for (GLuint i = 0; i < GLuint(integer(GL_MAX_DRAW_BUFFERS)); ++i) {
        glColorMaski(i, GL_FALSE, GL_TRUE, GL_FALSE, GL_FALSE);
        if (i != 1) glEnablei(GL_BLEND, i);
        glBlendEquationSeparatei(i, GL_FUNC_SUBTRACT, GL_MAX);
        glBlendFuncSeparatei(i, GL_ZERO, GL_DST_COLOR, GL_SRC_ALPHA, GL_ONE_MINUS_DST_ALPHA);
    }
    glCullFace(GL_FRONT_AND_BACK);
    glFrontFace(GL_CW);
    glDepthFunc(GL_NEVER);
    glDepthMask(GL_FALSE);
    glPolygonMode(GL_FRONT_AND_BACK, GL_LINE);
    glPolygonOffset(3, 7);
    glProvokingVertex(GL_FIRST_VERTEX_CONVENTION);
    glClipControl(GL_UPPER_LEFT, GL_NEGATIVE_ONE_TO_ONE);
    glLogicOp(GL_INVERT);
    glSampleCoverage(0, GL_TRUE);
    glSampleMaski(0, 0);
    glMinSampleShading(0.5f);
    glPrimitiveRestartIndex(1);
    glStencilFunc(GL_NEVER, 3, 5);
    glStencilMaskSeparate(GL_BACK, 9);
    glStencilOp(GL_INCR, GL_DECR, GL_INVERT);
    glBlendColor(0.1f, 0.2f, 0.3f, 0.4f);
    glClearColor(0.5f, 0.6f, 0.7f, 0.8f);
    glClearDepth(0.125);
    glClearStencil(3);
    glPatchParameteri(GL_PATCH_VERTICES, 5);
    glPointSize(3);
}

}  // namespace penumbra::test
