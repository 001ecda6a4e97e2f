// SPDX-License-Identifier: Apache-2.0
// Numbers typed, lights placed by numbers, and where they are saved.

#include <algorithm>
#include <bit>
#include <fstream>
#include <sstream>

#include "studio/image/image_io.h"
#include "studio/scene/builtin/placing.h"
#include "studio/viewer/light_editing.h"
#include "tests/viewer/viewer_fixture.h"

namespace penumbra::studio::viewer {
namespace {

std::string textOf(const std::string& file) {
    std::ostringstream text;
    text << std::ifstream(file).rdbuf();
    return text.str();
}

class EditingTest : public ViewerTest {
  protected:
    const Light& light() { return session().document().moment().lights.at(session().choices().light); }
    static glm::vec3 placeOf(const Light& light) {
        return glm::vec3(std::bit_cast<glm::mat4>(light.shape.worldFromLight)[3]);
    }
};

TEST_F(EditingTest, ATypedNumberCountsAtEnter) {
    start("two-boxes");
    session().editLights({rectLight("key", 1.2f, 0.5f, {0.4f, 1.6f, 0.5f}, {0, 0, 0}, 700)});
    frames();
    const Light before = light();
    const Image shown = picture();
    type("width (m)", "0.6");
    EXPECT_EQ(light().shape.width_m, 1.2f) << "not before";
    EXPECT_EQ(largestDifference(shown, picture()), 0);
    key("Return");
    EXPECT_EQ(light().shape.width_m, 0.6f);
    EXPECT_EQ(light().emission.value, before.emission.value) << "as if it were dragged";
    key("ctrl+z");
    EXPECT_EQ(light().shape.width_m, 1.2f) << "one step";
    type("width (m)", "3");
    key("Escape");
    EXPECT_EQ(light().shape.width_m, 1.2f);
}

TEST_F(EditingTest, DigitsOverAPanelChooseNoTechnique) {
    start("two-boxes", "pcf");
    const PlacedWidget* place = widget("casts shadow");
    ASSERT_NE(place, nullptr);
    Display::input("mousemove " + std::to_string(int(place->min.x + 5)) + " " +
                   std::to_string(int(place->min.y + 5)));
    frames();
    for (const char* digit : {"0", "1", "6"}) key(digit);
    EXPECT_EQ(session().choices().technique, "pcf");
    key("e");
    EXPECT_EQ(session().choices().technique, "exact");
    key("a");
    EXPECT_EQ(session().choices().technique, "auto");
    key("shift+e");
    EXPECT_EQ(session().choices().other, "exact");
    Display::input(to(0.5, 0.5));
    key("1");
    EXPECT_EQ(session().choices().technique, techniqueChoices()[0]);
}

TEST_F(EditingTest, ANewLightAppearsWhereOneLooksAndFacesIt) {
    start("two-boxes");
    drag(0.3, 0.6, 0.5, 0.55);
    const SurfacePoint looked = session().lookedAt();
    clickWidget("Add");
    const glm::mat4 matrix = std::bit_cast<glm::mat4>(light().shape.worldFromLight);
    const glm::vec3 way = looked.posWorld - glm::vec3(matrix[3]);
    EXPECT_GT(glm::length(way), 0.01f);
    EXPECT_NEAR(glm::dot(glm::normalize(way), -glm::vec3(matrix[2])), 1, 1e-3f) << "it shines there,";
    EXPECT_NEAR(glm::dot(glm::normalize(way), -looked.normalWorld), 1, 1e-3f) << "across the surface";
    EXPECT_LT(glm::length(way),
              glm::distance(looked.posWorld, glm::vec3(session().camera().worldFromCamera[3])));
}

TEST_F(EditingTest, LightsAreTurnedAndAimedByNumbers) {
    start(writeScene("box.gltf"));
    session().editLights({rectLight("lamp", 0.2f, 0.2f, {0.1f, 1.5f, 0.2f}, {0.1f, 0, 0.2f}, 100)});
    frames();
    type("altitude (deg)", "30");
    key("Return");
    type("azimuth (deg)", "90");
    key("Return");
    EXPECT_NEAR(bearingOf(light()).altitude_deg, 30, 0.01f);
    EXPECT_NEAR(bearingOf(light()).azimuth_deg, 90, 0.01f);
    EXPECT_NEAR(glm::distance(placeOf(light()), {0.1f, 1.5f, 0.2f}), 0, 1e-5f);
    for (const auto& [label, value] :
         {std::pair{"aim x (m)", "0.1"}, {"aim y (m)", "0"}, {"aim z (m)", "0.2"}}) {
        type(label, value);
        key("Return");
    }
    clickWidget("Aim there");
    EXPECT_NEAR(bearingOf(light()).altitude_deg, 90, 0.1f);

    session().editLights({distantLight("sun", 0.01f, {0, -1, 0.2f}, 1000)});
    frames();
    EXPECT_EQ(widget("Aim there"), nullptr) << "it has no place to turn at";
    type("azimuth (deg)", "200");
    key("Return");
    EXPECT_NEAR(std::remainder(bearingOf(light()).azimuth_deg - 200, 360.0f), 0, 0.01f);
}

TEST_F(EditingTest, ConesAndPicturesAreEditedAndSaved) {
    start(writeScene("box.gltf"));
    session().editLights({rectLight("lamp", 0.4f, 0.4f, {0.1f, 1.5f, 0.2f}, {0.1f, 0, 0.2f}, 100)});
    frames();
    clickWidget("cone", 0.1);
    ASSERT_TRUE(light().cone_rad);
    type("cone, none (deg)", "20");
    key("Return");
    EXPECT_NEAR((*light().cone_rad)[1], glm::radians(20.0f), 1e-5f);
    EXPECT_LE((*light().cone_rad)[0], (*light().cone_rad)[1]);

    Image stripes(8, 8, 3, 1);
    for (int x = 0; x < 8; x += 2) {
        for (int y = 0; y < 8; ++y) stripes.at(x, y, 2) = 0;
    }
    writePng(at("stripes.png"), stripes);
    clickWidget("Load a picture ...");
    Display::input("type " + at("stripes.png"));
    frames();
    key("Return");
    ASSERT_GE(light().texture, 0) << viewer().windowState().message;
    const Image edited = picture();
    key("ctrl+s");
    viewer_.reset();
    start(at("box.gltf"));
    EXPECT_GE(light().texture, 0);
    ASSERT_TRUE(light().cone_rad);
    EXPECT_EQ(largestDifference(edited, picture()), 0);
    clickWidget("texture", 0.3);
    clickWidget("(no picture)");
    EXPECT_EQ(light().texture, -1);
}

TEST_F(EditingTest, LightsAreSavedAsAnotherFile) {
    const std::string scene = writeScene("box.gltf");
    const std::string stated =
        "{\"version\": 1, \"lights\": [{\"type\": \"SphereLight\", \"name\": \"lamp\", "
        "\"radius\": 0.10, \"normalize\": true, \"intensity\": 30.0, \"translation\": [0, 2, 0]}]}";
    std::ofstream(at("box.lights.json")) << stated;
    start(scene);
    EXPECT_EQ(viewer().shownTitle(), "Penumbra - " + scene);
    clickWidget("casts shadow", 0.1);
    EXPECT_TRUE(viewer().shownTitle().ends_with(" *")) << viewer().shownTitle();
    const Image edited = picture();
    std::filesystem::create_directories(at("evening"));
    key("ctrl+shift+s");
    retype(at("evening/late.lights.json"));
    key("Return");
    EXPECT_FALSE(session().document().lights().unsaved()) << viewer().windowState().message;
    EXPECT_EQ(viewer().shownTitle(), "Penumbra - " + scene + " with late.lights.json");
    EXPECT_EQ(textOf(at("box.lights.json")), stated) << "the scene's own are as they were";
    const std::string saved = textOf(at("evening/late.lights.json"));
    EXPECT_NE(saved.find("\"radius\": 0.10, \"normalize\": true, \"intensity\": 30.0"), std::string::npos)
        << saved;
    EXPECT_NE(saved.find("\"shadow:enable\": false"), std::string::npos) << saved;

    // From now on that is the scene's file,
    clickWidget("casts shadow", 0.1);
    key("ctrl+s");
    EXPECT_EQ(textOf(at("evening/late.lights.json")), stated.substr(0, stated.size()))
        << "and what was undone is gone";
    clickWidget("casts shadow", 0.1);
    key("ctrl+s");
    // and under it the scene is found again.
    const RecentFile recent{std::filesystem::canonical(scene),
                            std::filesystem::canonical(at("evening/late.lights.json"))};
    EXPECT_EQ(viewer().settings().recentFiles.front(), recent);
    const std::string label = recent.scene + " with " + recent.lights;
    viewer_.reset();
    viewer_ = std::make_unique<Viewer>(options("two-boxes"));
    frames();
    clickWidget("File");
    clickWidget("Recent");
    clickWidget(label, 0.1);
    EXPECT_EQ(largestDifference(edited, picture()), 0) << viewer().windowState().message;

    key("ctrl+shift+s");
    retype(at("lights.txt"));
    key("Return");
    EXPECT_TRUE(viewer().windowState().messageIsError);
    EXPECT_FALSE(std::filesystem::exists(at("lights.txt")));
}

}  // namespace
}  // namespace penumbra::studio::viewer
