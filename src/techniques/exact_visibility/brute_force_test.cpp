// SPDX-License-Identifier: Apache-2.0
// What is looked for in a tree gives the same bits as all triangles, looked at one by one.
#include <unistd.h>

#include <array>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <random>
#include <sstream>

#include "studio/scene/builtin/builtin.h"
#include "studio/scene/builtin/placing.h"
#include "studio/scene/builtin/scene_builder.h"
#include "tests/support/random_ground.h"
#include "tests/support/technique_test.h"

namespace penumbra::studio {
namespace {

namespace fs = std::filesystem;

std::string textOf(const fs::path& file) {
    std::ostringstream text;
    text << std::ifstream(file).rdbuf();
    return text.str();
}

/// The library's shaders, with passes that leave nothing out.
class BruteForceShaders {
  public:
    BruteForceShaders()
        : folder_(fs::temp_directory_path() / ("penumbra-brute-force-" + std::to_string(getpid()))) {
        const fs::path source = PENUMBRA_SOURCE_DIRECTORY;
        for (const auto& entry : fs::recursive_directory_iterator(source / "src")) {
            const fs::path extension = entry.path().extension();
            if (extension != ".glsl" && extension != ".h") continue;
            const fs::path target = folder_ / fs::relative(entry.path(), source);
            fs::create_directories(target.parent_path());
            fs::copy_file(entry.path(), target, fs::copy_options::overwrite_existing);
        }
        redefine("candidates.comp.glsl", "void main()",
                 "#define mayBlockTile(shaft, sides, bounds, node) true\n"
                 "#define mayHideFromTile(bounds, sides, triangle) (!isInLightPlane(triangle))\n"
                 "#define isSmall(bounds, size, node) false\n"
                 "#define mayReachLight(bounds, boxMin, boxMax) true\n"
                 "#define isDark(bounds) ((bounds).otherNormal < 0.0)\n"  // only where nothing receives
                 "#define isAboveHorizon(bounds) false\n"
                 "#define hidesAll(bounds, triangle, borders) false\n");
        redefine("blockers.glsl", "// What turns a box", "#define isAnyOpen(low, high) true\n");
        redefine("resolve.comp.glsl", "// The next node",
                 "#define mayBoxHide(projection, normal, apex, boxMin, boxMax) true\n");
    }
    ~BruteForceShaders() { fs::remove_all(folder_); }
    const fs::path& folder() const { return folder_; }

  private:
    /// Puts `definitions` before where `place` first stands in a shader of this room.
    void redefine(const std::string& shader, const std::string& place, const std::string& definitions) const {
        const fs::path file = folder_ / "src/techniques/exact_visibility" / shader;
        std::string text = textOf(file);
        text.insert(text.find(place), definitions);
        std::ofstream(file) << text;
    }

    fs::path folder_;
};

/// A technique of another device on the same context, which writes where it is told as into a host's texture.
class OfAnotherDevice final : public Technique {
  public:
    OfAnotherDevice(Device& device, std::string_view name)
        : device_(device), technique_(makeTechnique(device, name)) {}
    void describe(ParameterVisitor& visitor) override { technique_->describe(visitor); }
    void render(const ShadowInputs& inputs, VisibilityBuffer& out) override {
        const VisibilityBuffer::HostTexture texture{
            .texture = out.texture(), .width_px = out.width_px(), .height_px = out.height_px()};
        VisibilityBuffer ours(device_, texture, out.colored());
        technique_->render(inputs, ours);
    }
    Statistics statistics() const override { return technique_->statistics(); }

  private:
    Device& device_;
    std::unique_ptr<Technique> technique_;
};

class BruteForceTest : public TechniqueTest {
  protected:
    void expectSameBits(const Scene& scene, const std::string& name, PictureSize size = {48, 32}) {
        for (const char* samples : {"16", "64", "300"}) {
            setParameter(*brute_, "samples", samples);
            EXPECT_EQ(render("exact", scene, size, {{"samples", samples}}).visibility.values,
                      render(*brute_, scene, size).visibility.values)
                << name << ", " << samples << " samples";
        }
    }

    BruteForceTest()
        : device_((workbench().makeCurrent(), DeviceOptions{.shaderSourceDirectory = shaders_.folder(),
                                                            .shared = &workbench().device()})),
          brute_(std::make_unique<OfAnotherDevice>(device_, "exact")) {
        setParameter(*brute_, "tile_candidates", "4096");
    }

