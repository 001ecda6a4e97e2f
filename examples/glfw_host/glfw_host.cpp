// SPDX-License-Identifier: Apache-2.0
// A renderer with a window, reversed depth, meshes in buffers of its own layout, deformation in a shader, and
// habits: it sets its OpenGL state once, at the start, and relies on it for ever. Penumbra leaves it alone.
//
//     glfw_host [--technique NAME] [--frames N --screenshot picture.png]
#include <epoxy/gl.h>

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <penumbra/penumbra.h>
#include <png.h>

#include <array>
#include <cmath>
#include <glm/gtc/constants.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <iostream>
#include <optional>
#include <string>
#include <vector>

namespace {

//! [layout]
/// The host's own vertices: interleaved, with 16-bit indices.
struct Vertex {
    glm::vec3 normal, position;
};
//! [layout]

constexpr const char* sceneVertex = R"(#version 450
layout(location = 0) in vec3 normal;
layout(location = 1) in vec3 position;
layout(location = 0) uniform mat4 clipFromWorld;
layout(location = 0) out vec3 posWorld;
layout(location = 1) out vec3 normalWorld;
void main() {
    posWorld = position;
    normalWorld = normal;
    gl_Position = clipFromWorld * vec4(position, 1.0);
})";

// Lit by a small disk's irradiance, times what of it each pixel sees.
constexpr const char* sceneFragment = R"(#version 450
layout(location = 0) in vec3 posWorld;
layout(location = 1) in vec3 normalWorld;
layout(location = 4) uniform vec3 lightWorld;
layout(binding = 2) uniform sampler2D visibility;
layout(location = 0) out vec4 color;
void main() {
    vec3 toLight = lightWorld - posWorld;
    float irradiance = max(dot(normalize(normalWorld), normalize(toLight)), 0.0) * 14.0 / dot(toLight, toLight);
    float seen = texelFetch(visibility, ivec2(gl_FragCoord.xy), 0).r;
    vec3 albedo = mod(floor(posWorld.x) + floor(posWorld.z), 2.0) < 1.0 && posWorld.y < 0.001 ? vec3(0.55) : vec3(0.8, 0.72, 0.6);
    color = vec4(pow(albedo * (0.06 + seen * irradiance) / 1.6, vec3(1.0 / 2.2)), 1.0);
})";

constexpr const char* depthFragment = "#version 450\nvoid main() {}\n";

// The host's deformation: a ring that wobbles, in its own vertex buffer, on the device.
constexpr const char* wobble = R"(#version 450
layout(local_size_x = 64) in;
layout(std430, binding = 5) readonly buffer Rest { float rest[]; };
layout(std430, binding = 6) writeonly buffer Moved { float moved[]; };
layout(location = 0) uniform float time_s;
void main() {
    uint i = 6u * gl_GlobalInvocationID.x;
    if (i + 5u >= uint(rest.length())) return;
    for (uint k = 0u; k < 6u; ++k) moved[i + k] = rest[i + k];
    moved[i + 4u] = rest[i + 4u] + 0.18 * sin(3.0 * atan(rest[i + 5u], rest[i + 3u]) + 2.0 * time_s);
})";

GLuint link(std::initializer_list<std::pair<GLenum, const char*>> stages) {
    const GLuint program = glCreateProgram();
    for (const auto& [stage, text] : stages) {
        const GLuint shader = glCreateShader(stage);
        glShaderSource(shader, 1, &text, nullptr);
        glCompileShader(shader);
        glAttachShader(program, shader);
        glDeleteShader(shader);
    }
    glLinkProgram(program);
    return program;
}

penumbra::Mat4 toPenumbra(const glm::mat4& matrix) {
    return penumbra::Mat4::fromColumns(&matrix[0][0]);
}

struct HostMesh {
    std::vector<Vertex> vertices;
    std::vector<std::uint16_t> indices;
    GLuint vertexBuffer = 0, indexBuffer = 0;

