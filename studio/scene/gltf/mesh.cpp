// SPDX-License-Identifier: Apache-2.0
// "Meshes", glTF 2.0 section 3.7.2, with the wider formats of KHR_mesh_quantization.
#include "studio/scene/gltf/mesh.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <numeric>

#include "studio/scene/gltf/draco_mesh.h"
#include "studio/scene/gltf/extensions.h"
#include "studio/scene/gltf/unit_vector.h"
#include "studio/scene/gltf/vertex_colors.h"
#include "studio/scene/weld.h"

namespace penumbra::studio::gltf {

namespace {

using enum ComponentType;

enum class Mode { points, lines, lineLoop, lineStrip, triangles, triangleStrip, triangleFan };

/// The triangle list that a primitive's vertices form, in the order of the specification.
std::vector<std::uint32_t> triangulate(std::vector<std::uint32_t> v, Mode mode) {
    if (v.size() < 3) return {};
    if (mode == Mode::triangles) {
        v.resize(v.size() / 3 * 3);
        return v;
    }
    std::vector<std::uint32_t> triangles;
    triangles.reserve(3 * (v.size() - 2));
    for (std::size_t i = 0; i + 2 < v.size(); ++i) {
        if (mode == Mode::triangleFan)
            triangles.insert(triangles.end(), {v[i + 1], v[i + 2], v[0]});
        else
            triangles.insert(triangles.end(), {v[i], v[i + 1 + i % 2], v[i + 2 - i % 2]});
    }
    return triangles;
}

template <class T>
void unshare(std::vector<T>& values, const std::vector<std::uint32_t>& indices) {
    if (values.empty()) return;
    std::vector<T> unshared;
    unshared.reserve(indices.size());
    for (const std::uint32_t index : indices) unshared.push_back(values[index]);
    values = std::move(unshared);
}

class PrimitiveLoader {
  public:
    PrimitiveLoader(const JsonView& json, const Accessors& accessors, VertexColors& vertexColors,
                    Budget& budget, Scene& scene)
        : json_(json),
          accessors_(accessors),
          attributes_(json.at("attributes")),
          vertexColors_(vertexColors),
          budget_(budget),
          scene_(scene) {
        if (const auto compressed = extensionOf(json, "KHR_draco_mesh_compression"))
            draco_.emplace(json, *compressed, accessors, budget);
        for (const std::string& name : attributes_.keys()) {
            const Accessor& accessor = accessors_[attributes_.at(name).asIndex(accessors_.size())];
            if (vertexCount_ == 0) vertexCount_ = accessor.count;
            if (accessor.count != vertexCount_)
                attributes_.at(name).fail("has another count than other attributes");
        }
    }

    /// Nothing where the primitive has no triangles.
    std::optional<Mesh> load(const std::vector<std::optional<UvSource>>& uvSources) {
        Mesh mesh;
        // Of the materials, the last is the default one.
        mesh.material = json_.index("material", uvSources.size() - 1).value_or(int(uvSources.size()) - 1);
        const Mode mode = Mode(json_.integer("mode", int(Mode::triangles), 0, 6));
        const std::vector<std::uint32_t> vertices = loadIndices();
        const Accessor* positions = attribute("POSITION");
        if (!positions) return skip("has no positions");
        if (mode < Mode::triangles) return skip("is made of points or lines");
        budget_.charge(vertices.size(), mode == Mode::triangles ? 4 : 12, json_.pointer());
        mesh.indices = triangulate(vertices, mode);
        if (mesh.indices.empty()) return skip("is empty");
        if (mode == Mode::triangles && vertices.size() % 3 != 0)
            warn("has vertices left over after its last triangle; left out");

        requireFormat(*positions, json_.pointer(), "VEC3", {f32, i8, u8, i16, u16});
        mesh.positions = readVec3s(*positions, budget_);
        loadNormals(mesh);
        if (const auto& uvSource = uvSources[std::size_t(mesh.material)]) loadUvs(mesh, *uvSource);
        loadColors(mesh);
        loadInfluences(mesh);
        for (const JsonView& target : json_.list("targets")) mesh.morphTargets.push_back(loadTarget(target));
        if (mesh.normals.empty()) shadeFlat(mesh);
        return mesh;
    }

  private:
    std::optional<Mesh> skip(const std::string& why) {
        warn(why + "; left out");
        return std::nullopt;
    }

    void warn(const std::string& what) {
        scene_.warnings.push_back(fmt::format("{}: {}", json_.pointer(), what));
    }

