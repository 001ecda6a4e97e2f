// SPDX-License-Identifier: Apache-2.0
// A host's own textures and buffers, in all their forms, give the shadows that plain ones give.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>

#include "src/gl/buffer.h"
#include "src/gl/texture.h"
#include "studio/frame/conversions.h"
#include "tests/support/host_test.h"

namespace penumbra::studio {
namespace {

class HostInputs : public HostTest {
  protected:
    Image rendered(const ShadowInputs& inputs, const char* technique = "pcss") {
        VisibilityBuffer out(device(), inputs.view.width_px, inputs.view.height_px);
        workbench().makeTechnique(technique)->render(inputs, out);
        return workbench().frame().readVisibility(out);
    }
};

Error::Kind kindOfError(const std::function<void()>& call) {
    try {
        call();
    } catch (const Error& error) {
        return error.kind();
    }
    ADD_FAILURE() << "nothing was thrown";
    return {};
}

/// A larger texture with `part` in it at (x, y) and nonsense around.
gl::Texture framed(GLuint part, const View& view, int x_px, int y_px, gl::Format format) {
    gl::Texture whole({.width_px = view.width_px + 19,
                       .height_px = view.height_px + 11,
                       .format = format,
                       .label = "host's atlas"});
    const float nonsense = 0.37f;
    const GLenum base = format == gl::Format::depth32f ? GL_DEPTH_COMPONENT : GL_RED;
    glClearTexImage(whole.name(), 0, base, GL_FLOAT, &nonsense);
    glCopyImageSubData(part, GL_TEXTURE_2D, 0, 0, 0, 0, whole.name(), GL_TEXTURE_2D, 0, x_px, y_px, 0,
                       view.width_px, view.height_px, 1);
    return whole;
}

TEST_F(HostInputs, PartsOfLargerTexturesAreTheSamePicture) {
    ShadowInputs inputs = drawScene();
    const Image expected = rendered(inputs);
    View& view = inputs.view;
    const gl::Texture depth = framed(view.depthTexture, view, 7, 5, gl::Format::depth32f);
    const gl::Texture normals = framed(view.normalTexture, view, 7, 5, gl::Format::rgba32f);
    const gl::Texture receivers = framed(view.receiverTexture, view, 7, 5, gl::Format::r8);
    view.depthTexture = depth.name();
    view.normalTexture = normals.name();
    view.receiverTexture = receivers.name();
    view.x_px = 7;
    view.y_px = 5;
    EXPECT_EQ(rendered(inputs).values, expected.values);
}

TEST_F(HostInputs, SamplingParametersOfTheDepthTextureDoNotMatter) {
    const ShadowInputs inputs = drawScene();
    const Image expected = rendered(inputs);
    const GLuint depth = inputs.view.depthTexture;
    std::vector<std::pair<GLenum, GLint>> odd = {
        {{GL_TEXTURE_COMPARE_MODE, GL_COMPARE_REF_TO_TEXTURE},
         {GL_TEXTURE_MIN_FILTER, GL_LINEAR_MIPMAP_LINEAR},  // and there are no other levels
         {GL_TEXTURE_SWIZZLE_R, GL_ALPHA},
         {GL_TEXTURE_SWIZZLE_A, GL_RED},
         {GL_DEPTH_STENCIL_TEXTURE_MODE, GL_STENCIL_INDEX}}};
    if (testProfile() == ContextProfile::compatibility) odd.push_back({GL_DEPTH_TEXTURE_MODE, GL_ALPHA});
    for (const auto& [name, value] : odd) glTextureParameteri(depth, name, value);
    EXPECT_EQ(rendered(inputs).values, expected.values);
    for (const auto& [name, value] : odd) {
        GLint now = 0;
        glGetTextureParameteriv(depth, name, &now);
        EXPECT_EQ(now, value) << "the host's parameter was not restored";
    }
}

/// A depth texture of four samples that shows the plane y = 0 as the camera sees it at each sample's place.
class MultisampledPlane {
  public:
    /// `mirrored`: as Mesa has a window's samples.
    explicit MultisampledPlane(const View& view, bool mirrored = false) {
        constexpr const char* vertex =
            "#version 450\nvoid main() { gl_Position = vec4(gl_VertexID == 1 ? 3.0 : -1.0,"
            " gl_VertexID == 2 ? 3.0 : -1.0, 0.5, 1.0); }\n";
        constexpr const char* fragment =
            "#version 450\n"
            "layout(location = 0) uniform mat4 worldFromClip;\n"
            "layout(location = 4) uniform mat4 clipFromWorld;\n"
            "layout(location = 8) uniform vec2 size_px;\n"
            "layout(location = 9) uniform float mirrored;\n"
            "vec3 world(vec2 ndc, float z) { vec4 p = worldFromClip * vec4(ndc, z, 1.0); return p.xyz / p.w; "
            "}\n"
            "void main() {\n"
            "    vec2 place = vec2(gl_SamplePosition.x, mix(gl_SamplePosition.y, 1.0 - gl_SamplePosition.y, "
            "mirrored));\n"
            "    vec2 ndc = 2.0 * (floor(gl_FragCoord.xy) + place) / size_px - 1.0;\n"
            "    vec3 a = world(ndc, 1.0), b = world(ndc, 0.5);\n"
            "    vec3 p = a + (b - a) * (a.y / (a.y - b.y));\n"
            "    vec4 clip = clipFromWorld * vec4(p, 1.0);\n"
            "    gl_FragDepth = a.y > 0.0 && b.y < a.y ? clip.z / clip.w : 0.0;\n"
            "}\n";
        glCreateTextures(GL_TEXTURE_2D_MULTISAMPLE, 1, &texture_);
        glTextureStorage2DMultisample(texture_, 4, GL_DEPTH_COMPONENT32F, view.width_px, view.height_px,
                                      GL_TRUE);
        GLuint framebuffer = 0, vertexArray = 0;
        glCreateFramebuffers(1, &framebuffer);
        glNamedFramebufferTexture(framebuffer, GL_DEPTH_ATTACHMENT, texture_, 0);
        glNamedFramebufferDrawBuffer(framebuffer, GL_NONE);
        glCreateVertexArrays(1, &vertexArray);
        const Program program(vertex, fragment);
        const glm::dmat4 clipFromWorld =
            glm::dmat4(fromPenumbra(view.clipFromView)) * glm::dmat4(fromPenumbra(view.viewFromWorld));
        const glm::mat4 forward(clipFromWorld), backward(glm::inverse(clipFromWorld));
        glProgramUniformMatrix4fv(program.name(), 0, 1, GL_FALSE, &backward[0][0]);
        glProgramUniformMatrix4fv(program.name(), 4, 1, GL_FALSE, &forward[0][0]);
        glProgramUniform2f(program.name(), 8, float(view.width_px), float(view.height_px));
        glProgramUniform1f(program.name(), 9, mirrored ? 1.0f : 0.0f);
        glBindFramebuffer(GL_DRAW_FRAMEBUFFER, framebuffer);
        for (GLuint sample = 0; sample < places_.size(); ++sample)
            glGetMultisamplefv(GL_SAMPLE_POSITION, sample, &places_[sample].x);
        glViewport(0, 0, view.width_px, view.height_px);
        glUseProgram(program.name());
        glBindVertexArray(vertexArray);
        glEnable(GL_DEPTH_TEST);
        glEnable(GL_MULTISAMPLE);
        glDepthFunc(GL_ALWAYS);
        glDepthMask(GL_TRUE);
        glDrawArrays(GL_TRIANGLES, 0, 3);
        glDeleteFramebuffers(1, &framebuffer);
        glDeleteVertexArrays(1, &vertexArray);
    }
    MultisampledPlane(const MultisampledPlane&) = delete;
    MultisampledPlane& operator=(const MultisampledPlane&) = delete;
    ~MultisampledPlane() { glDeleteTextures(1, &texture_); }
    GLuint texture() const { return texture_; }
    /// As OpenGL says, which mirrored ones are not.
    Vec2 placeOf(int sample) const { return places_[std::size_t(sample)]; }

