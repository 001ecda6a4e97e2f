// SPDX-License-Identifier: Apache-2.0
// Two of OCCT's own views of one model, with soft shadows of a square lamp over what they have drawn. OCCT
// has a context for each view, and Penumbra a device for each; the meshes are made once. No line of OpenGL,
// whose headers OCCT has its own of, is needed.
//
//     occt_host [--technique NAME] [--screenshot picture.png] [--no-shadows]
#include <penumbra/penumbra.h>

#include <AIS_InteractiveContext.hxx>
#include <AIS_Shape.hxx>
#include <Aspect_DisplayConnection.hxx>
#include <BRepAlgoAPI_Cut.hxx>
#include <BRepPrimAPI_MakeBox.hxx>
#include <BRepPrimAPI_MakeCylinder.hxx>
#include <BRepPrimAPI_MakeTorus.hxx>
#include <BRep_Tool.hxx>
#include <Image_AlienPixMap.hxx>
#include <OpenGl_Context.hxx>
#include <OpenGl_Element.hxx>
#include <OpenGl_GraphicDriver.hxx>
#include <OpenGl_Group.hxx>
#include <OpenGl_View.hxx>
#include <OpenGl_Workspace.hxx>
#include <TopExp_Explorer.hxx>
#include <TopoDS.hxx>
#include <V3d_AmbientLight.hxx>
#include <V3d_PositionalLight.hxx>
#include <V3d_View.hxx>
#include <V3d_Viewer.hxx>
#include <Xw_Window.hxx>
#include <array>
#include <iostream>
#include <map>
#include <memory>
#include <string>
#include <vector>
// Last, since it calls everything Status and None.
#include <X11/Xlib.h>

namespace {

/// Millimetres, as OCCT's shapes mostly are; Penumbra takes what the matrices are in.
const gp_Pnt lampPlace(-90, -120, 260);

//! [meshes]
/// The triangles that OCCT draws of a shape, all faces in one mesh. Its faces do not share corners.
penumbra::Mesh meshOf(penumbra::Device& device, const TopoDS_Shape& shape) {
    std::vector<penumbra::Vec3> positions;
    std::vector<std::uint32_t> indices;
    for (TopExp_Explorer face(shape, TopAbs_FACE); face.More(); face.Next()) {
        TopLoc_Location place;
        const Handle(Poly_Triangulation) drawn =
            BRep_Tool::Triangulation(TopoDS::Face(face.Current()), place);
        const auto first = std::uint32_t(positions.size());
        for (int i = 1; i <= drawn->NbNodes(); ++i) {
            const gp_Pnt corner = drawn->Node(i).Transformed(place.Transformation());
            positions.push_back({float(corner.X()), float(corner.Y()), float(corner.Z())});
        }
        for (int i = 1; i <= drawn->NbTriangles(); ++i) {
            for (int corner = 1; corner <= 3; ++corner)
                indices.push_back(first + std::uint32_t(drawn->Triangle(i).Value(corner)) - 1);
        }
    }
    return penumbra::Mesh(device, {.positions = positions, .indices = indices});
}
//! [meshes]

//! [views]
/// What Penumbra has on the context of one of OCCT's views.
class ViewShadows {
  public:
    ViewShadows(const std::string& technique, const std::vector<Handle(AIS_Shape)>& shapes)
        : technique_(penumbra::makeTechnique(device_, technique)) {
        for (const Handle(AIS_Shape) & shape : shapes) {
            meshes_.push_back(std::make_unique<penumbra::Mesh>(meshOf(device_, shape->Shape())));
            Graphic3d_Mat4d place;
            shape->LocalTransformation().GetMat4(place);
            casters_.push_back({meshes_.back().get(), penumbra::Mat4::fromColumns(place.GetData())});
        }
        light_.width_m = light_.height_m = 70;
        Graphic3d_Camera alongIt;  // -Z, as lights do
        alongIt.SetEyeAndCenter(lampPlace, gp_Pnt(0, 0, 0));
        Graphic3d_Mat4 worldFromLight;
        alongIt.OrientationMatrixF().Inverted(worldFromLight);
        light_.worldFromLight = penumbra::Mat4::fromColumns(worldFromLight.GetData());
    }

