// SPDX-License-Identifier: Apache-2.0
// OpenSceneGraph's own viewer and lighting, with soft shadows of a square lamp over what it has drawn. Not a
// line of OpenGL is needed: the depths come out of the window, and the shadows go back into it.
//
//     osg_host [--technique NAME] [--screenshot picture.png] [--no-shadows] [--on-earth]
//
// --on-earth: the same scene at the Earth's radius from the world's origin, as globes in metres have them.
#include <penumbra/penumbra.h>

#include <iostream>
#include <map>
#include <osg/Geode>
#include <osg/MatrixTransform>
#include <osg/ShapeDrawable>
#include <osg/TriangleIndexFunctor>
#include <osgDB/WriteFile>
#include <osgViewer/Viewer>
#include <string>

namespace {

//! [meshes]
struct Triangles {
    std::vector<std::uint32_t> indices;
    void operator()(unsigned a, unsigned b, unsigned c) { indices.insert(indices.end(), {a, b, c}); }
};

/// Finds what is drawn: a mesh for each geometry, and where it stands.
class CasterFinder final : public osg::NodeVisitor {
  public:
    CasterFinder(penumbra::Device& device, std::map<osg::Geometry*, penumbra::Mesh>& meshes,
                 const penumbra::WorldOrigin& origin)
        : NodeVisitor(TRAVERSE_ACTIVE_CHILDREN), device_(device), meshes_(meshes), origin_(origin) {}
    std::vector<penumbra::Caster> casters;

    void apply(osg::Geometry& geometry) override {
        const auto& positions = static_cast<const osg::Vec3Array&>(*geometry.getVertexArray());
        if (!meshes_.contains(&geometry)) {
            osg::TriangleIndexFunctor<Triangles> triangles;
            geometry.accept(triangles);
            static_assert(sizeof(osg::Vec3f) == sizeof(penumbra::Vec3));
            meshes_.emplace(&geometry,
                            penumbra::Mesh(device_, {.positions = {reinterpret_cast<const penumbra::Vec3*>(
                                                                       positions.getDataPointer()),
                                                                   positions.size()},
                                                     .indices = triangles.indices}));
        }
        casters.push_back(
            {.mesh = &meshes_.at(&geometry),
             .worldFromMesh = origin_.worldFrom(osg::computeLocalToWorld(getNodePath()).ptr())});
    }

  private:
    penumbra::Device& device_;
    std::map<osg::Geometry*, penumbra::Mesh>& meshes_;
    penumbra::WorldOrigin origin_;
};
//! [meshes]

//! [callback]
/// After each frame.
class Shadows final : public osg::Camera::DrawCallback {
  public:
    Shadows(std::string technique, const osg::Vec3d& lampTarget) : name_(std::move(technique)) {
        const osg::Vec3d lampPlace = lampTarget + osg::Vec3d(2, -1.5, 5);
        worldFromLight_.invert(osg::Matrixd::lookAt(lampPlace, lampTarget, osg::Vec3d(0, 1, 0)));
    }

    void operator()(osg::RenderInfo& info) const override {
        if (!drawing_) drawing_ = std::make_unique<Drawing>(name_);
        Drawing& drawing = *drawing_;
        osg::Camera& camera = *info.getCurrentCamera();
        const osg::Viewport& viewport = *camera.getViewport();
        // Worlds may be so large that floats cannot hold them: everything is told as seen from the eye.
        const osg::Vec3d eye = osg::Matrixd::inverse(camera.getViewMatrix()).getTrans();
        const penumbra::WorldOrigin origin{eye.x(), eye.y(), eye.z()};
        penumbra::View view;
        view.width_px = int(viewport.width());
        view.height_px = int(viewport.height());
        view.viewFromWorld = origin.fromWorld(camera.getViewMatrix().ptr());
        view.clipFromView = penumbra::Mat4::fromColumns(camera.getProjectionMatrix().ptr());
        view.depth = {.range = penumbra::DepthConvention::Range::minusOneToOne, .reversed = false};
        drawing.framebuffer.copyDepth(0, view);
        CasterFinder finder(drawing.device, drawing.meshes, origin);
        camera.accept(finder);
        drawing.visibility.resize(view.width_px, view.height_px);
        const penumbra::AreaLight lamp = {
            .worldFromLight = origin.worldFrom(worldFromLight_.ptr()), .width_m = 1.2f, .height_m = 1.2f};
        drawing.technique->render({view, lamp, finder.casters}, drawing.visibility);
        drawing.framebuffer.multiply(0, view, drawing.visibility, 0.25f);
    }

