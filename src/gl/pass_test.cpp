// SPDX-License-Identifier: Apache-2.0
// The seam: what C++ hands to shaders arrives under its name, or a message says what does not fit.
#include "src/gl/pass.h"

#include <gtest/gtest.h>

#include <array>
#include <stdexcept>

#include "src/gl/framebuffer.h"
#include "src/gl/shader_library.h"
#include "studio/context/headless_context.h"

namespace penumbra::gl {
namespace {

constexpr std::string_view scaling = R"(#version 450
layout(local_size_x = 1) in;
struct Numbers { float factor; float offset; };
layout(std140) uniform Constants { Numbers numbers; };
layout(std430) readonly buffer Source { float source[]; };
layout(std430) writeonly buffer /* as it */ Target { float target[]; };
// uniform sampler2D commentedOut;
uniform sampler2D unusedTexture;
void main() {
    uint i = gl_GlobalInvocationID.x;
    target[i] = source[i] * numbers.factor + numbers.offset;
}
)";

constexpr std::string_view filling = R"(#version 450
layout(local_size_x = 1) in;
layout(r32f) uniform writeonly image2D picture;
void main() { imageStore(picture, ivec2(0), vec4(5.0)); }
)";

constexpr std::string_view fetching = R"(#version 450
layout(local_size_x = 1) in;
uniform sampler2D pictures[3];
layout(std430) writeonly buffer Target { float target[]; };
void main() {
    target[0] = texelFetch(pictures[0], ivec2(0), 0).r + texelFetch(pictures[2], ivec2(0), 0).r;
    target[1] = texelFetch(pictures[1], ivec2(0), 0).r;
}
)";

constexpr std::string_view pointVertex = R"(#version 450
in vec2 place;
in int shade;
flat out int color;
void main() {
    gl_Position = vec4(place, 0.5, 1.0);
    color = shade;
}
)";

constexpr std::string_view pointFragment = R"(#version 450
flat in int color;
layout(location = 0) out float result;
void main() { result = float(color); }
)";

constexpr std::array<EmbeddedShader, 5> shaders = {EmbeddedShader{"scale.comp.glsl", scaling},
                                                   {"fill.comp.glsl", filling},
                                                   {"fetch.comp.glsl", fetching},
                                                   {"point.vert.glsl", pointVertex},
                                                   {"point.frag.glsl", pointFragment}};

struct alignas(16) Numbers {
    float factor, offset;
};

class PassTest : public ::testing::Test {
  protected:
    PassTest() { library.add(shaders); }

    /// What `run` throws, or nothing.
    template <typename Run>
    static std::string mistakeIn(Run run) {
        try {
            run();
        } catch (const std::logic_error& error) {
            return error.what();
        }
        return {};
    }

    template <std::size_t N>
    static std::array<float, N> contents(const Buffer& buffer) {
        std::array<float, N> values{};
        buffer.read(std::as_writable_bytes(std::span(values)));
        return values;
    }

    studio::HeadlessContext context;
    ShaderLibrary library{std::filesystem::path()};
};

Buffer bufferOf(std::initializer_list<float> values) {
    return {std::as_bytes(std::span(values.begin(), values.size())), "values"};
}

TEST_F(PassTest, BindsByNameInAnyOrder) {
    const Program scale(library, {"scale.comp.glsl"});
    const Buffer source = bufferOf({1, 3}), target = bufferOf({0, 0});
    Pass(scale).bind("Target", target).constants(Numbers{2, 0.5f}).bind("Source", source).dispatch(2);
    EXPECT_EQ(contents<2>(target), (std::array<float, 2>{2.5f, 6.5f}));
}

TEST_F(PassTest, WhatOnePassWritesTheNextOneReads) {
    const Program scale(library, {"scale.comp.glsl"}), fill(library, {"fill.comp.glsl"}),
        fetch(library, {"fetch.comp.glsl"});
    const Texture picture({.format = Format::r32f, .label = "picture"});
    const Buffer sums = bufferOf({0, 0}), scaled = bufferOf({0, 0});
    Pass(fill).bind("picture", picture).dispatch(1);
    Pass pass(fetch);
    for (std::size_t i = 0; i < 3; ++i) pass.bind("pictures", i, picture.ref());
    pass.bind("Target", sums).dispatch(1);
    Pass(scale).constants(Numbers{1, 1}).bind("Source", sums).bind("Target", scaled).dispatch(2);
    EXPECT_EQ(contents<2>(scaled), (std::array<float, 2>{11, 6}));
}

