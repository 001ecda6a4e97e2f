// SPDX-License-Identifier: Apache-2.0
// The lights as the user has them. Once anything is edited, they are the scene's no more but what their file
// says: every edit goes through the text of a sidecar (docs/lights.md), so that what is shown is what would
// be saved.
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "studio/scene/lights/sidecar.h"
#include "studio/scene/scene.h"

namespace penumbra::studio::viewer {

/// A rectangle above `bounds` that lights their middle, from another side for each `number`.
Light newLight(const Bounds& bounds, std::size_t number);

/// Another shape of the same brightness and about the same size at the same place. A texture stays with
/// rects.
void changeShape(Light& light, LightShape shape);

/// Sets one of the light's sizes. Where it becomes or ceases to be zero the unit of emission changes with it,
/// and the illuminance that the light gives from afar stays. A luminaire keeps the size that its file says.
void setSize(Light& light, float AreaLight::*size, float value);

class EditedLights {
  public:
    struct State;

    /// Puts the edited lights, if there are any, in place of the moment's own.
    void apply(SceneMoment& moment) const;

    bool edited() const { return state_ != nullptr; }
    /// Since the last save.
    bool unsaved() const { return state_ != saved_; }

    /// Takes `lights` as they are wanted. Names are made unique. Textures are kept.
    void edit(std::vector<Light> lights);
    /// The scene's own lights again.
    void revert() { state_ = nullptr; }

    /// What undo comes back to. Equal states are the same object; null: the scene's own lights.
    const std::shared_ptr<const State>& state() const { return state_; }
    void restore(std::shared_ptr<const State> state) { state_ = std::move(state); }

    /// Writes the edited lights to a sidecar, textures as PNG files beside it; what `file` says of nodes is
    /// kept. Whoever reads it gets the lights that are shown, bit for bit. Throws OutputError.
    void save(const Scene& scene, const std::filesystem::path& file);
    /// The same to a file of its own beneath `folder`, named by content, and returns its path; about nodes it
    /// says what `sidecar` says.
    std::filesystem::path snapshot(const Scene& scene, const std::filesystem::path& folder,
                                   const std::filesystem::path& sidecar) const;

  private:
    std::vector<SidecarLight> written() const;

    std::shared_ptr<const State> state_, saved_;
};

struct EditedLights::State {
    /// As they were given to be written. Their rotations, turned into quaternions once more, would differ in
    /// the last bit, so that saving must begin from the same numbers as showing did.
    std::vector<SidecarLight> written;
    std::vector<Light> lights;  ///< what reading the file gives
};

}  // namespace penumbra::studio::viewer