    /// Over what the view has drawn into `framebuffer`.
    void draw(std::uint32_t framebuffer, const Graphic3d_CView& of) {
        penumbra::View view;
        of.Window()->Size(view.width_px, view.height_px);
        view.viewFromWorld = penumbra::Mat4::fromColumns(of.Camera()->OrientationMatrixF().GetData());
        view.clipFromView = penumbra::Mat4::fromColumns(of.Camera()->ProjectionMatrixF().GetData());
        view.depth = {.range = penumbra::DepthConvention::Range::minusOneToOne, .reversed = false};
        view.polygonOffset = {1, 1};  // OCCT's default for the faces of all shapes
        framebuffer_.copyDepth(framebuffer, view);
        visibility_.resize(view.width_px, view.height_px);
        technique_->render({view, light_, casters_}, visibility_);
        framebuffer_.multiply(framebuffer, view, visibility_, 0.3f);
    }

  private:
    penumbra::Device device_;
    std::unique_ptr<penumbra::Technique> technique_;
    penumbra::HostFramebuffer framebuffer_{device_};
    penumbra::VisibilityBuffer visibility_{device_, 1, 1};
    std::vector<std::unique_ptr<penumbra::Mesh>> meshes_;
    std::vector<penumbra::Caster> casters_;
    penumbra::AreaLight light_;
};

/// What OCCT calls while it draws a view, with that view's context and framebuffer: afterwards its depths are
/// gone from the window.
class ShadowElement final : public OpenGl_Element {
  public:
    ShadowElement(std::string technique, std::vector<Handle(AIS_Shape)> shapes)
        : technique_(std::move(technique)), shapes_(std::move(shapes)) {}
    void Render(const Handle(OpenGl_Workspace) & workspace) const override {
        const OpenGl_Context& context = *workspace->GetGlContext();
        std::unique_ptr<ViewShadows>& shadows = views_[&context];
        if (!shadows) shadows = std::make_unique<ViewShadows>(technique_, shapes_);
        int framebuffer = 0;
        context.core11fwd->glGetIntegerv(GL_FRAMEBUFFER_BINDING, &framebuffer);
        shadows->draw(std::uint32_t(framebuffer), *workspace->View());
    }
    void Release(OpenGl_Context*) override {}

  private:
    std::string technique_;
    std::vector<Handle(AIS_Shape)> shapes_;
    mutable std::map<const OpenGl_Context*, std::unique_ptr<ViewShadows>> views_;
};
//! [views]

std::vector<Handle(AIS_Shape)> makeScene() {
    const TopoDS_Shape plate = BRepPrimAPI_MakeBox(gp_Pnt(-200, -200, -10), gp_Pnt(200, 200, 0)).Shape();
    const TopoDS_Shape block = BRepPrimAPI_MakeBox(gp_Pnt(-70, -30, 0), gp_Pnt(10, 40, 50)).Shape();
    const TopoDS_Shape bore =
        BRepPrimAPI_MakeCylinder(gp_Ax2(gp_Pnt(-30, -60, 28), gp_Dir(0, 1, 0)), 15, 120).Shape();
    const TopoDS_Shape ring = BRepPrimAPI_MakeTorus(gp_Ax2(gp_Pnt(0, 0, 0), gp_Dir(0, 0, 1)), 32, 8).Shape();
    std::vector<Handle(AIS_Shape)> shapes = {
        new AIS_Shape(plate), new AIS_Shape(BRepAlgoAPI_Cut(block, bore).Shape()), new AIS_Shape(ring)};
    gp_Trsf turned, lifted;
    turned.SetRotation(gp_Ax1(gp_Pnt(0, 0, 0), gp_Dir(1, 0.3, 0)), 0.9);
    lifted.SetTranslation(gp_Vec(75, 0, 45));
    shapes[2]->SetLocalTransformation(lifted * turned);
    const std::array<Quantity_Color, 3> colors = {Quantity_Color(0.7, 0.7, 0.68, Quantity_TOC_sRGB),
                                                  Quantity_Color(0.75, 0.45, 0.35, Quantity_TOC_sRGB),
                                                  Quantity_Color(0.4, 0.55, 0.75, Quantity_TOC_sRGB)};
    for (std::size_t i = 0; i < shapes.size(); ++i) {
        shapes[i]->SetColor(colors[i]);
        shapes[i]->SetMaterial(Graphic3d_NameOfMaterial_Plastified);
        shapes[i]->SetColor(colors[i]);
    }
    return shapes;
}

Handle(V3d_View) makeView(const Handle(V3d_Viewer) & viewer, const char* title, const gp_Pnt& eye) {
    const Handle(V3d_View) view = viewer->CreateView();
    const Handle(Xw_Window) window =
        new Xw_Window(viewer->Driver()->GetDisplayConnection(), title, 0, 0, 640, 400);
    view->SetWindow(window);
    view->SetBackgroundColor(Quantity_Color(0.1, 0.1, 0.12, Quantity_TOC_sRGB));
    view->Camera()->SetProjectionType(Graphic3d_Camera::Projection_Perspective);
    view->Camera()->SetUp(gp_Dir(0, 0, 1));
    view->Camera()->SetEyeAndCenter(eye, gp_Pnt(0, 0, 15));
    view->Camera()->SetFOVy(30);
    window->Map();
    return view;
}

/// Both views, one over the other.
bool writeScreenshot(const std::array<Handle(V3d_View), 2>& views, const char* path) {
    Image_AlienPixMap picture;
    picture.InitZero(Image_Format_BGR, 640, 400 * views.size());
    picture.SetTopDown(false);
    for (std::size_t i = 0; i < views.size(); ++i) {
        Image_PixMap part;
        if (!views[i]->ToPixMap(part, 640, 400)) return false;
        for (std::size_t y = 0; y < 400; ++y) {
            for (std::size_t x = 0; x < 640; ++x)
                picture.SetPixelColor(int(x), int(400 * i + y), part.PixelColor(int(x), int(y)));
        }
    }
    return picture.Save(path);
}

}  // namespace