TEST_F(PassTest, DrawsFromNamedInputs) {
    const Program point(library, {"point.vert.glsl", "point.frag.glsl"});
    const Texture picture({.width_px = 2, .format = Format::r32f, .label = "picture"});
    Framebuffer target;
    target.fit({&picture}, nullptr, "picture");
    constexpr std::array numbers = {7, 9};
    const Buffer places = bufferOf({-0.5f, 0}), shades(std::as_bytes(std::span(numbers)), "shades");
    Pass pass(point);
    pass.into(target, {.width_px = 2, .height_px = 1}).clearColor(0, std::array{1.0f, 0.0f, 0.0f, 0.0f});
    pass.vertices("place", places)
        .vertices("shade", shades, {.offset_bytes = sizeof(int), .perInstance = true});
    pass.draw(Primitive::points, 1);
    std::array<float, 2> texels{};
    picture.read(std::as_writable_bytes(std::span(texels)));
    EXPECT_EQ(texels, (std::array<float, 2>{9, 1}));
}

TEST_F(PassTest, MistakesNameShaderAndResource) {
    const Program scale(library, {"scale.comp.glsl"});
    const Buffer source = bufferOf({1}), target = bufferOf({0});
    const Texture picture({.format = Format::r32f, .label = "picture"});
    EXPECT_EQ(mistakeIn([&] { Pass(scale).bind("Sauce", source); }),
              "scale.comp.glsl: 'Sauce' is bound, and no shader declares it");
    EXPECT_EQ(mistakeIn([&] { Pass(scale).bind("commentedOut", picture); }),
              "scale.comp.glsl: 'commentedOut' is bound, and no shader declares it");
    EXPECT_EQ(mistakeIn([&] { Pass(scale).bind("Source", picture); }),
              "scale.comp.glsl: 'Source' is of another kind in the shader");
    EXPECT_EQ(mistakeIn([&] { Pass(scale).constants(Numbers{}).bind("Source", source).dispatch(1); }),
              "scale.comp.glsl: 'Target' is not bound");
    EXPECT_EQ(mistakeIn([&] { Pass(scale).constants(std::array<float, 8>{}); }),
              "scale.comp.glsl: 'Constants' has 32 bytes in C++ and 16 in the shader");
    EXPECT_EQ(mistakeIn([&] { Pass(scale).bind("Source", StorageArray<std::array<float, 2>>("pairs")); }),
              "scale.comp.glsl: 'Source' has 8 bytes in C++ and 4 in the shader");
    EXPECT_EQ(mistakeIn([&] { Pass(scale).bind("Target", HostBuffer{source.name()}); }),
              "scale.comp.glsl: 'Target' may be written, and is the host's");
    EXPECT_EQ(mistakeIn([&] {
                  Pass first(scale);
                  first.constants(Numbers{}).bind("Source", source).bind("Target", target);
                  const Pass second(scale);
                  first.dispatch(1);
              }),
              "scale.comp.glsl: 'scale.comp.glsl' runs after the next pass has begun");
    EXPECT_EQ(mistakeIn([&] { Pass(scale).bind("unusedTexture", picture); }), "") << "declared, if not used";
}

TEST_F(PassTest, BarriersFollowFromWhatWasWritten) {
    constexpr GLbitfield storage = GL_SHADER_STORAGE_BARRIER_BIT, fetch = GL_TEXTURE_FETCH_BARRIER_BIT;
    WriteOrder order;
    const WriteOrder::Serial writer = order.beginPass(), reader = order.beginPass();
    EXPECT_EQ(order.missing(writer, storage | fetch, reader), storage | fetch);
    EXPECT_EQ(order.missing(writer, storage, writer), 0u) << "a pass's own writes";
    EXPECT_EQ(order.missing(0, storage, reader), 0u) << "what no shader has written";
    order.makeVisible(storage, reader);
    EXPECT_EQ(order.missing(writer, storage | fetch, reader), fetch);
    const WriteOrder::Serial last = order.beginPass();
    EXPECT_EQ(order.missing(reader, storage, last), storage) << "written behind the barrier";
    order.makeAllVisible();
    EXPECT_EQ(order.missing(reader, storage | fetch, order.beginPass()), 0u);
}

}  // namespace
}  // namespace penumbra::gl
