// SPDX-License-Identifier: Apache-2.0
#include "studio/viewer/grid_overlay.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "studio/measure/plan_of.h"
#include "studio/metrics/false_color.h"
#include "studio/viewer/numbers.h"

namespace penumbra::studio::viewer {
namespace {

constexpr int mostLevels = 9, cellAlpha = 150;
constexpr ImU32 lineColor = IM_COL32(255, 255, 255, 235), lineShadow = IM_COL32(0, 0, 0, 150),
                boxColor = IM_COL32(12, 13, 16, 200), textColor = IM_COL32(255, 255, 255, 255);

class GridPainter {
  public:
    GridPainter(const CanvasPlace& place, const Session& session, const Measurement& measured, float scale)
        : list_(*ImGui::GetBackgroundDrawList()),
          place_(place),
          projection_(session.cameraView(), {place.size.x, place.size.y}),
          frame_(*measured.set.grid),
          values_(gridOf(measured)),
          scale_(scale) {
        for (const double value : values_.values) {
            if (!std::isfinite(value)) continue;
            least_ = std::min(least_, value);
            largest_ = std::max(largest_, value);
        }
    }

    void paint(bool withNumbers) {
        paintCells();
        paintBorder();
        paintIsolines();
        if (withNumbers) paintNumbers();
    }

  private:
    /// Of columns and rows from the frame's corner.
    std::optional<ImVec2> at(double column, double row) const {
        const glm::dvec3 posWorld = frame_.cornerWorld + column * frame_.cellWidth_m() * frame_.acrossWorld +
                                    row * frame_.cellDepth_m() * frame_.alongWorld;
        const auto pixel = projection_.pixelOf(glm::vec3(posWorld));
        if (!pixel) return {};
        return ImVec2(place_.min.x + pixel->x, place_.min.y + pixel->y);
    }

    void paintCells() {
        const double span = largest_ > least_ ? largest_ - least_ : 1;
        for (int row = 0; row < values_.rows; ++row) {
            for (int column = 0; column < values_.columns; ++column) {
                const double value = values_.at(column, row);
                if (!std::isfinite(value)) continue;
                const auto a = at(column, row), b = at(column + 1, row), c = at(column + 1, row + 1),
                           d = at(column, row + 1);
                if (!a || !b || !c || !d) continue;
                const std::array<float, 3> color = orderedColor(float((value - least_) / span));
                list_.AddQuadFilled(
                    *a, *b, *c, *d,
                    IM_COL32(int(255 * color[0]), int(255 * color[1]), int(255 * color[2]), cellAlpha));
            }
        }
    }

    void paintBorder() {
        const std::array<glm::dvec2, 5> corners = {
            glm::dvec2(0, 0), {frame_.columns, 0}, {frame_.columns, frame_.rows}, {0, frame_.rows}, {0, 0}};
        for (std::size_t i = 1; i < corners.size(); ++i) {
            const auto a = at(corners[i - 1].x, corners[i - 1].y), b = at(corners[i].x, corners[i].y);
            if (a && b) list_.AddLine(*a, *b, lineColor, 1.5f * scale_);
        }
    }

    void paintIsolines() {
        for (const double level : roundLevels(least_, largest_, mostLevels)) {
            for (const Isoline& line : isolinesOf(values_, level)) {
                for (std::size_t i = 1; i < line.places.size(); ++i) {
                    // Whole columns and rows are cells' middles.
                    const auto a = at(line.places[i - 1].x + 0.5, line.places[i - 1].y + 0.5),
                               b = at(line.places[i].x + 0.5, line.places[i].y + 0.5);
                    if (!a || !b) continue;
                    list_.AddLine(*a, *b, lineShadow, 3 * scale_);
                    list_.AddLine(*a, *b, lineColor, 1.3f * scale_);
                }
                const glm::dvec2 middle = line.places[line.places.size() / 2];
                if (const auto place = at(middle.x + 0.5, middle.y + 0.5))
                    number(*place, plainNumber(level, 3), true);
            }
        }
    }

    void paintNumbers() {
        for (int row = 0; row < values_.rows; ++row) {
            for (int column = 0; column < values_.columns; ++column) {
                const double value = values_.at(column, row);
                const auto middle = at(column + 0.5, row + 0.5);
                if (std::isfinite(value) && middle) number(*middle, plainNumber(value, 3), false);
            }
        }
    }

    /// Where none stands yet.
    void number(const ImVec2& middle, const std::string& text, bool ofLine) {
        const ImVec2 size = ImGui::CalcTextSize(text.c_str());
        const float pad = 2 * scale_;
        const ImVec2 min(middle.x - 0.5f * size.x - pad, middle.y - 0.5f * size.y),
            max(middle.x + 0.5f * size.x + pad, middle.y + 0.5f * size.y);
        const auto covers = [&](const std::array<ImVec2, 2>& box) {
            return min.x < box[1].x && max.x > box[0].x && min.y < box[1].y && max.y > box[0].y;
        };
        if (!place_.contains(min) || std::ranges::any_of(taken_, covers)) return;
        taken_.push_back({min, max});
        if (ofLine)
            list_.AddRectFilled(min, max, boxColor, 3 * scale_);
        else
            list_.AddText({min.x + pad + 1, min.y + 1}, lineShadow, text.c_str());
        list_.AddText({min.x + pad, min.y}, textColor, text.c_str());
    }

    ImDrawList& list_;
    const CanvasPlace& place_;
    Projection projection_;
    const GridFrame& frame_;
    ValueGrid values_;
    float scale_;
    double least_ = std::numeric_limits<double>::infinity(), largest_ = -least_;
    std::vector<std::array<ImVec2, 2>> taken_;
};

}  // namespace

void drawGridOverlay(const CanvasPlace& place, const Session& session, float scale) {
    const Measurement* const measured = session.grid().measurement();
    if (measured == nullptr) return;
    ImDrawList& list = *ImGui::GetBackgroundDrawList();
    list.PushClipRect(place.min, {place.min.x + place.size.x, place.min.y + place.size.y});
    GridPainter(place, session, *measured, scale).paint(session.choices().grid->showsNumbers);
    list.PopClipRect();
}

}  // namespace penumbra::studio::viewer
