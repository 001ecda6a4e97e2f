// SPDX-License-Identifier: Apache-2.0
// A scene graph of Coin3D's in a window, drawn and lit by Coin, with soft shadows of a square lamp over it.
// Not a line of OpenGL is needed for them: the depths come out of the window, and the shadows go back into
// it.
//
//     coin_host [--technique NAME] [--screenshot picture.png] [--no-shadows]
#include <penumbra/penumbra.h>

#include <Inventor/SbViewportRegion.h>
#include <Inventor/SoDB.h>
#include <Inventor/SoInteraction.h>
#include <Inventor/SoPrimitiveVertex.h>
#include <Inventor/SoRenderManager.h>
#include <Inventor/actions/SoCallbackAction.h>
#include <Inventor/nodekits/SoNodeKit.h>
#include <Inventor/nodes/SoComplexity.h>
#include <Inventor/nodes/SoCone.h>
#include <Inventor/nodes/SoCube.h>
#include <Inventor/nodes/SoCylinder.h>
#include <Inventor/nodes/SoEnvironment.h>
#include <Inventor/nodes/SoMaterial.h>
#include <Inventor/nodes/SoPerspectiveCamera.h>
#include <Inventor/nodes/SoPointLight.h>
#include <Inventor/nodes/SoPolygonOffset.h>
#include <Inventor/nodes/SoSeparator.h>
#include <Inventor/nodes/SoSphere.h>
#include <Inventor/nodes/SoTransform.h>
#include <Inventor/system/gl.h>
#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <png.h>

#include <iostream>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace {

const SbVec3f lampPlace(1.5f, 5, 2);

//! [meshes]
/// What Coin draws, as triangles: one mesh a shape.
class CasterFinder {
  public:
    CasterFinder(penumbra::Device& device, SoNode* scene) {
        SoCallbackAction action;
        action.addPreCallback(SoShape::getClassTypeId(), startShape, this);
        action.addTriangleCallback(SoShape::getClassTypeId(), addTriangle, this);
        action.apply(scene);
        for (const Shape& shape : shapes_) {
            std::vector<std::uint32_t> indices(shape.corners.size());
            for (std::uint32_t i = 0; i < indices.size(); ++i) indices[i] = i;
            meshes_.emplace_back(device,
                                 penumbra::Mesh::Source{.positions = shape.corners, .indices = indices});
        }
        for (std::size_t i = 0; i < shapes_.size(); ++i)
            casters_.push_back({.mesh = &meshes_[i], .worldFromMesh = shapes_[i].worldFromShape});
    }
    const std::vector<penumbra::Caster>& casters() const { return casters_; }

  private:
    struct Shape {
        penumbra::Mat4 worldFromShape;
        std::vector<penumbra::Vec3> corners;
    };
    static SoCallbackAction::Response startShape(void* self, SoCallbackAction* action, const SoNode*) {
        static_cast<CasterFinder*>(self)->shapes_.push_back(
            {penumbra::Mat4::fromColumns(action->getModelMatrix()[0]), {}});
        return SoCallbackAction::CONTINUE;
    }
    static void addTriangle(void* self, SoCallbackAction*, const SoPrimitiveVertex* a,
                            const SoPrimitiveVertex* b, const SoPrimitiveVertex* c) {
        for (const SoPrimitiveVertex* const corner : {a, b, c}) {
            const SbVec3f& p = corner->getPoint();
            static_cast<CasterFinder*>(self)->shapes_.back().corners.push_back({p[0], p[1], p[2]});
        }
    }
    std::vector<Shape> shapes_;
    std::vector<penumbra::Mesh> meshes_;
    std::vector<penumbra::Caster> casters_;
};
//! [meshes]

//! [shadows]
/// After each of the manager's frames.
class Shadows {
  public:
    Shadows(const std::string& technique, SoNode* scene)
        : technique_(penumbra::makeTechnique(device_, technique)), finder_(device_, scene) {
        light_.width_m = light_.height_m = 1.2f;
        SbMatrix worldFromLight;  // -Z, as lights do, along the way to the middle
        worldFromLight.setTransform(lampPlace, SbRotation(SbVec3f(0, 0, -1), -lampPlace), SbVec3f(1, 1, 1));
        light_.worldFromLight = penumbra::Mat4::fromColumns(worldFromLight[0]);
    }
    static void draw(void* self, SoRenderManager* manager) { static_cast<Shadows*>(self)->draw(*manager); }

  private:
    void draw(const SoRenderManager& manager) {
        const SbViewportRegion& region = manager.getViewportRegion();
        SbMatrix viewFromWorld, clipFromView;
        manager.getCamera()
            ->getViewVolume(region.getViewportAspectRatio())
            .getMatrices(viewFromWorld, clipFromView);
        penumbra::View view;
        view.width_px = region.getViewportSizePixels()[0];
        view.height_px = region.getViewportSizePixels()[1];
        view.viewFromWorld = penumbra::Mat4::fromColumns(viewFromWorld[0]);
        view.clipFromView = penumbra::Mat4::fromColumns(clipFromView[0]);
        view.depth = {.range = penumbra::DepthConvention::Range::minusOneToOne, .reversed = false};
        view.polygonOffset = {1, 1};  // the scene's SoPolygonOffset
        framebuffer_.copyDepth(0, view);
        visibility_.resize(view.width_px, view.height_px);
        technique_->render({view, light_, finder_.casters()}, visibility_);
        framebuffer_.multiply(0, view, visibility_, 0.25f);
    }

