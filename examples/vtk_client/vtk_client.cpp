// SPDX-License-Identifier: Apache-2.0
// Somebody else's renderer, with shadows: a VTK scene, drawn and lit by VTK, whose own depth buffer Penumbra
// reads after each frame. What the lamp's light adds to a pixel is scaled by what of the lamp the pixel sees.
//
//     vtk_client [--technique NAME] [--screenshot picture.png] [--no-shadows] [--samples N]
#include <penumbra/penumbra.h>
#include <vtkActor.h>
#include <vtkCamera.h>
#include <vtkCellArray.h>
#include <vtkCommand.h>
#include <vtkConeSource.h>
#include <vtkCubeSource.h>
#include <vtkCylinderSource.h>
#include <vtkLight.h>
#include <vtkMatrix4x4.h>
#include <vtkNew.h>
#include <vtkOpenGLFramebufferObject.h>
#include <vtkOpenGLRenderWindow.h>
#include <vtkPNGWriter.h>
#include <vtkPlaneSource.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>
#include <vtkRenderWindow.h>
#include <vtkRenderWindowInteractor.h>
#include <vtkRenderer.h>
#include <vtkSphereSource.h>
#include <vtkSuperquadricSource.h>
#include <vtkTextureObject.h>
#include <vtkTriangleFilter.h>
#include <vtkWindowToImageFilter.h>

#include <array>
#include <deque>
#include <iostream>
#include <memory>
#include <string>
#include <vector>

namespace {

const double lampPlace[3] = {1.2, 4.0, 1.6}, lampTarget[3] = {0, 0, 0};

//! [meshes]
/// VTK's matrices are for column vectors, row after row.
penumbra::Mat4 toPenumbra(vtkMatrix4x4* matrix) {
    return penumbra::Mat4::fromRows(matrix->GetData());
}

penumbra::Mesh toPenumbra(penumbra::Device& device, vtkPolyData* data) {
    vtkNew<vtkTriangleFilter> triangles;
    triangles->SetInputData(data);
    triangles->Update();
    vtkPolyData& drawn = *triangles->GetOutput();
    std::vector<penumbra::Vec3> positions;
    for (vtkIdType i = 0; i < drawn.GetNumberOfPoints(); ++i) {
        const double* const p = drawn.GetPoint(i);
        positions.push_back({float(p[0]), float(p[1]), float(p[2])});
    }
    vtkDataArray& corners = *drawn.GetPolys()->GetConnectivityArray();
    std::vector<std::uint32_t> indices;
    for (vtkIdType i = 0; i < corners.GetNumberOfTuples(); ++i)
        indices.push_back(std::uint32_t(corners.GetTuple1(i)));
    return penumbra::Mesh(device, {.positions = positions, .indices = indices});
}
//! [meshes]

//! [shadows]
/// A square lamp that hangs over the scene and looks down at it.
penumbra::AreaLight lamp() {
    vtkNew<vtkCamera> lookingAlongIt;  // -Z, as lights do
    lookingAlongIt->SetPosition(lampPlace);
    lookingAlongIt->SetFocalPoint(lampTarget);
    lookingAlongIt->SetViewUp(0, 0, 1);
    vtkNew<vtkMatrix4x4> worldFromLight;
    vtkMatrix4x4::Invert(lookingAlongIt->GetModelViewTransformMatrix(), worldFromLight);
    return {.worldFromLight = toPenumbra(worldFromLight), .width_m = 0.9f, .height_m = 0.9f};
}

/// What Penumbra has on the window's context.
struct Drawing {
    Drawing(const std::string& name, vtkActorCollection& actors)
        : technique(penumbra::makeTechnique(device, name)) {
        actors.InitTraversal();
        while (vtkActor* const actor = actors.GetNextActor()) {
            vtkPolyData* const data = vtkPolyData::SafeDownCast(actor->GetMapper()->GetInput());
            casters.push_back({.mesh = &meshes.emplace_back(toPenumbra(device, data)),
                               .worldFromMesh = toPenumbra(actor->GetMatrix())});
        }
    }
    penumbra::Device device;
    std::unique_ptr<penumbra::Technique> technique;
    penumbra::HostFramebuffer framebuffer{device};
    penumbra::VisibilityBuffer visibility{device, 1, 1};
    std::deque<penumbra::Mesh> meshes;
    std::vector<penumbra::Caster> casters;
};

/// The lamp's shadows over whatever the renderer has drawn.
class ShadowPass final : public vtkCommand {
  public:
    explicit ShadowPass(std::string technique) : name_(std::move(technique)) {}

    void Execute(vtkObject* caller, unsigned long, void*) override {
        auto* const renderer = static_cast<vtkRenderer*>(caller);
        auto* const window = static_cast<vtkOpenGLRenderWindow*>(renderer->GetRenderWindow());
        if (!drawing_) drawing_ = std::make_unique<Drawing>(name_, *renderer->GetActors());
        const penumbra::View view = viewOf(renderer, window);
        drawing_->visibility.resize(view.width_px, view.height_px);
        drawing_->technique->render({view, lamp(), drawing_->casters}, drawing_->visibility);
        drawing_->framebuffer.multiply(window->GetRenderFramebuffer()->GetFBOIndex(), view,
                                       drawing_->visibility, 0.16f);
    }

