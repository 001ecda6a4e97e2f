// SPDX-License-Identifier: Apache-2.0
// The one interface. Every technique answers one question: for each pixel, what fraction of this light does
// the surface there see?
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "penumbra/caster.h"
#include "penumbra/device.h"
#include "penumbra/light.h"
#include "penumbra/parameters.h"
#include "penumbra/view.h"

namespace penumbra {

/// The answer: visibility in [0, 1], 1 where the whole light is seen or the pixel shows no surface, 0 in
/// umbra. The fraction is of the light's emitting area above the surface's horizon (a distant light's and a
/// sphere's: of the solid angle that they show; a cylinder's: of its outline in the plane through its two
/// outer lines as seen from there), with no cosine and no distance weight. Where none of the light is above
/// the horizon it is 0.
///
/// Behind panes (Caster::transmittance), and of textured lights, each channel has a visibility of its own,
/// for which the buffer must be colored: see `needsColor`. Where nothing asks for it, it may be.
///
/// A buffer that was moved from can be destroyed and assigned to; all else throws Error::Kind::badArgument.
class PENUMBRA_API VisibilityBuffer {
  public:
    /// Makes its own texture: GL_R32F, or GL_RGBA16F (alpha unused) where colored. Both sizes >= 1.
    VisibilityBuffer(Device& device, int width_px, int height_px, bool colored = false);

    /// A rectangle of a texture of the host's. What lies around it is not written.
    struct HostTexture {
        /// GL_TEXTURE_2D, borrowed, whose level 0 is written: any of GL_R8, R16, R16F, R32F, RG8, RG16,
        /// RG16F, RG32F, RGBA8, RGBA16, RGBA16F, RGBA32F, RGB10_A2, R11F_G11F_B10F; at least three channels
        /// where colored.
        std::uint32_t texture = 0;
        int x_px = 0, y_px = 0;  ///< lower left corner
        int width_px = 0, height_px = 0;
    };
    /// Writes into the host's texture: at no extra cost where the rectangle starts at (0, 0) and the format
    /// is GL_R32F, or GL_RGBA16F where colored; else by a copy. Throws Error::Kind::badArgument where
    /// the texture has another format than those above or does not contain the rectangle.
    VisibilityBuffer(Device& device, const HostTexture& host, bool colored = false);

    VisibilityBuffer(VisibilityBuffer&&) noexcept;
    VisibilityBuffer& operator=(VisibilityBuffer&&) noexcept;
    ~VisibilityBuffer();

    /// Follows the host's window; the texture is another afterwards. For buffers with a texture of their own.
    void resize(int width_px, int height_px);

    int width_px() const;
    int height_px() const;
    bool colored() const;
    std::uint32_t texture() const;  ///< owned by the buffer, or the host's

    struct Internals;

  private:
    VisibilityBuffer();
    /// Throws Error::Kind::badArgument where the buffer was moved from.
    Internals& internals() const;
    std::unique_ptr<Internals> internals_;
};

struct ShadowInputs {
    View view{};
    AreaLight light{};
    std::span<const Caster> casters{};
};

/// Whether a light's visibility differs by channel, so that its VisibilityBuffer must be colored: it is
/// textured, or a caster is a pane.
PENUMBRA_API bool needsColor(const AreaLight& light, std::span<const Caster> casters);

/// One of the lights of a frame.
struct FrameLight {
    AreaLight light{};
    /// Filled as by Technique::render. Not null, and no other light's.
    VisibilityBuffer* out = nullptr;
    bool castsShadow = true;  ///< false: as if there were no casters
};

/// What the lights of a frame share, and the lights.
struct FrameInputs {
    View view{};
    std::span<const Caster> casters{};
    std::span<const FrameLight> lights{};
    /// Called once for each light, in their order, with its place among them, when it has been answered.
    /// Until it returns Technique::inspect and statistics tell of that light; nothing else may be called in
    /// it. May be empty.
    std::function<void(std::size_t light)> answered{};
};

struct Statistic {
    std::string_view name;  ///< "maps", "silhouette edges", ...; valid for ever
    double value = 0;
    std::string_view unit = "";
};

/// Device time of a pass, from timer queries. Taken without waiting, so that it lags some frames behind.
struct PassTime {
    std::string_view name;  ///< valid for ever
    double milliseconds = 0;
};

struct Statistics {
    std::vector<Statistic> counts{};