    penumbra::Device device_;
    std::unique_ptr<penumbra::Technique> technique_;
    penumbra::HostFramebuffer framebuffer_{device_};
    penumbra::VisibilityBuffer visibility_{device_, 1, 1};
    CasterFinder finder_;
    penumbra::AreaLight light_;
};
//! [shadows]

SoSeparator* makeScene(SoPerspectiveCamera* camera) {
    auto* const scene = new SoSeparator;
    scene->addChild(camera);
    auto* const lamp = new SoPointLight;
    lamp->location = lampPlace;
    auto* const others = new SoEnvironment;
    others->ambientIntensity = 0.35f;
    auto* const offset = new SoPolygonOffset;  // as scenes have it whose edges are drawn over their faces
    offset->factor = offset->units = 1;
    auto* const fineness = new SoComplexity;
    fineness->value = 0.9f;
    for (SoNode* const node : {static_cast<SoNode*>(others), static_cast<SoNode*>(lamp),
                               static_cast<SoNode*>(offset), static_cast<SoNode*>(fineness)})
        scene->addChild(node);
    const auto add = [&](SoShape* shape, const SbVec3f& place, float angle, const SbColor& color) {
        auto* const part = new SoSeparator;
        auto* const transform = new SoTransform;
        transform->translation = place;
        transform->rotation.setValue(SbVec3f(0.3f, 1, 0.1f), angle);
        auto* const material = new SoMaterial;
        material->diffuseColor = material->ambientColor = color;
        for (SoNode* const node :
             {static_cast<SoNode*>(transform), static_cast<SoNode*>(material), static_cast<SoNode*>(shape)})
            part->addChild(node);
        scene->addChild(part);
    };
    auto* const ground = new SoCube;
    ground->width = ground->depth = 10;
    ground->height = 0.2f;
    add(ground, {0, -0.1f, 0}, 0, {0.8f, 0.8f, 0.78f});
    auto* const box = new SoCube;
    box->width = box->height = box->depth = 1.1f;
    add(box, {-1.2f, 1, 0.2f}, 0.6f, {0.75f, 0.4f, 0.3f});
    auto* const sphere = new SoSphere;
    sphere->radius = 0.55f;
    add(sphere, {1.2f, 0.75f, 0.8f}, 0, {0.35f, 0.5f, 0.75f});
    auto* const pillar = new SoCylinder;
    pillar->radius = 0.2f;
    pillar->height = 1.8f;
    add(pillar, {0.6f, 0.9f, -1.2f}, 0, {0.5f, 0.65f, 0.45f});
    return scene;
}

bool writeScreenshot(const char* path, int width_px, int height_px) {
    std::vector<std::uint8_t> pixels(std::size_t(width_px) * std::size_t(height_px) * 4);
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
    bool hasShadows = true;
    for (int i = 1; i < argc; ++i) {
        const std::string flag = argv[i];
        if (flag == "--no-shadows") hasShadows = false;
        if (flag == "--technique" && i + 1 < argc) technique = argv[++i];
        if (flag == "--screenshot" && i + 1 < argc) screenshot = argv[++i];
    }
    if (!glfwInit()) return std::cerr << "GLFW finds no display\n", 1;
    // No version and no profile asked for: Mesa gives the newest compatibility context, which Coin needs.
    GLFWwindow* const window = glfwCreateWindow(640, 400, "Coin with shadows", nullptr, nullptr);
    if (window == nullptr) return std::cerr << "no OpenGL\n", 1;
    glfwMakeContextCurrent(window);
    SoDB::init();
    SoNodeKit::init();
    SoInteraction::init();

    auto* const camera = new SoPerspectiveCamera;
    camera->position = SbVec3f(3, 4, 5);
    camera->heightAngle = 0.7f;
    SoSeparator* const scene = makeScene(camera);
    scene->ref();
    camera->pointAt(SbVec3f(0, 0.4f, 0));
    SoRenderManager manager;
    manager.setSceneGraph(scene);
    manager.setCamera(camera);
    manager.setBackgroundColor(SbColor4f(0.1f, 0.1f, 0.12f, 1));
    int width_px = 0, height_px = 0;
    glfwGetFramebufferSize(window, &width_px, &height_px);
    manager.setViewportRegion(SbViewportRegion(short(width_px), short(height_px)));
    manager.setWindowSize(SbVec2s(short(width_px), short(height_px)));
    //! [callback]
    std::optional<Shadows> shadows;
    if (hasShadows) {
        shadows.emplace(technique, scene);
        manager.addPostRenderCallback(Shadows::draw, &*shadows);
    }
    //! [callback]
    glEnable(GL_DEPTH_TEST);
    do {
        manager.render();
        if (!screenshot.empty()) return writeScreenshot(screenshot.c_str(), width_px, height_px) ? 0 : 1;
        glfwSwapBuffers(window);
        glfwWaitEvents();
    } while (!glfwWindowShouldClose(window));
    return 0;
} catch (const penumbra::Error& error) {
    std::cerr << error.what() << "\n";
    return 1;
}
