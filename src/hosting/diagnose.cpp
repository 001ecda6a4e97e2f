// SPDX-License-Identifier: Apache-2.0
#include "penumbra/diagnose.h"

#include <algorithm>
#include <cmath>
#include <sstream>

#include "src/device/host_scope.h"
#include "src/device/input_checks.h"
#include "src/geometry/caster_checks.h"
#include "src/hosting/depth_agreement.h"
#include "src/hosting/diagnose_in_scope.h"
#include "src/hosting/host_view.h"
#include "src/hosting/readings.h"
#include "src/hosting/stored_depth.h"

namespace penumbra {
namespace {

/// From here on what is left may be the edges of things and a caster or two.
constexpr double goodShare = 0.9;
/// Of a caster that fits.
constexpr double goodCasterShare = 0.5;
/// Pixels of which something can be said.
constexpr std::size_t fewPixels = 16;
/// The share of surfaces from which it is told that no caster accounts for them; fewer would be called 0 %.
constexpr double noticedShare = 0.005;
/// From where an offset of depths is told, of a pixel's step, and a sample's place, in pixels.
constexpr double noticedFactor = 0.004, noticedUnits = 24, noticedShift_px = 0.05;

HostDepths read(GLuint texture, const View& view, const View& asGiven) {
    HostDepths depths;
    depths.values.resize(std::size_t(view.width_px) * std::size_t(view.height_px));
    GLint type = GL_NONE;
    glGetTextureLevelParameteriv(texture, 0, GL_TEXTURE_DEPTH_TYPE, &type);
    glGetTextureImage(texture, 0, type == GL_NONE ? GL_RED : GL_DEPTH_COMPONENT, GL_FLOAT,
                      GLsizei(depths.values.size() * sizeof(float)), depths.values.data());
    depths.background = view.depth.reversed ? 0.0f : 1.0f;
    const double ofFloats = std::exp2(-24), step = fixedDepthStep(asGiven.depthTexture);  // near 1
    depths.leastDifference = step > 0 ? step : ofFloats;
    return depths;
}

std::string percent(double share) {
    std::ostringstream text;
    text << std::lround(100 * share) << " %";
    return text.str();
}

/// The findings of one call, as they come.
class Search {
  public:
    Search(Device::Internals& device, const View& view, const View& plain, std::span<const Caster> casters)
        : view_(view),
          casters_(casters),
          painter_(device, view.width_px, view.height_px),
          depths_(read(plain.depthTexture, plain, view)),
          stated_(readingOf(plain, casters)) {}

    Diagnosis run() {
        if (saysNothingToCompare()) return result_;
        CasterPicture picture = painter_.draw(casters_, stated_);
        Agreement best = compare(depths_, picture, stated_);
        result_.agreement = best.share();
        Reading reading = stated_;
        if (best.share() < goodShare) {
            if (const OtherReading* const other = bestOther(best)) {
                say(other->finding);
                reading = other->reading;
                picture = painter_.draw(casters_, reading);
                best = compare(depths_, picture, reading);
            }
        }
        if (result_.findings.empty()) sayOfSmallDifferences(picture, reading);
        if (result_.findings.empty() && best.share() < goodShare) sayOfPlanes(picture);
        if (result_.findings.empty()) sayOfCasters(picture, reading, best);
        if (result_.findings.empty() && best.share() < goodShare) {
            say("the depths agree with the casters in " + percent(best.share()) +
                " of the pixels, and no one mistake explains the rest: is the view's matrix, or its "
                "projection, "
                "that of this frame and of these depths?");
        }
        return result_;
    }

  private:
    void say(std::string finding) { result_.findings.push_back(std::move(finding)); }

    bool saysNothingToCompare() {
        const auto isBackground = [](float depth) { return depth == 0 || depth == 1; };
        if (std::ranges::all_of(depths_.values, isBackground)) {
            say("the depths show no surface: give the texture that this frame's depth was drawn into, after "
                "it "
                "was drawn and before it is cleared");
        } else if (std::ranges::any_of(depths_.values, [](float d) { return !(d >= 0 && d <= 1); })) {
            say("the depths do not lie in 0..1: linear distances are not taken; give what the depth test "
                "compares");
        } else if (casters_.empty()) {
            say("there are no casters: give all objects, receivers that cast nothing included");
        } else {
            return false;
        }
        return true;
    }

    /// The one that fits best, if it fits much better than what is stated.
    const OtherReading* bestOther(const Agreement& stated) {
        others_ = otherReadings(stated_, view_.width_px, view_.height_px);
        const OtherReading* best = nullptr;
        double share = std::max(0.5, stated.share() + 0.2);
        for (const OtherReading& other : others_) {
            const double now =
                compare(depths_, painter_.draw(casters_, other.reading), other.reading).share();
            if (now <= share) continue;
            best = &other;
            share = now;
        }
        return best;
    }

