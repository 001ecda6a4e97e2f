// SPDX-License-Identifier: Apache-2.0
// A grid laid over a surface by hand, and the light measured on it: what `penumbra measure` would say of the
// same points, kept up to date with the lights.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>

#include "studio/measure/measurement.h"
#include "studio/viewer/document.h"

namespace penumbra::studio::viewer {

/// Where a grid lies and what is measured on it.
struct GridSpec {
    glm::dvec3 fromWorld{0}, toWorld{0};  ///< opposite corners, on the surface
    glm::dvec3 normalWorld{0, 1, 0};      ///< the surface's
    double above_m = 0;                   ///< how high over it points lie
    int columns = 20, rows = 20;
    bool ofSunHours = false;  ///< hours of direct sun over a day, else lux
    std::string over = "08:00-18:00/30min";
    bool showsNumbers = true;
    bool operator==(const GridSpec&) const = default;
};

class MeasuredGrid {
  public:
    explicit MeasuredGrid(Device& device) : device_(device) {}

    /// Measures anew where `spec`, lights, or time are others than the last time. While hands move with fewer
    /// samples, and no day. Returns whether anything is new; waits for the device then.
    bool update(const Document& document, const std::optional<GridSpec>& spec, bool isMoving);
    /// Of the scene before.
    void forget() { made_.reset(); }

    /// Nothing without a grid, nor where it could not be measured: see problem().
    const Measurement* measurement() const { return measurement_ ? &*measurement_ : nullptr; }
    const std::string& problem() const { return problem_; }
    /// Fewer samples than at rest.
    bool isRough() const { return made_ && made_->isRough; }

    /// The day's place and setting, as --sun has them, of the scene's sun; nothing without one.
    static std::optional<std::string> sunOf(const std::vector<Light>& lights);

    /// A table (.csv) or a plan (.svg, .png) of what is shown, the very one of `penumbra measure`. Throws
    /// UsageError for another name and where nothing is measured, OutputError.
    void save(const Document& document, const std::filesystem::path& file) const;

  private:
    struct Made {
        GridSpec spec;
        std::shared_ptr<const EditedLights::State> lights;
        double time_s = 0;
        bool isRough = false;
    };
    void measure(const Document& document, const GridSpec& spec, bool isMoving);

    Device& device_;
    std::unique_ptr<Technique> technique_;  ///< made with the first grid, as is the next
    std::unique_ptr<PointLighting> lighting_;
    std::optional<Made> made_;  ///< what the measurement is of
    std::optional<Measurement> measurement_;
    std::string problem_;
};

/// Cells of about equal sides, twenty along the longer one.
void fitCells(GridSpec& spec);

}  // namespace penumbra::studio::viewer