    void upload() {
        glCreateBuffers(1, &vertexBuffer);
        glNamedBufferStorage(vertexBuffer, GLsizeiptr(vertices.size() * sizeof(Vertex)), vertices.data(), 0);
        glCreateBuffers(1, &indexBuffer);
        glNamedBufferStorage(indexBuffer, GLsizeiptr(indices.size() * sizeof(std::uint16_t)), indices.data(),
                             0);
    }
};

HostMesh makeGround() {
    HostMesh mesh;
    for (const glm::vec2 corner : {glm::vec2(-6, -6), {6, -6}, {6, 6}, {-6, 6}}) {
        mesh.vertices.push_back({{0, 1, 0}, {corner.x, 0, corner.y}});
    }
    mesh.indices = {0, 2, 1, 0, 3, 2};
    mesh.upload();
    return mesh;
}

HostMesh makeRing() {
    HostMesh mesh;
    constexpr int around = 96, across = 24;
    for (int i = 0; i < around; ++i) {
        for (int j = 0; j < across; ++j) {
            const float a = glm::two_pi<float>() * float(i) / around,
                        b = glm::two_pi<float>() * float(j) / across;
            const glm::vec3 outward(std::cos(a), 0, std::sin(a));
            const glm::vec3 normal = std::cos(b) * outward + std::sin(b) * glm::vec3(0, 1, 0);
            mesh.vertices.push_back({normal, 1.2f * outward + glm::vec3(0, 1.1f, 0) + 0.25f * normal});
            const int i1 = (i + 1) % around, j1 = (j + 1) % across;
            const auto index = [&](int u, int v) { return std::uint16_t(u * across + v); };
            for (const std::uint16_t corner :
                 {index(i, j), index(i, j1), index(i1, j), index(i1, j), index(i, j1), index(i1, j1)}) {
                mesh.indices.push_back(corner);
            }
        }
    }
    mesh.upload();
    return mesh;
}

//! [fromBuffers]
penumbra::Mesh toPenumbra(penumbra::Device& device, const HostMesh& mesh) {
    return penumbra::Mesh::fromBuffers(
        device, {.positions = {mesh.vertexBuffer, offsetof(Vertex, position), sizeof(Vertex)},
                 .vertexCount = mesh.vertices.size(),
                 .indexBuffer = mesh.indexBuffer,
                 .indexCount = mesh.indices.size(),
                 .indexType = penumbra::Mesh::HostSource::IndexType::uint16});
}
//! [fromBuffers]

class Renderer {
  public:
    Renderer(const char* technique, int width_px, int height_px)
        : technique_(penumbra::makeTechnique(device_, technique)),
          width_px_(width_px),
          height_px_(height_px) {
        glCreateBuffers(1, &wobbled_);
        glNamedBufferStorage(wobbled_, GLsizeiptr(ring_.vertices.size() * sizeof(Vertex)), nullptr, 0);
        glCreateTextures(GL_TEXTURE_2D, 1, &depth_);
        glTextureStorage2D(depth_, 1, GL_DEPTH32F_STENCIL8, width_px, height_px);
        glCreateTextures(GL_TEXTURE_2D, 1, &seen_);
        glTextureStorage2D(seen_, 1, GL_R16F, width_px, height_px);
        glCreateFramebuffers(1, &prepass_);
        glNamedFramebufferTexture(prepass_, GL_DEPTH_STENCIL_ATTACHMENT, depth_, 0);
        visibility_.emplace(device_,
                            penumbra::VisibilityBuffer::HostTexture{seen_, 0, 0, width_px, height_px});
        setStateForEver();
    }

