// SPDX-License-Identifier: Apache-2.0
// Filament's own scene, materials and lighting, drawn by its own thread into textures that are shared with
// Penumbra's context, which puts soft shadows of a square lamp over them.
//
//     filament_host [--technique NAME] [--screenshot picture.png] [--no-shadows]
#include <filament/Camera.h>
#include <filament/Engine.h>
#include <filament/IndexBuffer.h>
#include <filament/LightManager.h>
#include <filament/Material.h>
#include <filament/MaterialInstance.h>
#include <filament/RenderTarget.h>
#include <filament/RenderableManager.h>
#include <filament/Renderer.h>
#include <filament/Scene.h>
#include <filament/Skybox.h>
#include <filament/Texture.h>
#include <filament/TransformManager.h>
#include <filament/VertexBuffer.h>
#include <filament/View.h>
#include <filament/Viewport.h>
#include <geometry/SurfaceOrientation.h>
#include <math/mat4.h>
#include <penumbra/penumbra.h>
#include <utils/EntityManager.h>
#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <png.h>

#include <array>
#include <cstdint>
#include <iostream>
#include <memory>
#include <string>
#include <vector>
// Last, since X11's headers call everything None and Success.
#include <epoxy/gl.h>
#include <epoxy/glx.h>

namespace {

using namespace filament::math;

constexpr int width_px = 640, height_px = 400;
constexpr float3 lampPlace{1.5f, 5, 2};

struct Box {
    mat4f worldFromBox;
    float3 color;
};

std::vector<Box> makeScene() {
    return {
        {mat4f::translation(float3(0, -0.1f, 0)) * mat4f::scaling(float3(5, 0.1f, 5)), {0.6f, 0.6f, 0.57f}},
        {mat4f::translation(float3(-0.9f, 1, 0.2f)) * mat4f::rotation(0.6f, float3(0.2f, 1, 0.1f)) *
             mat4f::scaling(0.55f),
         {0.53f, 0.13f, 0.07f}},
        {mat4f::translation(float3(1.1f, 0.8f, -0.3f)) * mat4f::scaling(float3(0.25f, 0.8f, 0.25f)),
         {0.1f, 0.21f, 0.53f}}};
}

/// A cube from -1 to 1, each of whose faces has corners of its own.
struct Cube {
    Cube() {
        for (const float sign : {-1.0f, 1.0f}) {
            for (std::size_t axis = 0; axis < 3; ++axis) {
                float3 normal(0), along(0);
                normal[axis] = sign;
                along[(axis + 1) % 3] = 1;
                const float3 across = cross(normal, along);
                const auto first = std::uint32_t(positions.size());
                for (const auto& [u, v] : {std::pair{-1, -1}, {1, -1}, {1, 1}, {-1, 1}}) {
                    const float3 corner = normal + float(u) * along + float(v) * across;
                    positions.push_back({corner.x, corner.y, corner.z});
                    normals.push_back(normal);
                }
                for (const std::uint32_t corner : {0, 1, 2, 0, 2, 3}) indices.push_back(first + corner);
            }
        }
    }
    std::vector<penumbra::Vec3> positions;
    std::vector<float3> normals;
    std::vector<std::uint32_t> indices;
};

//! [targets]
/// What Filament draws into, made on this program's context and imported into Filament's.
struct Target {
    Target() {
        glCreateTextures(GL_TEXTURE_2D, 1, &color);
        glTextureStorage2D(color, 1, GL_RGBA8, width_px, height_px);
        glCreateTextures(GL_TEXTURE_2D, 1, &depth);
        glTextureStorage2D(depth, 1, GL_DEPTH_COMPONENT32F, width_px, height_px);
        glCreateFramebuffers(1, &framebuffer);
        glNamedFramebufferTexture(framebuffer, GL_COLOR_ATTACHMENT0, color, 0);
    }
    filament::RenderTarget* imported(filament::Engine& engine) const {
        using filament::RenderTarget, filament::Texture;
        const auto import = [&](GLuint name, Texture::InternalFormat format, Texture::Usage usage) {
            return Texture::Builder()
                .width(width_px)
                .height(height_px)
                .levels(1)
                .format(format)
                .usage(Texture::Usage::SAMPLEABLE | usage)  // which Filament asks of what is imported
                .import(std::intptr_t(name))
                .build(engine);
        };
        return RenderTarget::Builder()
            .texture(RenderTarget::COLOR,
                     import(color, Texture::InternalFormat::RGBA8, Texture::Usage::COLOR_ATTACHMENT))
            .texture(RenderTarget::DEPTH,
                     import(depth, Texture::InternalFormat::DEPTH32F, Texture::Usage::DEPTH_ATTACHMENT))
            .build(engine);
    }
    GLuint color = 0, depth = 0, framebuffer = 0;
};
//! [targets]

//! [shadows]
/// All that Penumbra has, on this program's context.
class Shadows {
  public:
    Shadows(const std::string& technique, const Cube& cube, const std::vector<Box>& boxes)
        : technique_(penumbra::makeTechnique(device_, technique)),
          mesh_(device_, {.positions = cube.positions, .indices = cube.indices}) {
        for (const Box& box : boxes)
            casters_.push_back({.mesh = &mesh_, .worldFromMesh = toPenumbra(box.worldFromBox)});
        light_.width_m = light_.height_m = 1.2f;
        light_.worldFromLight = toPenumbra(mat4f::lookAt(lampPlace, float3(0), float3(0, 0, 1)));
    }

