// SPDX-License-Identifier: Apache-2.0
#include "studio/scene/gltf/draco_mesh.h"

#include <draco/compression/decode.h>
#include <fmt/format.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <cstring>
#include <new>
#include <optional>
#include <stdexcept>

namespace penumbra::studio::gltf {

namespace {

/// While it lives, this process can map no more than so many further bytes: libdraco believes the counts that
/// a file claims, and asks for their memory before it looks at the data.
class AddressSpaceLimit {
  public:
    explicit AddressSpaceLimit(std::uint64_t further_bytes) {
        std::uint64_t pages = 0;
        const std::unique_ptr<std::FILE, int (*)(std::FILE*)> statm(std::fopen("/proc/self/statm", "r"),
                                                                    std::fclose);
        unsigned long long first = 0;
        if (!statm || std::fscanf(statm.get(), "%llu", &first) != 1) return;
        pages = first;
        if (::getrlimit(RLIMIT_AS, &before_) != 0) return;
        rlimit limited = before_;
        limited.rlim_cur = std::min<rlim_t>(before_.rlim_cur,
                                            pages * std::uint64_t(::sysconf(_SC_PAGESIZE)) + further_bytes);
        isSet_ = ::setrlimit(RLIMIT_AS, &limited) == 0;
    }
    ~AddressSpaceLimit() {
        if (isSet_) ::setrlimit(RLIMIT_AS, &before_);
    }
    AddressSpaceLimit(const AddressSpaceLimit&) = delete;
    AddressSpaceLimit& operator=(const AddressSpaceLimit&) = delete;