  private:
    static penumbra::View viewOf(vtkRenderer* renderer, vtkOpenGLRenderWindow* window) {
        vtkCamera* const camera = renderer->GetActiveCamera();
        penumbra::View view;
        view.width_px = window->GetSize()[0];
        view.height_px = window->GetSize()[1];
        view.viewFromWorld = toPenumbra(camera->GetModelViewTransformMatrix());
        view.clipFromView =
            toPenumbra(camera->GetProjectionTransformMatrix(renderer->GetTiledAspectRatio(), -1, 1));
        // Multisampled, where the window is.
        view.depthTexture = window->GetRenderFramebuffer()->GetDepthAttachmentAsTextureObject()->GetHandle();
        // As OpenGL has it since 1992: -1..1, near before far.
        view.depth = {.range = penumbra::DepthConvention::Range::minusOneToOne, .reversed = false};
        return view;
    }

    std::string name_;
    std::unique_ptr<Drawing> drawing_;
};
//! [shadows]

template <typename Source>
vtkActor* add(vtkRenderer* renderer, Source& source, const std::array<double, 3>& place,
              const std::array<double, 3>& color) {
    vtkNew<vtkPolyDataMapper> mapper;
    source->Update();
    mapper->SetInputData(source->GetOutput());
    vtkNew<vtkActor> actor;
    actor->SetMapper(mapper);
    actor->SetPosition(place[0], place[1], place[2]);
    actor->GetProperty()->SetColor(color[0], color[1], color[2]);
    actor->GetProperty()->SetAmbient(0.1);
    actor->GetProperty()->SetDiffuse(0.9);
    renderer->AddActor(actor);
    return actor;
}

void buildScene(vtkRenderer* renderer) {
    vtkNew<vtkPlaneSource> ground;
    ground->SetOrigin(-5, 0, -5);
    ground->SetPoint1(-5, 0, 5);
    ground->SetPoint2(5, 0, -5);
    add(renderer, ground, {0, 0, 0}, {0.82, 0.82, 0.8});
    vtkNew<vtkSuperquadricSource> torus;
    torus->ToroidalOn();
    torus->SetThickness(0.3);
    torus->SetSize(0.9);
    torus->SetThetaResolution(96);
    torus->SetPhiResolution(48);
    add(renderer, torus, {-1.2, 1.0, 0.2}, {0.85, 0.55, 0.3})->RotateX(55);
    vtkNew<vtkSphereSource> sphere;
    sphere->SetRadius(0.55);
    sphere->SetThetaResolution(64);
    sphere->SetPhiResolution(48);
    add(renderer, sphere, {1.3, 0.55, -0.6}, {0.4, 0.6, 0.85});
    vtkNew<vtkCylinderSource> pillar;
    pillar->SetHeight(1.8);
    pillar->SetRadius(0.16);
    pillar->SetResolution(48);
    add(renderer, pillar, {0.4, 0.9, -1.4}, {0.75, 0.75, 0.72});
    vtkNew<vtkCubeSource> box;
    box->SetXLength(0.8);
    box->SetYLength(0.5);
    box->SetZLength(0.8);
    add(renderer, box, {0.9, 0.25, 1.3}, {0.5, 0.7, 0.45})->RotateY(30);
}

}  // namespace

int main(int argc, char** argv) try {
    std::string technique = "exact", screenshot;
    bool shadows = true;
    int samples = vtkOpenGLRenderWindow::GetGlobalMaximumNumberOfMultiSamples();  // VTK's default
    for (int i = 1; i < argc; ++i) {
        const std::string flag = argv[i];
        if (flag == "--no-shadows") shadows = false;
        if (flag == "--technique" && i + 1 < argc) technique = argv[++i];
        if (flag == "--screenshot" && i + 1 < argc) screenshot = argv[++i];
        if (flag == "--samples" && i + 1 < argc) samples = std::stoi(argv[++i]);
    }

    vtkNew<vtkRenderer> renderer;
    buildScene(renderer);
    renderer->SetBackground(0.55, 0.62, 0.7);
    vtkNew<vtkLight> light;
    light->SetLightTypeToSceneLight();
    light->SetPositional(true);
    light->SetConeAngle(90);
    light->SetPosition(lampPlace);
    light->SetFocalPoint(lampTarget);
    renderer->AddLight(light);
    renderer->GetActiveCamera()->SetPosition(3.2, 3.4, 5.2);
    renderer->GetActiveCamera()->SetFocalPoint(0, 0.4, 0);
    renderer->ResetCameraClippingRange();

    vtkNew<vtkRenderWindow> window;
    window->SetMultiSamples(samples);
    window->SetSize(640, 400);
    window->SetOffScreenRendering(screenshot.empty() ? 0 : 1);
    window->AddRenderer(renderer);

    vtkNew<vtkRenderWindowInteractor> interactor;
    interactor->SetRenderWindow(window);
    //! [observer]
    vtkSmartPointer<ShadowPass> pass = vtkSmartPointer<ShadowPass>::Take(new ShadowPass(technique));
    if (shadows) renderer->AddObserver(vtkCommand::EndEvent, pass);
    //! [observer]
    // Twice, so that what the first frame leaves behind would show in the second.
    window->Render();
    window->Render();
    if (screenshot.empty()) {
        interactor->Start();
    } else {
        vtkNew<vtkWindowToImageFilter> picture;
        picture->SetInput(window);
        picture->ReadFrontBufferOff();
        picture->ShouldRerenderOff();
        vtkNew<vtkPNGWriter> writer;
        writer->SetInputConnection(picture->GetOutputPort());
        writer->SetFileName(screenshot.c_str());
        writer->Write();
    }
    return 0;
} catch (const penumbra::Error& error) {
    std::cerr << error.what() << "\n";
    return 1;
}
