// SPDX-License-Identifier: Apache-2.0
// A Coin3D scene graph, rendered offscreen by Coin itself, with soft shadows of a square lamp: a node at the
// end of the scene that darkens what the others have drawn.
//
//     coin_host picture.png [TECHNIQUE | none]
#include <Inventor/SoDB.h>
#include <Inventor/SoOffscreenRenderer.h>
#include <Inventor/SoPrimitiveVertex.h>
#include <Inventor/actions/SoCallbackAction.h>
#include <Inventor/actions/SoGLRenderAction.h>
#include <Inventor/elements/SoViewVolumeElement.h>
#include <Inventor/elements/SoViewportRegionElement.h>
#include <Inventor/nodes/SoCallback.h>
#include <Inventor/nodes/SoCube.h>
#include <Inventor/nodes/SoDirectionalLight.h>
#include <Inventor/nodes/SoMaterial.h>
#include <Inventor/nodes/SoPerspectiveCamera.h>
#include <Inventor/nodes/SoSeparator.h>
#include <Inventor/nodes/SoSphere.h>
#include <Inventor/nodes/SoTransform.h>
#include <penumbra/penumbra.h>
#include <png.h>

#include <iostream>
#include <memory>
#include <string>
#include <vector>

namespace {

//! [meshes]
/// All triangles of the scene in world space, however its shapes make them.
struct Triangles {
    std::vector<penumbra::Vec3> positions;
    std::vector<std::uint32_t> indices;

    static void add(void* self, SoCallbackAction* action, const SoPrimitiveVertex* a,
                    const SoPrimitiveVertex* b, const SoPrimitiveVertex* c) {
        auto& triangles = *static_cast<Triangles*>(self);
        for (const SoPrimitiveVertex* const vertex : {a, b, c}) {
            SbVec3f world;
            action->getModelMatrix().multVecMatrix(vertex->getPoint(), world);
            triangles.indices.push_back(std::uint32_t(triangles.positions.size()));
            triangles.positions.push_back({world[0], world[1], world[2]});
        }
    }
};
//! [meshes]

//! [node]
class Shadows {
  public:
    Shadows(std::string technique, SoNode* scene) : name_(std::move(technique)), scene_(scene) {}

    static void draw(void* self, SoAction* action) {
        if (action->isOfType(SoGLRenderAction::getClassTypeId()))
            static_cast<Shadows*>(self)->draw(action->getState());
    }

  private:
    void draw(SoState* state) {
        if (!drawing_) drawing_ = std::make_unique<Drawing>(name_, scene_);
        const SbVec2s size_px = SoViewportRegionElement::get(state).getViewportSizePixels();
        SbMatrix viewFromWorld, clipFromView;
        SoViewVolumeElement::get(state).getMatrices(viewFromWorld, clipFromView);
        penumbra::View view;
        view.width_px = size_px[0];
        view.height_px = size_px[1];
        view.viewFromWorld = penumbra::Mat4::fromColumns(&viewFromWorld[0][0]);
        view.clipFromView = penumbra::Mat4::fromColumns(&clipFromView[0][0]);
        view.depth = {.range = penumbra::DepthConvention::Range::minusOneToOne, .reversed = false};
        penumbra::AreaLight light;  // 1.2 m square, five metres up, emitting down its -Z
        light.width_m = light.height_m = 1.2f;
        light.worldFromLight.columns = {{{1, 0, 0, 0}, {0, 0, -1, 0}, {0, 1, 0, 0}, {1, 5, 0.5f, 1}}};
        drawing_->framebuffer.copyDepth(0, view);
        drawing_->visibility.resize(view.width_px, view.height_px);
        const penumbra::Caster caster{.mesh = &drawing_->mesh};
        drawing_->technique->render({view, light, {&caster, 1}}, drawing_->visibility);
        drawing_->framebuffer.multiply(0, view, drawing_->visibility, 0.25f);
    }

    struct Drawing {
        Drawing(const std::string& name, SoNode* scene)
            : technique(penumbra::makeTechnique(device, name)), mesh(meshOf(device, scene)) {}
        static penumbra::Mesh meshOf(penumbra::Device& device, SoNode* scene) {
            Triangles triangles;
            SoCallbackAction action;
            action.addTriangleCallback(SoShape::getClassTypeId(), Triangles::add, &triangles);
            action.apply(scene);
            return penumbra::Mesh(device, {.positions = triangles.positions, .indices = triangles.indices});
        }
        penumbra::Device device;
        std::unique_ptr<penumbra::Technique> technique;
        penumbra::Mesh mesh;
        penumbra::HostFramebuffer framebuffer{device};
        penumbra::VisibilityBuffer visibility{device, 1, 1};
    };
    std::string name_;
    SoNode* scene_;
    std::unique_ptr<Drawing> drawing_;
};
//! [node]

template <typename Shape>
void add(SoGroup* scene, const SbVec3f& place, const SbVec3f& scale, const SbColor& color) {
    auto* const separator = new SoSeparator;
    auto* const transform = new SoTransform;
    transform->translation = place;
    transform->scaleFactor = scale;
    auto* const material = new SoMaterial;
    material->diffuseColor = color;
    separator->addChild(transform);
    separator->addChild(material);
    separator->addChild(new Shape);
    scene->addChild(separator);
}

}  // namespace

int main(int argc, char** argv) try {
    if (argc < 2) return std::cerr << "coin_host PICTURE.png [TECHNIQUE | none]\n", 1;
    const std::string technique = argc > 2 ? argv[2] : "exact";
    SoDB::init();
    auto* const root = new SoSeparator;
    root->ref();
    auto* const camera = new SoPerspectiveCamera;
    camera->position = SbVec3f(3, 4, 6);
    camera->pointAt(SbVec3f(0, 0.3f, 0), SbVec3f(0, 1, 0));
    camera->nearDistance = 1;
    camera->farDistance = 30;
    root->addChild(camera);
    auto* const sun = new SoDirectionalLight;
    sun->direction = SbVec3f(-0.2f, -1, -0.3f);
    root->addChild(sun);
    auto* const scene = new SoSeparator;
    add<SoCube>(scene, {0, -0.1f, 0}, {5, 0.1f, 5}, {0.8f, 0.8f, 0.78f});
    add<SoCube>(scene, {-0.9f, 1, 0}, {0.5f, 0.5f, 0.5f}, {0.75f, 0.4f, 0.3f});
    add<SoSphere>(scene, {1, 0.8f, 0.3f}, {0.6f, 0.6f, 0.6f}, {0.35f, 0.5f, 0.75f});
    root->addChild(scene);
    Shadows shadows(technique, scene);
    if (technique != "none") {
        auto* const callback = new SoCallback;
        callback->setCallback(Shadows::draw, &shadows);
        root->addChild(callback);
    }
    SoOffscreenRenderer renderer(SbViewportRegion(640, 400));
    if (!renderer.render(root)) return std::cerr << "Coin cannot render offscreen\n", 1;
    png_image image{};
    image.version = PNG_IMAGE_VERSION;
    image.width = 640;
    image.height = 400;
    image.format = PNG_FORMAT_RGB;
    return png_image_write_to_file(&image, argv[1], 0, renderer.getBuffer(), -3 * 640, nullptr) ? 0 : 1;
} catch (const penumbra::Error& error) {
    std::cerr << error.what() << "\n";
    return 1;
}
