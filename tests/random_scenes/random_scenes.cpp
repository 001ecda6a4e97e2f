// SPDX-License-Identifier: Apache-2.0
// random_scenes COUNT SEED [TECHNIQUE ...]: random valid scenes, on which every technique is judged by the
// reference, and the reference by brute force in doubles. What disagrees is made as small as it still
// disagrees and written to out/random-scenes/. Exit code 1 if the reference, or a technique that promises to
// be right everywhere, is wrong.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <map>

#include "studio/image/atomic_file.h"
#include "studio/image/image_io.h"
#include "studio/metrics/difference_image.h"
#include "studio/metrics/visibility_metrics.h"
#include "studio/reference/brute_force.h"
#include "studio/workbench/reference_inputs.h"
#include "studio/workbench/workbench.h"
#include "tests/random_scenes/recipe.h"

namespace penumbra::studio {
namespace {

constexpr PictureSize size{96, 72};
constexpr int rays = 256;

/// Techniques that hold for any scene; of the others wrong scenes are counted and no more.
constexpr std::array<std::string_view, 2> mustBeRight = {"exact", "reference"};

/// Wrong: a hundredth of what is dark or lit is not, or the penumbra is off by more than 64 points of a light
/// can be.
constexpr double largestShare = 0.01, largestPenumbraError = 0.06;
/// Shares of fewer pixels than this say nothing.
constexpr std::size_t fewest = 50;

/// Pixels at which brute force is asked, points of the light along each axis there, and by how much a regular
/// grid and so many random rays may differ.
constexpr std::size_t bruteForcePixels = 24;
constexpr int gridSize = 24;
constexpr double largestDifference = 0.15;

/// What a technique saw against the truth, and why that is wrong; `reason` is empty where it is right.
struct Verdict {
    std::string reason;
    Image truth, seen;
};

class Judge {
  public:
    Verdict judge(const std::string& technique, const Recipe& recipe) {
        const Scene scene = cook(recipe);
        const SceneMoment moment = scene.at(0);
        workbench_.open(scene);
        const LightResult truth = run("reference", moment);
        if (technique == "reference")
            return {byBruteForce(scene, moment, truth), truth.visibility, truth.visibility};
        const LightResult seen = run(technique, moment);
        std::vector<std::uint8_t> reached;
        for (const float irradiance : truth.reach.values) reached.push_back(irradiance > 0);
        return {byTruth(compareVisibility(truth.visibility, seen.visibility, reached)), truth.visibility,
                seen.visibility};
    }

  private:
    LightResult run(const std::string& name, const SceneMoment& moment) {
        std::unique_ptr<Technique>& technique = techniques_[name];
        if (technique == nullptr) {
            technique = workbench_.makeTechnique(name);
            if (name == "reference") {
                setParameter(*technique, "samples", std::to_string(rays));
                setParameter(*technique, "cache", "false");
            }
        }
        return workbench_.run(name, *technique, moment, moment.cameras.front(), size).lights.at(0);
    }

    static std::string byTruth(const VisibilityMetrics& metrics) {
        if (metrics.notFinite > 0) return "values that are not finite";
        if (metrics.umbraSamples >= fewest && metrics.leak > largestShare) {
            return fmt::format("{:.1f} % of the umbra is lit", 100 * metrics.leak);
        }
        if (metrics.litSamples >= fewest && metrics.false_shadow > largestShare) {
            return fmt::format("{:.1f} % of what is lit is dark", 100 * metrics.false_shadow);
        }
        if (metrics.penumbraSamples >= fewest && metrics.penumbra_rmse > largestPenumbraError) {
            return fmt::format("penumbra RMSE of {:.3f}", metrics.penumbra_rmse);
        }
        return "";
    }

    std::string byBruteForce(const Scene& scene, const SceneMoment& moment, const LightResult& truth) {
        const ShadowInputs inputs = workbench_.frame().shadowInputs(moment.lights.front());
        const ReceiverImage receivers = readReceivers(inputs.view);
        std::vector<TracedCaster> casters;
        for (const Instance& instance : moment.instances) {
            const Mesh& mesh = scene.meshes[std::size_t(instance.mesh)];
            casters.push_back({.positions = mesh.positions,
                               .indices = mesh.indices,
                               .worldFromMesh = instance.worldFromMesh});
        }
        const BruteForceScene brute(casters);
        std::size_t different = 0;
        std::string where;
        const std::size_t step = std::max<std::size_t>(1, receivers.posWorld.size() / bruteForcePixels);
        for (std::size_t i = step / 2; i < receivers.posWorld.size(); i += step) {
            if (receivers.valid[i] == 0 || !(truth.reach.values[i] > 0)) continue;
            const glm::dvec3 position(receivers.posWorld[i]), normal(receivers.normalWorld[i]);
            // Off the surface by what floats know of it.
            const double known = glm::distance(position, glm::dvec3(receivers.eyeWorld)) +
                                 std::max({std::abs(position.x), std::abs(position.y), std::abs(position.z)});
            const double seen = brute.visibility(position + 8e-6 * known * normal, normal,
                                                 moment.lights.front().shape, gridSize);
            if (std::abs(seen - truth.visibility.values[i]) <= largestDifference) continue;
            if (different++ == 0) {
                where = fmt::format("pixel ({}, {}): {:.3f}, and {:.3f} by brute force",
                                    i % std::size_t(size.width_px), i / std::size_t(size.width_px),
                                    truth.visibility.values[i], seen);
            }
        }
        return where;
    }