    /// Over what Filament has drawn; it must have ended.
    void draw(const Target& target, const filament::Camera& camera) {
        // As Filament's shaders change it: from -1..1 to 0..1, near before far reversed.
        mat4 clipFromView = transpose(camera.getProjectionMatrix());
        clipFromView[2] = 0.5 * (clipFromView[3] - clipFromView[2]);
        penumbra::View view;
        view.width_px = width_px;
        view.height_px = height_px;
        view.viewFromWorld = toPenumbra(camera.getViewMatrix());
        view.clipFromView = penumbra::Mat4::fromRows(&clipFromView[0][0]);
        view.depthTexture = target.depth;
        view.depth = {.range = penumbra::DepthConvention::Range::zeroToOne, .reversed = true};
        technique_->render({view, light_, casters_}, visibility_);
        framebuffer_.multiply(target.framebuffer, view, visibility_, 0.4f);
    }

  private:
    static penumbra::Mat4 toPenumbra(const mat4f& matrix) {
        return penumbra::Mat4::fromColumns(&matrix[0][0]);
    }
    penumbra::Device device_;
    std::unique_ptr<penumbra::Technique> technique_;
    penumbra::HostFramebuffer framebuffer_{device_};
    penumbra::VisibilityBuffer visibility_{device_, width_px, height_px};
    penumbra::Mesh mesh_;
    std::vector<penumbra::Caster> casters_;
    penumbra::AreaLight light_;
};
//! [shadows]

constexpr std::uint8_t painted[] = {
#include "painted.inc"
};

/// All that Filament has.
class Host {
  public:
    Host(const Cube& cube, const std::vector<Box>& boxes, const Target& target)
        : engine_(
              *filament::Engine::create(filament::Engine::Backend::OPENGL, nullptr, glXGetCurrentContext())) {
        scene_ = engine_.createScene();
        addBoxes(cube, boxes);
        const utils::Entity lamp = utils::EntityManager::get().create();
        filament::LightManager::Builder(filament::LightManager::Type::POINT)
            .position(lampPlace)
            .intensityCandela(50)
            .falloff(100)
            .build(engine_, lamp);
        scene_->addEntity(lamp);
        scene_->setSkybox(filament::Skybox::Builder().color({0.01f, 0.01f, 0.014f, 1}).build(engine_));
        camera_ = engine_.createCamera(utils::EntityManager::get().create());
        camera_->setProjection(40, double(width_px) / height_px, 0.5, 50);
        camera_->lookAt(float3(3, 4, 5), float3(0, 0.4f, 0));
        camera_->setExposure(1.0f);
        view_ = engine_.createView();
        view_->setScene(scene_);
        view_->setCamera(camera_);
        view_->setViewport({0, 0, width_px, height_px});
        //! [view]
        view_->setRenderTarget(target.imported(engine_));
        view_->setPostProcessingEnabled(false);  // or the depths are of another target
        //! [view]
        swapChain_ = engine_.createSwapChain(width_px, height_px);
        renderer_ = engine_.createRenderer();
    }
    Host(const Host&) = delete;
    Host& operator=(const Host&) = delete;
    ~Host() { filament::Engine::destroy(&engine_); }

    void draw() {
        while (!renderer_->beginFrame(swapChain_)) engine_.flushAndWait();
        renderer_->render(view_);
        renderer_->endFrame();
        engine_.flushAndWait();
    }
    const filament::Camera& camera() const { return *camera_; }

