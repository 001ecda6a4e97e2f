// SPDX-License-Identifier: Apache-2.0
// Mistakes made on purpose, and what penumbra::diagnose says of them; and that it says nothing of right
// input.
#include <glm/gtc/matrix_transform.hpp>

#include "penumbra/diagnose.h"
#include "tests/support/host_depth.h"

namespace penumbra::studio {
namespace {

constexpr Planes range{0.23, 23};
constexpr PictureSize size{240, 150};

std::string joined(const Diagnosis& diagnosis) {
    std::string text = std::to_string(diagnosis.agreement);
    for (const std::string& finding : diagnosis.findings) text += "\n" + finding;
    return text;
}

TEST_F(HostDepth, OfRightInputNothingIsDiagnosed) {
    for (const char* scene : {"primitives", "two-boxes", "columns", "torus"}) {
        const ShadowInputs inputs = drawScene(scene, size);
        const Diagnosis ofFrame = diagnose(device(), inputs.view, inputs.casters);
        EXPECT_TRUE(ofFrame.fits()) << scene << ": " << joined(ofFrame);
        EXPECT_GT(ofFrame.agreement, 0.98) << scene;
        for (const DepthForm& form : usual) {
            const View view = drawn(inputs, form, range, {});
            const Diagnosis diagnosis = diagnose(device(), view, inputs.casters);
            EXPECT_TRUE(diagnosis.fits()) << scene << ", " << form.name << ": " << joined(diagnosis);
        }
    }
}

// As OCCT draws: on faces that face the camera, too, and on triangles that are narrower than three pixels,
// whose slopes their depths do not tell.
TEST_F(HostDepth, OfStatedPolygonOffsetNothingIsDiagnosed) {
    for (const char* scene : {"primitives", "two-boxes", "columns", "torus"}) {
        const ShadowInputs inputs = drawScene(scene, size);
        for (const DepthForm& form : {usual[0], usual[1], usual[2], usual[5], best}) {
            const float away = form.convention.reversed ? -1 : 1;
            for (const auto& [factor, units] : {std::pair{1.0f, 1.0f}, {2.0f, 8.0f}}) {
                const PolygonOffset offset{away * factor, away * units};
                View view = drawn(inputs, form, range, offset);
                view.polygonOffset = offset;
                const Diagnosis diagnosis = diagnose(device(), view, inputs.casters);
                EXPECT_TRUE(diagnosis.fits())
                    << scene << ", " << form.name << ", factor " << factor << ": " << joined(diagnosis);
                EXPECT_GT(diagnosis.agreement, 0.98) << scene << ", " << form.name << ", factor " << factor;
            }
        }
    }
}

TEST_F(HostDepth, OfTooFewSurfacesWithoutCastersNothingIsSaid) {
    const ShadowInputs inputs = drawScene("two-boxes", size);
    const View view = drawn(inputs, usual[1], range, {});
    std::string said;
    constexpr int width_px = 16, most_px = 40;
    const std::vector<float> nearer(width_px, 0.5f);
    for (int height_px = 0; height_px < most_px; ++height_px) {  // a block before the ground, row by row
        glTextureSubImage2D(view.depthTexture, 0, 100, 5 + height_px, width_px, 1, GL_DEPTH_COMPONENT,
                            GL_FLOAT, nearer.data());
        const Diagnosis diagnosis = diagnose(device(), view, inputs.casters);
        said = diagnosis.fits() ? "" : diagnosis.findings.front();
        EXPECT_EQ(said.find("(0 %"), std::string::npos) << height_px << ": " << said;
    }
    EXPECT_NE(said.find("no caster accounts for (2 %"), std::string::npos) << said;
}

struct Inputs {
    View view;
    std::vector<Caster> casters;
};

struct Mistake {
    const char* name;
    const char* finding;  ///< a part of what is said
    void (*make)(Inputs&);
    PolygonOffset offset = {};
};

void change(Mat4& matrix, const std::function<glm::dmat4(const glm::dmat4&)>& how) {
    matrix = toPenumbra(glm::mat4(how(glm::dmat4(fromPenumbra(matrix)))));
}
glm::dmat4 scaled(double x, double y, double z) {
    return glm::scale(glm::dmat4(1), glm::dvec3(x, y, z));
}
void changeCasters(Inputs& inputs, const std::function<glm::dmat4(const glm::dmat4&)>& how) {
    for (Caster& caster : inputs.casters) change(caster.worldFromMesh, how);
}
glm::dmat4 turned(double degrees, glm::dvec3 axis) {
    return glm::rotate(glm::dmat4(1), glm::radians(degrees), axis);
}

const std::vector<Mistake> mistakes = {
    {"reversed", "another convention", [](Inputs& in) { in.view.depth.reversed = true; }},
    {"range", "another convention", [](Inputs& in) { in.view.depth.range = fromZero; }},
    {"both", "another convention",
     [](Inputs& in) {
         in.view.depth = {fromZero, true};
     }},
    {"upside_down", "upside down",
     [](Inputs& in) { change(in.view.clipFromView, [](auto& m) { return scaled(1, -1, 1) * m; }); }},
    {"mirrored", "mirrored",
     [](Inputs& in) { change(in.view.clipFromView, [](auto& m) { return scaled(-1, 1, 1) * m; }); }},
    {"view_inverse", "wrong way round",
     [](Inputs& in) { change(in.view.viewFromWorld, [](auto& m) { return glm::inverse(m); }); }},
    {"view_transposed", "viewFromWorld's rotation is transposed",
     [](Inputs& in) {
         change(in.view.viewFromWorld, [](auto& m) {
             glm::dmat4 result(glm::transpose(glm::dmat3(m)));
             result[3] = m[3];
             return result;
         });
     }},
    {"projection_transposed", "clipFromView is transposed",
     [](Inputs& in) { change(in.view.clipFromView, [](auto& m) { return glm::transpose(m); }); }},
    {"looks_along_plus_z", "looks along +Z",
     [](Inputs& in) { change(in.view.viewFromWorld, [](auto& m) { return scaled(-1, 1, -1) * m; }); }},
    {"left_handed", "left-handed",
     [](Inputs& in) { change(in.view.viewFromWorld, [](auto& m) { return scaled(1, 1, -1) * m; }); }},
    {"view_in_projection", "contains the view's matrix",
     [](Inputs& in) {
         const glm::dmat4 view(fromPenumbra(in.view.viewFromWorld));
         change(in.view.clipFromView, [&](auto& m) { return m * view; });
     }},
    {"millimetres", "lengths are",
     [](Inputs& in) { changeCasters(in, [](auto& m) { return scaled(1000, 1000, 1000) * m; }); }},
    {"inches", "lengths are",
     [](Inputs& in) { changeCasters(in, [](auto& m) { return scaled(0.0254, 0.0254, 0.0254) * m; }); }},
    {"view_in_casters", "contain the view's",
     [](Inputs& in) {
         const glm::dmat4 view(fromPenumbra(in.view.viewFromWorld));
         changeCasters(in, [&](auto& m) { return view * m; });
     }},
    {"other_axis_up", "another axis up",
     [](Inputs& in) { changeCasters(in, [](auto& m) {
                          return turned(90, {1, 0, 0}) * m;
                      }); }},
    {"matrices_forgotten", "casters[",
     [](Inputs& in) {
         for (Caster& caster : in.casters) caster.worldFromMesh = {};
     }},
    {"aspect", "another shape of picture",
     [](Inputs& in) { in.view.clipFromView.columns[0][0] = in.view.clipFromView.columns[1][1]; }},
    {"near_plane", "another near or far plane",
     [](Inputs& in) {
         in.view.clipFromView.columns[2][2] = -(40.0f + 0.1f) / (40.0f - 0.1f);
         in.view.clipFromView.columns[3][2] = -2 * 40.0f * 0.1f / (40.0f - 0.1f);
     }},
    {"polygon_offset", "polygon offset", [](Inputs&) {}, {1, 1}},
    {"small_polygon_offset", "polygon offset", [](Inputs&) {}, {0.05f, 0}},
    {"another_place_in_the_pixel", "pixels from where",
     [](Inputs& in) {
         in.view.clipFromView.columns[2][0] += 0.4f * 2 / size.width_px;
         in.view.clipFromView.columns[2][1] -= 0.3f * 2 / size.height_px;
     }},
    {"caster_left_out", "no caster accounts for",
     [](Inputs& in) { in.casters.erase(in.casters.begin() + 1); }},
    {"caster_too_many", "casters[",
     [](Inputs& in) {
         in.casters.push_back(in.casters.at(1));
         change(in.casters.back().worldFromMesh,
                [](auto& m) { return glm::translate(glm::dmat4(1), glm::dvec3(0, 1.2, 0)) * m; });
     }},
    {"caster_elsewhere", "casters[1]",
     [](Inputs& in) {
         change(in.casters.at(1).worldFromMesh,
                [](auto& m) { return glm::translate(glm::dmat4(1), glm::dvec3(0.3, 0.2, 0.3)) * m; });
     }},
    {"another_frames_view", "of this frame",
     [](Inputs& in) { change(in.view.viewFromWorld, [](auto& m) {
                          return turned(7, {0, 1, 0}) * m;
                      }); }},
    {"another_field_of_view", "of this frame",
     [](Inputs& in) {
         in.view.clipFromView.columns[0][0] *= 1.3f;
         in.view.clipFromView.columns[1][1] *= 1.3f;
     }},
    {"no_casters", "no casters", [](Inputs& in) { in.casters.clear(); }},
};

class Mistakes : public HostDepth, public ::testing::WithParamInterface<Mistake> {};
INSTANTIATE_TEST_SUITE_P(OnPurpose, Mistakes, ::testing::ValuesIn(mistakes),
                         [](const auto& test) { return std::string(test.param.name); });

TEST_P(Mistakes, AreNamed) {
    const Mistake& mistake = GetParam();
    const ShadowInputs frame = drawScene("primitives", size);
    Inputs inputs{drawn(frame, usual[5], range, mistake.offset), {}};
    inputs.casters.assign(frame.casters.begin(), frame.casters.end());
    mistake.make(inputs);
    const Diagnosis diagnosis = diagnose(device(), inputs.view, inputs.casters);
    ASSERT_FALSE(diagnosis.fits());
    EXPECT_NE(diagnosis.findings.front().find(mistake.finding), std::string::npos) << joined(diagnosis);
}

TEST_F(HostDepth, ThatIsClearedIsTold) {
    const ShadowInputs inputs = drawScene("two-boxes", size);
    View view = drawn(inputs, usual[0], range, {});
    const float far = 1;
    glClearTexImage(view.depthTexture, 0, GL_DEPTH_COMPONENT, GL_FLOAT, &far);
    const Diagnosis diagnosis = diagnose(device(), view, inputs.casters);
    ASSERT_FALSE(diagnosis.fits());
    EXPECT_NE(diagnosis.findings.front().find("no surface"), std::string::npos);
}

TEST_F(HostDepth, ADeviceThatDiagnosesLogsWhatItFindsOnce) {
    std::string log;
    Device device({.log =
                       [&](LogLevel level, std::string_view text) {
                           if (level == LogLevel::warning) log += text;
                       },
                   .diagnose = true,
                   .shared = &this->device()});
    ShadowInputs inputs = drawScene("two-boxes", size);
    inputs.view = drawn(inputs, usual[5], range, {});
    const auto technique = penumbra::makeTechnique(device, "hard");
    VisibilityBuffer out(device, size.width_px, size.height_px);
    technique->render(inputs, out);
    EXPECT_EQ(log, "");
    inputs.view.depth.range = fromZero;
    const auto another = penumbra::makeTechnique(device, "hard");
    another->render(inputs, out);
    EXPECT_NE(log.find("another convention"), std::string::npos) << log;
    log.clear();
    another->render(inputs, out);
    EXPECT_EQ(log, "");
}

}  // namespace
}  // namespace penumbra::studio