  private:
    struct Drawing {
        explicit Drawing(const std::string& name) : technique(penumbra::makeTechnique(device, name)) {}
        penumbra::Device device;
        std::unique_ptr<penumbra::Technique> technique;
        penumbra::HostFramebuffer framebuffer{device};
        penumbra::VisibilityBuffer visibility{device, 1, 1};
        std::map<osg::Geometry*, penumbra::Mesh> meshes;
    };
    std::string name_;
    osg::Matrixd worldFromLight_;
    mutable std::unique_ptr<Drawing> drawing_;
};
//! [callback]

/// The picture, after the shadows.
class Screenshot final : public osg::Camera::DrawCallback {
  public:
    Screenshot(osg::ref_ptr<osg::Camera::DrawCallback> before, std::string path)
        : before_(std::move(before)), path_(std::move(path)) {}
    void operator()(osg::RenderInfo& info) const override {
        if (before_) (*before_)(info);
        const osg::Viewport& viewport = *info.getCurrentCamera()->getViewport();
        osg::ref_ptr<osg::Image> image = new osg::Image;
        image->readPixels(0, 0, int(viewport.width()), int(viewport.height()), GL_RGB, GL_UNSIGNED_BYTE);
        osgDB::writeImageFile(*image, path_);
    }

  private:
    osg::ref_ptr<osg::Camera::DrawCallback> before_;
    std::string path_;
};

osg::ref_ptr<osg::Group> buildScene(const osg::Vec3d& middle) {
    osg::ref_ptr<osg::MatrixTransform> scene = new osg::MatrixTransform(osg::Matrixd::translate(middle));
    const auto add = [&](osg::ref_ptr<osg::Shape> shape, const osg::Vec4& color) {
        osg::ref_ptr<osg::ShapeDrawable> drawable = new osg::ShapeDrawable(shape);
        drawable->setColor(color);
        osg::ref_ptr<osg::Geode> geode = new osg::Geode;
        geode->addDrawable(drawable);
        osg::ref_ptr<osg::MatrixTransform> place = new osg::MatrixTransform;
        place->addChild(geode);
        scene->addChild(place);
        return place;
    };
    add(new osg::Box(osg::Vec3(0, 0, -0.1f), 10, 10, 0.2f), {0.8f, 0.8f, 0.78f, 1});
    add(new osg::Box(osg::Vec3(), 1, 1, 1), {0.75f, 0.4f, 0.3f, 1})
        ->setMatrix(osg::Matrix::rotate(0.6, osg::Z_AXIS) * osg::Matrix::translate(-1.1, 0.3, 1.0));
    add(new osg::Sphere(osg::Vec3(0.9f, -0.4f, 0.8f), 0.6f), {0.35f, 0.5f, 0.75f, 1});
    return scene;
}

}  // namespace

int main(int argc, char** argv) try {
    std::string technique = "exact", screenshot;
    bool shadows = true;
    osg::Vec3d middle(0, 0, 0);
    for (int i = 1; i < argc; ++i) {
        const std::string flag = argv[i];
        if (flag == "--no-shadows") shadows = false;
        if (flag == "--on-earth") middle = {5.1e6, -3.2e6, 2.1e6};
        if (flag == "--technique" && i + 1 < argc) technique = argv[++i];
        if (flag == "--screenshot" && i + 1 < argc) screenshot = argv[++i];
    }
    osgViewer::Viewer viewer;
    viewer.setThreadingModel(osgViewer::Viewer::SingleThreaded);
    viewer.setUpViewInWindow(0, 0, 640, 400);
    viewer.setSceneData(buildScene(middle));
    viewer.getCamera()->setViewMatrixAsLookAt(middle + osg::Vec3d(3, -6, 4.5), middle + osg::Vec3d(0, 0, 0.4),
                                              osg::Z_AXIS);
    viewer.getCamera()->setClearColor({0.1f, 0.1f, 0.12f, 1});
    osg::ref_ptr<osg::Camera::DrawCallback> callback;
    //! [set]
    if (shadows) callback = new Shadows(technique, middle);
    //! [set]
    if (!screenshot.empty()) callback = new Screenshot(callback, screenshot);
    viewer.getCamera()->setFinalDrawCallback(callback);
    viewer.realize();
    if (screenshot.empty()) return viewer.run();
    viewer.frame();
    return 0;
} catch (const penumbra::Error& error) {
    std::cerr << error.what() << "\n";
    return 1;
}