    const Accessor* attribute(const std::string& name) const {
        const auto index = attributes_.index(name, accessors_.size());
        const Accessor* decoded = draco_ ? draco_->attribute(name) : nullptr;
        return decoded ? decoded : index ? &accessors_[*index] : nullptr;
    }

    std::vector<std::uint32_t> loadIndices() {
        if (vertexCount_ > std::numeric_limits<std::uint32_t>::max())
            attributes_.fail("has too many vertices");
        const auto index = json_.index("indices", accessors_.size());
        if (index || draco_) {
            const Accessor& accessor = draco_ ? draco_->indices() : accessors_[*index];
            requireFormat(accessor, json_.pointer() + "/indices", "SCALAR", {u8, u16, u32});
            std::vector<std::uint32_t> indices = readUnsigned(accessor, budget_);
            for (std::size_t i = 0; i < indices.size(); ++i)
                if (indices[i] >= vertexCount_)
                    throw PlaceError(accessor.pointer,
                                     fmt::format("element {} is {}, but there are {} vertices", i, indices[i],
                                                 vertexCount_));
            return indices;
        }
        budget_.charge(vertexCount_, 4, json_.pointer());
        std::vector<std::uint32_t> indices(vertexCount_);
        std::iota(indices.begin(), indices.end(), 0u);
        return indices;
    }

    void loadNormals(Mesh& mesh) {
        const Accessor* normals = attribute("NORMAL");
        if (!normals) return;
        requireFormat(*normals, json_.pointer(), "VEC3", {f32, i8, i16});
        mesh.normals = readVec3s(*normals, budget_);
        for (glm::vec3& normal : mesh.normals) normal = unitOr(normal, {0, 0, 1});
    }

    void loadUvs(Mesh& mesh, const UvSource& source) {
        const std::string name = fmt::format("TEXCOORD_{}", source.texCoord);
        const Accessor* uvs = attribute(name);
        if (!uvs) {
            warn(fmt::format("has no {}, which its material's texture needs; (0, 0) is used", name));
            budget_.charge(vertexCount_, sizeof(glm::vec2), json_.pointer());
            mesh.uvs.assign(vertexCount_, glm::vec2(source.transform[2]));
            return;
        }
        requireFormat(*uvs, json_.pointer(), "VEC2", {f32, i8, u8, i16, u16});
        mesh.uvs = readVec2s(*uvs, budget_);
        for (glm::vec2& uv : mesh.uvs) uv = glm::vec2(source.transform * glm::vec3(uv, 1));
        for (const glm::vec2& uv : mesh.uvs)
            if (glm::any(glm::isnan(uv)) || glm::any(glm::isinf(uv)))
                json_.fail("its texture coordinates are too large to transform");
    }

    void loadColors(Mesh& mesh) {
        const Accessor* accessor = attribute("COLOR_0");
        if (!accessor) return;
        if (accessor->type != "VEC3") requireFormat(*accessor, json_.pointer(), "VEC4", {f32, u8, u16});
        if (accessor->type != "VEC4") requireFormat(*accessor, json_.pointer(), "VEC3", {f32, u8, u16});
        const std::vector<float> values = readFloats(*accessor, budget_);
        budget_.charge(vertexCount_, sizeof(glm::vec4) + sizeof(glm::vec3) + sizeof(glm::vec2),
                       json_.pointer());
        std::vector<glm::vec4> colors(vertexCount_, glm::vec4(1));
        for (std::size_t vertex = 0; vertex < vertexCount_; ++vertex)
            for (std::size_t i = 0; i < accessor->components; ++i)
                colors[vertex][int(i)] = std::clamp(values[vertex * accessor->components + i], 0.0f, 1.0f);
        if (!vertexColors_.apply(colors, mesh))
            warn("the alpha of its COLOR_0 varies beside a texture's, which alone makes its holes");
    }