  private:
    void addBoxes(const Cube& cube, const std::vector<Box>& boxes) {
        using filament::VertexBuffer, filament::IndexBuffer;
        auto* const orientation = filament::geometry::SurfaceOrientation::Builder()
                                      .vertexCount(cube.normals.size())
                                      .normals(cube.normals.data())
                                      .build();
        tangents_.resize(cube.normals.size());
        orientation->getQuats(tangents_.data(), tangents_.size());
        delete orientation;
        auto* const vertices = VertexBuffer::Builder()
                                   .vertexCount(std::uint32_t(cube.positions.size()))
                                   .bufferCount(2)
                                   .attribute(filament::POSITION, 0, VertexBuffer::AttributeType::FLOAT3)
                                   .attribute(filament::TANGENTS, 1, VertexBuffer::AttributeType::FLOAT4)
                                   .build(engine_);
        vertices->setBufferAt(engine_, 0, {cube.positions.data(), cube.positions.size() * sizeof(float3)});
        vertices->setBufferAt(engine_, 1, {tangents_.data(), tangents_.size() * sizeof(quatf)});
        auto* const indices = IndexBuffer::Builder()
                                  .indexCount(std::uint32_t(cube.indices.size()))
                                  .bufferType(IndexBuffer::IndexType::UINT)
                                  .build(engine_);
        indices->setBuffer(engine_, {cube.indices.data(), cube.indices.size() * sizeof(std::uint32_t)});
        auto* const material = filament::Material::Builder().package(painted, sizeof painted).build(engine_);
        for (const Box& box : boxes) {
            auto* const paint = material->createInstance();
            paint->setParameter("color", box.color);
            const utils::Entity entity = utils::EntityManager::get().create();
            filament::RenderableManager::Builder(1)
                .boundingBox({{0, 0, 0}, {1, 1, 1}})
                .geometry(0, filament::RenderableManager::PrimitiveType::TRIANGLES, vertices, indices)
                .material(0, paint)
                .castShadows(false)
                .receiveShadows(false)
                .build(engine_, entity);
            auto& transforms = engine_.getTransformManager();
            transforms.create(entity, {}, box.worldFromBox);
            scene_->addEntity(entity);
        }
    }

    filament::Engine& engine_;
    filament::Scene* scene_ = nullptr;
    filament::Camera* camera_ = nullptr;
    filament::View* view_ = nullptr;
    filament::SwapChain* swapChain_ = nullptr;
    filament::Renderer* renderer_ = nullptr;
    std::vector<quatf> tangents_;
};

bool writeScreenshot(const char* path, GLuint framebuffer) {
    std::vector<std::uint8_t> pixels(std::size_t(width_px) * std::size_t(height_px) * 3);
    glBindFramebuffer(GL_READ_FRAMEBUFFER, framebuffer);
    glPixelStorei(GL_PACK_ALIGNMENT, 1);
    glReadPixels(0, 0, width_px, height_px, GL_RGB, GL_UNSIGNED_BYTE, pixels.data());
    png_image image{};
    image.version = PNG_IMAGE_VERSION;
    image.width = width_px;
    image.height = height_px;
    image.format = PNG_FORMAT_RGB;
    return png_image_write_to_file(&image, path, 0, pixels.data(), -3 * width_px, nullptr) != 0;
}

}  // namespace

int main(int argc, char** argv) try {
    std::string technique = "exact", screenshot;
    bool hasShadows = true;
    for (int i = 1; i < argc; ++i) {
        const std::string flag = argv[i];
        if (flag == "--no-shadows") hasShadows = false;
        if (flag == "--technique" && i + 1 < argc) technique = argv[++i];
        if (flag == "--screenshot" && i + 1 < argc) screenshot = argv[++i];
    }
    if (!glfwInit()) return std::cerr << "GLFW finds no display\n", 1;
    glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, 4);
    glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, 5);
    glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
    glfwWindowHint(GLFW_ALPHA_BITS, 0);  // Filament's pbuffers have none, and Mesa's software driver minds
    GLFWwindow* const window =
        glfwCreateWindow(width_px, height_px, "Filament with shadows", nullptr, nullptr);
    if (window == nullptr) return std::cerr << "no OpenGL 4.5\n", 1;
    glfwMakeContextCurrent(window);

    const Cube cube;
    const std::vector<Box> boxes = makeScene();
    const Target target;
    Host host(cube, boxes, target);
    //! [start]
    std::unique_ptr<Shadows> shadows;
    if (hasShadows) shadows = std::make_unique<Shadows>(technique, cube, boxes);
    //! [start]
    do {
        host.draw();
        //! [draw]
        if (shadows) shadows->draw(target, host.camera());
        //! [draw]
        if (!screenshot.empty()) return writeScreenshot(screenshot.c_str(), target.framebuffer) ? 0 : 1;
        glBlitNamedFramebuffer(target.framebuffer, 0, 0, 0, width_px, height_px, 0, 0, width_px, height_px,
                               GL_COLOR_BUFFER_BIT, GL_NEAREST);
        glfwSwapBuffers(window);
        glfwWaitEvents();
    } while (!glfwWindowShouldClose(window));
    return 0;
} catch (const penumbra::Error& error) {
    std::cerr << error.what() << "\n";
    return 1;
}
