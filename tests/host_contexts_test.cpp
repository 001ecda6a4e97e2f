// SPDX-License-Identifier: Apache-2.0
// Several contexts and devices, and what is destroyed without any.
#include <array>
#include <optional>
#include <thread>

#include "tests/support/host_test.h"

namespace penumbra::studio {
namespace {

/// Two threads, each with a context, a device and a scene of its own, at the same time.
TEST(ContextsTest, TwoRenderAtOnce) {
    const auto picture = [](const char* sceneName, const char* technique) {
        Workbench workbench(std::nullopt, testProfile());
        const Scene scene = makeBuiltin(sceneName);
        const SceneMoment moment = scene.at(0);
        workbench.open(scene);
        const auto made = workbench.makeTechnique(technique);
        for (int frame = 0; frame < 2; ++frame) {
            workbench.run(technique, *made, moment, moment.cameras.front(), {96, 72});
        }
        return workbench.run(technique, *made, moment, moment.cameras.front(), {96, 72})
            .lights.front()
            .visibility.values;
    };
    const auto first = picture("two-boxes", "pcss"), second = picture("primitives", "soft-volumes");
    std::vector<float> firstAtOnce, secondAtOnce;
    std::thread a([&] { firstAtOnce = picture("two-boxes", "pcss"); });
    std::thread b([&] { secondAtOnce = picture("primitives", "soft-volumes"); });
    a.join();
    b.join();
    EXPECT_EQ(firstAtOnce, first);
    EXPECT_EQ(secondAtOnce, second);
    TechniqueTest::workbench().makeCurrent();
}

/// The same calls, interleaved on one thread.
TEST(ContextsTest, TwoTakeTurnsOnOneThread) {
    struct Host {
        Workbench workbench{std::nullopt, testProfile()};
        std::unique_ptr<Technique> technique;
        std::vector<float> picture;
    };
    const Scene scene = makeBuiltin("two-boxes");
    const SceneMoment moment = scene.at(0);
    std::array<std::optional<Host>, 2> hosts;
    for (int round = 0; round < 3; ++round) {
        for (std::optional<Host>& host : hosts) {
            if (!host) {
                host.emplace();
                host->workbench.open(scene);
                host->technique = host->workbench.makeTechnique("adaptive");
            }
            host->workbench.makeCurrent();
            host->picture =
                host->workbench.run("adaptive", *host->technique, moment, moment.cameras.front(), {64, 48})
                    .lights.front()
                    .visibility.values;
        }
    }
    EXPECT_EQ(hosts[0]->picture, hosts[1]->picture);
    for (std::optional<Host>& host : hosts) {
        host->workbench.makeCurrent();
        EXPECT_EQ(host->workbench.device().severeMessageCount(), 0);
        host.reset();
    }
    TechniqueTest::workbench().makeCurrent();
}

const std::vector<Vec3> corners = {{-0.3f, 1, -0.3f}, {0.3f, 1, -0.3f}, {0.3f, 1, 0.3f}, {-0.3f, 1, 0.3f}};
const std::vector<std::uint32_t> triangles = {0, 2, 1, 0, 3, 2};

Image rendered(Workbench& workbench, Device& device, Technique& technique, const ShadowInputs& inputs) {
    VisibilityBuffer out(device, inputs.view.width_px, inputs.view.height_px);
    technique.render(inputs, out);
    return workbench.frame().readVisibility(out);
}

TEST_F(HostTest, WhatWasMadeOnADeviceFollowsItWhenItMoves) {
    const ShadowInputs inputs = drawScene();
    for (const char* name : {"hard", "hard-volumes", "exact"}) {
        const auto expected = rendered(workbench(), device(), *workbench().makeTechnique(name), inputs);
        Device first({.shared = &device()});
        const auto technique = penumbra::makeTechnique(first, name);
        Device second(std::move(first));
        EXPECT_EQ(rendered(workbench(), second, *technique, inputs).values, expected.values) << name;
        Device third({.shared = &device()});
        third = std::move(second);
        EXPECT_EQ(rendered(workbench(), third, *technique, inputs).values, expected.values) << name;
    }
}

TEST_F(HostTest, MeshesAreSharedBetweenContextsThatShareObjects) {
    ShadowInputs inputs = drawScene();
    penumbra::Mesh mesh(device(), {.positions = corners, .indices = triangles});
    std::vector<Caster> casters(inputs.casters.begin(), inputs.casters.end());
    casters.push_back({.mesh = &mesh});
    inputs.casters = casters;
    for (const TechniqueInfo& info : techniqueCatalog()) {
        const auto technique = workbench().makeTechnique(info.name);
        const auto expected = rendered(workbench(), device(), *technique, inputs);
        glFinish();
        {
            const HeadlessContext context(std::nullopt, testProfile(), &workbench().context());
            Device other({.shared = &device()});
            const auto there = penumbra::makeTechnique(other, info.name);
            VisibilityBuffer out(other, inputs.view.width_px, inputs.view.height_px);
            there->render(inputs, out);
            EXPECT_EQ(readTexture(out.texture(), out.width_px(), out.height_px(), 1).values, expected.values)
                << info.name;
            EXPECT_EQ(other.severeMessageCount(), 0) << info.name;
        }
        workbench().makeCurrent();
    }
}

TEST_F(HostTest, WhatIsDestroyedInAnotherContextIsDeletedInItsOwn) {
    drawScene();
    auto mesh = std::optional<penumbra::Mesh>(
        std::in_place, device(), penumbra::Mesh::Source{.positions = corners, .indices = triangles});
    const GLuint name = mesh->positionBuffer();
    const HeadlessContext other(std::nullopt, testProfile());
    GLuint theirs = 0;
    while (theirs < name) glCreateBuffers(1, &theirs);
    mesh.reset();
    EXPECT_TRUE(glIsBuffer(name)) << "another context's buffer of the same name";
    workbench().makeCurrent();
    EXPECT_TRUE(glIsBuffer(name));
    workbench().makeTechnique("hard");
    EXPECT_FALSE(glIsBuffer(name));
}

TEST_F(HostTest, DestructionWithoutAContextIsTold) {
    const ShadowInputs inputs = drawScene();
    std::string log;
    auto device = std::optional<Device>(
        std::in_place, DeviceOptions{.log = [&](LogLevel, std::string_view text) { log += text; },
                                     .shared = &this->device()});
    std::vector<std::unique_ptr<Technique>> techniques;
    for (const TechniqueInfo& info : techniqueCatalog()) {
        techniques.push_back(penumbra::makeTechnique(*device, info.name));
        rendered(workbench(), *device, *techniques.back(), inputs);
    }
    auto mesh = std::optional<penumbra::Mesh>(
        std::in_place, *device, penumbra::Mesh::Source{.positions = corners, .indices = triangles});
    auto out = std::optional<VisibilityBuffer>(std::in_place, *device, 8, 8);
    workbench().context().makeNoneCurrent();
    techniques.resize(5);
    device.reset();
    EXPECT_NE(log.find("destroyed while its OpenGL context is not current"), std::string::npos) << log;
    techniques.clear();
    mesh.reset();
    out.reset();
    workbench().makeCurrent();
}

TEST_F(HostTest, ErrorsThatWerePendingAreTold) {
    std::string log;
    Device device({.log = [&](LogLevel level, std::string_view text) {
        if (level == LogLevel::warning) log += text;
    }});
    glEnable(GL_TEXTURE_2D_ARRAY);  // no capability
    penumbra::makeTechnique(device, "hard");
    EXPECT_NE(log.find("0x500"), std::string::npos) << log;
    EXPECT_EQ(glGetError(), GLenum(GL_NO_ERROR));
}

}  // namespace
}  // namespace penumbra::studio