    void render(float time_s) {
        const glm::mat4 viewFromWorld = glm::lookAt(glm::vec3(3.4f * std::sin(0.2f * time_s), 3.2f, 4.2f),
                                                    {0, 0.5f, 0}, glm::vec3(0, 1, 0));
        glm::mat4 clipFromView(0);  // reversed, without a far plane
        clipFromView[0][0] = 1.7f * float(height_px_) / float(width_px_);
        clipFromView[1][1] = 1.7f;
        clipFromView[2][3] = -1;
        clipFromView[3][2] = 0.05f;
        const glm::vec3 lightWorld(2 * std::cos(0.5f * time_s), 4, 2 * std::sin(0.5f * time_s));

        deform(time_s);
        const glm::mat4 clipFromWorld = clipFromView * viewFromWorld;
        glBindFramebuffer(GL_DRAW_FRAMEBUFFER, prepass_);
        glClear(GL_DEPTH_BUFFER_BIT);
        draw(depthProgram_, clipFromWorld);
        castShadows(viewFromWorld, clipFromView, lightWorld);
        // Straight on: program, framebuffer and all else are as they were left.
        glBindFramebuffer(GL_DRAW_FRAMEBUFFER, 0);
        glClear(GL_DEPTH_BUFFER_BIT | GL_COLOR_BUFFER_BIT);
        glProgramUniform3fv(sceneProgram_, 4, 1, &lightWorld[0]);
        draw(sceneProgram_, clipFromWorld);
    }

  private:
    void setStateForEver() {
        glViewport(0, 0, width_px_, height_px_);
        glClipControl(GL_LOWER_LEFT, GL_ZERO_TO_ONE);
        glEnable(GL_DEPTH_TEST);
        glDepthFunc(GL_GEQUAL);
        glClearDepth(0);
        glClearColor(0.05f, 0.06f, 0.08f, 1);
        glEnable(GL_CULL_FACE);
        glBindTextureUnit(2, seen_);
        glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 5, ring_.vertexBuffer);
        glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 6, wobbled_);
        glCreateVertexArrays(1, &vertexArray_);
        for (GLuint attribute = 0; attribute < 2; ++attribute) {
            glEnableVertexArrayAttrib(vertexArray_, attribute);
            glVertexArrayAttribFormat(vertexArray_, attribute, 3, GL_FLOAT, GL_FALSE,
                                      attribute * GLuint(sizeof(glm::vec3)));
            glVertexArrayAttribBinding(vertexArray_, attribute, 0);
        }
        glBindVertexArray(vertexArray_);
    }

    //! [deform]
    void deform(float time_s) {
        glUseProgram(wobbleProgram_);
        glUniform1f(0, time_s);
        glDispatchCompute(GLuint(ring_.vertices.size() + 63) / 64, 1, 1);
        glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT | GL_VERTEX_ATTRIB_ARRAY_BARRIER_BIT);
        // Penumbra copies from the buffer, on the device. The box must hold the ring however it wobbles.
        ringMesh_.deform({wobbled_, offsetof(Vertex, position), sizeof(Vertex)},
                         {.min = {-1.5f, 0.6f, -1.5f}, .max = {1.5f, 1.6f, 1.5f}});
    }
    //! [deform]

    void castShadows(const glm::mat4& viewFromWorld, const glm::mat4& clipFromView,
                     const glm::vec3& lightWorld) {
        penumbra::ShadowInputs inputs;
        inputs.view.width_px = width_px_;
        inputs.view.height_px = height_px_;
        inputs.view.viewFromWorld = toPenumbra(viewFromWorld);
        inputs.view.clipFromView = toPenumbra(clipFromView);
        inputs.view.depthTexture = depth_;
        inputs.light.shape = penumbra::LightShape::disk;
        inputs.light.radius_m = 0.45f;
        inputs.light.worldFromLight =
            toPenumbra(glm::inverse(glm::lookAt(lightWorld, glm::vec3(0), glm::vec3(0, 1, 0))));
        const std::array casters = {penumbra::Caster{.mesh = &groundMesh_},
                                    penumbra::Caster{.mesh = &ringMesh_}};
        inputs.casters = casters;
        technique_->render(inputs, *visibility_);
    }

    void draw(GLuint program, const glm::mat4& clipFromWorld) const {
        glUseProgram(program);
        glUniformMatrix4fv(0, 1, GL_FALSE, &clipFromWorld[0][0]);
        for (const auto& [mesh, vertices] : {std::pair{&ground_, ground_.vertexBuffer}, {&ring_, wobbled_}}) {
            glVertexArrayVertexBuffer(vertexArray_, 0, vertices, 0, sizeof(Vertex));
            glVertexArrayElementBuffer(vertexArray_, mesh->indexBuffer);
            glDrawElements(GL_TRIANGLES, GLsizei(mesh->indices.size()), GL_UNSIGNED_SHORT, nullptr);
        }
    }

    penumbra::Device device_;
    std::unique_ptr<penumbra::Technique> technique_;
    std::optional<penumbra::VisibilityBuffer> visibility_;
    HostMesh ground_ = makeGround(), ring_ = makeRing();
    penumbra::Mesh groundMesh_ = toPenumbra(device_, ground_), ringMesh_ = toPenumbra(device_, ring_);
    GLuint depthProgram_ = link({{GL_VERTEX_SHADER, sceneVertex}, {GL_FRAGMENT_SHADER, depthFragment}});
    GLuint sceneProgram_ = link({{GL_VERTEX_SHADER, sceneVertex}, {GL_FRAGMENT_SHADER, sceneFragment}});
    GLuint wobbleProgram_ = link({{GL_COMPUTE_SHADER, wobble}});
    GLuint wobbled_ = 0, depth_ = 0, seen_ = 0, prepass_ = 0, vertexArray_ = 0;
    int width_px_, height_px_;
};

