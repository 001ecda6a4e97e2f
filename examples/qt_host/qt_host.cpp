// SPDX-License-Identifier: Apache-2.0
// A QOpenGLWidget that draws a scene of its own, multisampled as Qt makes it, with soft shadows of a square
// lamp over it. Qt 5.15 and 6.
//
//     qt_host [--technique NAME] [--screenshot picture.png] [--no-shadows]
#include <penumbra/penumbra.h>

#include <QApplication>
#include <QMatrix4x4>
#include <QOpenGLBuffer>
#include <QOpenGLFunctions>
#include <QOpenGLShaderProgram>
#include <QOpenGLVertexArrayObject>
#include <QOpenGLWidget>
#include <iostream>
#include <optional>
#include <vector>

namespace {

struct Box {
    QMatrix4x4 worldFromBox;
    QVector3D color;
};

const std::vector<penumbra::Vec3> corners = {{-1, -1, -1}, {1, -1, -1}, {1, 1, -1}, {-1, 1, -1},
                                             {-1, -1, 1},  {1, -1, 1},  {1, 1, 1},  {-1, 1, 1}};
const std::vector<std::uint32_t> triangles = {0, 2, 1, 0, 3, 2, 4, 5, 6, 4, 6, 7, 0, 1, 5, 0, 5, 4,
                                              3, 6, 2, 3, 7, 6, 0, 4, 7, 0, 7, 3, 1, 2, 6, 1, 6, 5};

std::vector<Box> makeScene() {
    std::vector<Box> boxes(3);
    boxes[0].worldFromBox.translate(0, -0.1f, 0);
    boxes[0].worldFromBox.scale(5, 0.1f, 5);
    boxes[0].color = {0.8f, 0.8f, 0.78f};
    boxes[1].worldFromBox.translate(-0.9f, 1, 0.2f);
    boxes[1].worldFromBox.rotate(35, 0.2f, 1, 0.1f);
    boxes[1].worldFromBox.scale(0.55f);
    boxes[1].color = {0.75f, 0.4f, 0.3f};
    boxes[2].worldFromBox.translate(1.1f, 0.8f, -0.3f);
    boxes[2].worldFromBox.scale(0.25f, 0.8f, 0.25f);
    boxes[2].color = {0.35f, 0.5f, 0.75f};
    return boxes;
}

//! [shadows]
/// All that knows of Penumbra.
class Shadows {
  public:
    Shadows(const std::string& technique, const std::vector<Box>& boxes)
        : technique_(penumbra::makeTechnique(device_, technique)) {
        for (const Box& box : boxes) {
            casters_.push_back(
                {.mesh = &mesh_, .worldFromMesh = penumbra::Mat4::fromColumns(box.worldFromBox.constData())});
        }
        QMatrix4x4 viewFromLight;
        viewFromLight.lookAt({1.5f, 5, 2}, {0, 0, 0}, {0, 0, 1});
        light_.width_m = light_.height_m = 1.2f;
        light_.worldFromLight = penumbra::Mat4::fromColumns(viewFromLight.inverted().constData());
    }

    /// Over what is in the framebuffer.
    void draw(std::uint32_t framebuffer, const QSize& size, const QMatrix4x4& viewFromWorld,
              const QMatrix4x4& clipFromView) {
        penumbra::View view;
        view.width_px = size.width();
        view.height_px = size.height();
        view.viewFromWorld = penumbra::Mat4::fromColumns(viewFromWorld.constData());
        view.clipFromView = penumbra::Mat4::fromColumns(clipFromView.constData());
        view.depth = {.range = penumbra::DepthConvention::Range::minusOneToOne, .reversed = false};
        framebuffer_.copyDepth(framebuffer, view);
        visibility_.resize(view.width_px, view.height_px);
        technique_->render({view, light_, casters_}, visibility_);
        framebuffer_.multiply(framebuffer, view, visibility_, 0.25f);
    }

  private:
    penumbra::Device device_;
    std::unique_ptr<penumbra::Technique> technique_;
    penumbra::HostFramebuffer framebuffer_{device_};
    penumbra::VisibilityBuffer visibility_{device_, 1, 1};
    penumbra::Mesh mesh_{device_, {.positions = corners, .indices = triangles}};
    std::vector<penumbra::Caster> casters_;
    penumbra::AreaLight light_;
};
//! [shadows]

class Widget final : public QOpenGLWidget {
  public:
    explicit Widget(std::optional<std::string> technique) : technique_(std::move(technique)) {}
    ~Widget() override {
        makeCurrent();
        //! [destroy]
        shadows_.reset();
        //! [destroy]
        vertexArray_.destroy();
        doneCurrent();
    }