    void sayOfSmallDifferences(const CasterPicture& picture, const Reading& reading) {
        const TwoTerms offset = fitTwoTerms(depths_, picture, reading, SmallDifference::offset);
        const TwoTerms place = fitTwoTerms(depths_, picture, reading, SmallDifference::place);
        if (std::max(offset.share, place.share) < goodShare) return;
        std::ostringstream text;
        text.precision(2);
        if (place.share > offset.share) {
            if (std::hypot(place.first, place.second) <= noticedShift_px) return;
            text << "the depths are of places (" << -place.first << ", " << -place.second
                 << ") pixels from where they are said to be: set View::samplePlace, give the jittered "
                 << "View::clipFromView, or move View::x_px and y_px";
        } else if (std::abs(offset.first) > noticedFactor) {
            text << "the depths lie behind or before the casters by a polygon offset with a factor near "
                 << offset.first + view_.polygonOffset.factor << ": set View::polygonOffset, or switch "
                 << "GL_POLYGON_OFFSET_FILL off";
        } else if (std::abs(offset.second) > noticedUnits) {
            text
                << "the depths lie behind or before the casters by the same difference everywhere, a polygon "
                << "offset of " << offset.second + view_.polygonOffset.units
                << " units: set View::polygonOffset, or switch GL_POLYGON_OFFSET_FILL off";
        } else {
            return;
        }
        say(text.str());
    }

    void sayOfPlanes(const CasterPicture& picture) {
        const DepthLine line = fitDepthLine(depths_, picture);
        if (line.share < goodShare) return;
        say("the depths are those of a camera with another near or far plane, or of another depth range "
            "(glDepthRange): give the View::clipFromView that they were drawn with");
    }

    void sayOfCasters(const CasterPicture& picture, const Reading& reading, const Agreement& all) {
        std::size_t wrong = 0, seen = 0;
        std::string names;
        for (std::size_t i = 0; i < casters_.size(); ++i) {
            const Agreement one = compareCaster(depths_, picture, reading, i);
            if (one.surfaces < fewPixels) continue;
            ++seen;
            if (one.share() >= goodCasterShare) continue;
            constexpr std::size_t namedCasters = 8;
            if (++wrong <= namedCasters) names += (names.empty() ? "" : ", ") + std::to_string(i);
        }
        if (wrong > 0 && wrong < seen) {
            say("casters[" + names +
                "] are not where the depths show them, or are not in them: is their worldFromMesh, or their "
                "mesh, that of this frame, and are they drawn?");
            return;
        }
        if (wrong > 0) return;
        const auto noticed = [&](std::size_t pixels) {
            return pixels >= fewPixels && double(pixels) > noticedShare * double(all.surfaces);
        };
        if (noticed(all.missing)) {
            say("the depths show surfaces that no caster accounts for (" +
                percent(double(all.missing) / double(all.surfaces)) +
                " of them): give all objects that are drawn, receivers that cast nothing included");
        } else if (noticed(all.extra)) {
            say("casters are nearer than the depths show (" +
                percent(double(all.extra) / double(all.surfaces)) +
                " of the surfaces): are objects among them that are not drawn, or without their alpha "
                "masks?");
        }
    }

    const View& view_;
    std::span<const Caster> casters_;
    CasterPainter painter_;
    HostDepths depths_;
    Reading stated_;
    std::vector<OtherReading> others_;
    Diagnosis result_;
};

}  // namespace

Diagnosis diagnoseInScope(Device::Internals& device, const View& view, std::span<const Caster> casters) {
    const ReadableTexture depth(view.depthTexture);
    View depthsAlone = view;
    depthsAlone.normalTexture = depthsAlone.shadingNormalTexture = depthsAlone.receiverTexture = 0;
    HostView hostView(device);
    // With the casters, as techniques see it: slopes that are guessed at, to take a polygon offset out, are
    // too steep rather than too gentle, and what they lift too far would be surfaces of no caster.
    View plain = hostView.prepare(depthsAlone, casters);
    // Techniques take the nearest depth that may have become what is stored; here it is the likeliest.
    for (std::size_t column = 0; column < 4; ++column)
        plain.clipFromView.columns[column][2] = view.clipFromView.columns[column][2];
    return Search(device, view, plain, casters).run();
}

Diagnosis diagnose(Device& device, const View& view, std::span<const Caster> casters) {
    const HostScope scope(internalsOf(device));
    checkView(view);
    checkCasters(casters, internalsOf(device));
    return diagnoseInScope(internalsOf(device), view, casters);
}

}  // namespace penumbra
