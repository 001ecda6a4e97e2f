// SPDX-License-Identifier: Apache-2.0
// Everything the viewer does, without its window: a scene, a camera, two sides, the truth, and what they say
// of each other. Does work only where something has changed.
#pragma once

#include <chrono>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>

#include "studio/metrics/visibility_metrics.h"
#include "studio/viewer/camera_control.h"
#include "studio/viewer/canvas.h"
#include "studio/viewer/measured_grid.h"
#include "studio/viewer/picker.h"
#include "studio/viewer/refined_picture.h"
#include "studio/viewer/refining_cost.h"
#include "studio/viewer/settings.h"
#include "studio/viewer/sides.h"
#include "studio/workbench/workbench.h"

namespace penumbra::studio::viewer {

/// What the user has chosen. Whoever changes it says so with changedView() or changedLighting().
struct Choices {
    std::string technique{defaultTechnique()};            ///< of side A
    std::map<std::string, std::string> techniqueOfLight;  ///< where a light has its own, by the light's name
    std::string other{referenceName};                     ///< side B: one technique for all lights
    bool comparing = false;                               ///< both sides are shown
    bool flipped = false;                                 ///< side B alone is shown
    float wipe = 0.5f;                                    ///< where side B begins, share of the width
    bool referenceRuns = true;
    int referenceSamples = 1024;
    std::size_t light = 0;  ///< the one in question: selected, judged, inspected
    Shown shown = Shown::picture;
    float differenceRange = 0.2f;  ///< visibility at which the colours of errors end
    float largestLux = 0;          ///< end of the illuminance colours; 0: what the picture needed when fitted
    std::vector<Bookmark> bookmarks;  ///< views that were kept
    std::optional<GridSpec> grid;     ///< that is measured on
    bool logarithmic = true, isolines = true;
    bool luminairesShown = true;  ///< see FrameRenderer::showLuminaires
    float resolutionScale = 1;
    std::optional<float> exposureValue;  ///< see FrameRenderer::setExposure; none: automatic
    int sceneCamera = 0;                 ///< of the moment's; -1: the free one
};

/// A line of equal illuminance carries its number here.
struct IsolineNumber {
    int x = 0, y = 0;  ///< pixels from the upper left
    float lux = 0;
};

/// What undo and redo bring back: what the user has done to lights, techniques, bookmarks and grids.
struct Work {
    std::shared_ptr<const EditedLights::State> lights;
    std::size_t light = 0;  ///< the one in question
    std::string technique, other;
    std::map<std::string, std::string> techniqueOfLight;
    std::map<std::string, ParameterValues> parameters;  ///< that differ from the defaults, by technique
    std::vector<Bookmark> bookmarks;
    std::optional<GridSpec> grid;

    /// The light in question alone is no step.
    bool operator==(const Work& with) const {
        return lights == with.lights && technique == with.technique && other == with.other &&
               techniqueOfLight == with.techniqueOfLight && parameters == with.parameters &&
               bookmarks == with.bookmarks && grid == with.grid;
    }
};

class Session {
  public:
    /// `shaderSourceDirectory` as in DeviceOptions. An OpenGL context is current as long as this lives.
    explicit Session(const std::filesystem::path& shaderSourceDirectory);

    Choices& choices() { return choices_; }
    const Choices& choices() const { return choices_; }

    /// Throws as Document does, and then leaves everything as it is.
    void open(const std::string& nameOrPath, const OpenOptions& options = {});
    bool hasDocument() const { return document_ != nullptr; }
    Document& document() { return *document_; }
    const Document& document() const { return *document_; }

    TechniqueBank& techniques() { return techniques_; }
    FrameRenderer& frame() { return frame_; }
    Device& device() { return device_; }
    const Device& device() const { return device_; }
    const Canvas& canvas() const { return canvas_; }
    const Side& side(std::size_t index) const { return sides_.side(index); }
    ProgressiveReference& reference() { return reference_; }
    Picker& picker() { return picker_; }
    const Picker& picker() const { return picker_; }

    Camera camera() const;
    CameraView cameraView() const;
    /// The camera that hands move; begins where the scene's camera in use stands.
    CameraControl& freeCamera();
    void useSceneCamera(int index);
    /// Keeps the view under a name that is not taken; goes to one that was kept.
    void keepView();
    void goTo(const Bookmark& bookmark);
    /// Where one looks: the surface in the middle of the picture, else the scene's middle, seen from above.
    /// Waits for the device.
    SurfacePoint lookedAt() const;
    /// Adds a light that faces where one looks, from no farther than halfway to the eye; it is in question
    /// now.
    void addLight();
    const CameraControl& cameraControl() const { return control_; }

    void setTime(double time_s);
    void editLights(std::vector<Light> lights);
    void revertLights();

    Work work();
    void restore(const Work& work);

    /// Camera, time, lights or size are others now: both sides and the truth begin anew.
    void changedView();
    /// Techniques or their parameters are others now.
    void changedLighting();
    /// Colours are others now.
    void changedCanvas() { canvasStale_ = true; }

