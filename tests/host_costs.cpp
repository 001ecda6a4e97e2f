// SPDX-License-Identifier: Apache-2.0
// What a host pays beside the shadows themselves, printed as a table: keeping its state and checking its
// inputs, taking depths out of its framebuffers, and penumbra::diagnose. Of each the median of several calls
// (CostClock).
//
//     host_costs [SCENE] [WIDTHxHEIGHT]
#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <exception>
#include <functional>

#include "src/gl/gl.h"
#include "studio/scene/builtin/builtin.h"
#include "studio/workbench/cost_clock.h"
#include "studio/workbench/workbench.h"

namespace penumbra::studio {
namespace {

double median_ms(Workbench& workbench, const std::function<void()>& call) {
    constexpr int warmUps = 3, rounds = 25;
    const CostClock clock(workbench.device());
    std::vector<double> times;
    for (int i = 0; i < warmUps; ++i) call();
    for (int i = 0; i < rounds; ++i) times.push_back(clock.milliseconds(call));
    std::ranges::nth_element(times, times.begin() + rounds / 2);
    return times[rounds / 2];
}

/// A framebuffer of a host's, with nothing but depths.
class DepthsOnly {
  public:
    DepthsOnly(PictureSize size, GLenum format, int samples) {
        glCreateRenderbuffers(1, &renderbuffer_);
        glNamedRenderbufferStorageMultisample(renderbuffer_, samples, format, size.width_px, size.height_px);
        glCreateFramebuffers(1, &framebuffer_);
        glNamedFramebufferRenderbuffer(framebuffer_, GL_DEPTH_ATTACHMENT, GL_RENDERBUFFER, renderbuffer_);
    }
    DepthsOnly(const DepthsOnly&) = delete;
    DepthsOnly& operator=(const DepthsOnly&) = delete;
    ~DepthsOnly() {
        glDeleteFramebuffers(1, &framebuffer_);
        glDeleteRenderbuffers(1, &renderbuffer_);
    }
    GLuint framebuffer() const { return framebuffer_; }

  private:
    GLuint renderbuffer_ = 0, framebuffer_ = 0;
};

void print(const std::string& what, double milliseconds) {
    fmt::print("| {} | {:.3f} |\n", what, milliseconds);
}

void measure(const char* name, PictureSize size) {
    Workbench workbench;
    const Scene scene = makeBuiltin(name);
    const SceneMoment moment = scene.at(0);
    workbench.open(scene);
    workbench.frame().draw(workbench.scene(), moment, moment.cameras.front(), size.width_px, size.height_px);
    ShadowInputs inputs = workbench.frame().shadowInputs(moment.lights.front());
    fmt::print("{}, {}x{}, {}\n\n| what | ms |\n| --- | --- |\n", name, size.width_px, size.height_px,
               workbench.renderer());

    for (const char* technique : {"hard", "pcss", "exact"}) {
        const auto made = penumbra::makeTechnique(workbench.device(), technique);
        VisibilityBuffer out(workbench.device(), size.width_px, size.height_px);
        print(fmt::format("a frame of `{}`", technique),
              median_ms(workbench, [&] { made->render(inputs, out); }));
    }
    // All of a call but the shadows: the last of the checks refuses it.
    std::vector<Caster> casters(inputs.casters.begin(), inputs.casters.end());
    casters.push_back({});
    const ShadowInputs refused{inputs.view, inputs.light, casters};
    const auto technique = penumbra::makeTechnique(workbench.device(), "hard");
    VisibilityBuffer out(workbench.device(), size.width_px, size.height_px);
    print("state saved and put back, inputs checked", median_ms(workbench, [&] {
              try {
                  technique->render(refused, out);
              } catch (const Error&) {
              }
          }));

    HostFramebuffer host(workbench.device());
    for (const auto& [what, format, samples] :
         {std::tuple{"depths copied, 24 bits", GL_DEPTH_COMPONENT24, 0},
          {"depths copied, 32-bit float", GL_DEPTH_COMPONENT32F, 0},
          {"depths copied, 24 bits, 4 samples", GL_DEPTH_COMPONENT24, 4}}) {
        const DepthsOnly depths(size, GLenum(format), samples);
        View view = inputs.view;
        print(what, median_ms(workbench, [&] { host.copyDepth(depths.framebuffer(), view); }));
    }
    print("diagnose, right input",
          median_ms(workbench, [&] { diagnose(workbench.device(), inputs.view, inputs.casters); }));
    View wrong = inputs.view;
    wrong.depth.range = DepthConvention::Range::minusOneToOne;
    print("diagnose, another convention",
          median_ms(workbench, [&] { diagnose(workbench.device(), wrong, inputs.casters); }));
}

}  // namespace
}  // namespace penumbra::studio

int main(int argc, char** argv) try {
    penumbra::studio::PictureSize size{640, 400};
    if (argc > 2 && std::sscanf(argv[2], "%dx%d", &size.width_px, &size.height_px) != 2) {
        std::fprintf(stderr, "host_costs [SCENE] [WIDTHxHEIGHT]: '%s' is no size\n", argv[2]);
        return 2;
    }
    penumbra::studio::measure(argc > 1 ? argv[1] : "primitives", size);
    return 0;
} catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
}