    // The four largest influences of each vertex, over all sets of four.
    void loadInfluences(Mesh& mesh) {
        std::vector<std::vector<std::uint32_t>> joints;
        std::vector<std::vector<float>> weights;
        for (int set = 0;; ++set) {
            const Accessor* jointSet = attribute(fmt::format("JOINTS_{}", set));
            const Accessor* weightSet = attribute(fmt::format("WEIGHTS_{}", set));
            if (!jointSet && !weightSet) break;
            if (!jointSet || !weightSet)
                attributes_.fail(fmt::format("JOINTS_{0} and WEIGHTS_{0} go together", set));
            requireFormat(*jointSet, json_.pointer(), "VEC4", {u8, u16});
            requireFormat(*weightSet, json_.pointer(), "VEC4", {f32, u8, u16});
            joints.push_back(readUnsigned(*jointSet, budget_));
            weights.push_back(readFloats(*weightSet, budget_));
            if (std::ranges::any_of(weights.back(), [](float weight) { return weight < 0; }))
                throw PlaceError(weightSet->pointer, "has a negative weight");
        }
        if (joints.empty()) return;

        budget_.charge(vertexCount_, sizeof(glm::u16vec4) + sizeof(glm::vec4), json_.pointer());
        mesh.joints.resize(vertexCount_);
        mesh.jointWeights.resize(vertexCount_);
        std::vector<std::pair<float, std::uint32_t>> influences;
        for (std::size_t vertex = 0; vertex < vertexCount_; ++vertex) {
            influences.clear();
            for (std::size_t set = 0; set < joints.size(); ++set)
                for (std::size_t i = 4 * vertex; i < 4 * vertex + 4; ++i)
                    influences.emplace_back(weights[set][i], joints[set][i]);
            if (joints.size() > 1)
                std::ranges::partial_sort(influences, influences.begin() + 4, std::greater<>(),
                                          &std::pair<float, std::uint32_t>::first);
            float sum = 0;
            for (int i = 0; i < 4; ++i) sum += influences[std::size_t(i)].first;
            if (!(sum > 0 && sum <= std::numeric_limits<float>::max())) {
                influences[0].first = sum = 1;  // no weights at all: rigid on the first joint
                for (int i = 1; i < 4; ++i) influences[std::size_t(i)].first = 0;
            }
            for (int i = 0; i < 4; ++i) {
                const auto [weight, joint] = influences[std::size_t(i)];
                mesh.jointWeights[vertex][i] = weight / sum;
                mesh.joints[vertex][i] = weight > 0 ? std::uint16_t(joint) : 0;
            }
        }
    }

    MorphTarget loadTarget(const JsonView& json) {
        const auto deltas = [&](const char* name, std::initializer_list<ComponentType> types) {
            const auto index = json.index(name, accessors_.size());
            if (!index) return std::vector<glm::vec3>();
            const Accessor& accessor = accessors_[*index];
            requireFormat(accessor, json.pointer(), "VEC3", types);
            if (accessor.count != vertexCount_)
                json.at(name).fail(
                    fmt::format("has {} elements for {} vertices", accessor.count, vertexCount_));
            return readVec3s(accessor, budget_);
        };
        for (const std::string& name : json.keys()) json.at(name).asIndex(accessors_.size());
        return {.positionDeltas = deltas("POSITION", {f32, i8, u8, i16, u16}),
                .normalDeltas = deltas("NORMAL", {f32, i8, i16})};
    }

    // Flat normals differ at the same vertex from triangle to triangle, so that none may be shared.
    void shadeFlat(Mesh& mesh) {
        std::size_t vertex_bytes =
            3 * sizeof(glm::vec3) + sizeof(glm::vec2) + sizeof(glm::u16vec4) + sizeof(glm::vec4);
        vertex_bytes += mesh.morphTargets.size() * sizeof(glm::vec3);
        budget_.charge(mesh.indices.size(), vertex_bytes, json_.pointer());
        unshare(mesh.positions, mesh.indices);
        unshare(mesh.uvs, mesh.indices);
        unshare(mesh.colors, mesh.indices);
        unshare(mesh.joints, mesh.indices);
        unshare(mesh.jointWeights, mesh.indices);
        for (MorphTarget& target : mesh.morphTargets) {
            unshare(target.positionDeltas, mesh.indices);
            target.normalDeltas.clear();
        }
        std::iota(mesh.indices.begin(), mesh.indices.end(), 0u);
        mesh.normals = flatNormals(mesh.positions);
    }