  private:
    rlimit before_{};
    bool isSet_ = false;
};

/// The numbers at the start of a stream ("Draco bitstream specification", 2.2: header, connectivity).
struct Announced {
    std::uint64_t faces = 0, points = 0;
};

std::optional<Announced> readStart(std::span<const std::byte> bytes, const JsonView& json) {
    constexpr std::size_t header_bytes = 11;
    constexpr std::byte mesh{1}, sequential{0}, edgebreaker{1}, metadata{0x80};
    if (bytes.size() < header_bytes || std::memcmp(bytes.data(), "DRACO", 5) != 0 || bytes[7] != mesh ||
        (bytes[8] != sequential && bytes[8] != edgebreaker))
        json.fail("its compressed data is damaged (it does not begin as a mesh)");
    if (bytes[5] != std::byte(2) || bytes[6] != std::byte(2))
        json.fail("its compressed data is not of Draco's version 2.2");
    if ((bytes[10] & metadata) != std::byte(0)) return std::nullopt;  // which come first, and are long
    std::span<const std::byte> rest = bytes.subspan(header_bytes);
    if (bytes[8] == edgebreaker)
        rest = rest.subspan(std::min<std::size_t>(1, rest.size()));  // the kind of traversal
    // Seven bits a byte, the lowest first.
    const auto number = [&] {
        std::uint64_t value = 0;
        for (int shift = 0; shift < 35; shift += 7) {
            if (rest.empty()) json.fail("its compressed data is damaged (it ends too early)");
            const auto byte = std::uint64_t(rest.front());
            rest = rest.subspan(1);
            value |= (byte & 0x7f) << shift;
            if ((byte & 0x80) == 0) break;
        }
        return value;
    };
    const std::uint64_t first = number(), second = number();
    return bytes[8] == sequential ? Announced{first, second} : Announced{second, first};
}

/// What is decoded must be as much as the file says elsewhere, which the budget must have room for.
void checkStart(const JsonView& primitive, const JsonView& json, std::span<const std::byte> bytes,
                const Accessors& accessors, Budget& budget) {
    const std::optional<Announced> announced = readStart(bytes, json);
    const std::uint64_t points =
        accessors[primitive.at("attributes").at("POSITION").asIndex(accessors.size())].count;
    const auto indices = primitive.index("indices", accessors.size());
    constexpr std::uint64_t inDecoder_bytes = 100;
    if (announced) {
        if (announced->points > points || (indices && 3 * announced->faces != accessors[*indices].count))
            json.fail(fmt::format(
                "its compressed data has {} triangles and {} points or more, but its accessors say "
                "another number",
                announced->faces, announced->points));
        budget.charge(announced->faces, inDecoder_bytes, json.pointer());
    }
    budget.charge(points, inDecoder_bytes, json.pointer());
}

std::optional<ComponentType> componentTypeOf(draco::DataType type) {
    switch (type) {
        case draco::DT_INT8:
            return ComponentType::i8;
        case draco::DT_UINT8:
            return ComponentType::u8;
        case draco::DT_INT16:
            return ComponentType::i16;
        case draco::DT_UINT16:
            return ComponentType::u16;
        case draco::DT_UINT32:
            return ComponentType::u32;
        case draco::DT_FLOAT32:
            return ComponentType::f32;
        default:
            return std::nullopt;
    }
}

std::unique_ptr<draco::Mesh> decode(std::span<const std::byte> bytes, const JsonView& json,
                                    std::uint64_t memory_bytes) {
    draco::DecoderBuffer buffer;
    buffer.Init(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    const AddressSpaceLimit limit(memory_bytes);
    try {
        draco::Decoder decoder;
        auto mesh = decoder.DecodeMeshFromBuffer(&buffer);
        if (!mesh.ok())
            json.fail(fmt::format("its compressed data is damaged ({})", mesh.status().error_msg_string()));
        return std::move(mesh).value();
    } catch (const std::bad_alloc&) {
        json.fail("its compressed data asks for more memory than the budget for loading has left");
    } catch (const std::length_error&) {
        json.fail("its compressed data asks for more memory than there can be");
    }
}

}  // namespace

DracoMesh::DracoMesh(const JsonView& primitive, const JsonView& json, const Accessors& accessors,
                     Budget& budget) {
    const BufferView& view = accessors.view(json.at("bufferView").asIndex(accessors.viewCount()));
    checkStart(primitive, json, view.bytes, accessors, budget);
    const auto mesh = decode(view.bytes, json, budget.left_bytes());

    const std::uint64_t indexCount = 3 * std::uint64_t(mesh->num_faces());
    if (indexCount == 0) json.fail("its compressed data has no triangles");
    budget.charge(indexCount, sizeof(std::uint32_t), json.pointer());
    indices_.bytes.resize(indexCount * sizeof(std::uint32_t));
    for (draco::FaceIndex face(0); face < mesh->num_faces(); ++face)
        for (std::size_t corner = 0; corner < 3; ++corner) {
            const std::uint32_t point = mesh->face(face)[corner].value();
            std::memcpy(&indices_.bytes[(3 * std::size_t(face.value()) + corner) * sizeof(point)], &point,
                        sizeof(point));
        }
    indices_.accessor = {.pointer = json.pointer(),
                         .componentType = ComponentType::u32,
                         .type = "SCALAR",
                         .count = indexCount,
                         .bytes = indices_.bytes,
                         .stride_bytes = sizeof(std::uint32_t)};

    const JsonView ids = json.at("attributes");
    for (const std::string& name : ids.keys()) {
        const JsonView id = ids.at(name);
        const Accessor& announced = accessors[primitive.at("attributes").at(name).asIndex(accessors.size())];
        const draco::PointAttribute* attribute =
            mesh->GetAttributeByUniqueId(std::uint32_t(id.asInteger(0, 0xffffffff)));
        if (!attribute) id.fail("names nothing in the compressed data");
        if (componentTypeOf(attribute->data_type()) != announced.componentType ||
            std::size_t(attribute->num_components()) != announced.components ||
            mesh->num_points() != announced.count || announced.sparse)
            id.fail("its compressed data is of another type or number than its accessor");

        Decoded& decoded = attributes_[name];
        decoded.accessor = announced;
        const std::size_t stride = announced.components * sizeOf_bytes(announced.componentType);
        budget.charge(announced.count, stride, id.pointer());
        decoded.bytes.resize(announced.count * stride);
        for (draco::PointIndex point(0); point < mesh->num_points(); ++point)
            attribute->GetMappedValue(point, &decoded.bytes[std::size_t(point.value()) * stride]);
        decoded.accessor.bytes = decoded.bytes;
        decoded.accessor.stride_bytes = stride;
    }
}

const Accessor* DracoMesh::attribute(const std::string& name) const {
    const auto found = attributes_.find(name);
    return found == attributes_.end() ? nullptr : &found->second.accessor;
}

}  // namespace penumbra::studio::gltf
