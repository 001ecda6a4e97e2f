// SPDX-License-Identifier: Apache-2.0
// The least that a program needs: triangles in, visibility out, a picture. Without a window, through EGL.
//
//     minimal picture.png [TECHNIQUE]
#include <epoxy/egl.h>
#include <epoxy/gl.h>
#include <penumbra/penumbra.h>
#include <png.h>

#include <algorithm>
#include <array>
#include <glm/gtc/matrix_transform.hpp>
#include <iostream>
#include <vector>

namespace {

constexpr int width_px = 640, height_px = 360;

bool makeContextCurrent() {
    const EGLDisplay display =
        eglGetPlatformDisplayEXT(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr);
    eglInitialize(display, nullptr, nullptr);
    eglBindAPI(EGL_OPENGL_API);
    constexpr std::array attributes = {EGL_CONTEXT_MAJOR_VERSION, 4, EGL_CONTEXT_MINOR_VERSION, 5, EGL_NONE};
    const EGLContext context =
        eglCreateContext(display, EGL_NO_CONFIG_KHR, EGL_NO_CONTEXT, attributes.data());
    return eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, context) == EGL_TRUE;
}

penumbra::Mat4 toPenumbra(const glm::mat4& matrix) {
    return penumbra::Mat4::fromColumns(&matrix[0][0]);
}

/// What the host has already: a program that draws its meshes' depth.
class DepthPass {
  public:
    DepthPass() {
        const char* const source =
            "#version 450\nlayout(location = 0) in vec3 position; layout(location = 0) uniform mat4 "
            "clipFromMesh;\n"
            "void main() { gl_Position = clipFromMesh * vec4(position, 1.0); }\n";
        program_ = glCreateShaderProgramv(GL_VERTEX_SHADER, 1, &source);
        glCreateTextures(GL_TEXTURE_2D, 1, &depth_);
        glTextureStorage2D(depth_, 1, GL_DEPTH_COMPONENT32F, width_px, height_px);
        glCreateFramebuffers(1, &framebuffer_);
        glNamedFramebufferTexture(framebuffer_, GL_DEPTH_ATTACHMENT, depth_, 0);
        glCreateVertexArrays(1, &vertexArray_);
        glEnableVertexArrayAttrib(vertexArray_, 0);
        glVertexArrayAttribFormat(vertexArray_, 0, 3, GL_FLOAT, GL_FALSE, 0);
        glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_);
        glViewport(0, 0, width_px, height_px);
        glBindProgramPipeline(0);
        glUseProgram(program_);
        glBindVertexArray(vertexArray_);
        glClipControl(GL_LOWER_LEFT, GL_ZERO_TO_ONE);
        glEnable(GL_DEPTH_TEST);
        glDepthFunc(GL_GREATER);
        glClearDepth(0);
        glClear(GL_DEPTH_BUFFER_BIT);
    }
    void draw(const penumbra::Mesh& mesh, const glm::mat4& clipFromMesh) const {
        glUniformMatrix4fv(0, 1, GL_FALSE, &clipFromMesh[0][0]);
        glVertexArrayVertexBuffer(vertexArray_, 0, mesh.positionBuffer(), 0, sizeof(penumbra::Vec3));
        glVertexArrayElementBuffer(vertexArray_, mesh.indexBuffer());
        glDrawElements(GL_TRIANGLES, GLsizei(mesh.indices().size()), GL_UNSIGNED_INT, nullptr);
    }
    GLuint texture() const { return depth_; }

  private:
    GLuint program_ = 0, depth_ = 0, framebuffer_ = 0, vertexArray_ = 0;
};

bool writePng(const char* path, const std::vector<float>& visibility) {
    std::vector<std::uint8_t> pixels;
    for (const float v : visibility) pixels.push_back(std::uint8_t(255 * v + 0.5f));
    png_image image{};
    image.version = PNG_IMAGE_VERSION;
    image.width = width_px;
    image.height = height_px;
    image.format = PNG_FORMAT_GRAY;
    // A negative stride: OpenGL's rows start at the bottom.
    return png_image_write_to_file(&image, path, 0, pixels.data(), -width_px, nullptr) != 0;
}

}  // namespace

