// SPDX-License-Identifier: Apache-2.0
// The door: every row of the table in docs/manual/misuse.md, done.
#include <algorithm>
#include <array>
#include <cctype>
#include <exception>
#include <fstream>
#include <limits>
#include <map>
#include <regex>
#include <thread>

#include "src/gl/texture.h"
#include "studio/frame/conversions.h"
#include "tests/support/host_test.h"

namespace penumbra::studio {
namespace {

struct Row {
    std::string what, kind, message;
};

std::vector<Row> tableOfMisuse() {
    static const std::regex row("^\\| ([^|]+) \\| (\\w+) \\| ([^|]+) \\|$");
    std::vector<Row> rows;
    std::ifstream text(PENUMBRA_SOURCE_DIRECTORY "/docs/manual/misuse.md");
    std::smatch match;
    for (std::string line; std::getline(text, line);) {
        if (std::regex_match(line, match, row) && match[1] != "what")
            rows.push_back({match[1], match[2], match[3]});
    }
    return rows;
}

std::string nameOf(Error::Kind kind) {
    switch (kind) {
        case Error::Kind::noOpenGL:
            return "noOpenGL";
        case Error::Kind::badArgument:
            return "badArgument";
        case Error::Kind::unknownName:
            return "unknownName";
        case Error::Kind::lostContext:
            return "lostContext";
        default:
            return "another kind";
    }
}

const std::vector<Vec3> corners = {{0, 0.3f, 0}, {0.5f, 0.3f, 0}, {0, 0.9f, 0}, {0, 0.3f, 0.5f}};
const std::vector<std::uint32_t> triangles = {0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3};
constexpr float nan = std::numeric_limits<float>::quiet_NaN();
constexpr std::uint32_t noTexture = 54321;

Mat4 transposed(const Mat4& matrix) {
    return toPenumbra(glm::transpose(fromPenumbra(matrix)));
}

/// Sets what it is told to, wherever the parameters say that it may.
class Setter final : public ParameterVisitor {
  public:
    explicit Setter(int value) : value_(value) {}
    void boolean(const ParameterInfo&, bool&) override {}
    void integer(const ParameterInfo&, int& value, Range<int>) override { value = value_; }
    void real(const ParameterInfo&, float&, Range<float>) override {}
    void choice(const ParameterInfo&, int& value, std::span<const std::string_view>) override {
        value = value_;
    }

  private:
    int value_;
};

class Misuse : public HostTest, public ::testing::WithParamInterface<Row> {
  protected:
    /// A right call, for `change` to make wrong.
    void renderWrong(const std::function<void()>& change) {
        prepare();
        change();
        inputs_.casters = casters_;
        technique_->render(inputs_, *out_);
    }
    void prepare() {
        inputs_ = drawScene();
        technique_ = workbench().makeTechnique("hard");
        out_.emplace(device(), inputs_.view.width_px, inputs_.view.height_px);
        mesh_.emplace(device(), penumbra::Mesh::Source{.positions = corners, .indices = triangles});
        casters_ = {{.mesh = &*mesh_}, {.mesh = &*mesh_}};
    }
    gl::Texture texture(GLenum format, int layers = 0) const {
        const View& view = inputs_.view;
        return gl::Texture({.width_px = view.width_px,
                            .height_px = view.height_px,
                            .layers = layers,
                            .format = gl::Format(format),
                            .label = "host's"});
    }
    penumbra::Mesh meshOn(Device& on) const {
        return penumbra::Mesh(on, {.positions = corners, .indices = triangles});
    }
    void withTexture(GLenum format, int layers, const std::function<void(GLuint)>& use) {
        renderWrong([&] {
            kept_ = texture(format, layers);
            use(kept_.name());
        });
    }
    void TearDown() override {
        workbench().makeCurrent();
        technique_.reset();
        out_.reset();
        mesh_.reset();
        otherMesh_.reset();
        otherDevice_.reset();
        kept_ = {};
        HostTest::TearDown();
    }
    using Calls = std::map<std::string, std::function<void()>>;
    Calls calls();