bool writeScreenshot(const char* path, int width_px, int height_px) {
    std::vector<std::uint8_t> pixels(std::size_t(width_px) * std::size_t(height_px) * 4);
    glReadBuffer(GL_BACK);
    glReadPixels(0, 0, width_px, height_px, GL_RGBA, GL_UNSIGNED_BYTE, pixels.data());
    png_image image{};
    image.version = PNG_IMAGE_VERSION;
    image.width = png_uint_32(width_px);
    image.height = png_uint_32(height_px);
    image.format = PNG_FORMAT_RGBA;
    return png_image_write_to_file(&image, path, 0, pixels.data(), -4 * width_px, nullptr) != 0;
}

}  // namespace

int main(int argc, char** argv) try {
    std::string technique = "exact", screenshot;
    int frames = -1;
    for (int i = 1; i + 1 < argc; i += 2) {
        const std::string flag = argv[i];
        if (flag == "--technique") technique = argv[i + 1];
        if (flag == "--frames") frames = std::stoi(argv[i + 1]);
        if (flag == "--screenshot") screenshot = argv[i + 1];
    }
    if (!glfwInit()) return std::cerr << "GLFW finds no display\n", 1;
    glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, 4);
    glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, 5);
    glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
    glfwWindowHint(GLFW_RESIZABLE, GLFW_FALSE);
    GLFWwindow* const window = glfwCreateWindow(640, 360, "A host of Penumbra", nullptr, nullptr);
    if (window == nullptr) return std::cerr << "no OpenGL 4.5\n", 1;
    glfwMakeContextCurrent(window);
    int width_px = 0, height_px = 0;
    glfwGetFramebufferSize(window, &width_px, &height_px);

    Renderer renderer(technique.c_str(), width_px, height_px);
    bool written = true;
    for (int frame = 0; frame != frames && !glfwWindowShouldClose(window); ++frame) {
        // A given number of frames runs on a clock of its own, so that each picture is always the same.
        renderer.render(frames < 0 ? float(glfwGetTime()) : float(frame) / 10);
        if (frame + 1 == frames && !screenshot.empty())
            written = writeScreenshot(screenshot.c_str(), width_px, height_px);
        glfwSwapBuffers(window);
        glfwPollEvents();
    }
    return written ? 0 : 1;
} catch (const penumbra::Error& error) {
    std::cerr << error.what() << "\n";
    return 1;
}