int main(int argc, char** argv) try {
    std::string technique = "exact", screenshot;
    bool shadows = true;
    for (int i = 1; i < argc; ++i) {
        const std::string flag = argv[i];
        if (flag == "--no-shadows") shadows = false;
        if (flag == "--technique" && i + 1 < argc) technique = argv[++i];
        if (flag == "--screenshot" && i + 1 < argc) screenshot = argv[++i];
    }
    const Handle(Aspect_DisplayConnection) display = new Aspect_DisplayConnection;
    const Handle(OpenGl_GraphicDriver) driver = new OpenGl_GraphicDriver(display);
    const Handle(V3d_Viewer) viewer = new V3d_Viewer(driver);
    const Handle(V3d_PositionalLight) light = new V3d_PositionalLight(lampPlace);
    const Handle(V3d_AmbientLight) ambient = new V3d_AmbientLight(Quantity_NOC_WHITE);
    ambient->SetIntensity(0.35f);
    for (const Handle(Graphic3d_CLight) & each :
         {Handle(Graphic3d_CLight)(light), Handle(Graphic3d_CLight)(ambient)}) {
        viewer->AddLight(each);
        viewer->SetLightOn(each);
    }
    const std::array<Handle(V3d_View), 2> views = {makeView(viewer, "from before", gp_Pnt(160, -420, 300)),
                                                   makeView(viewer, "from beside", gp_Pnt(-430, -130, 200))};
    const Handle(AIS_InteractiveContext) scene = new AIS_InteractiveContext(viewer);
    const std::vector<Handle(AIS_Shape)> shapes = makeScene();
    for (const Handle(AIS_Shape) & shape : shapes) scene->Display(shape, AIS_Shaded, -1, false);

    //! [start]
    const Handle(Graphic3d_Structure) last = new Graphic3d_Structure(viewer->StructureManager());
    last->SetInfiniteState(true);  // in every view
    last->SetDisplayPriority(10);  // behind all that is opaque, before what is transparent
    Handle(OpenGl_Group)::DownCast(last->NewGroup())->AddElement(new ShadowElement(technique, shapes));
    if (shadows) last->Display();
    //! [start]
    for (const Handle(V3d_View) & view : views) view->Redraw();
    if (!screenshot.empty()) return writeScreenshot(views, screenshot.c_str()) ? 0 : 1;
    auto* const x11 = reinterpret_cast<Display*>(display->GetDisplayAspect());
    for (XEvent event; XNextEvent(x11, &event) == 0 && event.type != KeyPress;) {
        if (event.type != Expose) continue;
        for (const Handle(V3d_View) & view : views) view->Redraw();
    }
    return 0;
} catch (const penumbra::Error& error) {
    std::cerr << error.what() << "\n";
    return 1;
}
