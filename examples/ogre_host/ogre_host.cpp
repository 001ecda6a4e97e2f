// SPDX-License-Identifier: Apache-2.0
// OGRE's own scene, window and lighting, with soft shadows of a square lamp over what it has drawn. Not a
// line of OpenGL is needed: the depths come out of the window, and the shadows go back into it.
//
//     ogre_host [--technique NAME] [--screenshot picture.png] [--no-shadows]
#include <penumbra/penumbra.h>

#include <Ogre.h>

#include <iostream>
#include <map>
#include <memory>
#include <string>
#include <vector>

namespace {

const Ogre::Vector3 lampPlace(150, 500, 200);

//! [meshes]
/// OGRE's matrices are for column vectors, row after row.
penumbra::Mat4 toPenumbra(const Ogre::Matrix4& matrix) {
    return penumbra::Mat4::fromRows(matrix[0]);
}

penumbra::Mesh toPenumbra(penumbra::Device& device, const Ogre::Mesh& mesh) {
    std::vector<penumbra::Vec3> positions;
    std::vector<std::uint32_t> indices;
    for (const Ogre::SubMesh* const part : mesh.getSubMeshes()) {
        const auto first = std::uint32_t(positions.size());
        const Ogre::VertexData& vertices =
            part->useSharedVertices ? *mesh.sharedVertexData : *part->vertexData;
        const Ogre::VertexElement& place =
            *vertices.vertexDeclaration->findElementBySemantic(Ogre::VES_POSITION);
        const auto buffer = vertices.vertexBufferBinding->getBuffer(place.getSource());
        const Ogre::HardwareBufferLockGuard vertexLock(buffer, Ogre::HardwareBuffer::HBL_READ_ONLY);
        for (std::size_t i = 0; i < vertices.vertexCount; ++i) {
            float* position = nullptr;
            place.baseVertexPointerToElement(
                static_cast<char*>(vertexLock.pData) + (vertices.vertexStart + i) * buffer->getVertexSize(),
                &position);
            positions.push_back({position[0], position[1], position[2]});
        }
        const auto source = part->indexData->indexBuffer;
        const Ogre::HardwareBufferLockGuard indexLock(source, Ogre::HardwareBuffer::HBL_READ_ONLY);
        const bool isShort = source->getType() == Ogre::HardwareIndexBuffer::IT_16BIT;
        for (std::size_t i = part->indexData->indexStart;
             i < part->indexData->indexStart + part->indexData->indexCount; ++i) {
            indices.push_back(first + (isShort ? static_cast<const std::uint16_t*>(indexLock.pData)[i]
                                               : static_cast<const std::uint32_t*>(indexLock.pData)[i]));
        }
    }
    return penumbra::Mesh(device, {.positions = positions, .indices = indices});
}
//! [meshes]

//! [shadows]
/// After each viewport, before the window's buffers are swapped.
class Shadows final : public Ogre::RenderTargetListener {
  public:
    Shadows(const std::string& technique, Ogre::SceneManager& scene)
        : technique_(penumbra::makeTechnique(device_, technique)), scene_(scene) {
        light_.width_m = light_.height_m = 120;
        Ogre::Matrix4 worldFromLight;  // -Z, as lights do, along the way to the middle
        worldFromLight.makeTransform(
            lampPlace, Ogre::Vector3::UNIT_SCALE,
            Ogre::Vector3::NEGATIVE_UNIT_Z.getRotationTo(-lampPlace.normalisedCopy()));
        light_.worldFromLight = toPenumbra(worldFromLight);
    }

    void postViewportUpdate(const Ogre::RenderTargetViewportEvent& event) override {
        const Ogre::Camera& camera = *event.source->getCamera();
        std::vector<penumbra::Caster> casters;
        for (const auto& [name, object] : scene_.getMovableObjects("Entity")) {
            const Ogre::MeshPtr& mesh = static_cast<Ogre::Entity*>(object)->getMesh();
            auto known = meshes_.find(mesh.get());
            if (known == meshes_.end()) known = meshes_.emplace(mesh.get(), toPenumbra(device_, *mesh)).first;
            casters.push_back({.mesh = &known->second,
                               .worldFromMesh = toPenumbra(object->getParentNode()->_getFullTransform())});
        }
        penumbra::View view;
        view.width_px = event.source->getActualWidth();
        view.height_px = event.source->getActualHeight();
        view.viewFromWorld = toPenumbra(camera.getViewMatrix());
        view.clipFromView =
            toPenumbra(camera.getProjectionMatrix());  // OpenGL's -1..1, whatever the renderer
        view.depth = {.range = penumbra::DepthConvention::Range::minusOneToOne, .reversed = false};
        framebuffer_.copyDepth(0, view);
        visibility_.resize(view.width_px, view.height_px);
        technique_->render({view, light_, casters}, visibility_);
        framebuffer_.multiply(0, view, visibility_, 0.25f);
    }

