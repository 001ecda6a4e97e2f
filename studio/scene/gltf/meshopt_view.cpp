// SPDX-License-Identifier: Apache-2.0
#include "studio/scene/gltf/meshopt_view.h"

#include <fmt/format.h>
#include <meshoptimizer.h>

namespace penumbra::studio::gltf {

namespace {

using Mode = MeshoptView::Mode;
using Filter = MeshoptView::Filter;

Mode modeOf(const JsonView& json) {
    const std::string& name = json.asString();
    if (name == "ATTRIBUTES") return Mode::attributes;
    if (name == "TRIANGLES") return Mode::triangles;
    if (name == "INDICES") return Mode::indices;
    json.fail(fmt::format("'{}' is not ATTRIBUTES, TRIANGLES or INDICES", name));
}

Filter filterOf(const JsonView& json) {
    const std::string name = json.string("filter", "NONE");
    if (name == "NONE") return Filter::none;
    if (name == "OCTAHEDRAL") return Filter::octahedral;
    if (name == "QUATERNION") return Filter::quaternion;
    if (name == "EXPONENTIAL") return Filter::exponential;
    json.at("filter").fail(fmt::format("'{}' is not NONE, OCTAHEDRAL, QUATERNION or EXPONENTIAL", name));
}

// What the decoder takes for granted.
bool isPossible(const MeshoptView& view) {
    const std::size_t stride = view.stride_bytes;
    if (view.mode != Mode::attributes)
        return (stride == 2 || stride == 4) && view.filter == Filter::none &&
               (view.mode == Mode::indices || view.count % 3 == 0);
    if (view.filter == Filter::octahedral && stride != 4 && stride != 8) return false;
    if (view.filter == Filter::quaternion && stride != 8) return false;
    return stride % 4 == 0 && stride <= 256;
}

}  // namespace

MeshoptView readMeshoptView(const JsonView& json, std::uint64_t view_bytes) {
    MeshoptView view{.count = std::uint64_t(json.at("count").asInteger(1, maxJsonInteger)),
                     .stride_bytes = std::size_t(json.at("byteStride").asInteger(2, 256)),
                     .mode = modeOf(json.at("mode")),
                     .filter = filterOf(json)};
    if (!isPossible(view)) json.fail("its mode, filter, count and byteStride do not go together");
    if (view.count * view.stride_bytes != view_bytes)
        json.fail(fmt::format("its {} elements of {} bytes do not fill the view's {} bytes", view.count,
                              view.stride_bytes, view_bytes));
    return view;
}

Bytes decompress(const MeshoptView& view, std::span<const std::byte> compressed, const JsonView& json,
                 Budget& budget) {
    // What compresses best, vertices that are all the same, takes a 64th; indices take a byte a triangle.
    constexpr std::uint64_t mostExpansion = 64;
    if (view.count * view.stride_bytes > mostExpansion * compressed.size())
        json.fail("its compressed data is too short for so many elements");
    budget.charge(view.count, view.stride_bytes, json.pointer());
    Bytes bytes(view.count * view.stride_bytes);
    const auto* in = reinterpret_cast<const unsigned char*>(compressed.data());
    // The header overloads each of these names with a template.
    using Decode = int (*)(void*, std::size_t, std::size_t, const unsigned char*, std::size_t);
    constexpr Decode decodeVertices = meshopt_decodeVertexBuffer, decodeTriangles = meshopt_decodeIndexBuffer,
                     decodeSequence = meshopt_decodeIndexSequence;
    const Decode decode = view.mode == Mode::attributes  ? decodeVertices
                          : view.mode == Mode::triangles ? decodeTriangles
                                                         : decodeSequence;
    if (decode(bytes.data(), view.count, view.stride_bytes, in, compressed.size()) != 0)
        json.fail("its compressed data is damaged");
    switch (view.filter) {
        case Filter::none:
            break;
        case Filter::octahedral:
            meshopt_decodeFilterOct(bytes.data(), view.count, view.stride_bytes);
            break;
        case Filter::quaternion:
            meshopt_decodeFilterQuat(bytes.data(), view.count, view.stride_bytes);
            break;
        case Filter::exponential:
            meshopt_decodeFilterExp(bytes.data(), view.count, view.stride_bytes);
            break;
    }
    return bytes;
}

}  // namespace penumbra::studio::gltf