    BruteForceShaders shaders_;
    Device device_;
    std::unique_ptr<Technique> brute_;
};

void change(LightShape shape, Light& light) {
    light.shape.shape = shape;
    light.shape.length_m = 1.1f;
    light.shape.radius_m = 0.7f;
    light.shape.angle_rad = 0.3f;
    light.texture = -1;
}

TEST_F(BruteForceTest, GivesTheSameBitsOnBuiltInScenes) {
    for (const char* name : {"two-boxes", "cylinder", "overlapping-blockers", "textured-window"})
        expectSameBits(makeBuiltin(name), name);
    for (const LightShape shape : {LightShape::rect, LightShape::disk, LightShape::sphere,
                                   LightShape::distant, LightShape::cylinder}) {
        expectSameBits(withLight(makeBuiltin("two-boxes"), [&](Light& light) { change(shape, light); }),
                       "two-boxes, shape " + std::to_string(int(shape)));
    }
}

TEST_F(BruteForceTest, GivesTheSameBitsOnGrounds) {
    for (std::uint32_t seed = 0; seed < 8; ++seed) {
        const RandomGround ground = makeRandomGround(seed);
        expectSameBits(ground.casting, ground.description);
    }
}

/// Triangles anywhere: open, crossing each other, the light and the ground, behind receivers and around them;
/// patches that share edges, fold back on themselves and lie in one plane; some twice.
Scene soup(std::uint32_t seed, LightShape shape) {
    std::mt19937 random(seed);
    const auto unit = [&] { return float(random() >> 8) * 0x1p-24f; };
    const auto between = [&](float low, float high) { return low + (high - low) * unit(); };
    const auto point = [&](float size) {
        return glm::vec3(between(-size, size), between(-0.2f * size, 1.2f * size), between(-size, size));
    };
    Mesh mesh;
    const auto add = [&](const glm::vec3& a, const glm::vec3& b, const glm::vec3& c) {
        for (const glm::vec3& corner : {a, b, c}) {
            mesh.indices.push_back(std::uint32_t(mesh.positions.size()));
            mesh.positions.push_back(corner);
        }
    };
    for (int i = 0; i < 120; ++i) {
        const glm::vec3 center = point(2);
        const float size = std::pow(10.0f, between(-2, 0.7f));
        add(center + point(size), center + point(size), center + point(size));
    }
    for (int patch = 0; patch < 6; ++patch) {  // fans around a corner, flat or folded
        const glm::vec3 center = point(1.5f);
        const float rough = patch % 2 == 0 ? 0 : 0.3f;
        glm::vec3 last = center + glm::vec3(0.5f, 0, 0);
        for (int k = 1; k <= 14; ++k) {
            const float angle = 0.6f * float(k);
            const glm::vec3 next =
                center + glm::vec3(0.5f * std::cos(angle), between(-rough, rough), 0.5f * std::sin(angle));
            add(center, last, next);
            last = next;
        }
    }
    mesh.normals.assign(mesh.positions.size(), glm::vec3(0, 1, 0));
    const auto indices = mesh.indices;
    mesh.indices.insert(mesh.indices.end(), indices.begin(), indices.begin() + 60);

    SceneBuilder scene("soup");
    const glm::mat4 one(1);
    scene.place("soup", scene.mesh("soup", std::move(mesh), glm::vec3(0.5f)), [=](double) { return one; });
    scene.ground(8);
    Light light = rectLight("light", 0.8f, 0.5f, {1, 2.5f, 0.6f}, {0, 0, 0}, 1000);
    change(shape, light);
    scene.light(light);
    scene.camera(camera("eye", {0.5f, 3.5f, 5}, {0, 0.3f, 0}));
    return std::move(scene).build();
}

TEST_F(BruteForceTest, GivesTheSameBitsOnSoups) {
    for (std::uint32_t seed = 0; seed < 9; ++seed) {
        constexpr std::array shapes = {LightShape::rect, LightShape::disk, LightShape::distant};
        expectSameBits(soup(seed, shapes[seed % shapes.size()]), "soup " + std::to_string(seed));
    }
    for (std::uint32_t seed = 0; seed < 4; ++seed)
        expectSameBits(soup(seed, LightShape::cylinder), "tube in soup " + std::to_string(seed));
}

// Samples of a sphere are counted on a disk through its middle, which is wider than what a receiver close by
// sees of the sphere. What stands in between, and hides nothing, is culled as a rule: then there is more
// light, and rightly.
TEST_F(BruteForceTest, GivesNoMoreShadowOfSpheresThatTouchWhatTheyLight) {
    for (const std::uint32_t seed : {2u, 6u}) {
        const Scene scene = soup(seed, LightShape::sphere);
        constexpr PictureSize size{48, 32};
        const LightResult exact = render("exact", scene, size), brute = render(*brute_, scene, size);
        for (std::size_t i = 0; i < exact.visibility.values.size(); ++i)
            ASSERT_GE(exact.visibility.values[i], brute.visibility.values[i]) << seed << ", pixel " << i;
        const LightResult reference = truth(scene, size, 1024);
        EXPECT_LE(judge(reference, exact).rmse, judge(reference, brute).rmse) << seed;
    }
}

}  // namespace
}  // namespace penumbra::studio