    Workbench workbench_;
    std::map<std::string, std::unique_ptr<Technique>> techniques_;
};

/// Leaves out and straightens what can be, as long as the verdict stays "wrong".
Recipe smallest(Judge& judge, const std::string& technique, Recipe recipe) {
    const auto tries = [&](auto&& change) {
        Recipe changed = recipe;
        change(changed);
        if (judge.judge(technique, changed).reason.empty()) return false;
        recipe = changed;
        return true;
    };
    for (std::size_t i = recipe.parts.size(); i-- > 0;) {
        tries([&](Recipe& r) { r.parts.erase(r.parts.begin() + std::ptrdiff_t(i)); });
    }
    tries([](Recipe& r) { r.scale = 1; });
    for (std::size_t i = 0; i < recipe.parts.size(); ++i) {
        tries([&](Recipe& r) { r.parts[i].shape = Recipe::Shape::box; });
        tries([&](Recipe& r) { r.parts[i].turn_rad = r.parts[i].tilt_rad = 0; });
        tries([&](Recipe& r) { r.parts[i].mirrored = false; });
    }
    tries([](Recipe& r) { r.lamp.aspect = 1; });
    return recipe;
}

void write(const std::filesystem::path& folder, const std::string& technique, const std::string& title,
           const Recipe& recipe, const Verdict& verdict) {
    std::filesystem::create_directories(folder);
    writeFileAtomically(folder / (technique + ".txt"), title + "\n" + describe(recipe));
    writePng(folder / "truth.png", verdict.truth);
    writePng(folder / (technique + ".png"), verdict.seen);
    writePng(folder / (technique + ".difference.png"), differenceImage(verdict.truth, verdict.seen));
}

template <typename T>
T number(const char* text) {
    T value{};
    const std::string_view view(text);
    const auto [end, error] = std::from_chars(view.data(), view.data() + view.size(), value);
    if (error != std::errc() || end != view.data() + view.size() || value < 0) {
        throw std::runtime_error(
            fmt::format("'{}' is not a number; random_scenes COUNT SEED [TECHNIQUE ...]", text));
    }
    return value;
}

int run(int argc, char** argv) {
    if (argc < 3) throw std::runtime_error("random_scenes COUNT SEED [TECHNIQUE ...]");
    const int count = number<int>(argv[1]);
    const auto seed = number<std::uint64_t>(argv[2]);
    std::vector<std::string> techniques(argv + 3, argv + argc);
    if (techniques.empty()) {
        techniques.emplace_back("reference");
        for (const TechniqueInfo& info : techniqueCatalog()) techniques.emplace_back(info.name);
    }
    Judge judge;
    std::map<std::string, int> wrong;
    for (int index = 0; index < count; ++index) {
        const Recipe recipe = randomRecipe(seed, index);
        for (const std::string& technique : techniques) {
            if (judge.judge(technique, recipe).reason.empty()) continue;
            ++wrong[technique];
            const bool isFinding = std::ranges::find(mustBeRight, technique) != mustBeRight.end();
            if (!isFinding) continue;
            const Recipe small = smallest(judge, technique, recipe);
            const Verdict verdict = judge.judge(technique, small);
            const std::string title =
                fmt::format("scene {} of seed {}, {}: {}", index, seed, technique, verdict.reason);
            fmt::print("{}\n{}", title, describe(small));
            write(fmt::format("out/random-scenes/{}-{}", seed, index), technique, title, small, verdict);
        }
    }
    fmt::print("{} scenes of seed {}; wrong by each technique:\n", count, seed);
    int findings = 0;
    for (const std::string& technique : techniques) {
        fmt::print("{:<14} {}\n", technique, wrong[technique]);
        if (std::ranges::find(mustBeRight, technique) != mustBeRight.end()) findings += wrong[technique];
    }
    return findings == 0 ? 0 : 1;
}

}  // namespace
}  // namespace penumbra::studio

int main(int argc, char** argv) {
    try {
        return penumbra::studio::run(argc, argv);
    } catch (const std::exception& error) {
        fmt::print(stderr, "{}\n", error.what());
        return 2;
    }
}