int main(int argc, char** argv) try {
    if (argc < 2 || !makeContextCurrent()) {
        std::cerr << (argc < 2 ? "minimal PICTURE.png [TECHNIQUE]\n" : "no OpenGL 4.5\n");
        return 1;
    }

    //! [device]
    penumbra::Device device;  // on the context that is current
    const auto technique = penumbra::makeTechnique(device, argc > 2 ? argv[2] : "auto");
    //! [device]

    //! [meshes]
    const std::vector<penumbra::Vec3> groundCorners = {{-4, 0, -4}, {4, 0, -4}, {4, 0, 4}, {-4, 0, 4}};
    const std::vector<std::uint32_t> groundTriangles = {0, 2, 1, 0, 3, 2};
    const penumbra::Mesh ground(device, {.positions = groundCorners, .indices = groundTriangles});

    const std::vector<penumbra::Vec3> boxCorners = {{-1, -1, -1}, {1, -1, -1}, {1, 1, -1}, {-1, 1, -1},
                                                    {-1, -1, 1},  {1, -1, 1},  {1, 1, 1},  {-1, 1, 1}};
    const std::vector<std::uint32_t> boxTriangles = {0, 2, 1, 0, 3, 2, 4, 5, 6, 4, 6, 7, 0, 1, 5, 0, 5, 4,
                                                     3, 6, 2, 3, 7, 6, 0, 4, 7, 0, 7, 3, 1, 2, 6, 1, 6, 5};
    const penumbra::Mesh box(device, {.positions = boxCorners, .indices = boxTriangles});
    //! [meshes]

    //! [casters]
    const glm::mat4 worldFromBox =
        glm::scale(glm::rotate(glm::translate(glm::mat4(1), {0, 0.8f, 0}), 0.6f, {0, 1, 0}),
                   glm::vec3(0.5f, 0.5f, 0.5f));
    const std::array casters = {penumbra::Caster{.mesh = &ground},
                                penumbra::Caster{.mesh = &box, .worldFromMesh = toPenumbra(worldFromBox)}};
    //! [casters]

    // The host's own frame: reversed depth without a far plane.
    const glm::mat4 viewFromWorld =
        glm::lookAt(glm::vec3(2.5f, 3, 4), glm::vec3(0, 0.4f, 0), glm::vec3(0, 1, 0));
    glm::mat4 clipFromView(0);
    clipFromView[0][0] = 3.0f * height_px / width_px;
    clipFromView[1][1] = 3.0f;
    clipFromView[2][3] = -1;
    clipFromView[3][2] = 0.1f;  // the near plane
    const DepthPass depth;
    depth.draw(ground, clipFromView * viewFromWorld);
    depth.draw(box, clipFromView * viewFromWorld * worldFromBox);

    //! [view]
    penumbra::View view;
    view.width_px = width_px;
    view.height_px = height_px;
    view.viewFromWorld = toPenumbra(viewFromWorld);
    view.clipFromView = toPenumbra(clipFromView);
    view.depthTexture = depth.texture();
    view.depth = {.range = penumbra::DepthConvention::Range::zeroToOne, .reversed = true};
    //! [view]

    //! [light]
    penumbra::AreaLight light;  // a square of one metre, three above the ground, emitting down its -Z
    light.shape = penumbra::LightShape::rect;
    light.width_m = light.height_m = 1;
    light.worldFromLight = toPenumbra(
        glm::rotate(glm::translate(glm::mat4(1), {0.5f, 3, 0.3f}), glm::radians(-90.0f), {1, 0, 0}));
    //! [light]

    //! [render]
    penumbra::VisibilityBuffer visibility(device, width_px, height_px);
    technique->render({view, light, casters}, visibility);
    // visibility.texture() now holds, for each pixel, the fraction of the light that its surface sees.
    //! [render]

    std::vector<float> pixels(std::size_t(width_px) * height_px);
    glGetTextureImage(visibility.texture(), 0, GL_RED, GL_FLOAT, GLsizei(pixels.size() * sizeof(float)),
                      pixels.data());
    return writePng(argv[1], pixels) ? 0 : 1;
} catch (const penumbra::Error& error) {
    std::cerr << error.what() << "\n";
    return 1;
}
