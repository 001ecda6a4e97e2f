// SPDX-License-Identifier: Apache-2.0
#include "src/catalog.h"

#include <algorithm>
#include <array>
#include <string>

#include "penumbra/promise.h"
#include "penumbra/technique.h"
#include "src/automatic/automatic.h"
#include "src/hosting/hosted_technique.h"
#include "src/techniques/exact_visibility/exact.h"
#include "src/techniques/light_sampling/adaptive.h"
#include "src/techniques/light_sampling/uniform.h"
#include "src/techniques/shadow_map/hard.h"
#include "src/techniques/shadow_map/pcf.h"
#include "src/techniques/shadow_map/pcss.h"
#include "src/techniques/shadow_width_map/shadow_width_map.h"
#include "src/techniques/smoothies/smoothies.h"
#include "src/techniques/soft_shadow_volumes/hard_volumes.h"
#include "src/techniques/soft_shadow_volumes/soft_volumes.h"

namespace penumbra {
namespace {

struct Entry {
    TechniqueInfo info;
    float rampRmse;  ///< see rampRmseOf
    std::unique_ptr<Technique> (*make)(Device&);
    std::span<const Promise> promises = {};
};

template <typename T>
std::unique_ptr<Technique> make(Device& device) {
    return std::make_unique<T>(device);
}

constexpr std::array entries = {
    Entry{{"hard", "one shadow map from the light's centre: no penumbra (Williams 1978)"},
          0.30f,
          make<shadow_map::HardShadowMap>,
          shadow_map::HardShadowMap::promises},
    Entry{{"pcf", "a shadow map filtered over a fixed kernel (Reeves et al. 1987)"},
          0.30f,
          make<shadow_map::Pcf>},
    Entry{{"pcss", "blocker search, then a filter as wide as the penumbra (Fernando 2005)"},
          0.02f,
          make<shadow_map::Pcss>,
          shadow_map::Pcss::promises},
    Entry{
        {"shadow-width", "distances to the shadow's border beside one shadow map (Kirsch and Döllner 2003)"},
        0.03f,
        make<shadow_width_map::ShadowWidthMap>},
    Entry{{"smoothies", "geometry on silhouettes fades the edges of a shadow map (Chan and Durand 2003)"},
          0.02f,
          make<smoothies::Smoothies>},
    Entry{{"uniform", "n x n shadow maps from all over the light (Schwaerzler et al. 2012)"},
          0.03f,
          make<light_sampling::UniformLightSampling>},
    Entry{{"adaptive",
           "as many shadow maps from all over the light as the view needs (Schwaerzler et al. 2012)"},
          0.03f,
          make<light_sampling::AdaptiveLightSampling>},
    Entry{{"hard-volumes", "shadow volumes of the light's centre: edges as sharp as the picture (Crow 1977)"},
          0.30f,
          make<soft_shadow_volumes::HardVolumes>},
    Entry{{"soft-volumes", "layers counted from the edges of penumbra wedges (after Assarsson et al. 2003)"},
          0.01f,
          make<soft_shadow_volumes::SoftVolumes>},
    Entry{{"exact", "samples of the light, each decided exactly, from triangles without maps"},
          0.02f,
          make<exact_visibility::ExactVisibility>,
          exact_visibility::ExactVisibility::promises},
};

/// Null where there is none of that name.
const Entry* entryOf(std::string_view technique) {
    const auto found =
        std::ranges::find(entries, technique, [](const Entry& entry) { return entry.info.name; });
    return found == entries.end() ? nullptr : &*found;
}

std::unique_ptr<Technique> makeAutomatic(Device& device) {
    std::vector<Automatic::Candidate> candidates;
    for (const Entry& entry : entries) {
        for (const Promise& promise : entry.promises)
            candidates.push_back({entry.info.name, entry.make, promise});
    }
    return std::make_unique<Automatic>(device, std::move(candidates));
}

constexpr TechniqueInfo automatic = {
    "auto", "whatever keeps an error, or a time, at the least cost; the settings of the others follow"};
constexpr float rampRmseOfAutomatic = defaultMaxError;

constexpr auto infos = [] {
    std::array<TechniqueInfo, entries.size() + 1> result;
    std::ranges::transform(entries, result.begin(), &Entry::info);
    result.back() = automatic;
    return result;
}();

}  // namespace

std::span<const TechniqueInfo> techniqueCatalog() {
    return infos;
}

float rampRmseOf(std::string_view technique) {
    const Entry* const entry = entryOf(technique);
    return entry ? entry->rampRmse : rampRmseOfAutomatic;
}

std::span<const Promise> promisesOf(std::string_view technique) {
    const Entry* const entry = entryOf(technique);
    return entry ? entry->promises : std::span<const Promise>();
}

std::optional<Choice> choiceFor(double maxError, std::string_view technique) {
    std::optional<Choice> cheapest;
    for (const Entry& entry : entries) {
        if (!technique.empty() && technique != entry.info.name) continue;
        for (const Promise& promise : entry.promises) {
            if (double(promise.penumbraRmse) > maxError) continue;
            if (!cheapest || promise.cost < cheapest->promise.cost) cheapest = {entry.info.name, promise};
        }
    }
    return cheapest;
}

std::unique_ptr<Technique> makeTechnique(Device& device, std::string_view name) {
    if (name == automatic.name) return std::make_unique<HostedTechnique>(device, makeAutomatic);
    std::string names;
    for (const Entry& entry : entries) {
        if (entry.info.name == name) return std::make_unique<HostedTechnique>(device, entry.make);
        names += (names.empty() ? "" : ", ") + std::string(entry.info.name);
    }
    throw Error(Error::Kind::unknownName, "there is no technique '" + std::string(name) +
                                              "'; there are: " + names + ", " + std::string(automatic.name));
}

}  // namespace penumbra
