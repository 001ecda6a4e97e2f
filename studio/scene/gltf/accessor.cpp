// SPDX-License-Identifier: Apache-2.0
// "Accessors", glTF 2.0 section 3.6.2.
#include "studio/scene/gltf/accessor.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>

#include "studio/scene/gltf/extensions.h"
#include "studio/scene/gltf/meshopt_view.h"

namespace penumbra::studio::gltf {

static_assert(std::endian::native == std::endian::little,
              "buffers are little-endian and are copied as they are");

namespace {

// Sums of three values below 2^53 and products of a stride below 2^8 with a count below 2^53 stay below 2^63.
constexpr std::int64_t maxSize_bytes = maxJsonInteger;

struct ElementShape {
    std::size_t rows = 1, columns = 1;
};

ElementShape shapeOf(const JsonView& type) {
    const std::string& name = type.asString();
    if (name == "SCALAR") return {1, 1};
    if (name == "VEC2") return {2, 1};
    if (name == "VEC3") return {3, 1};
    if (name == "VEC4") return {4, 1};
    if (name == "MAT2") return {2, 2};
    if (name == "MAT3") return {3, 3};
    if (name == "MAT4") return {4, 4};
    type.fail(fmt::format("'{}' is not an accessor type", name));
}

ComponentType componentTypeOf(const JsonView& json) {
    const std::int64_t value = json.asInteger(5120, 5126);
    if (value == 5124) json.fail("component type 5124 (signed 32-bit) is not allowed");
    return ComponentType(value);
}

template <class T>
T load(const std::byte* bytes) {
    T value;
    std::memcpy(&value, bytes, sizeof(T));
    return value;
}

// Calls visit with a value of the C++ type that the component type stands for.
template <class Visit>
void withType(ComponentType type, Visit visit) {
    switch (type) {
        case ComponentType::i8:
            return visit(std::int8_t());
        case ComponentType::u8:
            return visit(std::uint8_t());
        case ComponentType::i16:
            return visit(std::int16_t());
        case ComponentType::u16:
            return visit(std::uint16_t());
        case ComponentType::u32:
            return visit(std::uint32_t());
        case ComponentType::f32:
            return visit(float());
    }
}

// "Animations" in section 3.11: f = c / max for unsigned, max(c / max, -1) for signed integers.
template <class T>
float toFloat(T value, bool normalized) {
    if constexpr (std::is_floating_point_v<T>)
        return value;
    else
        return normalized ? std::max(float(value) / float(std::numeric_limits<T>::max()), -1.0f)
                          : float(value);
}

// Every element in order, sparse substitutions applied, through convert(T) into `out`.
template <class T, class Out, class Convert>
void readComponents(const Accessor& accessor, std::span<Out> out, Convert convert) {
    const std::size_t components = accessor.components;
    if (!accessor.bytes.empty())
        for (std::size_t i = 0; i < accessor.count; ++i) {
            const std::byte* element = accessor.bytes.data() + i * accessor.stride_bytes;
            for (std::size_t c = 0; c < components; ++c)
                out[i * components + c] = convert(load<T>(element + c * sizeof(T)));
        }
    if (accessor.sparse)
        for (std::size_t i = 0; i < accessor.sparse->indices.size(); ++i)
            for (std::size_t c = 0; c < components; ++c)
                out[accessor.sparse->indices[i] * components + c] =
                    convert(load<T>(accessor.sparse->values.data() + (i * components + c) * sizeof(T)));
}

void readFloatsInto(const Accessor& accessor, std::span<float> out) {
    withType(accessor.componentType, [&]<class T>(T) {
        readComponents<T>(accessor, out, [&](T value) { return toFloat(value, accessor.normalized); });
    });
    for (std::size_t i = 0; i < out.size(); ++i)
        if (!std::isfinite(out[i]))
            throw PlaceError(accessor.pointer,
                             fmt::format("component {} of element {} is not a finite number",
                                         i % accessor.components, i / accessor.components));
}

template <class Vector>
std::vector<Vector> readVectors(const Accessor& accessor, Budget& budget) {
    budget.charge(accessor.count, sizeof(Vector), accessor.pointer);
    std::vector<Vector> vectors(accessor.count, Vector(0));
    readFloatsInto(accessor, std::span(&vectors[0].x, accessor.count * accessor.components));
    return vectors;
}

// The bytes of `count` elements of a view, or a PlaceError at `json`.
std::span<const std::byte> elements(const JsonView& json, const BufferView& view, std::uint64_t byteOffset,
                                    std::uint64_t count, std::uint64_t stride_bytes,
                                    std::uint64_t element_bytes, std::size_t alignment_bytes) {
    // Views begin anywhere in a buffer, but the sum of both offsets must be aligned.
    if ((view.offset_bytes + byteOffset) % alignment_bytes != 0 || stride_bytes % alignment_bytes != 0)
        json.fail(fmt::format("its elements are not aligned to {} bytes", alignment_bytes));
    const std::uint64_t end = byteOffset + stride_bytes * (count - 1) + element_bytes;
    if (end > view.bytes.size())
        json.fail(fmt::format("its {} elements end at byte {} of a buffer view of {}", count, end,
                              view.bytes.size()));
    return view.bytes.subspan(byteOffset, end - byteOffset);
}

}  // namespace

std::size_t sizeOf_bytes(ComponentType type) {
    std::size_t size = 0;
    withType(type, [&]<class T>(T) { size = sizeof(T); });
    return size;
}

Accessors::Accessors(const Document& document, const std::filesystem::path& folder, Budget& budget) {
    const JsonView root = document.root();
    readBuffers(document, folder, budget);
    readViews(root, budget);
    for (const JsonView& json : root.list("accessors")) accessors_.push_back(readAccessor(json, budget));
}

void Accessors::readBuffers(const Document& document, const std::filesystem::path& folder, Budget& budget) {
    for (const JsonView& json : document.root().list("buffers")) {
        const std::uint64_t length = std::uint64_t(json.at("byteLength").asInteger(1, maxSize_bytes));
        std::optional<Bytes>& bytes = buffers_.emplace_back();
        if (const auto uri = json.find("uri")) {
            bytes = readUri(*uri, folder, budget);
        } else if (buffers_.size() == 1 && document.binaryChunk) {
            bytes = document.binaryChunk;
            budget.charge(bytes->size(), 1, json.pointer());
        }
        if (bytes && bytes->size() < length)
            json.fail(fmt::format("claims {} bytes, but its data has {}", length, bytes->size()));
        // A chunk or file may be padded; nothing may be read from there.
        if (bytes) bytes->resize(length);
    }
}

std::span<const std::byte> Accessors::rangeOf(const JsonView& json, std::uint64_t& offset) const {
    const int buffer = json.at("buffer").asIndex(buffers_.size());
    offset = std::uint64_t(json.integer("byteOffset", 0, 0, maxSize_bytes));
    const std::uint64_t length = std::uint64_t(json.at("byteLength").asInteger(1, maxSize_bytes));
    const std::optional<Bytes>& bytes = buffers_[std::size_t(buffer)];
    if (!bytes) json.fail(fmt::format("refers to buffer {}, which has no data", buffer));
    if (offset + length > bytes->size())
        json.fail(fmt::format("ends at byte {} of a buffer of {}", offset + length, bytes->size()));
    return std::span(*bytes).subspan(offset, length);
}

void Accessors::readViews(const JsonView& root, Budget& budget) {
    for (const JsonView& json : root.list("bufferViews")) {
        const std::int64_t stride = json.integer("byteStride", 0, 4, 252);
        if (stride % 4 != 0) json.at("byteStride").fail("must be a multiple of 4");
        BufferView& view = views_.emplace_back();
        view.stride_bytes = std::size_t(stride);
        if (const auto compressed = extensionOf(json, "EXT_meshopt_compression")) {
            // The buffer that the view itself names is for those who cannot read the other, and may have no
            // data.
            json.at("buffer").asIndex(buffers_.size());
            std::uint64_t offset = 0;
            const std::span<const std::byte> bytes = rangeOf(*compressed, offset);
            const auto length = std::uint64_t(json.at("byteLength").asInteger(1, maxSize_bytes));
            view.bytes = decompressed_.emplace_back(
                decompress(readMeshoptView(*compressed, length), bytes, *compressed, budget));
        } else {
            view.bytes = rangeOf(json, view.offset_bytes);
        }
    }
}

Accessor Accessors::readAccessor(const JsonView& json, Budget& budget) const {
    const ElementShape shape = shapeOf(json.at("type"));
    Accessor accessor{.pointer = json.pointer(),
                      .componentType = componentTypeOf(json.at("componentType")),
                      .type = json.at("type").asString(),
                      .components = shape.rows * shape.columns,
                      .normalized = json.boolean("normalized", false),
                      .count = std::uint64_t(json.at("count").asInteger(1, maxSize_bytes))};
    const std::size_t component_bytes = sizeOf_bytes(accessor.componentType);
    // Columns of matrices start at multiples of four bytes.
    const std::size_t column_bytes = shape.rows * component_bytes;
    const std::size_t element_bytes =
        shape.columns == 1 ? column_bytes : shape.columns * ((column_bytes + 3) / 4 * 4);
    const std::uint64_t offset = std::uint64_t(json.integer("byteOffset", 0, 0, maxSize_bytes));

    if (const auto index = json.index("bufferView", views_.size())) {
        const BufferView& source = view(*index);
        accessor.stride_bytes = source.stride_bytes == 0 ? element_bytes : source.stride_bytes;
        if (accessor.stride_bytes < element_bytes)
            json.fail(fmt::format("its elements of {} bytes overlap at a stride of {}", element_bytes,
                                  accessor.stride_bytes));
        accessor.bytes = elements(json, source, offset, accessor.count, accessor.stride_bytes, element_bytes,
                                  component_bytes);
    } else if (offset != 0) {
        json.at("byteOffset").fail("has no meaning without a bufferView");
    }

    if (const auto sparse = json.find("sparse")) {
        const std::uint64_t count =
            std::uint64_t(sparse->at("count").asInteger(1, std::int64_t(accessor.count)));
        const JsonView indicesJson = sparse->at("indices"), valuesJson = sparse->at("values");
        const ComponentType indexType = componentTypeOf(indicesJson.at("componentType"));
        const std::size_t index_bytes = sizeOf_bytes(indexType);
        Accessor indices{.pointer = indicesJson.pointer(),
                         .componentType = indexType,
                         .type = "SCALAR",
                         .count = count,
                         .stride_bytes = index_bytes};
        requireFormat(indices, indicesJson.pointer(), "SCALAR",
                      {ComponentType::u8, ComponentType::u16, ComponentType::u32});
        indices.bytes = elements(indicesJson, view(indicesJson.at("bufferView").asIndex(views_.size())),
                                 std::uint64_t(indicesJson.integer("byteOffset", 0, 0, maxSize_bytes)), count,
                                 index_bytes, index_bytes, index_bytes);
        accessor.sparse.emplace();
        accessor.sparse->indices = readUnsigned(indices, budget);
        const auto& all = accessor.sparse->indices;
        if (all.back() >= accessor.count ||
            std::ranges::adjacent_find(all, std::greater_equal<>()) != all.end())
            indicesJson.fail("sparse indices must increase strictly and lie below the accessor's count");
        accessor.sparse->values =
            elements(valuesJson, view(valuesJson.at("bufferView").asIndex(views_.size())),
                     std::uint64_t(valuesJson.integer("byteOffset", 0, 0, maxSize_bytes)), count,
                     element_bytes, element_bytes, component_bytes);
    }
    return accessor;
}

void requireFormat(const Accessor& accessor, const std::string& where, const std::string& type,
                   std::initializer_list<ComponentType> componentTypes) {
    if (accessor.type != type ||
        std::ranges::find(componentTypes, accessor.componentType) == componentTypes.end())
        throw PlaceError(where, fmt::format("{} is a {} of component type {}, which is not allowed here",
                                            accessor.pointer, accessor.type, int(accessor.componentType)));
}

std::vector<float> readFloats(const Accessor& accessor, Budget& budget) {
    budget.charge(accessor.count, accessor.components * sizeof(float), accessor.pointer);
    std::vector<float> floats(accessor.count * accessor.components);
    readFloatsInto(accessor, floats);
    return floats;
}

std::vector<glm::vec2> readVec2s(const Accessor& accessor, Budget& budget) {
    return readVectors<glm::vec2>(accessor, budget);
}

std::vector<glm::vec3> readVec3s(const Accessor& accessor, Budget& budget) {
    return readVectors<glm::vec3>(accessor, budget);
}

std::vector<std::uint32_t> readUnsigned(const Accessor& accessor, Budget& budget) {
    budget.charge(accessor.count, accessor.components * sizeof(std::uint32_t), accessor.pointer);
    std::vector<std::uint32_t> values(accessor.count * accessor.components);
    const std::span<std::uint32_t> out(values);
    withType(accessor.componentType, [&]<class T>(T) {
        if constexpr (std::is_unsigned_v<T>)
            readComponents<T>(accessor, out, [](T value) { return std::uint32_t(value); });
        else
            throw PlaceError(accessor.pointer, "must have an unsigned component type");
    });
    return values;
}

}  // namespace penumbra::studio::gltf