  private:
    void initializeGL() override {
        program_.addShaderFromSourceCode(QOpenGLShader::Vertex, R"(#version 450
            layout(location = 0) in vec3 position;
            uniform mat4 worldFromBox, clipFromWorld;
            out vec3 posWorld;
            void main() {
                posWorld = vec3(worldFromBox * vec4(position, 1.0));
                gl_Position = clipFromWorld * vec4(posWorld, 1.0);
            })");
        program_.addShaderFromSourceCode(QOpenGLShader::Fragment, R"(#version 450
            in vec3 posWorld;
            uniform vec3 color;
            out vec4 pixel;
            void main() {
                vec3 normal = normalize(cross(dFdx(posWorld), dFdy(posWorld)));
                pixel = vec4(color * (0.35 + 0.65 * max(dot(normal, normalize(vec3(1.5, 5.0, 2.0))), 0.0)), 1.0);
            })");
        program_.link();
        vertexArray_.create();
        vertexArray_.bind();
        positions_.create();
        positions_.bind();
        positions_.allocate(corners.data(), int(corners.size() * sizeof(corners[0])));
        indices_.create();
        indices_.bind();
        indices_.allocate(triangles.data(), int(triangles.size() * sizeof(triangles[0])));
        program_.bind();
        program_.enableAttributeArray(0);
        program_.setAttributeBuffer(0, GL_FLOAT, 0, 3);
        vertexArray_.release();
        //! [initialize]
        if (technique_) shadows_ = std::make_unique<Shadows>(*technique_, boxes_);
        //! [initialize]
    }
    void paintGL() override {
        QMatrix4x4 viewFromWorld, clipFromView;
        viewFromWorld.lookAt({3, 4, 5}, {0, 0.4f, 0}, {0, 1, 0});
        clipFromView.perspective(40, float(width()) / float(height()), 0.5f, 50);
        QOpenGLFunctions& gl = *QOpenGLContext::currentContext()->functions();
        gl.glClearColor(0.1f, 0.1f, 0.12f, 1);
        gl.glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
        gl.glEnable(GL_DEPTH_TEST);
        program_.bind();
        vertexArray_.bind();
        program_.setUniformValue("clipFromWorld", clipFromView * viewFromWorld);
        for (const Box& box : boxes_) {
            program_.setUniformValue("worldFromBox", box.worldFromBox);
            program_.setUniformValue("color", box.color);
            gl.glDrawElements(GL_TRIANGLES, GLsizei(triangles.size()), GL_UNSIGNED_INT, nullptr);
        }
        vertexArray_.release();
        //! [paint]
        if (shadows_) {
            const QSize size_px = size() * devicePixelRatioF();
            shadows_->draw(defaultFramebufferObject(), size_px, viewFromWorld, clipFromView);
        }
        //! [paint]
    }

    std::optional<std::string> technique_;
    std::vector<Box> boxes_ = makeScene();
    QOpenGLShaderProgram program_;
    QOpenGLVertexArrayObject vertexArray_;
    QOpenGLBuffer positions_{QOpenGLBuffer::VertexBuffer}, indices_{QOpenGLBuffer::IndexBuffer};
    //! [member]
    std::unique_ptr<Shadows> shadows_;
    //! [member]
};

}  // namespace

int main(int argc, char** argv) try {
    QSurfaceFormat format;
    format.setVersion(4, 5);
    format.setProfile(QSurfaceFormat::CompatibilityProfile);
    format.setDepthBufferSize(24);
    format.setStencilBufferSize(8);
    format.setSamples(4);
    QSurfaceFormat::setDefaultFormat(format);
    QApplication application(argc, argv);
    std::optional<std::string> technique = "exact";
    QString screenshot;
    for (int i = 1; i < argc; ++i) {
        const std::string flag = argv[i];
        if (flag == "--no-shadows") technique.reset();
        if (flag == "--technique" && i + 1 < argc) technique = argv[++i];
        if (flag == "--screenshot" && i + 1 < argc) screenshot = argv[++i];
    }
    Widget widget(technique);
    widget.resize(640, 400);
    widget.show();
    if (screenshot.isEmpty()) return application.exec();
    return widget.grabFramebuffer().save(screenshot) ? 0 : 1;
} catch (const penumbra::Error& error) {
    std::cerr << error.what() << "\n";
    return 1;
}