  private:
    GLuint texture_ = 0;
    std::array<Vec2, 4> places_;
};

class MultisampledDepth : public HostInputs, public ::testing::WithParamInterface<bool> {};
INSTANTIATE_TEST_SUITE_P(AsInTexturesAndInWindows, MultisampledDepth, ::testing::Bool());

TEST_P(MultisampledDepth, HasEverySampleWhereItIs) {
    // The ground alone casts and receives: whatever is taken for a place beside the sample's lies above or
    // below it, by up to a pixel's slope, and shadows itself.
    ShadowInputs inputs = drawScene({48, 32});
    const bool mirrored = GetParam();
    const MultisampledPlane plane(inputs.view, mirrored);
    inputs.view.depthTexture = plane.texture();
    inputs.view.normalTexture = inputs.view.receiverTexture = 0;
    const std::vector<Vec3> corners = {{-50, 0, -50}, {50, 0, -50}, {50, 0, 50}, {-50, 0, 50}};
    const std::vector<std::uint32_t> indices = {0, 2, 1, 0, 3, 2};
    const penumbra::Mesh ground(device(), {.positions = corners, .indices = indices});
    const std::array<Caster, 1> casters = {Caster{.mesh = &ground}};
    inputs.casters = casters;
    for (int sample = 0; sample < 4; ++sample) {
        inputs.view.sample = sample;
        const Vec2 place = plane.placeOf(sample);
        if (mirrored) inputs.view.samplePlace = Vec2{place.x, 1 - place.y};
        const Image seen = rendered(inputs, "hard");
        // Not the topmost rows: there a pixel's depth says little about where near the horizon it is.
        const auto shadowed = std::count_if(seen.values.begin() + 8 * seen.width_px, seen.values.end(),
                                            [](float v) { return v != 1; });
        EXPECT_EQ(shadowed, 0) << "at sample " << sample;
    }
    inputs.view.sample = 4;
    EXPECT_EQ(kindOfError([&] { rendered(inputs); }), Error::Kind::badArgument);
}

class WrittenByEveryTechnique : public HostInputs, public ::testing::WithParamInterface<std::string> {};

INSTANTIATE_TEST_SUITE_P(Catalog, WrittenByEveryTechnique, everyTechnique(), techniqueTestName);

TEST_P(WrittenByEveryTechnique, TheHostsTextureAndNothingAroundTheRectangle) {
    const ShadowInputs inputs = drawScene({61, 43});  // no multiple of any group's size
    const auto technique = workbench().makeTechnique(GetParam());
    VisibilityBuffer plain(device(), 61, 43);
    technique->render(inputs, plain);
    const Image expected = workbench().frame().readVisibility(plain);
    for (const gl::Format format : {gl::Format::r32f, gl::Format::r8}) {
        for (const auto& [x_px, y_px] : {std::pair{0, 0}, std::pair{5, 3}}) {
            const gl::Texture texture({.width_px = 80, .height_px = 60, .format = format, .label = "host's"});
            const float untouched = 0.4f;
            glClearTexImage(texture.name(), 0, GL_RED, GL_FLOAT, &untouched);
            VisibilityBuffer out(device(), VisibilityBuffer::HostTexture{texture.name(), x_px, y_px, 61, 43});
            technique->render(inputs, out);
            const Image whole = readTexture(texture.name(), 80, 60, 1);
            int wrong = 0;
            for (int y = 0; y < 60; ++y) {
                for (int x = 0; x < 80; ++x) {
                    const int column = x - x_px, row = (59 - y) - y_px;  // rows from the bottom
                    const bool inside = column >= 0 && column < 61 && row >= 0 && row < 43;
                    const float wanted = inside ? expected.at(column, 42 - row) : untouched;
                    // Eight bits round by half a step.
                    wrong += std::abs(whole.at(x, y) - wanted) >
                             (format == gl::Format::r8 ? 0.5f / 255 + 1e-6f : 0);
                }
            }
            EXPECT_EQ(wrong, 0) << "format " << GLenum(format) << " at " << x_px << ", " << y_px;
        }
    }
}

TEST_F(HostInputs, WrongTexturesAreRefused) {
    const ShadowInputs good = drawScene();
    const auto broken = [&](auto change) {
        ShadowInputs inputs = good;
        change(inputs.view);
        return kindOfError([&] { rendered(inputs); });
    };
    EXPECT_EQ(broken([](View& view) { view.depthTexture = 0; }), Error::Kind::badArgument);
    EXPECT_EQ(broken([](View& view) { view.depthTexture = 54321; }), Error::Kind::badArgument);
    EXPECT_EQ(broken([](View& view) { view.normalTexture = 54321; }), Error::Kind::badArgument);
    EXPECT_EQ(broken([](View& view) { view.x_px = 1; }), Error::Kind::badArgument);
    EXPECT_EQ(broken([](View& view) { view.y_px = -1; }), Error::Kind::badArgument);
    const gl::Texture unwritable(
        {.width_px = 8, .height_px = 8, .format = gl::Format(GL_RGB9_E5), .label = "t"});
    const gl::Texture gray({.width_px = 8, .height_px = 8, .format = gl::Format::r16f, .label = "t"});
    const auto outInto = [&](GLuint texture, int size_px, bool colored) {
        return kindOfError([&] {
            VisibilityBuffer(device(), VisibilityBuffer::HostTexture{texture, 0, 0, size_px, size_px},
                             colored);
        });
    };
    EXPECT_EQ(outInto(unwritable.name(), 8, false), Error::Kind::badArgument);
    EXPECT_EQ(outInto(gray.name(), 9, false), Error::Kind::badArgument);
    EXPECT_EQ(outInto(gray.name(), 8, true), Error::Kind::badArgument);
    EXPECT_EQ(outInto(54321, 8, false), Error::Kind::badArgument);
    EXPECT_EQ(device().severeMessageCount(), 0) << "asked of the driver what was not checked before";
}

/// Interleaved vertices as renderers have them, and 16-bit indices that do not start at a word.
class HostMesh {
  public:
    struct Vertex {
        std::array<float, 2> uv;
        Vec3 normal, position;
    };
    HostMesh(std::span<const Vec3> positions, std::span<const std::uint32_t> indices) {
        for (const Vec3& p : positions) vertices_.push_back({{p.x, -p.z}, {0, 1, 0}, p});
        std::vector<std::uint16_t> shorts = {77};
        for (const std::uint32_t index : indices) shorts.push_back(std::uint16_t(index));
        vertexBuffer_ = gl::Buffer(std::as_bytes(std::span(vertices_)), "host's vertices");
        indexBuffer_ = gl::Buffer(std::as_bytes(std::span(shorts)), "host's indices");
        source = {.positions = {vertexBuffer_.name(), offsetof(Vertex, position), sizeof(Vertex)},
                  .vertexCount = positions.size(),
                  .indexBuffer = indexBuffer_.name(),
                  .indexOffset_bytes = 2,
                  .indexCount = indices.size(),
                  .indexType = penumbra::Mesh::HostSource::IndexType::uint16,
                  .uvs = {vertexBuffer_.name(), offsetof(Vertex, uv), sizeof(Vertex)}};
    }
    void move(const Vec3& by) {
        for (Vertex& vertex : vertices_) {
            vertex.position = {vertex.position.x + by.x, vertex.position.y + by.y, vertex.position.z + by.z};
        }
        vertexBuffer_.write(std::as_bytes(std::span(vertices_)));
    }
    penumbra::Mesh::HostSource source;