  private:
    penumbra::Device device_;
    std::unique_ptr<penumbra::Technique> technique_;
    penumbra::HostFramebuffer framebuffer_{device_};
    penumbra::VisibilityBuffer visibility_{device_, 1, 1};
    std::map<const Ogre::Mesh*, penumbra::Mesh> meshes_;
    Ogre::SceneManager& scene_;
    penumbra::AreaLight light_;
};
//! [shadows]

void buildScene(Ogre::SceneManager& scene) {
    scene.setAmbientLight(Ogre::ColourValue(0.35f, 0.35f, 0.35f));
    Ogre::SceneNode& root = *scene.getRootSceneNode();
    root.createChildSceneNode(lampPlace)->attachObject(scene.createLight("lamp"));  // shines all around
    const auto add = [&](const char* name, Ogre::SceneManager::PrefabType shape, const Ogre::Vector3& place,
                         const Ogre::Vector3& scale, const Ogre::ColourValue& color) {
        const Ogre::MaterialPtr material = Ogre::MaterialManager::getSingleton().create(name, "General");
        material->setDiffuse(color);
        material->setAmbient(color);
        Ogre::Entity* const entity = scene.createEntity(name, shape);
        entity->setMaterial(material);
        Ogre::SceneNode* const node = root.createChildSceneNode(place);
        node->setScale(scale);
        node->attachObject(entity);
        return node;
    };
    // The prefabricated shapes are a hundred units wide.
    add("ground", Ogre::SceneManager::PT_CUBE, {0, -10, 0}, {10, 0.2f, 10},
        Ogre::ColourValue(0.8f, 0.8f, 0.78f));
    add("box", Ogre::SceneManager::PT_CUBE, {-100, 100, 20}, {1.1f, 1.1f, 1.1f},
        Ogre::ColourValue(0.75f, 0.4f, 0.3f))
        ->yaw(Ogre::Radian(0.6f));
    add("ball", Ogre::SceneManager::PT_SPHERE, {110, 75, 60}, {1, 1, 1},
        Ogre::ColourValue(0.35f, 0.5f, 0.75f));
    add("pillar", Ogre::SceneManager::PT_CUBE, {60, 90, -120}, {0.4f, 1.8f, 0.4f},
        Ogre::ColourValue(0.5f, 0.65f, 0.45f));
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
    Ogre::Root root("", "", "");
    for (const char* const plugin : {"/RenderSystem_GL", "/Codec_STBI"})
        root.loadPlugin(std::string(OGRE_PLUGINS) + plugin);
    root.setRenderSystem(root.getAvailableRenderers().front());
    root.initialise(false);
    Ogre::RenderWindow* const window = root.createRenderWindow("OGRE with shadows", 640, 400, false);
    Ogre::SceneManager& scene = *root.createSceneManager();
    buildScene(scene);
    Ogre::Camera* const camera = scene.createCamera("camera");
    camera->setNearClipDistance(50);
    camera->setFarClipDistance(5000);
    camera->setFOVy(Ogre::Radian(0.7f));
    camera->setAspectRatio(1.6f);
    Ogre::SceneNode* const eye = scene.getRootSceneNode()->createChildSceneNode(Ogre::Vector3(300, 400, 500));
    eye->attachObject(camera);
    eye->lookAt({0, 40, 0}, Ogre::Node::TS_WORLD);
    window->addViewport(camera)->setBackgroundColour(Ogre::ColourValue(0.1f, 0.1f, 0.12f));

    //! [listener]
    std::unique_ptr<Shadows> shadows;
    if (hasShadows) {
        shadows = std::make_unique<Shadows>(technique, scene);
        window->addListener(shadows.get());
    }
    //! [listener]
    if (screenshot.empty()) {
        root.startRendering();
    } else {
        window->update(false);  // not swapped
        window->writeContentsToFile(screenshot);
    }
    if (shadows) window->removeListener(shadows.get());
    return 0;
} catch (const penumbra::Error& error) {
    std::cerr << error.what() << "\n";
    return 1;
}