    /// The grid of Choices::grid, measured. Brought up to date by update(), roughly while hands move.
    const MeasuredGrid& grid() const { return grid_; }
    void setHandsMove(bool areMoving) { handsMove_ = areMoving; }

    /// Brings everything up to date at this size; cheap where nothing has changed. Returns whether the canvas
    /// was made anew. What a technique or the device throws becomes problem().
    bool update(int width_px, int height_px);

    /// Draws the picture anew at `width_px` x `height_px`, which the window has room for, with four samples a
    /// pixel, or with one where no more can be drawn within `budget_ms`; until something changes. Does
    /// nothing where neither can, nor for two sides, for numbers, or for what rays are traced for.
    void refine(int width_px, int height_px, double budget_ms);
    /// Side A, drawn at a size for a file. Neither what is shown nor the truth is touched, unless a light is
    /// shown by the truth: that there is of one size, the picture's. Throws what techniques throw.
    struct KeptPicture {
        const Side& side;
        int width_px, height_px;
        float exposureValue;
    };
    KeptPicture drawToKeep(PictureSize size);
    /// Whether side A shows the truth of some light.
    bool showsTruth() const { return showsTruth(0); }
    bool isRefined() const { return refinedSamples_ > 0; }
    /// A pixel's, of the refined picture; 0: it is not.
    int refinedSamples() const { return refinedSamples_; }
    /// The canvas, or the refined picture.
    const gl::Texture& shown() const { return isRefined() ? refined_->texture() : canvas_.texture(); }

    int width_px() const { return width_px_; }
    int height_px() const { return height_px_; }
    /// Milliseconds that the last update took that had something to do.
    double milliseconds() const { return milliseconds_; }
    /// Something is still to come without the user's doing: more rays, more picks.
    bool busy() const;

    /// What is shown is what was asked for: where that is the truth, all of its rays are traced.
    bool complete() const;

    /// Technique of a light on side A.
    std::string techniqueOf(const Light& light) const;
    /// Errors of a side against the truth so far; nothing without one, or for the truth itself.
    const std::optional<VisibilityMetrics>& metrics(std::size_t side) const { return metrics_[side]; }
    std::shared_ptr<const ProgressiveReference::Level> truth() const { return truth_; }
    /// Range of the colours shown, and of what.
    CanvasOptions canvasOptions() const;
    /// Whether the truth's noise leaves a difference as large as this worth telling: it is below a tenth of
    /// it.
    bool isCertain(double error) const;
    const std::vector<IsolineNumber>& isolineNumbers() const { return isolineNumbers_; }
    /// The colours of illuminance shall span what the next picture needs.
    void fitIlluminance() {
        fittedLux_.reset();
        changedCanvas();
    }

    /// That pictures are shown with. Waits for the device.
    float exposureValue() const { return frame_.readExposureValue(); }

    /// Why the picture is not what was asked for, or empty.
    const std::string& problem() const { return problem_; }
    /// Reads all shaders anew (see DeviceOptions::shaderSourceDirectory); those that do not compile keep
    /// their last good version, and shaderProblem() says why.
    void reloadShaders();
    const std::string& shaderProblem() const { return shaderProblem_; }

    /// The buffers that the technique of the light in question left, and the frame's own.
    std::vector<InspectedTexture> inspected();
    /// Makes a picture of one of them, for inspection().
    void inspect(const InspectedTexture& texture, int layer, bool stretched = true);
    const Canvas& inspection() const { return inspection_; }

  private:
    using Clock = std::chrono::steady_clock;
    bool wantsTruth() const;
    bool showsOther() const;
    bool showsTruth(std::size_t side) const;
    void render(int width_px, int height_px);
    std::vector<std::string> techniquesOfLights() const;
    void lightSides();
    void startReference();
    void takeTruth();
    void judge();
    void compose();
    void numberIsolines();
    double probeRefined(int attempt);

    Device device_;
    gl::ShaderLibrary shaders_;
    FrameRenderer frame_;
    TechniqueBank techniques_;
    Sides sides_;
    Canvas canvas_, inspection_;
    std::filesystem::path shaderSourceDirectory_;
    std::unique_ptr<RefinedPicture> refined_;  ///< made when it is first wanted
    int refinedSamples_ = 0;
    RefiningCost refiningCost_;
    Picker picker_;
    std::unique_ptr<Document> document_;
    ProgressiveReference reference_;

    Choices choices_;
    CameraControl control_;
    int width_px_ = 0, height_px_ = 0;
    bool viewStale_ = true, canvasStale_ = true;
    std::array<bool, 2> sideStale_{true, true};
    bool referenceStale_ = true;
    Clock::time_point changedAt_;

    std::shared_ptr<const CasterCopies> casters_;
    std::uint64_t castersRevision_ = 0;
    std::shared_ptr<const ProgressiveReference::Level> truth_;
    std::array<std::optional<VisibilityMetrics>, 2> metrics_;
    std::optional<ValueRange> fittedLux_;
    std::vector<IsolineNumber> isolineNumbers_;
    MeasuredGrid grid_;
    bool handsMove_ = false;
    double milliseconds_ = 0;
    std::string problem_, shaderProblem_;
};

}  // namespace penumbra::studio::viewer
