// SPDX-License-Identifier: Apache-2.0
// Once sizes have settled a frame allocates nothing, compiles nothing and reads nothing back: counted, by
// standing between the library and OpenGL, and between it and operator new.
#include "tests/support/allocations.h"
#include "tests/support/host_test.h"

namespace penumbra::studio {
namespace {

/// Calls of one OpenGL function. libepoxy calls through pointers that programs may exchange.
template <auto Slot>
struct Counted;

template <typename Result, typename... Arguments, Result (**Slot)(Arguments...)>
struct Counted<Slot> {
    static inline Result (*original)(Arguments...) = nullptr;
    static inline int calls = 0;

    static Result call(Arguments... arguments) {
        ++calls;
        return original(arguments...);
    }
    static void install() {
        original = *Slot;
        *Slot = call;
        calls = 0;
    }
    static void remove() { *Slot = original; }
};

struct Watched {
    const char* name;
    void (*install)();
    void (*remove)();
    int& calls;
};

template <auto Slot>
Watched watch(const char* name) {
    return {name, Counted<Slot>::install, Counted<Slot>::remove, Counted<Slot>::calls};
}

const std::vector<Watched>& watched() {
    static const std::vector<Watched> functions = {
        // makes something
        watch<&epoxy_glCreateBuffers>("glCreateBuffers"),
        watch<&epoxy_glCreateTextures>("glCreateTextures"),
        watch<&epoxy_glCreateFramebuffers>("glCreateFramebuffers"),
        watch<&epoxy_glCreateVertexArrays>("glCreateVertexArrays"),
        watch<&epoxy_glCreateQueries>("glCreateQueries"),
        watch<&epoxy_glCreateSamplers>("glCreateSamplers"),
        watch<&epoxy_glGenBuffers>("glGenBuffers"),
        watch<&epoxy_glGenTextures>("glGenTextures"),
        watch<&epoxy_glGenFramebuffers>("glGenFramebuffers"),
        watch<&epoxy_glGenQueries>("glGenQueries"),
        watch<&epoxy_glNamedBufferStorage>("glNamedBufferStorage"),
        watch<&epoxy_glNamedBufferData>("glNamedBufferData"),
        watch<&epoxy_glTextureStorage2D>("glTextureStorage2D"),
        watch<&epoxy_glTextureStorage3D>("glTextureStorage3D"),
        watch<&epoxy_glTextureView>("glTextureView"),
        // compiles
        watch<&epoxy_glCreateShader>("glCreateShader"),
        watch<&epoxy_glCreateProgram>("glCreateProgram"),
        watch<&epoxy_glCompileShader>("glCompileShader"),
        watch<&epoxy_glLinkProgram>("glLinkProgram"),
        // waits for the device
        watch<&epoxy_glReadPixels>("glReadPixels"),
        watch<&epoxy_glGetTextureImage>("glGetTextureImage"),
        watch<&epoxy_glGetTextureSubImage>("glGetTextureSubImage"),
        watch<&epoxy_glGetNamedBufferSubData>("glGetNamedBufferSubData"),
        watch<&epoxy_glMapNamedBuffer>("glMapNamedBuffer"),
        watch<&epoxy_glMapNamedBufferRange>("glMapNamedBufferRange"),
        watch<&epoxy_glFinish>("glFinish"),
    };
    return functions;
}

std::string callsCounted(std::string_view technique) {
    std::string text;
    for (const Watched& function : watched()) {
        // It reads copies of earlier frames' numbers, once a fence has been passed: nobody waits.
        if (technique == "adaptive" && function.name == std::string_view("glGetNamedBufferSubData")) continue;
        if (function.calls > 0)
            text += std::string(function.name) + " x" + std::to_string(function.calls) + "\n";
    }
    return text;
}

class SteadyState : public HostTest, public ::testing::WithParamInterface<std::string> {};

INSTANTIATE_TEST_SUITE_P(Catalog, SteadyState, everyTechnique(), techniqueTestName);

TEST_P(SteadyState, AllocatesCompilesAndReadsNothing) {
    ShadowInputs inputs = drawScene({64, 48});
    const auto technique = workbench().makeTechnique(GetParam());
    prewarm(device(), *technique, inputs);
    VisibilityBuffer out(device(), inputs.view.width_px, inputs.view.height_px);
    // Away from the place above the middle, where one map is just enough.
    inputs.light.worldFromLight.columns[3][0] += 0.01f;
    technique->render(inputs, out);
    technique->render(inputs, out);
    glFinish();

    const std::size_t memory_bytes = device().memory_bytes();
    for (const Watched& function : watched()) function.install();
    {
        const test::AllocationCount count;
        for (int frame = 0; frame < 4; ++frame) {
            // The light moves, so that nothing is just remembered.
            inputs.light.worldFromLight.columns[3][0] += 0.001f;
            technique->render(inputs, out);
        }
    }
    for (const Watched& function : watched()) function.remove();

    EXPECT_EQ(callsCounted(GetParam()), "");
    EXPECT_EQ(device().memory_bytes(), memory_bytes);
    EXPECT_EQ(test::AllocationCount::allocations(), 0) << "in four frames";
}

TEST_P(SteadyState, ASecondOfItsKindCompilesNothing) {
    const ShadowInputs inputs = drawScene({64, 48});
    VisibilityBuffer out(device(), inputs.view.width_px, inputs.view.height_px);
    const auto first = workbench().makeTechnique(GetParam());
    first->render(inputs, out);

    for (const Watched& function : watched()) function.install();
    const auto second = workbench().makeTechnique(GetParam());
    second->render(inputs, out);
    for (const Watched& function : watched()) function.remove();

    EXPECT_EQ(Counted<&epoxy_glCompileShader>::calls, 0);
    EXPECT_EQ(Counted<&epoxy_glLinkProgram>::calls, 0);
}

}  // namespace
}  // namespace penumbra::studio
