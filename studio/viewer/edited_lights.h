// SPDX-License-Identifier: Apache-2.0
// The lights as the user has them. A light that was edited is the scene's no more but what its file says:
// every edit goes through the text of a sidecar (docs/lights.md), so that what is shown is what would be
// saved. Those that were not are the scene's own, at every moment, and stay in their file as they stand
// there.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "studio/viewer/light_file.h"

namespace penumbra::studio::viewer {

class EditedLights {
  public:
    struct State;

    /// Of a scene that has its lights from `sidecar`, if that exists.
    explicit EditedLights(const Scene& scene, const std::filesystem::path& sidecar = {});

    /// The lights of a moment whose own ones are `own`.
    std::vector<Light> at(const SceneMoment& moment, const std::vector<Light>& own) const;

    bool edited() const { return state_ != nullptr; }
    /// Since the last save.
    bool unsaved() const { return state_ != saved_; }

    /// Takes `lights` as they are wanted at `moment`, which shows those before, the scene's own being `own`.
    /// Names are made unique, textures are kept, and what hangs on a node goes on to.
    void edit(std::vector<Light> lights, const SceneMoment& moment, const std::vector<Light>& own);
    /// The scene's own lights again.
    void revert() { state_ = nullptr; }

    /// What undo comes back to. Equal states are the same object; null: the scene's own lights.
    const std::shared_ptr<const State>& state() const { return state_; }
    void restore(std::shared_ptr<const State> state) { state_ = std::move(state); }

    /// Writes the lights to a sidecar, which is replaced as a whole: what nobody has edited stands there as
    /// it stood in the scene's. Textures, profiles and what the text names lie beside it. Whoever reads it
    /// gets the lights that are shown, bit for bit. Throws OutputError, and InputError for a file that is
    /// there no more.
    void save(const std::filesystem::path& file);
    /// The same to a file in a folder of its own beneath `folder`, named by content; returns its path.
    std::filesystem::path snapshot(const std::filesystem::path& folder) const;

  private:
    std::vector<WrittenLight> written() const;

    const Scene& scene_;
    LightFile file_;
    std::shared_ptr<const State> state_, saved_;
};

}  // namespace penumbra::studio::viewer