    /// Which technique has answered, with which setting, where one (`auto`) takes another. Empty: itself.
    struct Chosen {
        std::string_view technique, parameter, value;
    };
    Chosen chosen = {};
    std::vector<PassTime> passes{};
};

/// How an intermediate buffer is best shown.
struct InspectedTexture {
    std::string_view name;      ///< "depth map", "shadow-width map", ...; valid for ever
    std::uint32_t texture = 0;  ///< GL_TEXTURE_2D or GL_TEXTURE_2D_ARRAY, owned by the technique
    int layers = 1;
    float black = 0;  ///< the value to show as black
    float white = 1;  ///< the value to show as white
};

class PENUMBRA_API InspectionVisitor {
  public:
    virtual ~InspectionVisitor() = default;
    virtual void texture(const InspectedTexture& texture) = 0;
};

/// One way to answer. Keeps what it needs between frames; destroying it frees everything.
class PENUMBRA_API Technique {
  public:
    virtual ~Technique() = default;

    /// Visits every parameter, in the order in which a person wants to read them. A value that the visitor
    /// leaves outside of the range is put back, and Error::Kind::badArgument thrown. The references that a
    /// visitor gets are valid during the visit.
    virtual void describe(ParameterVisitor& visitor) = 0;

    /// Fills `out`, which has the view's size and is colored where `needsColor` says so. Equal inputs give
    /// equal bits. The host may then sample, fetch, load or blit from the texture without a barrier of its
    /// own.
    ///
    /// Once sizes and casters have settled, nothing is allocated, compiled or read back. Sizes may change
    /// from call to call; what is allocated follows.
    virtual void render(const ShadowInputs& inputs, VisibilityBuffer& out) = 0;

    /// Several lights of a frame at once: for each the bits that `render` gives for it. What follows from the
    /// view and the casters alone is made once for all, where a technique can. There may be no light.
    virtual void renderLights(const FrameInputs& frame);

    /// Whether `render` takes points in place of a picture (View::isOfPoints). Where it does not, it throws
    /// Error::Kind::badArgument for them.
    virtual bool answersAtPoints() const { return false; }

    /// Whether `render` answers for LightShape::cylinder as it is. Where it does not, it takes a flat strip
    /// for it, as long and as wide, that shines both ways and is turned to the middle of the casters' boxes;
    /// a warning in the log says so once.
    virtual bool answersTubes() const { return false; }

    /// Whether `render` takes from the light what panes take (Caster::transmittance). Where it does not,
    /// panes cast no shadow; a warning in the log says so once.
    virtual bool answersPanes() const { return false; }

    /// Visits the intermediate buffers of the last render, or of the light that was answered last.
    virtual void inspect(InspectionVisitor&) const {}

    /// Of the last render, or of the light that was answered last. Times of passes lag behind and wait for
    /// nothing; counts may wait for the device.
    virtual Statistics statistics() const { return {}; }
};

/// Its strings are valid for ever.
struct TechniqueInfo {
    std::string_view name;     ///< as on the command line: "hard"
    std::string_view summary;  ///< one line
};

/// All techniques of the catalog, in the order in which they are listed.
PENUMBRA_API std::span<const TechniqueInfo> techniqueCatalog();

/// Makes a technique on `device`, which must outlive it. Throws Error::Kind::unknownName, listing the names
/// there are. Without a name it takes whichever keeps `max_error` at the least cost: docs/manual/choosing.md.
PENUMBRA_API std::unique_ptr<Technique> makeTechnique(Device& device, std::string_view name = "auto");

/// Renders into the void and waits, so that drivers compile and everything is allocated before the first
/// frame and not in it.
PENUMBRA_API void prewarm(Device& device, Technique& technique, const ShadowInputs& inputs);

}  // namespace penumbra