    const JsonView& json_;
    const Accessors& accessors_;
    JsonView attributes_;
    VertexColors& vertexColors_;
    Budget& budget_;
    Scene& scene_;
    std::optional<DracoMesh> draco_;  ///< has the data of indices and attributes that are compressed
    std::uint64_t vertexCount_ = 0;
};

}  // namespace

std::vector<glm::vec3> flatNormals(const std::vector<glm::vec3>& positions) {
    std::vector<glm::vec3> normals(positions.size());
    for (std::size_t i = 0; i + 2 < positions.size(); i += 3) {
        const glm::dvec3 a = positions[i], b = positions[i + 1], c = positions[i + 2];
        const glm::dvec3 normal = glm::cross(b - a, c - a);
        const double length = glm::length(normal);
        const glm::vec3 unit = length > 0 ? glm::vec3(normal / length) : glm::vec3(0, 0, 1);
        normals[i] = normals[i + 1] = normals[i + 2] = unit;
    }
    return normals;
}

namespace {

// Positions much farther from their origin than from each other (a city in coordinates of its country) lose
// digits in all that is done with them: they are kept relative to their middle.
void bringToItsMiddle(MeshGroup& group, const JsonView& json, Scene& scene) {
    Bounds bounds;
    for (const MeshGroup::Part& part : group.parts)
        for (const glm::vec3& position : scene.meshes[std::size_t(part.mesh)].positions)
            bounds.include(position);
    if (bounds.empty() || !isFar(glm::dvec3(bounds.min), glm::dvec3(bounds.max))) return;
    const glm::dvec3 middle = glm::dvec3(glm::vec3(0.5 * (glm::dvec3(bounds.min) + glm::dvec3(bounds.max))));
    for (const MeshGroup::Part& part : group.parts)
        for (glm::vec3& position : scene.meshes[std::size_t(part.mesh)].positions)
            position = glm::vec3(glm::dvec3(position) - middle);
    group.origin = middle;

    // Floats that lie this share of the mesh's size apart show in its shape.
    constexpr double visible = 1e-4;
    const double size = glm::length(glm::dvec3(bounds.max) - glm::dvec3(bounds.min));
    const double apart = std::max({std::abs(middle.x), std::abs(middle.y), std::abs(middle.z)}) *
                         double(std::numeric_limits<float>::epsilon());
    if (apart > visible * size)
        scene.warnings.push_back(
            fmt::format("{}: lies so far from its origin that its positions are only told {:.2g} apart: its "
                        "shape and shadows are "
                        "as coarse; export it relative to a place nearby",
                        json.pointer(), apart));
}

// What lies this share of a thing's size apart is one place that was rounded twice.
constexpr float oneUlpOrSo = 1e-6f;

void closeSeams(const MeshGroup& group, const JsonView& json, Budget& budget, Scene& scene) {
    std::vector<std::span<glm::vec3>> surfaces;
    Bounds bounds;
    for (const MeshGroup::Part& part : group.parts) {
        Mesh& mesh = scene.meshes[std::size_t(part.mesh)];
        if (mesh.deforms()) return;  // what is together at rest need not be so later
        constexpr std::size_t kept_bytes = 80;
        budget.charge(mesh.positions.size(), kept_bytes, json.pointer());
        surfaces.push_back(mesh.positions);
        for (const glm::vec3& position : mesh.positions) bounds.include(position);
    }
    const double size = glm::length(glm::dvec3(bounds.max) - glm::dvec3(bounds.min));
    if (!bounds.empty()) weld(surfaces, float(oneUlpOrSo * size));
}

}  // namespace

std::vector<MeshGroup> loadMeshes(const JsonView& root, const Accessors& accessors,
                                  const std::vector<std::optional<UvSource>>& uvSources, Budget& budget,
                                  Scene& scene) {
    std::vector<MeshGroup> groups;
    VertexColors vertexColors(scene);
    for (const JsonView& json : root.list("meshes")) {
        MeshGroup& group = groups.emplace_back();
        const std::vector<JsonView> primitives = json.at("primitives").elements();
        if (primitives.empty()) json.fail("has no primitives");
        group.targetCount = primitives.front().list("targets").size();
        std::vector<float> weights(group.targetCount, 0.0f);
        if (const auto member = json.find("weights")) weights = member->asNumbers(group.targetCount);

        for (const JsonView& primitive : primitives) {
            if (primitive.list("targets").size() != group.targetCount)
                primitive.fail("has another number of morph targets than the mesh's first primitive");
            std::optional<Mesh> mesh =
                PrimitiveLoader(primitive, accessors, vertexColors, budget, scene).load(uvSources);
            if (!mesh) continue;
            mesh->name = json.string("name", fmt::format("mesh {}", groups.size() - 1));
            mesh->solid = int(groups.size()) - 1;
            mesh->morphWeights = weights;
            for (const glm::u16vec4& joints : mesh->joints)
                for (int i = 0; i < 4; ++i) group.jointCount = std::max(group.jointCount, joints[i] + 1u);
            group.parts.push_back({int(scene.meshes.size()), !primitive.at("attributes").has("NORMAL")});
            scene.meshes.push_back(std::move(*mesh));
        }
        bringToItsMiddle(group, json, scene);
        closeSeams(group, json, budget, scene);
    }
    return groups;
}

}  // namespace penumbra::studio::gltf