    ShadowInputs inputs_;
    std::vector<Caster> casters_;
    std::unique_ptr<Technique> technique_;
    std::optional<VisibilityBuffer> out_;
    std::optional<penumbra::Mesh> mesh_, otherMesh_;
    std::optional<Device> otherDevice_;
    std::optional<HeadlessContext> otherContext_;
    gl::Texture kept_;
};

Misuse::Calls Misuse::calls() {
    View& view = inputs_.view;
    AreaLight& light = inputs_.light;
    const auto render = [this](auto change) { return [this, change] { renderWrong([&] { change(); }); }; };
    const auto renderLights = [this](auto secondBuffer) {
        return [this, secondBuffer] {
            prepare();
            const std::array<FrameLight, 2> lights = {
                FrameLight{.light = inputs_.light, .out = &*out_},
                FrameLight{.light = inputs_.light, .out = secondBuffer()}};
            technique_->renderLights({.view = inputs_.view, .casters = casters_, .lights = lights});
        };
    };
    const auto textured = [this](GLenum format, int layers, auto use) {
        return [=, this] { withTexture(format, layers, [&](GLuint name) { use(name); }); };
    };
    return {
        {"a caster without a mesh", render([this] { casters_[1].mesh = nullptr; })},
        {"a caster whose mesh was moved from", render([this] {
             otherMesh_.emplace(meshOn(device()));
             const penumbra::Mesh moved = std::move(*otherMesh_);
             casters_[1].mesh = &*otherMesh_;
         })},
        {"a caster whose mesh is another device's", render([this] {
             otherDevice_.emplace();
             otherMesh_.emplace(meshOn(*otherDevice_));
             casters_[1].mesh = &*otherMesh_;
         })},
        {"a caster whose device is destroyed", render([this] {
             otherDevice_.emplace(DeviceOptions{.shared = &device()});
             otherMesh_.emplace(meshOn(*otherDevice_));
             otherDevice_.reset();
             casters_[1].mesh = &*otherMesh_;
         })},
        {"a caster's matrix with a NaN", render([this] { casters_[1].worldFromMesh.columns[2][1] = nan; })},
        {"a caster's matrix transposed", render([this] {
             casters_[1].worldFromMesh.columns[3] = {1, 2, 3, 1};
             casters_[1].worldFromMesh = transposed(casters_[1].worldFromMesh);
         })},
        {"a mesh whose positions floats cannot hold", render([this] {
             std::vector<Vec3> far = corners;
             for (Vec3& position : far) position.x += 6.378e6f;
             otherMesh_.emplace(device(), penumbra::Mesh::Source{.positions = far, .indices = triangles});
             casters_[1].mesh = &*otherMesh_;
         })},
        {"an alpha mask that is no texture", render([this] { casters_[1].alphaMask.texture = noTexture; })},
        {"an alpha mask of another kind",
         textured(GL_RGBA8, 2, [this](GLuint name) { casters_[1].alphaMask.texture = name; })},
        {"an alpha mask with a depth format",
         textured(GL_DEPTH_COMPONENT24, 0, [this](GLuint name) { casters_[1].alphaMask.texture = name; })},
        {"an alpha mask with a cutoff that is no number",
         render([this] { casters_[1].alphaMask.cutoff = nan; })},
        {"a caster that lets more light pass than there is", render([this] {
             casters_[1].transmittance = {0.5f, 1.5f, 0.5f};
         })},
        {"a transmittance with a NaN", render([this] { casters_[1].transmittance.z = nan; })},
        {"a view without a depth texture", render([&] { view.depthTexture = 0; })},
        {"a depth texture that is none", render([&] { view.depthTexture = noTexture; })},
        {"colours for depth", textured(GL_RGBA8, 0, [&](GLuint name) { view.depthTexture = name; })},
        {"a cube map for depth", render([&] {
             GLuint name = 0;
             glCreateTextures(GL_TEXTURE_CUBE_MAP, 1, &name);
             glTextureStorage2D(name, 1, GL_DEPTH_COMPONENT24, 128, 128);
             view.depthTexture = name;
         })},
        {"a view larger than its textures", render([&] { view.x_px = 1; })},
        {"a view without a size", render([&] { view.width_px = 0; })},
        {"unsigned normals", textured(GL_RGBA8, 0, [&](GLuint name) { view.normalTexture = name; })},
        {"a normal texture that is none", render([&] { view.normalTexture = noTexture; })},
        {"shading normals without heights",
         textured(GL_RGB16F, 0, [&](GLuint name) { view.shadingNormalTexture = name; })},
        {"shading normals without geometric ones", render([&] {
             view.shadingNormalTexture = view.normalTexture;
             view.normalTexture = 0;
         })},
        {"a receiver texture of integers",
         textured(GL_R8UI, 0, [&](GLuint name) { view.receiverTexture = name; })},
        {"a view matrix with an infinity",
         render([&] { view.viewFromWorld.columns[3][0] = std::numeric_limits<float>::infinity(); })},
        {"a view matrix transposed", render([&] { view.viewFromWorld = transposed(view.viewFromWorld); })},
        {"a view matrix with a scale", render([&] { view.viewFromWorld.columns[0][0] *= 2; })},
        {"a projection with a NaN", render([&] { view.clipFromView.columns[2][2] = nan; })},
        {"a singular projection", render([&] { view.clipFromView.columns[1] = {}; })},
        {"a light's matrix with a scale", render([&] {
             light.worldFromLight.columns[0] = {2, 0, 0, 0};
         })},
        {"a light's matrix transposed",
         render([&] { light.worldFromLight = transposed(light.worldFromLight); })},
        {"a light's size that is no number", render([&] { light.width_m = nan; })},
        {"an angle in degrees", render([&] { light.angle_rad = 45; })},
        {"a disk with a texture", textured(GL_RGBA8, 0,
                                           [&](GLuint name) {
                                               light.shape = LightShape::disk;
                                               light.radianceTexture = name;
                                           })},
        {"a radiance texture that is none", render([&] { light.radianceTexture = noTexture; })},
        {"a radiance texture of another kind",
         textured(GL_RGBA8, 2, [&](GLuint name) { light.radianceTexture = name; })},
        {"a textured light and a gray buffer",
         textured(GL_RGBA8, 0, [&](GLuint name) { light.radianceTexture = name; })},
        {"a caster that lets light pass and a gray buffer",
         render([this] { casters_[1].transmittance.y = 0.5f; })},
        {"a buffer of another size than the view", render([this] { out_->resize(5, 5); })},
        {"a buffer of another device", render([this] {
             otherDevice_.emplace();
             out_.emplace(*otherDevice_, out_->width_px(), out_->height_px());
         })},
        {"a light of a frame without a buffer", renderLights([] { return nullptr; })},
        {"two lights of a frame with one buffer", renderLights([this] { return &*out_; })},
        {"a buffer that was moved from", render([this] { const VisibilityBuffer moved = std::move(*out_); })},
        {"a buffer whose texture is deleted", render([this] {
             const gl::Texture soonGone = texture(GL_R32F);
             out_.emplace(device(), VisibilityBuffer::HostTexture{.texture = soonGone.name(),
                                                                  .width_px = out_->width_px(),
                                                                  .height_px = out_->height_px()});
         })},
        {"a buffer that writes into the depth",
         textured(GL_R32F, 0,
                  [&, this](GLuint name) {
                      view.depthTexture = name;
                      out_.emplace(device(), VisibilityBuffer::HostTexture{.texture = name,
                                                                           .width_px = out_->width_px(),
                                                                           .height_px = out_->height_px()});
                  })},
        {"a mesh that was moved from is deformed",
         [this] {
             prepare();
             const penumbra::Mesh moved = std::move(*mesh_);
             mesh_->deform(corners);
         }},
        {"a number below its range through a visitor",
         [this] {
             prepare();
             Setter setter(-5);
             technique_->describe(setter);
         }},
        {"a choice that there is not through a visitor",
         [this] {
             technique_ = workbench().makeTechnique("hard-volumes");
             Setter setter(77);
             technique_->describe(setter);
         }},
        {"a parameter that there is not",
         [this] {
             prepare();
             setParameter(*technique_, "mapsize", "512");
         }},
        {"a technique that there is not", [this] { penumbra::makeTechnique(device(), "harder"); }},
        {"a device that was moved from",
         [this] {
             otherDevice_.emplace();
             const Device moved = std::move(*otherDevice_);
             penumbra::makeTechnique(*otherDevice_, "hard");
         }},
        {"a technique whose device is destroyed",
         [this] {
             prepare();
             otherDevice_.emplace();
             technique_ = penumbra::makeTechnique(*otherDevice_, "hard");
             otherDevice_.reset();
             technique_->render(inputs_, *out_);
         }},
        {"a mesh deformed whose device is destroyed",
         [this] {
             otherDevice_.emplace();
             otherMesh_.emplace(meshOn(*otherDevice_));
             otherDevice_.reset();
             otherMesh_->deform(corners);
         }},
        {"a device that was abandoned",
         [this] {
             otherDevice_.emplace();
             otherDevice_->abandon();
             penumbra::makeTechnique(*otherDevice_, "hard");
         }},
        {"no context",
         [this] {
             prepare();
             // A thread of its own has none, and what it throws comes back to this one.
             std::exception_ptr thrown;
             std::thread([&] {
                 try {
                     technique_->render(inputs_, *out_);
                 } catch (...) {
                     thrown = std::current_exception();
                 }
             }).join();
             if (thrown) std::rethrow_exception(thrown);
         }},
        {"another context",
         [this] {
             prepare();
             otherContext_.emplace(std::nullopt, testProfile());
             technique_->render(inputs_, *out_);
         }},
    };
}

INSTANTIATE_TEST_SUITE_P(Table, Misuse, ::testing::ValuesIn(tableOfMisuse()), [](const auto& test) {
    std::string name;
    for (const char c : test.param.what) name += std::isalnum(static_cast<unsigned char>(c)) ? c : '_';
    return name;
});

TEST_P(Misuse, IsToldBeforeAnythingIsDrawn) {
    const Calls all = calls();
    const auto found = all.find(GetParam().what);
    ASSERT_NE(found, all.end()) << "docs/manual/misuse.md has a row that nothing tests";
    try {
        found->second();
        FAIL() << "nothing was thrown";
    } catch (const Error& error) {
        EXPECT_EQ(nameOf(error.kind()), GetParam().kind);
        EXPECT_NE(std::string(error.what()).find(GetParam().message), std::string::npos) << error.what();
    }
    // What was asked of the driver had been checked before, and a right call works as if nothing had been.
    workbench().makeCurrent();
    EXPECT_EQ(glGetError(), GLenum(GL_NO_ERROR));
    EXPECT_EQ(device().severeMessageCount(), 0);
    prepare();
    inputs_.casters = casters_;
    EXPECT_NO_THROW(technique_->render(inputs_, *out_));
}

class TableOfMisuse : public Misuse {};

TEST_F(TableOfMisuse, HasARowInTheManualForEachTest) {
    std::vector<std::string> rows;
    for (const Row& row : tableOfMisuse()) rows.push_back(row.what);
    for (const auto& [what, call] : calls())
        EXPECT_NE(std::ranges::find(rows, what), rows.end()) << what << " is no row of docs/manual/misuse.md";
}

}  // namespace
}  // namespace penumbra::studio