  private:
    std::vector<Vertex> vertices_;
    gl::Buffer vertexBuffer_, indexBuffer_;
};

const std::vector<Vec3> tetrahedron = {{0, 0.3f, 0}, {0.5f, 0.3f, 0}, {0, 0.9f, 0}, {0, 0.3f, 0.5f}};
const std::vector<std::uint32_t> tetrahedronIndices = {0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3};

TEST_F(HostInputs, MeshesFromTheHostsBuffersAreThoseFromArrays) {
    HostMesh host(tetrahedron, tetrahedronIndices);
    const penumbra::Mesh mesh = penumbra::Mesh::fromBuffers(device(), host.source);
    EXPECT_TRUE(std::ranges::equal(mesh.positions(), tetrahedron));
    EXPECT_TRUE(std::ranges::equal(mesh.indices(), tetrahedronIndices));
    ASSERT_EQ(mesh.uvs().size(), 4u);
    EXPECT_EQ(mesh.uvs()[3].y, -0.5f);
    EXPECT_EQ(mesh.bounds().max, (Vec3{0.5f, 0.9f, 0.5f}));
}

TEST_F(HostInputs, DeformationOnTheDeviceIsThatOnTheCpu) {
    ShadowInputs inputs = drawScene();
    HostMesh host(tetrahedron, tetrahedronIndices);
    penumbra::Mesh onDevice = penumbra::Mesh::fromBuffers(device(), host.source);
    penumbra::Mesh onCpu(device(), {.positions = tetrahedron, .indices = tetrahedronIndices});
    const Vec3 by{-0.25f, 0.5f, 0.25f};
    std::vector<Vec3> moved = tetrahedron;
    for (Vec3& p : moved) p = {p.x + by.x, p.y + by.y, p.z + by.z};
    std::vector<Caster> casters(inputs.casters.begin(), inputs.casters.end());
    casters.push_back({.mesh = &onCpu});
    inputs.casters = casters;
    for (const TechniqueInfo& info : techniqueCatalog()) {
        const auto technique = workbench().makeTechnique(info.name);
        const auto seen = [&](const penumbra::Mesh& mesh) {
            casters.back().mesh = &mesh;
            VisibilityBuffer out(device(), inputs.view.width_px, inputs.view.height_px);
            technique->render(inputs, out);
            return workbench().frame().readVisibility(out).values;
        };
        // Before and after, with one technique, so that nothing stale is remembered.
        const auto before = seen(onDevice);
        if (onDevice.revision() == 0) {
            onCpu.deform(moved);
            host.move(by);
            onDevice.deform(host.source.positions, onCpu.bounds());
            EXPECT_NE(seen(onDevice), before) << info.name << " did not notice";
        }
        EXPECT_EQ(seen(onDevice), seen(onCpu)) << info.name;
    }
    EXPECT_TRUE(std::ranges::equal(onDevice.positions(), moved));
}

TEST_F(HostInputs, BuffersThatAreTooSmallAreRefused) {
    HostMesh host(tetrahedron, tetrahedronIndices);
    const auto broken = [&](auto change) {
        penumbra::Mesh::HostSource source = host.source;
        change(source);
        return kindOfError([&] { penumbra::Mesh::fromBuffers(device(), source); });
    };
    EXPECT_EQ(broken([](auto& s) { s.vertexCount = 5; }), Error::Kind::badArgument);
    EXPECT_EQ(broken([](auto& s) { s.vertexCount = 3; }), Error::Kind::badArgument) << "index 3";
    EXPECT_EQ(broken([](auto& s) { s.indexCount = 15; }), Error::Kind::badArgument);
    EXPECT_EQ(broken([](auto& s) { s.indexOffset_bytes = 1; }), Error::Kind::badArgument);
    EXPECT_EQ(broken([](auto& s) { s.positions.stride_bytes = 30; }), Error::Kind::badArgument);
    EXPECT_EQ(broken([](auto& s) { s.positions.buffer = 54321; }), Error::Kind::badArgument);
    penumbra::Mesh mesh = penumbra::Mesh::fromBuffers(device(), host.source);
    EXPECT_EQ(kindOfError([&] { mesh.deform(host.source.positions, Box{}); }), Error::Kind::badArgument);
}

TEST_F(HostInputs, MeshesHaveIdsOfTheirOwn) {
    const auto make = [&] {
        return penumbra::Mesh(device(), {.positions = tetrahedron, .indices = tetrahedronIndices});
    };
    std::uint64_t first = 0;
    {
        const penumbra::Mesh mesh = make();
        first = mesh.id();
    }
    EXPECT_NE(make().id(), first);
}

TEST_F(HostInputs, MemoryIsCountedAndGivenBack) {
    // Its programs are the device's from now on.
    prewarm(device(), *workbench().makeTechnique("hard"), drawScene());
    workbench().open(Scene{});
    const std::size_t before = device().memory_bytes();
    {
        const VisibilityBuffer out(device(), 100, 50);
        EXPECT_EQ(device().memory_bytes() - before, 100u * 50 * 4);
        VisibilityBuffer colored(device(), 10, 10, true);
        colored.resize(20, 10);
        EXPECT_EQ(device().memory_bytes() - before, 100u * 50 * 4 + 20 * 10 * 8);
        const auto technique = workbench().makeTechnique("hard");
        prewarm(device(), *technique, drawScene());
        EXPECT_GE(device().memory_bytes() - before, 2048u * 2048 * 4) << "the shadow map";
    }
    workbench().open(Scene{});
    EXPECT_LE(device().memory_bytes(), before);
}

TEST_F(HostInputs, AnAbandonedDeviceCallsNoOpenGL) {
    const ShadowInputs inputs = drawScene();
    auto technique = std::optional(workbench().makeTechnique("adaptive"));
    auto out =
        std::optional<VisibilityBuffer>(std::in_place, device(), inputs.view.width_px, inputs.view.height_px);
    auto mesh = std::optional<penumbra::Mesh>(
        std::in_place, device(),
        penumbra::Mesh::Source{.positions = tetrahedron, .indices = tetrahedronIndices});
    (*technique)->render(inputs, *out);

    const GLuint visibility = out->texture(), positions = mesh->positionBuffer();
    device().abandon();
    EXPECT_EQ(kindOfError([&] { (*technique)->render(inputs, *out); }), Error::Kind::lostContext);
    EXPECT_EQ(kindOfError([&] { mesh->deform(tetrahedron); }), Error::Kind::lostContext);
    EXPECT_EQ(kindOfError([&] { out->resize(4, 4); }), Error::Kind::lostContext);
    EXPECT_EQ(kindOfError([&] { makeTechnique(device(), "hard"); }), Error::Kind::lostContext);
    technique.reset();
    out.reset();
    mesh.reset();
    EXPECT_TRUE(glIsTexture(visibility)) << "names of a lost context may be another's by now";
    EXPECT_TRUE(glIsBuffer(positions));
}

}  // namespace
}  // namespace penumbra::studio
